// Rectangles of fragments that come from an image (spec 3.6.4, "Rasterization", and 3.7): which element each
// pixel takes, and what the tiles need of the image.
#pragma once

#include <cstddef>
#include <cstdint>

#include "raster/api/pixel_packet.h"
#include "raster/arena.h"
#include "raster/vertex/shaded_vertices.h"

namespace halfspace::raster {

// An image as the tiles see it. The arrays are the caller's or, for a small image, copies in the pass's
// arena.
struct PixelImage {
  PixelKind kind = PixelKind::color;
  Rect bounds;            // pixels that get a fragment, or for a bitmap may get one
  const int32_t* column;  // of pixel bounds.x0 + i: its element's place in a row of the image
  const int32_t* row;     // of pixel bounds.y0 + i: its element's row
  const float* color;
  const uint32_t* depth;
  const uint8_t* stencil;
  const uint8_t* bits;
  size_t row_elements, row_bytes;
  uint8_t stencil_mask;
  double planes[8];  // values that all fragments share, in SetupBatch's units and in the layout's order
};

// What a pixel rectangle's fragments bring along.
VertexLayout pixel_layout(const PixelPacket& packet);

// Whether the image is small enough to be kept until the pass is executed.
bool is_small(const PixelPacket& packet);

// Lays out the fragments inside `limit`; false if there are none. `keep`: copies what they need into `arena`,
// else the packet's arrays stay in use. May throw std::bad_alloc.
bool lay_out_pixels(const PixelPacket& packet, const VertexLayout& layout, const Rect& limit, bool keep,
                    Arena& arena, PixelImage& image);

}  // namespace halfspace::raster
