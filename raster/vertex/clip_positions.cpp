#include "raster/vertex/clip_positions.h"

namespace halfspace::raster {

ClipVertex ClipPositions::operator[](uint32_t vertex) const {
  float v[4] = {0, 0, 0, 1};
  if (position_.data != nullptr) read_element(position_, vertex, v);
  const double x = double(v[0]), y = double(v[1]), z = double(v[2]), w = double(v[3]);
  double clip[4];
  // As row_times() in raster/vertex/vertex_stage.cpp.
  for (int r = 0; r < 4; ++r) clip[r] = ((m_[r] * x + m_[4 + r] * y) + m_[8 + r] * z) + m_[12 + r] * w;
  return {clip[0], clip[1], clip[2], clip[3]};
}

}  // namespace halfspace::raster
