#include "tests/oracle/primitives.h"

namespace halfspace::oracle {

std::vector<GivenPrimitive> primitives_of(raster::Primitive mode, uint32_t n) {
  using raster::Primitive;
  std::vector<GivenPrimitive> all;
  switch (mode) {
    case Primitive::points:
      for (uint32_t i = 0; i < n; ++i) all.push_back({{i}});
      break;
    case Primitive::lines:
      for (uint32_t i = 0; i + 1 < n; i += 2) all.push_back({{i, i + 1}, 1, false, true});
      break;
    case Primitive::line_strip:
    case Primitive::line_loop:
      for (uint32_t i = 0; i + 1 < n; ++i) all.push_back({{i, i + 1}, 1, false, i == 0});
      if (mode == Primitive::line_loop && n > 1) all.push_back({{n - 1, 0}, 1});
      break;
    case Primitive::triangles:
      for (uint32_t i = 0; i + 2 < n; i += 3) all.push_back({{i, i + 1, i + 2}, 2, true});
      break;
    case Primitive::triangle_strip:  // every other one is turned around, so that all face alike
      for (uint32_t i = 0; i + 2 < n; ++i) all.push_back({{i + i % 2, i + 1 - i % 2, i + 2}, 2});
      break;
    case Primitive::triangle_fan:
      for (uint32_t i = 1; i + 1 < n; ++i) all.push_back({{0, i, i + 1}, 2});
      break;
    case Primitive::quads:
      for (uint32_t i = 0; i + 3 < n; i += 4) all.push_back({{i, i + 1, i + 2, i + 3}, 3, true});
      break;
    case Primitive::quad_strip:
      for (uint32_t i = 0; i + 3 < n; i += 2) all.push_back({{i, i + 1, i + 3, i + 2}, 2});
      break;
    case Primitive::polygon:
      if (n < 3) break;
      all.push_back({{}, 0, true});
      for (uint32_t i = 0; i < n; ++i) all[0].places.push_back(i);
      break;
  }
  return all;
}

}  // namespace halfspace::oracle
