// Rectangles of fragments that come from an image: which pixels they cover, and that neither the way they are
// executed nor the machine shows.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/canvas.h"

namespace halfspace::test {
namespace {

using raster::DrawState;
using raster::PixelKind;
using raster::PixelPacket;

constexpr int kWidth = 150, kHeight = 90;

struct Image {
  int width, height;
  std::vector<float> color;
  std::vector<uint32_t> depth;
  std::vector<uint8_t> bits, stencil;

  Image(int w, int h, unsigned seed) : width(w), height(h) {
    std::mt19937 random(seed);
    const size_t count = size_t(w) * size_t(h);
    for (size_t i = 0; i < count * 4; ++i) color.push_back(float(random() % 256) / 255.0f);
    for (size_t i = 0; i < count; ++i) depth.push_back(random() & 0xffffff);
    for (size_t i = 0; i < count; ++i) stencil.push_back(uint8_t(random()));
    for (size_t i = 0; i < row_bytes() * size_t(h); ++i) bits.push_back(uint8_t(random()));
  }
  size_t row_bytes() const { return size_t(width + 7) / 8; }

  // The whole image, or the part [x0, x1) x [y0, y1) of it.
  PixelPacket packet(PixelKind kind, const std::shared_ptr<const DrawState>& state) const {
    PixelPacket p;
    p.state = state;
    p.kind = kind;
    p.width = width;
    p.height = height;
    p.color = color.data();
    p.depth = depth.data();
    p.stencil = stencil.data();
    p.bits = bits.data();
    p.row_elements = size_t(width);
    p.row_bytes = row_bytes();
    p.raster_color = {0.2f, 0.4f, 0.6f, 0.8f};
    p.raster_depth = 0.25;
    return p;
  }
  PixelPacket part(PixelKind kind, const std::shared_ptr<const DrawState>& state,
                   const raster::Rect& r) const {
    PixelPacket p = packet(kind, state);
    const size_t at = size_t(r.y0) * size_t(width) + size_t(r.x0);
    p.first_column = r.x0;
    p.first_row = r.y0;
    p.width = r.x1 - r.x0;
    p.height = r.y1 - r.y0;
    p.color += at * 4;
    p.depth += at;
    return p;
  }
};

std::shared_ptr<DrawState> state_of() { return std::make_shared<DrawState>(plain_state(64, 64)); }

void place(PixelPacket& p, double x, double y, double zoom_x, double zoom_y) {
  p.x = x;
  p.y = y;
  p.zoom_x = zoom_x;
  p.zoom_y = zoom_y;
}

// An image in parts of any size is the image: parts meet without gap or overlap, at every zoom.
TEST(PixelRect, PartsMeet) {
  const Image image(37, 23, 1);
  auto state = state_of();
  state->blend = {true, raster::BlendFactor::one, raster::BlendFactor::one};  // what is drawn twice shows
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place_at(-20, 100), zooms(-4, 4);
  for (int run = 0; run < 60; ++run) {
    const double x = place_at(random), y = place_at(random), zx = zooms(random), zy = zooms(random);
    Canvas whole(kWidth, kHeight), parts(kWidth, kHeight);
    whole.clear({0.1f, 0.1f, 0.1f, 0.1f});
    parts.clear({0.1f, 0.1f, 0.1f, 0.1f});
    PixelPacket p = image.packet(PixelKind::color, state);
    place(p, x, y, zx, zy);
    whole.device().draw_pixels(p);
    for (int j = 0; j < image.height; j += 5) {
      for (int i = 0; i < image.width; i += 11) {
        p = image.part(PixelKind::color, state,
                       {i, j, std::min(i + 11, image.width), std::min(j + 5, image.height)});
        place(p, x, y, zx, zy);
        parts.device().draw_pixels(p);
      }
    }
    ASSERT_EQ(first_difference(whole.read(), parts.read()), "") << x << " " << y << " " << zx << " " << zy;
  }
}

// Images small enough to wait and those that are drawn at once give the same picture, with draws between
// them.
TEST(PixelRect, SmallAndLargeImagesKeepTheOrder) {
  const Image image(120, 80, 3);  // too large to wait
  auto state = state_of();
  state->blend = {true, raster::BlendFactor::src_alpha, raster::BlendFactor::one_minus_src_alpha};
  state->depth = {true, raster::CompareFunc::less_equal, true};
  const auto quad = snapped_quad(10 * 256, 10 * 256, 50 * 256, 40 * 256, 64, 0.5f, {1, 0, 0, 0.5f});
  const auto draw = [&](int step) {
    Canvas canvas(kWidth, kHeight, 3);
    canvas.clear();
    for (PixelKind kind : {PixelKind::color, PixelKind::depth, PixelKind::color}) {
      canvas.draw(*state, raster::Primitive::quads, quad);
      for (int j = 0; j < image.height; j += step) {
        PixelPacket p = image.part(kind, state, {0, j, image.width, std::min(j + step, image.height)});
        place(p, 5.25, 3.5, 1, 1);
        canvas.device().draw_pixels(p);
      }
    }
    return canvas.read();
  };
  EXPECT_EQ(first_difference(draw(image.height), draw(1)), "");
}

TEST(PixelRect, EveryMachineDrawsTheSame) {
  const Image image(61, 45, 4);
  auto state = state_of();
  state->blend = {true, raster::BlendFactor::src_alpha, raster::BlendFactor::one};
  state->depth = {true, raster::CompareFunc::less, true};
  state->alpha_test = {true, raster::CompareFunc::greater, 0.2f};
  const auto draw = [&](int threads, bool fuse) {
    Canvas canvas(kWidth, kHeight, threads, raster::ColorFormat::rgba8, fuse);
    canvas.clear({0.3f, 0.2f, 0.1f, 0});
    for (PixelKind kind : {PixelKind::bitmap, PixelKind::color, PixelKind::depth, PixelKind::bitmap}) {
      PixelPacket p = image.packet(kind, state);
      place(p, 12.5, 80.75, kind == PixelKind::bitmap ? 1 : 2.3, kind == PixelKind::bitmap ? 1 : -1.7);
      p.raster_depth = 0.7;
      canvas.device().draw_pixels(p);
    }
    return hash(canvas.read());
  };
  const uint64_t expected = draw(1, true);
  for (const std::string& isa : isa_levels()) {
    const IsaScope scope(isa);
    EXPECT_EQ(draw(1, true), expected) << isa;
    EXPECT_EQ(draw(4, true), expected) << isa;
    EXPECT_EQ(draw(1, false), expected) << isa;
  }
}

// Elements against the rule itself; positions and zooms that a double holds exactly, so that ties are ties.
TEST(PixelRect, CentresOnAnEdgeBelongToOneElement) {
  const Image image(9, 7, 5);
  auto state = state_of();
  for (double zoom : {1.0, 0.5, 0.25, 1.5, 3.0, -1.0, -0.5, -2.0}) {
    for (double at : {20.0, 20.5, 20.25, 19.75}) {
      Canvas canvas(64, 64);
      canvas.clear();
      PixelPacket p = image.packet(PixelKind::color, state);
      place(p, at, at + 0.25, zoom, zoom);
      canvas.device().draw_pixels(p);
      const Picture picture = canvas.read();
      for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
          int expected[4] = {0, 0, 0, 0};
          for (int j = 0; j < image.height; ++j) {
            for (int i = 0; i < image.width; ++i) {
              const double a = at + zoom * i, b = at + zoom * (i + 1), c = at + 0.25 + zoom * j,
                           d = at + 0.25 + zoom * (j + 1);
              const bool inside = x + 0.5 >= std::min(a, b) && x + 0.5 < std::max(a, b) &&
                                  y + 0.5 >= std::min(c, d) && y + 0.5 < std::max(c, d);
              if (!inside) continue;
              for (int k = 0; k < 4; ++k)
                expected[k] =
                    int(std::lround(image.color[size_t(j * image.width + i) * 4 + size_t(k)] * 255));
            }
          }
          for (int k = 0; k < 4; ++k)
            ASSERT_EQ(int(picture.pixel(x, y)[k]), expected[k]) << zoom << " " << at;
        }
      }
    }
  }
}

TEST(PixelRect, StencilIsWrittenUnderMaskAndScissor) {
  const Image image(70, 30, 6);
  auto state = state_of();
  state->raster.scissor_test = true;
  state->raster.scissor = {5, 8, 90, 33};
  raster::Framebuffer framebuffer(kWidth, kHeight, raster::ColorFormat::rgba8);
  raster::Device device;
  device.begin_pass(&framebuffer);
  raster::ClearCommand clear;
  clear.stencil = true;
  clear.stencil_value = 0x3c;
  device.clear(clear);
  PixelPacket p = image.packet(PixelKind::stencil, state);
  place(p, 2, 4, 2, 1);
  p.stencil_mask = 0xf5;
  device.draw_pixels(p);
  std::vector<uint8_t> out(kWidth * kHeight);
  device.read_stencil({0, 0, kWidth, kHeight}, out.data());
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool inside = x >= 5 && x < 90 && y >= 8 && y < 33 && x >= 2 && x < 142 && y >= 4 && y < 34;
      unsigned expected = 0x3c;
      if (inside)
        expected = (0x3c & ~0xf5u) | (image.stencil[size_t((y - 4) * image.width + (x - 2) / 2)] & 0xf5u);
      ASSERT_EQ(unsigned{out[size_t(y * kWidth + x)]}, expected) << x << " " << y;
    }
  }
}

// No zoom makes anything but a picture.
TEST(PixelRect, WildZooms) {
  const Image image(13, 5, 7);
  auto state = state_of();
  Canvas canvas(64, 64);
  canvas.clear();
  const double wild[] = {0,
                         -0.0,
                         1e-30,
                         1e-14,
                         1e30,
                         -1e30,
                         1e300,
                         std::numeric_limits<double>::infinity(),
                         -std::numeric_limits<double>::infinity(),
                         std::numeric_limits<double>::quiet_NaN(),
                         5e-324};
  for (double x : wild) {
    for (double y : wild) {
      for (double at : {0.0, 31.5, -1e9, 1e18}) {
        PixelPacket p = image.packet(PixelKind::color, state);
        place(p, at, 10, x, y);
        canvas.device().draw_pixels(p);
      }
    }
  }
  canvas.read();
}

}  // namespace
}  // namespace halfspace::test
