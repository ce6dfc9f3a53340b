// Lookup in one-dimensional textures: t counts for nothing, neither for the texel nor for the level
// (spec 3.8.8).
#include <gtest/gtest.h>

#include "tests/oracle/fragment.h"
#include "tests/oracle/triangle.h"
#include "tests/support/canvas.h"
#include "tests/support/textures.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kSize = 64;

// The same texture twice: with one row as the oracle has it, and as the raster room wants it, the rows of the
// border being the row itself.
class Row {
 public:
  explicit Row(int border) : border_(border) {}

  void add_level(Random& random, int width) {
    std::vector<uint8_t> row(4 * size_t(width + 2 * border_));
    for (uint8_t& component : row) component = uint8_t(random.bits());
    texture_.define_level(int(levels_.size()), width, 1, border_, BaseFormat::rgba,
                          [&](int) { return row.data(); });
    std::vector<uint8_t> rows;
    for (int j = -border_; j < 1 + border_; ++j) rows.insert(rows.end(), row.begin(), row.end());
    levels_.push_back({width, 1, border_, std::move(rows)});
  }
  std::shared_ptr<const TextureView> view(Sampler sampler) {
    sampler.wrap_t = Wrap::repeat;
    sampler.one_dimensional = true;
    return texture_.view(sampler, int(levels_.size()));
  }
  oracle::Texture reference(Sampler sampler) const {
    sampler.wrap_t = Wrap::clamp_to_edge;
    return {levels_, sampler};
  }

 private:
  int border_;
  std::vector<oracle::Level> levels_;
  Texture texture_;
};

struct Drawn {
  Picture picture;
  oracle::Triangle triangle;
  std::array<long double, 3> s;
};

// One triangle with s as given and t as wild as it likes.
Drawn draw_triangle(Random& random, std::shared_ptr<const TextureView> view, bool perspective, float s_range,
                    float t_range, Accuracy accuracy) {
  DrawState state = plain_state(kSize, kSize);
  state.texture.view = std::move(view);
  state.texture.env = EnvMode::replace;
  state.accuracy = accuracy;
  std::vector<Vertex> vertices(3);
  std::array<oracle::ClipPoint, 3> clip;
  std::array<long double, 3> s;
  for (size_t i = 0; i < 3; ++i) {
    Vertex& v = vertices[i];
    v.w = perspective ? random.real(0.5f, 6) : 1;
    v.x = v.w * random.real(-1.5f, 1.5f);
    v.y = v.w * random.real(-1.5f, 1.5f);
    v.s = random.real(-s_range, s_range);
    v.t = random.real(-t_range, t_range);
    clip[i] = {double(v.x), double(v.y), double(v.z), double(v.w)};
    s[i] = static_cast<long double>(v.s);
  }
  Canvas canvas(kSize, kSize);
  canvas.draw(state, Primitive::triangles, vertices);
  return {canvas.read(), oracle::Triangle(state.viewport, clip), s};
}

void expect_close(const Drawn& drawn, int x, int y, const oracle::Rgba& exact, double tolerance,
                  const std::string& what) {
  for (size_t k = 0; k < 4; ++k) {
    ASSERT_LE(std::fabs(double(exact[k] * 255) - drawn.picture.pixel(x, y)[k]), tolerance)
        << what << ", pixel " << x << ", " << y << ", component " << k;
  }
}

TEST(Texture1d, LinearIgnoresT) {
  Random random(1);
  for (int border : {0, 1}) {
    for (Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::clamp_to_edge}) {
      if (border == 1 && wrap == Wrap::repeat) continue;
      Row row(border);
      row.add_level(random, 16);
      Sampler sampler = sampler_of(Filter::linear, wrap);
      sampler.border_color = {0.2f, 0.4f, 0.8f, 0.6f};
      const oracle::Texture reference = row.reference(sampler);
      for (int round = 0; round < (long_tests() ? 60 : 6); ++round) {
        const Accuracy accuracy = round % 3 == 2 ? Accuracy::all(Level::exact) : Accuracy::all(Level::standard);
        const Drawn drawn = draw_triangle(random, row.view(sampler), round % 2 == 1, 3, 40, accuracy);
        for (int y = 0; y < kSize && !testing::Test::HasFatalFailure(); ++y) {
          for (int x = 0; x < kSize; ++x) {
            if (!drawn.triangle.covers(x, y)) continue;
            const auto s = drawn.triangle.attribute(drawn.s, x, y).value;
            expect_close(drawn, x, y, oracle::sample_level(reference, 0, Filter::linear, s, 0.5L), 0.55,
                         "border " + std::to_string(border) + ", wrap " + std::to_string(int(wrap)));
          }
        }
      }
    }
  }
}

// Every level one colour: the picture shows which was taken. A steep t must not make it a smaller one.
TEST(Texture1d, TheLevelFollowsSAlone) {
  Random random(2);
  const Sampler sampler = sampler_of(Filter::linear, Wrap::repeat, MipMode::linear);
  Row row(0);
  for (int width = 256; width > 0; width /= 2) row.add_level(random, width);
  const oracle::Texture reference = row.reference(sampler);
  int compared = 0;
  for (int round = 0; round < (long_tests() ? 60 : 8); ++round) {
    const Drawn drawn =
        draw_triangle(random, row.view(sampler), round % 2 == 1, 0.5f, 200, Accuracy::all(Level::standard));
    for (int y = 0; y < kSize && !testing::Test::HasFatalFailure(); ++y) {
      for (int x = 0; x < kSize; ++x) {
        if (!drawn.triangle.covers(x, y)) continue;
        const auto s = drawn.triangle.attribute(drawn.s, x, y);
        const oracle::Affine<long double> t{0.5L, 0, 0};
        const oracle::Lookup lookup = oracle::sample(reference, s, t);
        // 1/64 of a level of detail is worth up to 4 levels of colour between two levels of noise (NUMERICS).
        expect_close(drawn, x, y, lookup.color, 4.6, "lod " + std::to_string(double(lookup.lod)));
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 1000);
}

}  // namespace
}  // namespace halfspace::test
