// Pixels in client memory: what a (format, type) pair means, and conversion between such pixels and RGBA of 8
// bits or float (spec 3.6.4, 4.3.2).
//
// A component of b bits stands for c / (2^b - 1), signed ones for (2c + 1) / (2^b - 1) (table 2.9). All
// conversions round that exact value to the nearest, halves up; a NaN counts as 0.
#pragma once

#include <cstddef>
#include <cstdint>

#include "state/gl_types.h"

namespace halfspace::state {

struct PixelFormat {
  GLenum format = GL_RGBA, type = GL_UNSIGNED_BYTE;
  uint8_t components = 4;     // numbers a pixel
  uint8_t element_bytes = 1;  // of one number, or of the packed word; what byte swapping reverses
  uint8_t pixel_bytes = 4;    // 0: GL_BITMAP, eight pixels a byte
  bool packed = false;        // all components in one word
};

// Whether the pair is legal at all: GL_NO_ERROR and `out` filled in, or GL_INVALID_ENUM for an unknown name
// or GL_BITMAP with anything but an index, GL_INVALID_OPERATION for a packed type with the wrong format
// (spec 1.2, 3.6.4). Which formats a command takes is the command's question.
GLenum describe_pixels(GLenum format, GLenum type, PixelFormat& out);

bool is_index_format(GLenum format);  // GL_COLOR_INDEX, GL_STENCIL_INDEX
bool is_color_format(GLenum format);  // what holds at least one of R, G, B, A or L

// Whether a pixel in client memory is the bytes R, G, B, A in this order, so that nothing is to be converted.
bool is_plain_rgba8(const PixelFormat& format, bool swap_bytes);

// Reads `count` pixels of a colour format; writes R, G, B, A. Luminance goes to R, G and B; what the format
// lacks is 0, alpha 1. As floats they are not clamped.
void decode_pixels(const PixelFormat& format, bool swap_bytes, const std::byte* source, size_t count,
                   uint8_t* rgba);
void decode_pixels(const PixelFormat& format, bool swap_bytes, const std::byte* source, size_t count,
                   float* rgba);
// Reads GL_COLOR_INDEX or GL_STENCIL_INDEX pixels, of any type but GL_BITMAP. Fractions are dropped.
void decode_indices(const PixelFormat& format, bool swap_bytes, const std::byte* source, size_t count,
                    int64_t* indices);
// Reads GL_DEPTH_COMPONENT pixels; 1 is the far plane. Not clamped.
void decode_depths(const PixelFormat& format, bool swap_bytes, const std::byte* source, size_t count,
                   double* depths);

// Writes `count` pixels of a colour format. Luminance is R + G + B, at most 1. `rgba`: 4 components a pixel.
void encode_pixels(const PixelFormat& format, bool swap_bytes, const uint8_t* rgba, size_t count,
                   std::byte* target);
void encode_pixels(const PixelFormat& format, bool swap_bytes, const float* rgba, size_t count,
                   std::byte* target);
// Writes GL_DEPTH_COMPONENT pixels. `depth`: 24-bit, d / (2^24 - 1); or in [0, 1].
void encode_depth(const PixelFormat& format, bool swap_bytes, const uint32_t* depth, size_t count,
                  std::byte* target);
void encode_depth(const PixelFormat& format, bool swap_bytes, const double* depth, size_t count,
                  std::byte* target);
// Writes GL_STENCIL_INDEX pixels of any type but GL_BITMAP: as many bits as the type has (spec table 4.6).
void encode_indices(const PixelFormat& format, bool swap_bytes, const int64_t* indices, size_t count,
                    std::byte* target);

}  // namespace halfspace::state
