// glPixelStore (spec 3.6.1, 4.3.1), and where it puts pixels in client memory.
#pragma once

#include <cstddef>

#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

struct PixelStore {
  bool swap_bytes = false, lsb_first = false;
  GLint row_length = 0, skip_rows = 0, skip_pixels = 0;  // pixels; row_length 0: the image's width
  GLint alignment = 4;                                   // bytes: 1, 2, 4 or 8
};

struct PixelStoreState {
  PixelStore pack, unpack;
};

// Byte distances of an image in client memory: pixel (0, 0) lies `offset` bytes after the user's pointer.
struct ClientLayout {
  size_t offset = 0;
  size_t row_bytes = 0;    // from row to row
  size_t pixel_bytes = 0;  // from pixel to pixel
};

// For pixels of `pixel_bytes` bytes each (spec 3.6.4). GL_BITMAP is not laid out like this.
ClientLayout client_layout(const PixelStore& store, GLsizei width, size_t pixel_bytes);

}  // namespace halfspace::state
