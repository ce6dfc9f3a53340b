// With several threads small draws, and those that come vertex by vertex, wait until another thread takes
// them up (raster/waiting_draws.h). What they leave is what each leaves that is taken up at once, on random
// streams: of all faces, with and without indices, colours, coordinates, materials; between them matrices
// that change, larger draws, lines, images and clears, all of which must keep their turn.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <vector>

#include "tests/support/canvas.h"
#include "tests/support/random.h"
#include "tests/support/textures.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kWidth = 150, kHeight = 100;
constexpr int kDraws = 700;  // more than a batch has

class Stream {
 public:
  Stream(uint64_t seed, std::span<TestTexture> textures) : random_(seed), textures_(textures) {
    state_ = plain_state(128, 128);
    state_.rest_version = 1;
    state_.depth = {seed % 2 == 0, CompareFunc::less, true};
    state_.lighting.lights[0].enabled = true;
    state_.lighting.lights[0].diffuse = {0.7f, 0.9f, 0.8f, 1};
    state_.lighting.lights[0].position = {0.5, 0.25, 1, 0};
  }

  void next(Device& device) {
    for (auto changes = random_.integer(0, 2); changes > 0; --changes) change();
    switch (random_.integer(0, 39)) {
      case 0:
        return clear(device);
      case 1:
        return draw_image(device);
      case 2:
        return draw(device, Primitive(random_.integer(0, 3)), random_.integer(0, 9));  // points and lines
      case 3:
        return draw(device, Primitive::triangles, random_.integer(1, 300));
      case 4:
        return draw(device, Primitive::quads, random_.integer(1, 300), true);
      default:
        return draw(device, Primitive(random_.integer(4, 9)), random_.integer(1, 16),
                    random_.integer(0, 1) != 0);
    }
  }

 private:
  Color some_color() {
    std::array<float, 4> c;
    for (float& v : c) v = random_.real(0, 1);
    return {c[0], c[1], c[2], c[3]};
  }
  bool chance(int64_t one_in) { return random_.integer(1, one_in) == 1; }

  // Of what stands before rest_version, and of the rest, which gets a new number.
  void change() {
    if (random_.integer(0, 3) != 0) return change_often();
    state_.rest_version = chance(8) ? 0 : ++version_;
    switch (random_.integer(0, 10)) {
      case 0:
        state_.raster.flat_shading = !state_.raster.flat_shading;
        break;
      case 1:
        state_.raster.cull_back = !state_.raster.cull_back;
        break;
      case 2:
        state_.raster.scissor_test = !state_.raster.scissor_test;
        state_.raster.scissor = {10, 5, 10 + static_cast<int>(random_.integer(1, 120)), 90};
        break;
      case 3:
        state_.lighting.enabled = !state_.lighting.enabled;
        state_.lighting.two_sided = chance(2);
        state_.lighting.color_material_front.diffuse = chance(2);
        break;
      case 4:
        state_.fog.enabled = !state_.fog.enabled;
        break;
      case 5:
        state_.tex_gen.coord[0].mode = chance(2) ? TexGenMode::off : TexGenMode::object_linear;
        state_.tex_gen.coord[0].object_plane = {0.5, 0.25, 0, 0.125};
        break;
      case 6:
        state_.polygon.front = chance(3) ? PolygonMode::line : PolygonMode::fill;
        break;
      case 7:
        state_.clip_planes.enabled = chance(2) ? 1 : 0;
        state_.clip_planes.planes[0] = {1, 0.5, 0, 0.5};
        break;
      case 8:
        state_.depth.test = chance(3);  // without it the order shows
        break;
      case 9:
        state_.accuracy.transform = Level(random_.integer(0, 2));
        break;
      default:
        state_.texture.matrix_is_identity = chance(2);
        state_.texture.matrix[0] = state_.texture.matrix_is_identity ? 1 : 0.75;
        break;
    }
  }

  void change_often() {
    if (chance(3)) {
      const auto i = static_cast<size_t>(random_.integer(0, 4));
      state_.texture.view =
          i < textures_.size() ? textures_[i].view(sampler_of(Filter::linear, Wrap::repeat)) : nullptr;
      return;
    }
    state_.clip_from_object[0] = double(random_.real(0.2f, 1.5f));
    state_.clip_from_object[12] = double(random_.real(-1, 1));
    state_.clip_from_object[13] = double(random_.real(-1, 1));
    state_.clip_from_object[11] = chance(3) ? 0.5 : 0;
    state_.eye_from_object[14] = double(random_.real(-2, 0));
  }

  void draw(Device& device, Primitive primitive, int64_t vertices, bool gathered = false) {
    const auto count = static_cast<size_t>(vertices);
    std::vector<Vertex> corners(count);
    const float reach = chance(10) ? 3.0f : 0.4f;  // some are cut
    for (Vertex& v : corners) {
      v = {random_.real(-reach, reach),
           random_.real(-reach, reach),
           random_.real(-1, reach),
           1,
           some_color(),
           0,
           0,
           0,
           1};
      v.s = random_.real(-2, 2), v.t = random_.real(-2, 2), v.q = chance(4) ? 2.0f : 1.0f;
    }
    std::vector<uint32_t> bytes(count), indices, material_of(count);
    for (uint32_t& b : bytes) b = static_cast<uint32_t>(random_.bits());
    DrawPacket packet;
    packet.state = std::make_shared<DrawState>(state_);
    packet.primitive = primitive;
    packet.gathered = gathered;
    packet.index_count = packet.batch.count = static_cast<uint32_t>(count);
    if (count == 0) return device.draw(packet);
    packet.batch.position = {&corners[0].x, sizeof(Vertex), static_cast<uint8_t>(random_.integer(2, 4))};
    packet.batch.color = {&corners[0].color, chance(3) ? 0 : sizeof(Vertex),
                          static_cast<uint8_t>(chance(2) ? 3 : 4)};
    if (chance(4)) packet.batch.color = {bytes.data(), sizeof(uint32_t), 4, true};
    packet.batch.tex_coord = {&corners[0].s, sizeof(Vertex), static_cast<uint8_t>(random_.integer(1, 4))};
    if (chance(2)) packet.batch.normal = {&corners[0].color, sizeof(Vertex), 3};
    std::vector<MaterialPair> materials(3);
    if (chance(3)) {
      for (MaterialPair& pair : materials) pair.front.diffuse = pair.back.emission = some_color();
      for (uint32_t& m : material_of) m = static_cast<uint32_t>(random_.integer(0, 2));
      packet.batch.material_index = material_of.data();
      packet.materials = materials;
    }
    if (chance(2)) {
      for (int64_t n = random_.integer(1, vertices + 12); n > 0; --n)
        indices.push_back(static_cast<uint32_t>(random_.integer(0, vertices - 1)));
      packet.indices = indices.data();
      packet.index_count = static_cast<uint32_t>(indices.size());
    }
    device.draw(packet);
  }

  void draw_image(Device& device) {
    std::array<float, 4 * 16> colors;
    for (float& c : colors) c = random_.real(0, 1);
    PixelPacket packet;
    packet.state = std::make_shared<DrawState>(state_);
    packet.width = packet.height = 4;
    packet.row_elements = 4;
    packet.color = colors.data();
    packet.x = double(random_.real(0, kWidth)), packet.y = double(random_.real(0, kHeight));
    packet.zoom_x = packet.zoom_y = 5;
    packet.raster_depth = double(random_.real(0, 1));
    device.draw_pixels(packet);
  }

  // Of a part, mostly: else little would be left to see.
  void clear(Device& device) {
    ClearCommand command;
    command.color = command.depth = true;
    command.color_value = some_color();
    command.scissor_test = !chance(20);
    const auto x = static_cast<int>(random_.integer(0, kWidth)),
               y = static_cast<int>(random_.integer(0, kHeight));
    command.scissor = {x, y, x + 40, y + 20};
    device.clear(command);
  }

  Random random_;
  std::span<TestTexture> textures_;
  DrawState state_;
  uint64_t version_ = 1;
};

struct Outcome {
  Picture picture;
  uint64_t draws, vertices, triangles, culled, clipped;
};

Outcome draw_stream(uint64_t seed, std::span<TestTexture> textures, int threads) {
  Stream stream(seed, textures);
  Canvas canvas(kWidth, kHeight, threads);
  canvas.clear({0.1f, 0.2f, 0.3f, 0.4f}, 1);
  for (int i = 0; i < kDraws; ++i) stream.next(canvas.device());
  Picture picture = canvas.read();
  const DeviceStatistics& s = canvas.device().statistics();
  return {std::move(picture), s.draws, s.vertices, s.triangles, s.culled, s.clipped};
}

TEST(WaitingDraws, LeaveWhatEachAloneDoes) {
  std::array<TestTexture, 3> textures;
  Random random(5);
  for (TestTexture& texture : textures) texture.add_noise(random, 16, 16);
  const uint64_t seeds = long_tests() ? 400 : 25;
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    const Outcome alone = draw_stream(seed, textures, 1);
    for (const int threads : {2, 3, 8}) {
      const Outcome waited = draw_stream(seed, textures, threads);
      ASSERT_EQ(first_difference(alone.picture, waited.picture), "")
          << "seed " << seed << ", " << threads << " threads";
      EXPECT_EQ(alone.draws, waited.draws);
      EXPECT_EQ(alone.vertices, waited.vertices);
      EXPECT_EQ(alone.triangles, waited.triangles) << "seed " << seed << ", " << threads << " threads";
      EXPECT_EQ(alone.culled, waited.culled) << "seed " << seed << ", " << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace halfspace::test
