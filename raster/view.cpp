#include "raster/view.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace halfspace::raster {
namespace {

struct Rgb {
  int r, g, b;
};

constexpr Rgb kNothing{24, 24, 28};
// One fragment, two, ...; the last stands for all there are more.
constexpr Rgb kHeat[] = {{32, 48, 128}, {32, 112, 192}, {32, 176, 176}, {64, 192, 64}, {192, 208, 48},
                         {240, 160, 32}, {240, 80, 32}, {208, 32, 48}, {240, 144, 200}, {255, 255, 255}};
constexpr Rgb kLevel[] = {{208, 48, 48}, {224, 128, 40}, {216, 200, 56}, {96, 184, 64}, {48, 168, 160},
                          {56, 104, 200}, {112, 72, 184}, {184, 72, 168}, {128, 128, 128}, {232, 232, 232}};
// packed, part, whole, filled
constexpr Rgb kPath[] = {{232, 136, 40}, {56, 120, 208}, {72, 176, 96}, {184, 72, 176}};

template <size_t kCount>
Rgb pick(const Rgb (&colors)[kCount], size_t i) {
  return colors[std::min(i, kCount - 1)];
}

struct PixelPlace {
  int block, pixel;  // of the tile, of the block
};

Rgb pixel_at(const Framebuffer::Impl& fb, uint32_t tile, int plane, const PixelPlace& at) {
  if (fb.format == ColorFormat::rgba8) {
    const uint32_t pixel = fb.color_tile<uint32_t>(tile, plane)[at.block * kBlockPixels + at.pixel];
    return {static_cast<int>(pixel & 255u), static_cast<int>(pixel >> 8 & 255u), static_cast<int>(pixel >> 16 & 255u)};
  }
  const float* channels = fb.color_tile<float>(tile, plane) + at.block * kBlockPixels * 4 + at.pixel;
  const auto byte = [&](int c) { return static_cast<int>(std::clamp(channels[c * kBlockPixels], 0.0f, 1.0f) * 255.0f); };
  return {byte(0), byte(1), byte(2)};
}

void store_pixel(const Rgb& c, const Framebuffer::Impl& fb, uint32_t tile, int plane, const PixelPlace& at) {
  if (fb.format == ColorFormat::rgba8) {
    const auto byte = [](int v) { return static_cast<uint32_t>(std::clamp(v, 0, 255)); };
    fb.color_tile<uint32_t>(tile, plane)[at.block * kBlockPixels + at.pixel] =
        byte(c.r) | byte(c.g) << 8 | byte(c.b) << 16 | 0xff000000u;
    return;
  }
  float* channels = fb.color_tile<float>(tile, plane) + at.block * kBlockPixels * 4 + at.pixel;
  const int value[4] = {c.r, c.g, c.b, 255};
  for (int k = 0; k < 4; ++k) channels[k * kBlockPixels] = static_cast<float>(value[k]) / 255.0f;
}

// The colour, with the picture's light and shade to a third.
Rgb shaded(const Rgb& color, const Rgb& pixel) {
  const int light = (pixel.r * 2 + pixel.g * 5 + pixel.b) / 8;
  const auto one = [&](int v) { return v * (170 + light / 3) / 255; };
  return {one(color.r), one(color.g), one(color.b)};
}

Rgb dimmed(const Rgb& c) { return {c.r * 5 / 8, c.g * 5 / 8, c.b * 5 / 8}; }

Rgb color_of(View view, const PixelNote& note, const Rgb& pixel, int x, int y) {
  if (view == View::overdraw) return note.fragments == 0 ? kNothing : pick(kHeat, note.fragments - size_t{1});
  if (view == View::levels) {
    const Rgb gray{144, 144, 144};
    return shaded(note.level == 0 ? gray : pick(kLevel, note.level - size_t{1}), pixel);
  }
  const Rgb path = note.path == FragmentPath::none ? kNothing : pick(kPath, static_cast<size_t>(note.path) - 1);
  const Rgb color = shaded(path, pixel);
  if (x % kTileSize == 0 || y % kTileSize == 0) return {0, 0, 0};
  return x % kBlockSize == 0 || y % kBlockSize == 0 ? dimmed(color) : color;
}

// The squared length of the longer gradient of the texture coordinates, in texels of level 0 a pixel (spec 3.8.8).
double rho_squared(const SetupBatch& s, int lane, const FragmentParams& params, bool projective, double dx, double dy) {
  const bool constant = !projective && (s.variant[lane] & kAffine) != 0;
  const int divisor = projective ? params.tex_plane + 2 : 1;
  const auto at = [&](int plane) { return s.f0[plane][lane] + s.dfdy[plane][lane] * dy + s.dfdx[plane][lane] * dx; };
  const double q = constant ? 1 : at(divisor), qx = constant ? 0 : s.dfdx[divisor][lane],
               qy = constant ? 0 : s.dfdy[divisor][lane];
  double along_x = 0, along_y = 0;
  for (int axis = 0; axis < 2; ++axis) {
    const int plane = params.tex_plane + axis;
    const double coord = at(plane) / q;
    const double gx = (s.dfdx[plane][lane] - coord * qx) / q * params.lod_scale[axis];
    const double gy = (s.dfdy[plane][lane] - coord * qy) / q * params.lod_scale[axis];
    along_x += gx * gx;
    along_y += gy * gy;
  }
  return std::max(along_x, along_y);
}

// The nearest level to log2 of rho.
uint8_t nearest_level(double rho2, int count) {
  int level = 0;
  for (; level + 1 < count && rho2 > 2; rho2 /= 4) ++level;
  return static_cast<uint8_t>(level);
}

}  // namespace

View view_from_environment() {
  const char* wish = std::getenv("HALFSPACE_VIEW");
  if (wish == nullptr || *wish == '\0') return View::none;
  const std::string_view name = wish;
  if (name == "overdraw") return View::overdraw;
  if (name == "levels") return View::levels;
  if (name == "tiles") return View::tiles;
  if (name != "wireframe")
    std::fprintf(stderr, "halfspace: HALFSPACE_VIEW=%s is none of overdraw, levels, tiles and wireframe\n", wish);
  return View::none;
}

void note_fragments(PixelNote* pixels, const SetupBatch& setup, int lane, const FragmentParams& params, bool projective,
                    int x, int y, uint64_t mask, FragmentPath path) {
  for (uint64_t todo = mask; todo != 0; todo &= todo - 1) {
    const int i = __builtin_ctzll(todo), px = x + i % kBlockSize, py = y + i / kBlockSize;
    PixelNote& note = pixels[py * kTileSize + px];
    if (note.fragments < 0xffff) ++note.fragments;
    note.path = path;
    note.level = 0;
    if (params.level_count < 2) continue;
    const double rho2 = rho_squared(setup, lane, params, projective, setup.anchor_x[lane] + px, setup.anchor_y[lane] + py);
    note.level = static_cast<uint8_t>(1 + nearest_level(rho2, params.level_count));
  }
}

void ViewNotes::attend(const Framebuffer::Impl& framebuffer) {
  const size_t count = framebuffer.tiles.size() * kTilePixels;
  if (of_ == &framebuffer && notes_.size() == count) return;
  of_ = &framebuffer;
  notes_.assign(count, {});
}

void ViewNotes::forget() { std::fill(notes_.begin(), notes_.end(), PixelNote()); }

void ViewNotes::paint_tile(Framebuffer::Impl& framebuffer, uint32_t tile, int plane) {
  PixelNote* notes = this->tile(tile);
  framebuffer.settle_color(tile, ~uint64_t{0}, plane);
  for (int y = 0; y < kTileSize; ++y) {
    for (int x = 0; x < kTileSize; ++x) {
      const PixelPlace place{y / kBlockSize * 8 + x / kBlockSize, y % kBlockSize * kBlockSize + x % kBlockSize};
      const Rgb color = color_of(view_, notes[y * kTileSize + x], pixel_at(framebuffer, tile, plane, place), x, y);
      store_pixel(color, framebuffer, tile, plane, place);
    }
  }
  std::fill_n(notes, kTilePixels, PixelNote());
}

}  // namespace halfspace::raster
