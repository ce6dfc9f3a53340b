#include "gl/osmesa/format.h"

namespace halfspace::gl {

using raster::PixelLayout;

int BufferFormat::pixel_bytes() const {
  switch (component) {
    case Component::byte8:
      return components;
    case Component::short16:
      return 2 * components;
    case Component::float32:
      return 4 * components;
    case Component::packed565:
      return 2;
  }
  return 0;
}

raster::ColorFormat BufferFormat::surface_format() const {
  const bool wide = component == Component::short16 || component == Component::float32;
  return wide ? raster::ColorFormat::rgba32f : raster::ColorFormat::rgba8;
}

std::optional<BufferFormat> format_of_context(GLenum format) {
  switch (format) {
    case OSMESA_RGBA:
      return BufferFormat{PixelLayout::rgba, Component::byte8, 4};
    case OSMESA_BGRA:
      return BufferFormat{PixelLayout::bgra, Component::byte8, 4};
    case OSMESA_ARGB:
      return BufferFormat{PixelLayout::argb, Component::byte8, 4};
    case OSMESA_RGB:
      return BufferFormat{PixelLayout::rgb, Component::byte8, 3};
    case OSMESA_BGR:
      return BufferFormat{PixelLayout::bgr, Component::byte8, 3};
    case OSMESA_RGB_565:
      return BufferFormat{PixelLayout::rgb565, Component::packed565, 3};
    default:
      return std::nullopt;
  }
}

std::optional<BufferFormat> format_of_buffer(GLenum context_format, GLenum type) {
  std::optional<BufferFormat> format = format_of_context(context_format);
  if (!format) return format;
  const bool packed = format->component == Component::packed565;
  if (packed != (type == GL_UNSIGNED_SHORT_5_6_5)) return std::nullopt;
  if (packed) return format;
  switch (type) {
    case GL_UNSIGNED_BYTE:
      return format;
    case GL_UNSIGNED_SHORT:
      format->component = Component::short16;
      return format;
    case GL_FLOAT:
      format->component = Component::float32;
      return format;
    default:
      return std::nullopt;
  }
}

state::VisualConfig visual_of(const BufferFormat& format, const AncillaryBits& bits) {
  state::VisualConfig visual;
  int color_bits = 8;
  if (format.component == Component::short16) color_bits = 16;
  if (format.component == Component::float32) color_bits = 32;
  visual.red_bits = visual.green_bits = visual.blue_bits = color_bits;
  visual.alpha_bits = format.has_alpha() ? color_bits : 0;
  if (format.component == Component::packed565) {
    visual.red_bits = visual.blue_bits = 5;
    visual.green_bits = 6;
  }
  // Never fewer than there are in any buffer of ours, even when 16 bits of depth were asked for.
  visual.depth_bits = bits.depth > 0 ? 24 : 0;
  visual.stencil_bits = bits.stencil > 0 ? 8 : 0;
  visual.accum_bits = bits.accum > 0 ? 16 : 0;
  return visual;
}

}  // namespace halfspace::gl
