#include "state/pixel_image.h"

#include <algorithm>
#include <cstring>
#include <new>

#include "state/context.h"
#include "state/pixel_transfer.h"
#include "state/pixel_value.h"

namespace halfspace::state {
namespace {

bool is_bitmap(const PixelFormat& format) { return format.pixel_bytes == 0; }

// Whether bit `i` of a GL_BITMAP row is set.
bool bit_at(const std::byte* row, size_t i, bool lsb_first) {
  const unsigned byte = std::to_integer<unsigned>(row[i / 8]), at = unsigned(i % 8);
  return (byte >> (lsb_first ? at : 7 - at) & 1) != 0;
}

void copy_bits(const std::byte* row, unsigned first_bit, bool lsb_first, size_t count, std::byte* out) {
  std::memset(out, 0, (count + 7) / 8);
  for (size_t i = 0; i < count; ++i) {
    if (bit_at(row, first_bit + i, lsb_first)) out[i / 8] |= std::byte(0x80 >> i % 8);
  }
}

void copy_elements(const std::byte* row, size_t bytes, size_t element_bytes, bool swap, std::byte* out) {
  std::memcpy(out, row, bytes);
  if (!swap || element_bytes == 1) return;
  for (size_t i = 0; i < bytes; i += element_bytes) {
    if (element_bytes == 2)
      store_value(out + i, load_value<uint16_t>(row + i, true), false);
    else
      store_value(out + i, load_value<uint32_t>(row + i, true), false);
  }
}

}  // namespace

ImageLayout image_layout(const PixelFormat& format, const PixelStore& store, GLsizei width) {
  if (!is_bitmap(format)) {
    const ClientLayout layout = client_layout(store, width, format.pixel_bytes);
    return {layout.offset, layout.row_bytes, 0};
  }
  // Spec 3.6.4, "Bitmap": a * ceil(l / 8a) bytes a row, and pixels to skip are bits.
  const size_t row_pixels = size_t(store.row_length > 0 ? store.row_length : width);
  const size_t alignment = size_t(store.alignment), skip = size_t(store.skip_pixels);
  ImageLayout layout;
  layout.row_bytes = (row_pixels + 8 * alignment - 1) / (8 * alignment) * alignment;
  layout.offset = size_t(store.skip_rows) * layout.row_bytes + skip / 8;
  layout.first_bit = unsigned(skip % 8);
  return layout;
}

std::vector<std::byte> unpack_image(const PixelFormat& format, const PixelStore& store, GLsizei width,
                                    GLsizei height, const void* pixels) {
  if (pixels == nullptr || width <= 0 || height <= 0) return {};
  const ImageLayout from = image_layout(format, store, width), to = image_layout(format, kPackedStore, width);
  if (size_t(height) > (SIZE_MAX >> 1) / to.row_bytes) throw std::bad_alloc();
  std::vector<std::byte> packed(to.row_bytes * size_t(height));
  const std::byte* row = static_cast<const std::byte*>(pixels) + from.offset;
  for (GLsizei y = 0; y < height; ++y, row += from.row_bytes) {
    std::byte* out = packed.data() + size_t(y) * to.row_bytes;
    if (is_bitmap(format))
      copy_bits(row, from.first_bit, store.lsb_first, size_t(width), out);
    else
      copy_elements(row, to.row_bytes, format.element_bytes, store.swap_bytes, out);
  }
  return packed;
}

ImageReader::ImageReader(const Context& context, const PixelFormat& format, const PixelStore& store,
                         GLsizei width, const void* pixels)
    : context_(context),
      format_(format),
      layout_(image_layout(format, store, width)),
      swap_bytes_(store.swap_bytes),
      lsb_first_(store.lsb_first),
      pixels_(static_cast<const std::byte*>(pixels)) {}

void ImageReader::reserve(size_t count) {
  if (is_index_format(format_.format)) indices_.resize(std::max(indices_.size(), count));
  if (format_.format == GL_DEPTH_COMPONENT) depths_.resize(std::max(depths_.size(), count));
  if (is_color_format(format_.format) || format_.format == GL_COLOR_INDEX)
    colors_.resize(std::max(colors_.size(), count * 4));
}

const std::byte* ImageReader::address(GLsizei x, GLsizei y) const {
  return pixels_ + layout_.offset + size_t(y) * layout_.row_bytes + size_t(x) * format_.pixel_bytes;
}

const uint8_t* ImageReader::plain_rgba8(GLsizei y) const {
  if (!is_plain_rgba8(format_, swap_bytes_) || transfers_colors(context_)) return nullptr;
  return reinterpret_cast<const uint8_t*>(address(0, y));
}

const int64_t* ImageReader::read_indices(GLsizei x, GLsizei y, size_t count) {
  reserve(count);
  const std::byte* source = address(x, y);
  if (is_bitmap(format_)) {
    const size_t first = layout_.first_bit + size_t(x);
    for (size_t i = 0; i < count; ++i) indices_[i] = bit_at(source, first + i, lsb_first_) ? 1 : 0;
  } else {
    decode_indices(format_, swap_bytes_, source, count, indices_.data());
  }
  return indices_.data();
}

void ImageReader::read_rgba(GLsizei x, GLsizei y, size_t count, float* rgba) {
  if (is_index_format(format_.format)) {
    return transfer_color_indices(context_, read_indices(x, y, count), count, rgba);
  }
  decode_pixels(format_, swap_bytes_, address(x, y), count, rgba);
  if (transfers_colors(context_)) transfer_colors(context_, rgba, count);
  for (size_t i = 0; i < count * 4; ++i) rgba[i] = clamp_unit(rgba[i]);
}

void ImageReader::read_rgba8(GLsizei x, GLsizei y, size_t count, uint8_t* rgba) {
  if (!is_index_format(format_.format) && !transfers_colors(context_)) {
    return decode_pixels(format_, swap_bytes_, address(x, y), count, rgba);
  }
  reserve(count);
  read_rgba(x, y, count, colors_.data());
  for (size_t i = 0; i < count * 4; ++i) rgba[i] = to_byte(colors_[i]);
}

void ImageReader::read_depth(GLsizei x, GLsizei y, size_t count, uint32_t* depth) {
  reserve(count);
  decode_depths(format_, swap_bytes_, address(x, y), count, depths_.data());
  transfer_depths(context_, depths_.data(), count);
  for (size_t i = 0; i < count; ++i) depth[i] = uint32_t(depths_[i] * double(kDepthMax) + 0.5);
}

void ImageReader::read_stencil(GLsizei x, GLsizei y, size_t count, uint8_t* stencil) {
  read_indices(x, y, count);
  transfer_stencil(context_, indices_.data(), count);
  for (size_t i = 0; i < count; ++i) stencil[i] = uint8_t(indices_[i]);
}

}  // namespace halfspace::state
