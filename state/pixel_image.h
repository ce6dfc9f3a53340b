// Images in client memory as pixel store describes them (spec 3.6.4), taken out whole or row by row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "state/pixel_format.h"
#include "state/pixel_store.h"

namespace halfspace::state {

struct Context;

// How unpack_image leaves an image: rows without gaps from the lowest, elements in the machine's byte order,
// the leftmost of eight GL_BITMAP pixels in the highest bit, each of its rows from a new byte on.
inline constexpr PixelStore kPackedStore{.alignment = 1};

// Where an image lies: `offset` bytes and `first_bit` bits after the user's pointer; bits for GL_BITMAP only.
struct ImageLayout {
  size_t offset = 0, row_bytes = 0;
  unsigned first_bit = 0;
};
ImageLayout image_layout(const PixelFormat& format, const PixelStore& store, GLsizei width);

// Copies an image of client memory, so that it reads as the same one with kPackedStore: what a display list
// keeps of it. Empty for a null pointer or an empty image; throws std::bad_alloc.
std::vector<std::byte> unpack_image(const PixelFormat& format, const PixelStore& store, GLsizei width,
                                    GLsizei height, const void* pixels);

// Reads pixels of an image in client memory and takes them through pixel transfer, as it is set at the call.
// `pixels` may be null as long as nothing is read.
class ImageReader {
 public:
  ImageReader(const Context& context, const PixelFormat& format, const PixelStore& store, GLsizei width,
              const void* pixels);

  // So that reads of up to `count` pixels do not throw std::bad_alloc.
  void reserve(size_t count);

  // Pixels (x, y) .. (x + count - 1, y). Colour formats and GL_COLOR_INDEX: R, G, B, A, clamped to [0, 1].
  void read_rgba(GLsizei x, GLsizei y, size_t count, float* rgba);
  void read_rgba8(GLsizei x, GLsizei y, size_t count, uint8_t* rgba);
  // GL_DEPTH_COMPONENT: 24-bit.
  void read_depth(GLsizei x, GLsizei y, size_t count, uint32_t* depth);
  // GL_STENCIL_INDEX: the lowest eight bits.
  void read_stencil(GLsizei x, GLsizei y, size_t count, uint8_t* stencil);

  // Row `y` where it lies, if it is R, G, B, A bytes that transfer leaves alone; else null.
  const uint8_t* plain_rgba8(GLsizei y) const;

 private:
  const std::byte* address(GLsizei x, GLsizei y) const;
  const int64_t* read_indices(GLsizei x, GLsizei y, size_t count);

  const Context& context_;
  PixelFormat format_;
  ImageLayout layout_;
  bool swap_bytes_, lsb_first_;
  const std::byte* pixels_;
  std::vector<int64_t> indices_;
  std::vector<float> colors_;
  std::vector<double> depths_;
};

}  // namespace halfspace::state
