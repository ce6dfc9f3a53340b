// Rectangles of fragments that come from an image instead of a primitive: glDrawPixels, glCopyPixels and
// glBitmap (spec 3.6, 3.7, 4.3.3). They go through all of the fragment stages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "raster/api/draw_state.h"

namespace halfspace::raster {

// What the fragments' values are; the other values are the packet's own.
enum class PixelKind : uint8_t {
  color,    // `color`: a colour each; depth is the raster position's
  depth,    // `depth`: a 24-bit depth each; colour is the raster position's
  bitmap,   // `bits`: a fragment where the bit is set, with the raster position's colour and depth
  stencil,  // `stencil`: written under the stencil write mask where scissor and ownership let it; no other
            // stage runs
};

// Element (i, j) of the whole image, j up, covers the pixels whose centres lie in the rectangle between (x + zoom_x * i,
// y + zoom_y * j) and (x + zoom_x * (i + 1), y + zoom_y * (j + 1)), left and lower edges in, for either sign of the
// zooms. A packet brings a part of the image; parts of one image meet without gap or overlap. Nothing is kept of the
// arrays once Device::draw_pixels has returned.
struct PixelPacket {
  std::shared_ptr<const DrawState> state;
  PixelKind kind = PixelKind::color;
  int width = 0, height = 0;          // elements
  int first_column = 0, first_row = 0;  // of the whole image: i and j of the packet's element 0
  double x = 0, y = 0;        // window coordinates of the image's corner
  double zoom_x = 1, zoom_y = 1;
  const float* color = nullptr;     // 4 floats an element, r g b a in [0, 1]
  const uint32_t* depth = nullptr;  // 0 .. 2^24 - 1
  const uint8_t* stencil = nullptr;
  uint8_t stencil_mask = 0xff;  // bits to write
  const uint8_t* bits = nullptr;  // rows of row_bytes bytes, leftmost element in the highest bit
  size_t row_elements = 0;        // elements from row to row of color, depth, stencil
  size_t row_bytes = 0;           // of bits
  Color raster_color{1, 1, 1, 1};
  double raster_depth = 0;                    // window z, in [0, 1]
  double raster_tex_coord[4] = {0, 0, 0, 1};  // s t r q, through the texture matrix
  double raster_distance = 0;                 // eye distance, for fog
};

}  // namespace halfspace::raster
