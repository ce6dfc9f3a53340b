// HALFSPACE_VIEW: what a shown picture tells of the work, by areas whose fragments and levels are known.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "raster/api/texture.h"
#include "tests/support/canvas.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kSize = 128;
using Rgb = std::array<uint8_t, 3>;

// A canvas whose device looks at HALFSPACE_VIEW=view, and its picture as a program is shown it.
struct Viewed {
  explicit Viewed(const char* view, int threads = 1) {
    setenv("HALFSPACE_VIEW", view, 1);
    canvas = std::make_unique<Canvas>(kSize, kSize, threads);
    unsetenv("HALFSPACE_VIEW");
    canvas->clear();
  }
  // Pixels [x0, x1) of all rows, `color` at all corners.
  void strip(int x0, int x1, const DrawState& state = plain_state(kSize, kSize)) {
    canvas->draw(state, Primitive::quads, snapped_quad(x0 * 256, 0, x1 * 256, kSize * 256, kSize));
  }
  std::vector<uint8_t> show() {
    std::vector<uint8_t> out(size_t{kSize} * kSize * 4);
    LinearImage image;
    image.data = out.data();
    image.row_bytes = kSize * 4;
    image.width = image.height = kSize;
    canvas->device().finish(&image);
    return out;
  }
  std::unique_ptr<Canvas> canvas;
};

Rgb at(const std::vector<uint8_t>& picture, int x, int y) {
  const uint8_t* p = &picture[4 * (size_t(y) * kSize + size_t(x))];
  return {p[0], p[1], p[2]};
}

TEST(View, OverdrawCountsTheFragmentsOfEachPixel) {
  for (const int threads : {1, 3}) {
    Viewed viewed("overdraw", threads);
    viewed.strip(0, 96);
    viewed.strip(32, 96);
    viewed.strip(32, 64);
    const std::vector<uint8_t> shown = viewed.show();
    const Rgb none = at(shown, 100, 5), one = at(shown, 10, 5), two = at(shown, 70, 5),
              three = at(shown, 40, 5);
    EXPECT_EQ((std::set<Rgb>{none, one, two, three}.size()), 4u);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x)
        ASSERT_EQ(at(shown, x, y), x < 32 ? one : x < 64 ? three : x < 96 ? two : none) << x << ", " << y;
    }
  }
}

TEST(View, CountsStartAnewWithEachPictureAndEachClear) {
  Viewed viewed("overdraw");
  viewed.strip(0, 64);
  const std::vector<uint8_t> first = viewed.show();
  viewed.strip(0, 64);
  EXPECT_EQ(viewed.show(), first);
  viewed.strip(0, 128);
  viewed.canvas->device().finish();  // drawn, but never shown
  viewed.canvas->clear();
  viewed.strip(0, 64);
  EXPECT_EQ(viewed.show(), first);
}

TEST(View, TilesAreOutlined) {
  Viewed viewed("tiles");
  viewed.strip(0, kSize);
  const std::vector<uint8_t> shown = viewed.show();
  EXPECT_EQ(at(shown, 64, 10), (Rgb{0, 0, 0}));
  EXPECT_EQ(at(shown, 10, 64), (Rgb{0, 0, 0}));
  const Rgb filled = at(shown, 30, 30);
  EXPECT_EQ(at(shown, 100, 100), filled);
  EXPECT_NE(at(shown, 32, 30), filled);  // a block's edge
  EXPECT_NE(at(shown, 68, 62), filled);  // the quad's diagonal cuts this one
}

// A texture of 64 x 64 on 128, 64, 32 ... pixels: level 0 twice, then 1, 2, 3.
TEST(View, LevelsAreThoseOfTheLookup) {
  Texture texture;
  const std::vector<uint8_t> white(64 * 64 * 4, 255);
  for (int level = 0; level < 7; ++level)
    texture.define_level(level, 64 >> level, 64 >> level, 0, BaseFormat::rgba, white.data(),
                         size_t(64 >> level) * 4);
  Sampler sampler;
  sampler.mip = MipMode::nearest;
  std::vector<Rgb> colors;
  for (const float turns : {1.0f, 2.0f, 4.0f, 8.0f, 16.0f}) {  // over 128 pixels
    Viewed viewed("levels");
    DrawState state = plain_state(kSize, kSize);
    state.texture.view = texture.view(sampler, 7);
    std::vector<Vertex> quad = snapped_quad(0, 0, kSize * 256, kSize * 256, kSize);
    for (Vertex& v : quad) v.s = v.x > 0 ? turns : 0, v.t = v.y > 0 ? turns : 0;
    viewed.canvas->draw(state, Primitive::quads, quad);
    const std::vector<uint8_t> shown = viewed.show();
    colors.push_back(at(shown, 20, 90));
    EXPECT_EQ(at(shown, 90, 20), colors.back());
  }
  EXPECT_EQ(colors[0], colors[1]);
  EXPECT_EQ((std::set<Rgb>(colors.begin(), colors.end()).size()), 4u);
}

TEST(View, NoViewAndAnUnknownOneShowThePicture) {
  std::vector<std::vector<uint8_t>> shown;
  for (const char* view : {"", "wireframe", "no such view"}) {
    Viewed viewed(view);
    viewed.strip(0, 70);
    shown.push_back(viewed.show());
    EXPECT_EQ(at(shown.back(), 69, 3), (Rgb{255, 255, 255}));
    EXPECT_EQ(shown.back(), shown.front());
  }
}

}  // namespace
}  // namespace halfspace::test
