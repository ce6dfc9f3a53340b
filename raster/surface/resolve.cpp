#include "raster/surface/resolve.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "raster/surface/rows.h"

namespace halfspace::raster {
namespace {

struct BlockRow {
  size_t tile;
  int block;
  int first_pixel;  // of the row, within the block
  int count;
};

// Calls visit(BlockRow, position) for each stretch of row y between x0 and x1 that lies in one block.
template <class Visit>
void for_block_rows(const Framebuffer::Impl& fb, int x0, int x1, int y, Visit visit) {
  const size_t tile_row = static_cast<size_t>(y / kTileSize) * static_cast<size_t>(fb.tiles_x);
  const int block_row = (y % kTileSize) / kBlockSize * 8, pixel_row = y % kBlockSize * kBlockSize;
  for (int x = x0; x < x1;) {
    const int count = std::min(kBlockSize - x % kBlockSize, x1 - x);
    visit(BlockRow{tile_row + static_cast<size_t>(x / kTileSize), block_row + (x % kTileSize) / kBlockSize,
                   pixel_row + x % kBlockSize, count},
          x - x0);
    x += count;
  }
}

bool is_marked(uint64_t marks, int block) { return (marks >> block & 1) != 0; }

uint32_t to_byte(float v) {
  return static_cast<uint32_t>((v > 0 ? std::min(v, 1.0f) : 0.0f) * 255.0f + 0.5f);
}

void copy_blocks_rgba8(const Framebuffer::Impl& fb, int plane, int x0, int x1, int y, uint32_t* out) {
  for_block_rows(fb, x0, x1, y, [&](const BlockRow& row, int at) {
    const ColorMarks& marks = fb.tiles[row.tile].color[plane];
    if (is_marked(marks.is_clear, row.block)) {
      std::fill_n(out + at, row.count, marks.rgba8);
    } else {
      const auto* pixels = fb.color_tile<uint32_t>(row.tile, plane) + row.block * kBlockPixels + row.first_pixel;
      std::memcpy(out + at, pixels, static_cast<size_t>(row.count) * sizeof(uint32_t));
    }
  });
}

// `band`: 0 to 7, from the tile's lowest.
uint64_t band_of(uint64_t marks, int band) { return marks >> (band * 8) & 0xff; }

void copy_blocks_float(const Framebuffer::Impl& fb, int plane, int x0, int x1, int y, float* out) {
  for_block_rows(fb, x0, x1, y, [&](const BlockRow& row, int at) {
    const ColorMarks& marks = fb.tiles[row.tile].color[plane];
    const float clear[4] = {marks.value.r, marks.value.g, marks.value.b, marks.value.a};
    const bool marked = is_marked(marks.is_clear, row.block);
    const float* channels = marked ? nullptr : fb.color_tile<float>(row.tile, plane) + row.block * kBlockPixels * 4;
    for (int i = 0; i < row.count; ++i)
      for (int c = 0; c < 4; ++c)
        out[(at + i) * 4 + c] = marked ? clear[c] : channels[c * kBlockPixels + row.first_pixel + i];
  });
}

// One pixel of `rgba` (R lowest) into `out` in the layout's order.
template <PixelLayout kLayout>
void store_pixel(uint32_t rgba, std::byte* out) {
  const auto r = static_cast<std::byte>(rgba), g = static_cast<std::byte>(rgba >> 8),
             b = static_cast<std::byte>(rgba >> 16), a = static_cast<std::byte>(rgba >> 24);
  if constexpr (kLayout == PixelLayout::rgba) out[0] = r, out[1] = g, out[2] = b, out[3] = a;
  if constexpr (kLayout == PixelLayout::bgra || kLayout == PixelLayout::bgrx)
    out[0] = b, out[1] = g, out[2] = r, out[3] = a;
  if constexpr (kLayout == PixelLayout::argb) out[0] = a, out[1] = r, out[2] = g, out[3] = b;
  if constexpr (kLayout == PixelLayout::rgb) out[0] = r, out[1] = g, out[2] = b;
  if constexpr (kLayout == PixelLayout::bgr) out[0] = b, out[1] = g, out[2] = r;
  if constexpr (kLayout == PixelLayout::rgb565) {
    auto narrow = [](uint32_t byte, uint32_t most) { return (byte * most + 127) / 255; };
    const auto word = static_cast<uint16_t>(narrow(rgba & 255, 31) << 11 | narrow(rgba >> 8 & 255, 63) << 5 |
                                            narrow(rgba >> 16 & 255, 31));
    std::memcpy(out, &word, sizeof word);
  }
}

template <PixelLayout kLayout, int kBytes>
void store_row(const uint32_t* rgba, int count, std::byte* out) {
  for (int i = 0; i < count; ++i) store_pixel<kLayout>(rgba[i], out + i * kBytes);
}

void store_row_bytes(const uint32_t* rgba, int count, PixelLayout layout, std::byte* out) {
  switch (layout) {
    case PixelLayout::rgba: std::memcpy(out, rgba, static_cast<size_t>(count) * 4); return;
    case PixelLayout::bgra:
    case PixelLayout::bgrx: return store_row<PixelLayout::bgra, 4>(rgba, count, out);
    case PixelLayout::argb: return store_row<PixelLayout::argb, 4>(rgba, count, out);
    case PixelLayout::rgb: return store_row<PixelLayout::rgb, 3>(rgba, count, out);
    case PixelLayout::bgr: return store_row<PixelLayout::bgr, 3>(rgba, count, out);
    case PixelLayout::rgb565: return store_row<PixelLayout::rgb565, 2>(rgba, count, out);
  }
}

void store_row_floats(const float* rgba, int count, PixelLayout layout, std::byte* out) {
  constexpr int kOrder[][4] = {{0, 1, 2, 3}, {2, 1, 0, 3}, {3, 0, 1, 2}, {0, 1, 2, -1}, {2, 1, 0, -1}};
  const bool has_order = layout <= PixelLayout::bgr;
  const int* order = kOrder[has_order ? static_cast<int>(layout) : static_cast<int>(PixelLayout::bgra)];
  const int channels = order[3] < 0 ? 3 : 4;
  for (int i = 0; i < count; ++i)
    for (int c = 0; c < channels; ++c)
      std::memcpy(out + (i * channels + c) * static_cast<int>(sizeof(float)), &rgba[i * 4 + order[c]], sizeof(float));
}

size_t pixel_bytes(const LinearImage& image) {
  switch (image.layout) {
    case PixelLayout::rgb:
    case PixelLayout::bgr: return image.float_components ? 12 : 3;
    case PixelLayout::rgb565: return 2;
    default: return image.float_components ? 16 : 4;
  }
}

// An image and where in the framebuffer it lies.
struct Placed {
  const LinearImage& image;
  int left, bottom;

  Rect rect() const { return {left, bottom, left + image.width, bottom + image.height}; }
  // The image's top row is the framebuffer's when y goes down, so rows are told from the bottom of the image.
  std::byte* at(int x, int y) const {
    const int row = image.y_up ? y - bottom : image.height - 1 - (y - bottom);
    return static_cast<std::byte*>(image.data) + row * image.row_bytes +
           static_cast<size_t>(x - left) * pixel_bytes(image);
  }
};

bool takes_rgba8(const LinearImage& image) {
  return image.layout == PixelLayout::rgba && !image.opaque && !image.float_components &&
         (reinterpret_cast<uintptr_t>(image.data) | static_cast<uintptr_t>(image.row_bytes)) % sizeof(uint32_t) == 0;
}

void resolve_row(const Framebuffer::Impl& fb, int plane, int x0, int x1, int y, const Placed& placed) {
  const LinearImage& image = placed.image;
  std::byte* out = placed.at(x0, y);
  const int count = x1 - x0;
  if (image.float_components && image.layout != PixelLayout::rgb565) {
    float rgba[kTileSize * 4];
    read_row_float(fb, plane, x0, x1, y, rgba);
    if (image.opaque)
      for (int i = 0; i < count; ++i) rgba[i * 4 + 3] = 1;
    store_row_floats(rgba, count, image.layout, out);
    return;
  }
  uint32_t rgba[kTileSize];
  if (takes_rgba8(image)) {
    read_row_rgba8(fb, plane, x0, x1, y, reinterpret_cast<uint32_t*>(out));
    return;
  }
  read_row_rgba8(fb, plane, x0, x1, y, rgba);
  if (image.opaque)
    for (int i = 0; i < count; ++i) rgba[i] |= 0xff000000u;
  store_row_bytes(rgba, count, image.layout, out);
}

// Tiles of a row onto an image of bytes, in bands of eight rows. All tiles at once, since memory likes its rows whole.
struct BandWriter {
  static constexpr uint32_t kMostTiles = 64;
  struct Tile {
    uint64_t is_clear;
    uint32_t value;
    const uint32_t* pixels;
  };

  const Framebuffer::Impl& fb;
  int plane;
  const Placed& placed;
  const Rect& rect;  // of the tiles, what the image has
  RowFunctions rows;
  bool direct;
  int left;             // of the first tile
  bool cleared = true;  // nothing is drawn
  int colours = 0;      // that what is cleared has: none, one (`value`) or, if there are more, 2
  uint32_t value = 0;
  Tile tiles[kMostTiles];

  BandWriter(const Framebuffer::Impl& framebuffer, int plane_of, const Placed& image, const Rect& part,
             uint32_t first, uint32_t count)
      : fb(framebuffer),
        plane(plane_of),
        placed(image),
        rect(part),
        rows(row_functions()),
        direct(takes_rgba8(image.image)),
        left(fb.tile_rect(first).x0) {
    for (uint32_t i = 0; i < count; ++i) {
      const ColorMarks& marks = fb.tiles[first + i].color[plane];
      tiles[i] = {marks.is_clear, marks.rgba8, nullptr};
      if (marks.is_clear != ~uint64_t{0}) tiles[i].pixels = fb.color_tile<uint32_t>(first + i, plane);
      cleared = cleared && tiles[i].pixels == nullptr;
      if (marks.is_clear == 0) continue;
      colours = colours == 0 || (colours == 1 && marks.rgba8 == value) ? 1 : 2;
      value = marks.rgba8;
    }
  }

  PixelRows at(int x, int y) const {
    const ptrdiff_t step = placed.image.row_bytes / static_cast<ptrdiff_t>(sizeof(uint32_t));
    return {reinterpret_cast<uint32_t*>(placed.at(x, y)), placed.image.y_up ? step : -step};
  }

  // The blocks from x on, all cleared or none, that lie in one tile.
  BlockRun run_at(int x, int end, int band) const {
    const Tile& tile = tiles[(x - left) / kTileSize];
    const int block = (x - left) % kTileSize / kBlockSize;
    const auto ahead = static_cast<uint32_t>(band_of(tile.is_clear, band) >> block);
    const bool clear = is_marked(ahead, 0);
    const int alike = clear ? std::countr_one(ahead) : std::countr_zero(ahead);
    const int blocks = std::min({alike, kTileSize / kBlockSize - block, (end - x) / kBlockSize});
    return {clear ? nullptr : tile.pixels + (band * 8 + block) * kBlockPixels, tile.value, blocks};
  }

  // Runs from x on, no further than `end` nor than there is room; returns where they end.
  int find_runs(int x, int end, int band, BlockRun* runs, int room, int& count) const {
    count = 0;
    while (x < end) {
      const BlockRun run = run_at(x, end, band);
      BlockRun* last = runs + count - 1;
      if (count != 0 && run.pixels == nullptr && last->pixels == nullptr && last->value == run.value)
        last->blocks += run.blocks;
      else if (count == room) break;
      else runs[count++] = run;
      x += run.blocks * kBlockSize;
    }
    return x;
  }

  // Where only short stretches of a band are drawn: a fill that ends at each and begins again costs more than
  // a few blocks that are filled in vain. False: the band is another kind.
  bool write_over(int x, int end, int y) const {
    constexpr int kShort = 8;  // blocks
    PlacedBlock blocks[kMostTiles * kTileSize / kBlockSize];
    int count = 0, stretches = 0;
    ptrdiff_t stretch_end = -1;
    const int band = y % kTileSize / kBlockSize;
    for (int t = (x - left) / kTileSize; !cleared && left + t * kTileSize < end; ++t) {
      for (uint64_t todo = band_of(~tiles[t].is_clear, band); todo != 0; todo &= todo - 1) {
        const int block = std::countr_zero(todo), at = left + t * kTileSize + block * kBlockSize - x;
        if (at < 0 || at >= end - x) continue;
        blocks[count++] = {tiles[t].pixels + (band * 8 + block) * kBlockPixels, at};
        stretches += at != stretch_end;
        stretch_end = at + kBlockSize;
      }
    }
    if (count > stretches * kShort) return false;
    rows.write_over(value, end - x, blocks, count, at(x, y));
    return true;
  }

  void convert(const BlockRun* runs, int count, int width, int x, int y) const {
    alignas(64) uint32_t pixels[kBlockSize * kTileSize];
    rows.write_runs(runs, count, {pixels, kTileSize});
    if (placed.image.opaque)
      for (uint32_t& pixel : pixels) pixel |= 0xff000000u;
    for (int row = 0; row < kBlockSize; ++row)
      store_row_bytes(pixels + row * kTileSize, width, placed.image.layout, placed.at(x, y + row));
  }

  // Less than a block's width.
  void write_edge(int x, int end, int y) const {
    for (int row = 0; x < end && row < kBlockSize; ++row) resolve_row(fb, plane, x, end, y + row, placed);
  }

  void write(int y) const {
    const int first = std::min((rect.x0 + kBlockSize - 1) / kBlockSize * kBlockSize, rect.x1);
    const int end = std::max(rect.x1 / kBlockSize * kBlockSize, first);
    write_edge(rect.x0, first, y);
    const bool done = direct && colours == 1 && first < end && write_over(first, end, y);
    for (int x = done ? end : first; x < end;) {
      constexpr int kRoom = 64;
      BlockRun runs[kRoom];
      int count = 0;
      const int tile_end = std::min(x / kTileSize * kTileSize + kTileSize, end);
      const int next = find_runs(x, direct ? end : tile_end, y % kTileSize / kBlockSize, runs, kRoom, count);
      if (direct) rows.write_runs(runs, count, at(x, y));
      else convert(runs, count, next - x, x, y);
      x = next;
    }
    write_edge(end, rect.x1, y);
  }
};

}  // namespace

void read_row_rgba8(const Framebuffer::Impl& fb, int plane, int x0, int x1, int y, uint32_t* out) {
  if (fb.format == ColorFormat::rgba8) return copy_blocks_rgba8(fb, plane, x0, x1, y, out);
  for (int x = x0; x < x1; x += kTileSize) {
    float rgba[kTileSize * 4];
    const int end = std::min(x + kTileSize, x1);
    copy_blocks_float(fb, plane, x, end, y, rgba);
    for (int i = 0; i < end - x; ++i)
      out[x - x0 + i] = to_byte(rgba[i * 4]) | to_byte(rgba[i * 4 + 1]) << 8 | to_byte(rgba[i * 4 + 2]) << 16 |
                        to_byte(rgba[i * 4 + 3]) << 24;
  }
}

void read_row_float(const Framebuffer::Impl& fb, int plane, int x0, int x1, int y, float* out) {
  if (fb.format == ColorFormat::rgba32f) return copy_blocks_float(fb, plane, x0, x1, y, out);
  for (int x = x0; x < x1; x += kTileSize) {
    uint32_t rgba[kTileSize];
    const int end = std::min(x + kTileSize, x1);
    copy_blocks_rgba8(fb, plane, x, end, y, rgba);
    for (int i = 0; i < end - x; ++i)
      for (int c = 0; c < 4; ++c)
        out[(x - x0 + i) * 4 + c] = static_cast<float>(rgba[i] >> (8 * c) & 255u) / 255.0f;
  }
}

void read_row_depth(const Framebuffer::Impl& fb, int x0, int x1, int y, uint32_t* out) {
  for_block_rows(fb, x0, x1, y, [&](const BlockRow& row, int at) {
    const TileState& state = fb.tiles[row.tile];
    if (is_marked(state.depth_is_clear, row.block)) {
      std::fill_n(out + at, row.count, state.clear_depth);
    } else if (is_marked(state.depth_on_plane, row.block)) {
      const DepthPlane& plane = state.depth_plane;
      for (int i = 0; i < row.count; ++i)
        out[at + i] = DepthPlane::depth(plane.row(y % kTileSize), plane.across((x0 + at + i) % kTileSize));
    } else {
      std::copy_n(fb.depth_tile(row.tile) + row.block * kBlockPixels + row.first_pixel, row.count, out + at);
    }
  });
}

void read_row_stencil(const Framebuffer::Impl& fb, int x0, int x1, int y, uint8_t* out) {
  for_block_rows(fb, x0, x1, y, [&](const BlockRow& row, int at) {
    const TileState& state = fb.tiles[row.tile];
    if (is_marked(state.stencil_is_clear, row.block))
      std::fill_n(out + at, row.count, state.clear_stencil);
    else
      std::copy_n(fb.stencil_tile(row.tile) + row.block * kBlockPixels + row.first_pixel, row.count, out + at);
  });
}

void resolve_tiles(const Framebuffer::Impl& fb, uint32_t first, uint32_t count, int plane, const LinearImage& image,
                   int left, int bottom) {
  for (; count > BandWriter::kMostTiles; first += BandWriter::kMostTiles, count -= BandWriter::kMostTiles)
    resolve_tiles(fb, first, BandWriter::kMostTiles, plane, image, left, bottom);
  const Placed placed{image, left, bottom};
  Rect tiles = fb.tile_rect(first);
  tiles.x1 = fb.tile_rect(first + count - 1).x1;
  const Rect rect = intersect(tiles, placed.rect());
  if (rect.empty()) return;
  const bool in_bands = fb.format == ColorFormat::rgba8 && !image.float_components;
  const BandWriter bands(fb, plane, placed, rect, first, count);
  for (int y = rect.y0; y < rect.y1;) {
    if (in_bands && y % kBlockSize == 0 && y + kBlockSize <= rect.y1) {
      bands.write(y);
      y += kBlockSize;
      continue;
    }
    for (int x = rect.x0; x < rect.x1;) {
      const int end = std::min(x / kTileSize * kTileSize + kTileSize, rect.x1);
      resolve_row(fb, plane, x, end, y, placed);
      x = end;
    }
    ++y;
  }
}

namespace {

void copy_whole_tile(Framebuffer::Impl& fb, uint32_t tile, int from, int to) {
  TileState& state = fb.tiles[tile];
  state.color[to] = state.color[from];
  const size_t block_bytes = kBlockPixels * fb.color_pixel_bytes();
  for (uint64_t todo = ~state.color[from].is_clear; todo != 0; todo &= todo - 1) {
    const size_t at = static_cast<size_t>(std::countr_zero(todo)) * block_bytes;
    std::memcpy(fb.color_tile<std::byte>(tile, to) + at, fb.color_tile<std::byte>(tile, from) + at, block_bytes);
  }
}

// Channels that lie apart: one of bytes together, or four floats.
void copy_row(Framebuffer::Impl& fb, int from, int to, int x0, int x1, int y) {
  const bool bytes = fb.format == ColorFormat::rgba8;
  for_block_rows(fb, x0, x1, y, [&](const BlockRow& row, int) {
    for (int c = 0; c < (bytes ? 1 : 4); ++c) {
      const int at = (row.block * (bytes ? 1 : 4) + c) * kBlockPixels + row.first_pixel;
      std::copy_n(fb.color_tile<uint32_t>(row.tile, from) + at, row.count, fb.color_tile<uint32_t>(row.tile, to) + at);
    }
  });
}

}  // namespace

void copy_plane_tile(Framebuffer::Impl& fb, uint32_t tile, int from, int to, const Rect& rect) {
  const Rect all = fb.tile_rect(tile), part = intersect(all, rect);
  if (part.empty()) return;
  if (part == all) return copy_whole_tile(fb, tile, from, to);
  for (const int plane : {from, to}) fb.settle_color(tile, ~uint64_t{0}, plane);
  for (int y = part.y0; y < part.y1; ++y) copy_row(fb, from, to, part.x0, part.x1, y);
}

}  // namespace halfspace::raster
