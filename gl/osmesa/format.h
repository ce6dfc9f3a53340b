// What OSMesa's format and type say about the user's buffer.
#pragma once

#include <GL/osmesa.h>

#include <optional>

#include "raster/api/framebuffer.h"
#include "state/drawable.h"

namespace halfspace::gl {

// How a component lies in memory. packed565: GL_UNSIGNED_SHORT_5_6_5, three components in one word.
enum class Component : uint8_t { byte8, short16, float32, packed565 };

struct BufferFormat {
  raster::PixelLayout layout = raster::PixelLayout::rgba;
  Component component = Component::byte8;
  int components = 4;
  bool operator==(const BufferFormat&) const = default;

  // Bytes a pixel.
  int pixel_bytes() const;
  // What to draw in: bytes hold every component up to 8 bits, floats the others.
  raster::ColorFormat surface_format() const;
  bool has_alpha() const { return components == 4; }
};

// The layout a context format stands for; nothing for OSMESA_COLOR_INDEX and for what is no format.
std::optional<BufferFormat> format_of_context(GLenum format);
// `context_format` with components of `type`; nothing when the two do not go together.
std::optional<BufferFormat> format_of_buffer(GLenum context_format, GLenum type);
// Bits of the buffers beside the colours, as the program asked for.
struct AncillaryBits {
  int depth = 0, stencil = 0, accum = 0;
};
// What glGet reports as the bits of such a buffer.
state::VisualConfig visual_of(const BufferFormat& format, const AncillaryBits& bits);

}  // namespace halfspace::gl
