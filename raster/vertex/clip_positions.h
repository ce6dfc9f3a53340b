// A draw's clip coordinates. Only what is cut asks for them, so none is kept: they are worked out again, by
// the operations that placed the vertex, to the same bits.
#pragma once

#include "raster/api/draw_packet.h"

namespace halfspace::raster {

struct ClipVertex {
  double x, y, z, w;
};

// Valid as long as the positions and the matrix are.
class ClipPositions {
 public:
  ClipPositions() = default;
  ClipPositions(const AttributeStream& position, const DrawState& state)
      : ClipPositions(position, state.clip_from_object.data()) {}
  ClipPositions(const AttributeStream& position, const double* clip_from_object)
      : position_(position), m_(clip_from_object) {}
  ClipVertex operator[](uint32_t vertex) const;

 private:
  AttributeStream position_;
  const double* m_ = nullptr;  // clip_from_object, column-major
};

}  // namespace halfspace::raster
