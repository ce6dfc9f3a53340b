// Texture storage: what a view sees, skirt included, and who keeps which texels when.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

#include "raster/isa.h"
#include "raster/texture/level.h"

namespace halfspace::raster {
namespace {

struct Image {
  int width, height;
  std::vector<uint8_t> bytes;

  Image(int w, int h, uint32_t seed) : width(w), height(h), bytes(size_t(w) * size_t(h) * 4) {
    std::mt19937 rng(seed);
    for (uint8_t& b : bytes) b = uint8_t(rng());
  }
  size_t stride() const { return size_t(width) * 4; }
  uint32_t texel(int x, int y) const {
    const uint8_t* p = &bytes[size_t(y) * stride() + size_t(x) * 4];
    return uint32_t(p[0]) | uint32_t(p[1]) << 8 | uint32_t(p[2]) << 16 | uint32_t(p[3]) << 24;
  }
};

void define(Texture& t, int level, const Image& image, int border = 0, BaseFormat format = BaseFormat::rgba) {
  t.define_level(level, image.width - 2 * border, image.height - 2 * border, border, format,
                 image.bytes.data(), image.stride());
}

Sampler wrapping(Wrap s, Wrap t, Color border = {}) {
  Sampler sampler;
  sampler.wrap_s = s, sampler.wrap_t = t, sampler.border_color = border;
  return sampler;
}

// What spec 3.8.2 says texel (i, j) is when it lies beside the image: -1 stands for the border colour.
int model_index(int i, int size, Wrap wrap, bool& outside) {
  if (i >= 0 && i < size) return i;
  if (wrap == Wrap::repeat) return (i + size) % size;
  if (wrap == Wrap::clamp_to_edge) return i < 0 ? 0 : size - 1;
  outside = true;
  return i;
}

uint32_t model_texel(const Image& image, int border, int i, int j, const Sampler& s, uint32_t border_color) {
  bool outside = false;
  const int mi = model_index(i, image.width - 2 * border, s.wrap_s, outside);
  const int mj = model_index(j, image.height - 2 * border, s.wrap_t, outside);
  return outside && border == 0 ? border_color : image.texel(mi + border, mj + border);
}

constexpr Wrap kWraps[] = {Wrap::repeat, Wrap::clamp, Wrap::clamp_to_edge};

void expect_level(const TextureLevel& level, const Image& image, int border, const Sampler& s,
                  uint32_t border_color) {
  ASSERT_EQ(level.width, image.width - 2 * border);
  ASSERT_EQ(level.height, image.height - 2 * border);
  EXPECT_EQ(reinterpret_cast<uintptr_t>(level.base) % 64, 0u);
  for (int j = -1; j <= level.height; ++j) {
    for (int i = -1; i <= level.width; ++i) {
      ASSERT_EQ(level.texel(i, j), model_texel(image, border, i, j, s, border_color)) << i << "," << j;
    }
  }
}

TEST(TextureStorage, SkirtsFollowTheWrapModes) {
  const int sizes[][2] = {{8, 4}, {1, 1}, {1, 16}, {5, 3}, {64, 1}};
  for (int border : {0, 1}) {
    for (const auto& size : sizes) {
      const Image image(size[0] + 2 * border, size[1] + 2 * border, 5);
      Texture t;
      define(t, 0, image, border);
      for (Wrap ws : kWraps) {
        for (Wrap wt : kWraps) {
          const Sampler s = wrapping(ws, wt, {1, 0.5f, 0, 0.2f});
          expect_level(*t.view(s, 1)->levels[0], image, border, s, 0x330080ffu);
        }
      }
    }
  }
}

TEST(TextureStorage, BorderColourTakesTheFormOfTheFormat) {
  const Color color = {0.2f, 0.4f, 0.6f, 0.8f};  // 51, 102, 153, 204
  const std::pair<BaseFormat, uint32_t> expected[] = {
      {BaseFormat::rgba, 0xcc996633u},      {BaseFormat::rgb, 0xff996633u},
      {BaseFormat::luminance, 0xff333333u}, {BaseFormat::luminance_alpha, 0xcc333333u},
      {BaseFormat::intensity, 0x33333333u}, {BaseFormat::alpha, 0xcc000000u}};
  for (const auto& [format, texel] : expected) {
    Texture t;
    define(t, 0, Image(4, 4, 1), 0, format);
    const auto view = t.view(wrapping(Wrap::clamp, Wrap::repeat, color), 1);
    EXPECT_EQ(view->levels[0]->texel(-1, 2), texel);
    EXPECT_EQ(view->base_format, format);
  }
}

TEST(TextureStorage, AViewKeepsTheTexelsItWasTakenWith) {
  const Image before(8, 8, 1), patch(3, 2, 2);
  Texture t;
  define(t, 0, before);
  const Sampler s = wrapping(Wrap::repeat, Wrap::repeat);
  const auto old_view = t.view(s, 1);
  t.update_level(0, 6, 0, 2, 2, patch.bytes.data(), patch.stride());
  const auto new_view = t.view(s, 1);
  expect_level(*old_view->levels[0], before, 0, s, 0);
  Image after = before;
  for (int y = 0; y < 2; ++y) {
    std::memcpy(&after.bytes[size_t(y) * after.stride() + 6 * 4], &patch.bytes[size_t(y) * patch.stride()],
                8);
  }
  expect_level(*new_view->levels[0], after, 0, s, 0);
}

TEST(TextureStorage, TwoSkirtsMayBeHeldAtOnce) {
  const Image image(8, 8, 3);
  Texture t;
  define(t, 0, image);
  const Sampler repeat = wrapping(Wrap::repeat, Wrap::repeat), clamp = wrapping(Wrap::clamp, Wrap::clamp);
  const auto first = t.view(repeat, 1), second = t.view(clamp, 1);
  expect_level(*first->levels[0], image, 0, repeat, 0);
  expect_level(*second->levels[0], image, 0, clamp, 0);
}

TEST(TextureStorage, NothingIsCopiedUnlessItMustBe) {
  Texture t;
  define(t, 0, Image(64, 64, 3));
  Sampler s = wrapping(Wrap::repeat, Wrap::repeat);
  auto view = t.view(s, 1);
  EXPECT_EQ(t.view(s, 1), view) << "unchanged";
  const uint32_t* texels = view->levels[0]->base;
  s.mag = Filter::nearest;  // another sampler, the same skirt
  auto other = t.view(s, 1);
  EXPECT_NE(other, view);
  EXPECT_EQ(other->levels[0]->base, texels);
  view.reset();
  other.reset();
  t.update_level(0, 0, 0, 64, 64, Image(64, 64, 4).bytes.data(), 256);
  s.wrap_s = Wrap::clamp;
  EXPECT_EQ(t.view(s, 1)->levels[0]->base, texels) << "nobody held the old texels";
  define(t, 0, Image(64, 64, 9));
  EXPECT_EQ(t.view(s, 1)->levels[0]->base, texels) << "same size, nobody looking";
}

TEST(TextureStorage, ReadsBackWhatItTookWithItsBorder) {
  for (int border : {0, 1}) {
    const Image image(7 + 2 * border, 5 + 2 * border, 11), corner(2, 2, 12);
    Texture t;
    define(t, 2, image, border, BaseFormat::rgb);
    t.view(wrapping(Wrap::repeat, Wrap::clamp), 1);
    t.update_level(2, -border, 5 + border - 2, 2, 2, corner.bytes.data(), corner.stride());
    Image expected = image, got(image.width, image.height, 0);
    for (int y = 0; y < 2; ++y) {
      std::memcpy(&expected.bytes[size_t(image.height - 2 + y) * image.stride()],
                  &corner.bytes[size_t(y) * corner.stride()], 8);
    }
    t.read_level(2, got.bytes.data(), got.stride());
    EXPECT_EQ(got.bytes, expected.bytes);
    EXPECT_EQ(t.level_info(2).width, 7);
    EXPECT_EQ(t.level_info(2).border, border);
    EXPECT_EQ(t.level_info(2).base_format, BaseFormat::rgb);
    t.remove_level(2);
    EXPECT_EQ(t.level_info(2).width, 0);
  }
}

TEST(TextureStorage, KnowsWhenEverythingIsOpaque) {
  Image image(4, 4, 1);
  for (size_t i = 3; i < image.bytes.size(); i += 4) image.bytes[i] = 255;
  Texture t;
  define(t, 0, image);
  const Sampler repeat = wrapping(Wrap::repeat, Wrap::repeat);
  EXPECT_TRUE(t.view(repeat, 1)->levels[0]->opaque);
  EXPECT_FALSE(t.view(wrapping(Wrap::repeat, Wrap::clamp, {1, 1, 1, 0.5f}), 1)->levels[0]->opaque);
  EXPECT_TRUE(t.view(wrapping(Wrap::repeat, Wrap::clamp, {1, 1, 1, 1}), 1)->levels[0]->opaque);
  const uint8_t clear[4] = {0, 0, 0, 254};
  t.update_level(0, 3, 3, 1, 1, clear, 4);
  EXPECT_FALSE(t.view(repeat, 1)->levels[0]->opaque);
  t.define_level(0, 4, 4, 0, BaseFormat::rgba, nullptr, 0);
  EXPECT_FALSE(t.view(repeat, 1)->levels[0]->opaque);
  EXPECT_EQ(t.view(repeat, 1)->levels[0]->texel(2, 2), 0u);
}

TEST(TextureStorage, LevelsAreDefinedAlone) {
  Texture t;
  for (int n = 0; n < 4; ++n) define(t, n, Image(8 >> n, 8 >> n, uint32_t(n)));
  EXPECT_EQ(t.view(Sampler{}, 4)->level_count, 4);
  EXPECT_EQ(t.view(Sampler{}, 2)->level_count, 2);
  EXPECT_EQ(t.view(Sampler{}, 2)->levels[2], nullptr);
  for (int n = 0; n < 4; ++n) {
    expect_level(*t.view(Sampler{}, 4)->levels[size_t(n)], Image(8 >> n, 8 >> n, uint32_t(n)), 0, Sampler{},
                 0);
  }
}

void expect_stacked(const TextureLevel& level) {
  ASSERT_NE(level.stacked, nullptr);
  for (int j = -1; j < level.height; ++j) {
    for (int i = -1; i <= level.width; ++i) {
      const ptrdiff_t at = 2 * (ptrdiff_t(j + 1) * level.pitch + (i + 1));
      ASSERT_EQ(level.stacked[size_t(at)], level.texel(i, j)) << i << "," << j;
      ASSERT_EQ(level.stacked[size_t(at) + 1], level.texel(i, j + 1)) << i << "," << j;
    }
  }
}

TEST(TextureStorage, LevelsForLinearLookupsAreStackedAsTheyChange) {
  if (current_isa() != Isa::avx512) GTEST_SKIP() << "no kernel would look";
  Texture t;
  define(t, 0, Image(16, 8, 3));
  Sampler s = wrapping(Wrap::repeat, Wrap::repeat);
  s.mag = Filter::nearest;
  const auto nearest = t.view(s, 1);
  EXPECT_EQ(nearest->levels[0]->stacked, nullptr);
  s.mag = Filter::linear;
  const auto held = t.view(s, 1);
  expect_stacked(*held->levels[0]);
  EXPECT_EQ(nearest->levels[0]->stacked, nullptr) << "another thread may look at it";
  t.update_level(0, 3, 7, 2, 1, Image(2, 1, 4).bytes.data(), 8);
  expect_stacked(*t.view(s, 1)->levels[0]);
  s.wrap_t = Wrap::clamp_to_edge;
  expect_stacked(*t.view(s, 1)->levels[0]);
  expect_stacked(*held->levels[0]);
  define(t, 0, Image(16, 8, 5));
  expect_stacked(*t.view(s, 1)->levels[0]);
  define(t, 0, Image(512, 256, 6));
  define(t, 1, Image(256, 128, 7));
  const auto large = t.view(s, 2);
  EXPECT_EQ(large->levels[0]->stacked, nullptr) << "too large";
  EXPECT_EQ(large->levels[1]->stacked, nullptr) << "all or none";
}

}  // namespace
}  // namespace halfspace::raster
