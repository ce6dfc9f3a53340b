// glReadPixels (spec 4.3.2).
#include <algorithm>
#include <vector>

#include "state/context.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"
#include "state/pixel_image.h"
#include "state/pixel_transfer.h"
#include "state/pixel_value.h"

namespace halfspace::state {
namespace {

// Pixels fetched from the device at a time.
constexpr int64_t kBandPixels = 1 << 16;

// Where a read goes. Rows of client memory are numbered as the window's are, from the bottom.
struct ReadTarget {
  const Context& context;  // whose pixel transfer the pixels go through
  PixelFormat format;
  ImageLayout layout;
  bool swap_bytes, lsb_first;
  raster::ColorPlane plane;
  bool opaque;  // the visual has no alpha: it reads as 1
  int x, y;     // window position of the user's first pixel
  std::byte* pixels;

  std::byte* address(int window_x, int window_y) const {
    return pixels + layout.offset + size_t(window_y - y) * layout.row_bytes +
           size_t(window_x - x) * format.pixel_bytes;
  }
  // GL_BITMAP: the bit of the byte at address() that pixel `window_x` is, or of one behind it.
  size_t bit(int window_x) const { return layout.first_bit + size_t(window_x - x); }
};

void set_opaque(uint8_t* rgba, size_t count) {
  for (size_t i = 0; i < count; ++i) rgba[4 * i + 3] = 255;
}
void set_opaque(float* rgba, size_t count) {
  for (size_t i = 0; i < count; ++i) rgba[4 * i + 3] = 1;
}

// Fetches `rect` in bands of rows and hands on each row: fetch(band, values), emit(row's values, count,
// address).
template <class Value, class Fetch, class Emit>
void read_bands(const raster::Rect& rect, size_t values_a_pixel, const ReadTarget& target, Fetch&& fetch,
                Emit&& emit) {
  const int width = rect.x1 - rect.x0;
  const int band_rows = int(std::clamp<int64_t>(kBandPixels / width, 1, rect.y1 - rect.y0));
  const size_t row_values = size_t(width) * values_a_pixel;
  std::vector<Value> values(row_values * size_t(band_rows));
  for (int y = rect.y0; y < rect.y1; y += band_rows) {
    const int end = std::min(y + band_rows, rect.y1);
    fetch(raster::Rect{rect.x0, y, rect.x1, end}, values.data());
    for (int row = y; row < end; ++row) {
      emit(&values[row_values * size_t(row - y)], size_t(width), target.address(rect.x0, row));
    }
  }
}

void read_depth(raster::Device& device, const raster::Rect& rect, const ReadTarget& target) {
  read_bands<uint32_t>(
      rect, 1, target, [&](const raster::Rect& band, uint32_t* out) { device.read_depth(band, out); },
      [&](const uint32_t* row, size_t count, std::byte* out) {
        if (!transfers_depths(target.context))
          return encode_depth(target.format, target.swap_bytes, row, count, out);
        std::vector<double> depths(count);
        for (size_t i = 0; i < count; ++i) depths[i] = double(row[i]) / double(kDepthMax);
        transfer_depths(target.context, depths.data(), count);
        encode_depth(target.format, target.swap_bytes, depths.data(), count, out);
      });
}

// Spec table 4.6: of an index, a bit is the lowest.
void store_bits(const int64_t* indices, size_t count, size_t first_bit, bool lsb_first, std::byte* out) {
  for (size_t i = 0; i < count; ++i) {
    const size_t at = first_bit + i;
    const auto mask = std::byte(lsb_first ? 1 << at % 8 : 0x80 >> at % 8);
    out[at / 8] = (indices[i] & 1) != 0 ? out[at / 8] | mask : out[at / 8] & ~mask;
  }
}

void read_stencil(raster::Device& device, const raster::Rect& rect, const ReadTarget& target) {
  std::vector<int64_t> indices(size_t(rect.x1 - rect.x0));
  read_bands<uint8_t>(
      rect, 1, target, [&](const raster::Rect& band, uint8_t* out) { device.read_stencil(band, out); },
      [&](const uint8_t* row, size_t count, std::byte* out) {
        std::copy_n(row, count, indices.data());
        transfer_stencil(target.context, indices.data(), count);
        if (target.format.type == GL_BITMAP) {
          store_bits(indices.data(), count, target.bit(rect.x0), target.lsb_first, out);
        } else {
          encode_indices(target.format, target.swap_bytes, indices.data(), count, out);
        }
      });
}

// Colours through pixel transfer, on their way to client memory.
template <class Value>
void encode_transferred(const ReadTarget& target, const Value* row, size_t count, std::byte* out) {
  std::vector<float> rgba(count * 4);
  for (size_t i = 0; i < count * 4; ++i) rgba[i] = to_component(row[i]);
  transfer_colors(target.context, rgba.data(), count);
  encode_pixels(target.format, target.swap_bytes, rgba.data(), count, out);
}

template <class Value, class Fetch>
void read_color(const raster::Rect& rect, const ReadTarget& target, Fetch&& fetch) {
  read_bands<Value>(rect, 4, target, fetch, [&](Value* row, size_t count, std::byte* out) {
    if (target.opaque) set_opaque(row, count);
    if (transfers_colors(target.context)) return encode_transferred(target, row, count, out);
    encode_pixels(target.format, target.swap_bytes, row, count, out);
  });
}

// The usual read: bytes as they are, rows without gaps. No buffer in between.
bool read_plain(raster::Device& device, const raster::Rect& rect, const ReadTarget& target) {
  const size_t width = size_t(rect.x1 - rect.x0);
  if (transfers_colors(target.context)) return false;
  if (!is_plain_rgba8(target.format, target.swap_bytes) || target.layout.row_bytes != width * 4) return false;
  uint8_t* out = reinterpret_cast<uint8_t*>(target.address(rect.x0, rect.y0));
  device.read_color(rect, out, target.plane);
  if (target.opaque) set_opaque(out, width * size_t(rect.y1 - rect.y0));
  return true;
}

void read_into(Context& context, raster::Framebuffer& framebuffer, const raster::Rect& rect,
               const ReadTarget& target) {
  raster::Device& device = context.device;
  device.begin_pass(&framebuffer);
  if (target.format.format == GL_DEPTH_COMPONENT) return read_depth(device, rect, target);
  if (target.format.format == GL_STENCIL_INDEX) return read_stencil(device, rect, target);
  if (read_plain(device, rect, target)) return;
  if (framebuffer.format() == raster::ColorFormat::rgba32f) {
    read_color<float>(rect, target, [&](const raster::Rect& band, float* out) {
      device.read_color_float(band, out, target.plane);
    });
  } else {
    read_color<uint8_t>(rect, target, [&](const raster::Rect& band, uint8_t* out) {
      device.read_color(band, out, target.plane);
    });
  }
}

// Buffers that are not there: INVALID_OPERATION (spec 4.3.2).
GLenum check_read(const Context& context, GLenum format, GLenum type, PixelFormat& out) {
  const GLenum error = describe_pixels(format, type, out);
  if (error != GL_NO_ERROR) return error;
  if (format == GL_COLOR_INDEX) return GL_INVALID_OPERATION;  // of an RGBA visual there are none
  if (format == GL_STENCIL_INDEX && context.visual.stencil_bits == 0) return GL_INVALID_OPERATION;
  if (format == GL_DEPTH_COMPONENT && context.visual.depth_bits == 0) return GL_INVALID_OPERATION;
  return GL_NO_ERROR;
}

// Pixels of the read that exist. Sides are at most 2^31: no overflow in 64 bits.
raster::Rect clip_to(const raster::Framebuffer& framebuffer, GLint x, GLint y, GLsizei width,
                     GLsizei height) {
  const auto clip = [](int64_t v, int limit) { return int(std::clamp<int64_t>(v, 0, limit)); };
  return {clip(x, framebuffer.width()), clip(y, framebuffer.height()),
          clip(int64_t{x} + width, framebuffer.width()), clip(int64_t{y} + height, framebuffer.height())};
}

}  // namespace

namespace op {

void read_pixels(Context& context, GLint x, GLint y, GLsizei width, GLsizei height, GLenum format,
                 GLenum type, GLvoid* pixels) {
  if (width < 0 || height < 0) return record_error(context, GL_INVALID_VALUE);
  PixelFormat pixel_format;
  const GLenum error = check_read(context, format, type, pixel_format);
  if (error != GL_NO_ERROR) return record_error(context, error);
  if (pixels == nullptr) return;
  guard_memory(context, [&] {
    raster::Framebuffer* framebuffer = read_framebuffer(context);
    if (framebuffer == nullptr) return;
    const raster::Rect rect = clip_to(*framebuffer, x, y, width, height);
    if (rect.empty()) return;
    const PixelStore& pack = context.pixel_store.pack;
    read_into(context, *framebuffer, rect,
              {.context = context,
               .format = pixel_format,
               .layout = image_layout(pixel_format, pack, width),
               .swap_bytes = pack.swap_bytes,
               .lsb_first = pack.lsb_first,
               .plane = read_plane(context),
               .opaque = context.visual.alpha_bits == 0,
               .x = x,
               .y = y,
               .pixels = static_cast<std::byte*>(pixels)});
  });
}

}  // namespace op
}  // namespace halfspace::state
