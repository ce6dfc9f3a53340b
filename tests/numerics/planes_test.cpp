// Two colour planes over one depth plane: each gets what it would get alone.
#include <gtest/gtest.h>

#include <memory>

#include "tests/support/canvas.h"
#include "tests/support/random.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kWidth = 150, kHeight = 90;  // no multiple of a block, several tiles

struct TwoPlanes {
  explicit TwoPlanes(bool fuse = true)
      : framebuffer(kWidth, kHeight, ColorFormat::rgba8, 2), device({2, fuse}) {
    device.begin_pass(&framebuffer);
  }
  void clear(uint8_t targets, const Color& color, double depth) {
    ClearCommand command;
    command.color = command.depth = true;
    command.color_targets = targets;
    command.color_value = color;
    command.depth_value = depth;
    device.clear(command);
  }
  void draw(const DrawState& state, const std::vector<Vertex>& vertices) {
    DrawPacket packet;
    packet.state = std::make_shared<DrawState>(state);
    packet.batch.count = packet.index_count = uint32_t(vertices.size());
    packet.batch.position = {&vertices[0].x, sizeof(Vertex), 4};
    packet.batch.color = {&vertices[0].color, sizeof(Vertex), 4};
    device.draw(packet);
  }
  std::vector<uint8_t> read(ColorPlane plane) {
    std::vector<uint8_t> rgba(kWidth * kHeight * 4);
    device.read_color({0, 0, kWidth, kHeight}, rgba.data(), plane);
    return rgba;
  }

  Framebuffer framebuffer;
  Device device;
};

std::vector<Vertex> some_triangles(uint64_t seed, int count) {
  Random random(seed);
  std::vector<Vertex> vertices;
  for (int i = 0; i < 3 * count; ++i) {
    Vertex v;
    v.x = random.real(-1.2f, 1.2f);
    v.y = random.real(-1.2f, 1.2f);
    v.z = random.real(-0.9f, 0.9f);
    v.color = {random.real(0, 1), random.real(0, 1), random.real(0, 1), random.real(0, 1)};
    vertices.push_back(v);
  }
  return vertices;
}

DrawState state_for(uint8_t targets, int variant) {
  DrawState state = plain_state(kWidth, kHeight);
  state.color_targets = targets;
  state.depth = {true, CompareFunc::less, true};
  if (variant & 1) state.blend = {true, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha};
  if (variant & 2) state.alpha_test = {true, CompareFunc::greater, 0.4f};
  if (variant & 4) state.color_mask.g = false;
  return state;
}

constexpr Color kBackColor{0.2f, 0.4f, 0.6f, 1}, kFrontColor{0.9f, 0.1f, 0.3f, 0.5f};

// `targets` at once, over planes of different colours.
void draw_scene(TwoPlanes& planes, uint8_t targets, int variant) {
  planes.clear(kBackPlane, kBackColor, 1);
  planes.clear(kFrontPlane, kFrontColor, 1);
  planes.draw(state_for(targets, variant), some_triangles(5, 60));
}

TEST(Planes, DrawnTogetherAsDrawnAlone) {
  for (int variant = 0; variant < 8; ++variant) {
    for (const bool fuse : {true, false}) {
      TwoPlanes both(fuse), back(fuse), front(fuse);
      draw_scene(both, kBackPlane | kFrontPlane, variant);
      draw_scene(back, kBackPlane, variant);
      draw_scene(front, kFrontPlane, variant);
      EXPECT_EQ(both.read(kBackPlane), back.read(kBackPlane)) << variant << fuse;
      EXPECT_EQ(both.read(kFrontPlane), front.read(kFrontPlane)) << variant << fuse;
      EXPECT_NE(both.read(kBackPlane), both.read(kFrontPlane));
      // The plane that is not drawn to is as it was cleared.
      TwoPlanes cleared;
      cleared.clear(kBackPlane, kBackColor, 1);
      cleared.clear(kFrontPlane, kFrontColor, 1);
      EXPECT_EQ(front.read(kBackPlane), cleared.read(kBackPlane));
      EXPECT_EQ(back.read(kFrontPlane), cleared.read(kFrontPlane));
    }
  }
}

TEST(Planes, DepthIsShared) {
  TwoPlanes planes;
  planes.clear(kBackPlane | kFrontPlane, kBackColor, 1);
  const auto square = [](float z, const Color& color) {
    return std::vector<Vertex>{{-1, -1, z, 1, color}, {3, -1, z, 1, color}, {-1, 3, z, 1, color}};
  };
  planes.draw(state_for(kBackPlane, 0), square(0, {0, 1, 0, 1}));
  planes.draw(state_for(kFrontPlane, 0), square(0.5f, {1, 1, 1, 1}));  // hidden by what the other plane shows
  TwoPlanes untouched;
  untouched.clear(kFrontPlane, kBackColor, 1);
  EXPECT_EQ(planes.read(kFrontPlane), untouched.read(kFrontPlane));
}

// With no plane to draw to, depth is drawn all the same.
TEST(Planes, WithoutColourDepthIsDrawn) {
  TwoPlanes planes, usual;
  draw_scene(planes, 0, 0);
  draw_scene(usual, kBackPlane, 0);
  std::vector<uint32_t> depth(kWidth * kHeight), expected(kWidth * kHeight);
  planes.device.read_depth({0, 0, kWidth, kHeight}, depth.data());
  usual.device.read_depth({0, 0, kWidth, kHeight}, expected.data());
  EXPECT_EQ(depth, expected);
  TwoPlanes cleared;
  cleared.clear(kBackPlane, kBackColor, 1);
  EXPECT_EQ(planes.read(kBackPlane), cleared.read(kBackPlane));
}

// A clear of one plane must not drop what is pending for the other.
TEST(Planes, AClearOfOneLeavesWorkPendingForTheOther) {
  TwoPlanes planes, expected;
  draw_scene(planes, kBackPlane, 0);
  planes.clear(kFrontPlane, kFrontColor, 1);
  draw_scene(expected, kBackPlane, 0);
  EXPECT_EQ(planes.read(kBackPlane), expected.read(kBackPlane));
}

TEST(Planes, CopiesOfAPart) {
  for (const Rect& part : {Rect{0, 0, kWidth, kHeight}, Rect{7, 3, 131, 71}, Rect{64, 0, 128, 64}}) {
    TwoPlanes planes;
    draw_scene(planes, kBackPlane, 0);
    const auto back = planes.read(kBackPlane), front = planes.read(kFrontPlane);
    planes.device.copy_plane(kBackPlane, kFrontPlane, part);
    const auto copied = planes.read(kFrontPlane);
    EXPECT_EQ(planes.read(kBackPlane), back);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const bool inside = x >= part.x0 && x < part.x1 && y >= part.y0 && y < part.y1;
        const size_t at = size_t(y * kWidth + x) * 4;
        for (size_t c = 0; c < 4; ++c)
          ASSERT_EQ(copied[at + c], (inside ? back : front)[at + c]) << x << "," << y;
      }
    }
  }
}

}  // namespace
}  // namespace halfspace::test
