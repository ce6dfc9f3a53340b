// Which places of a draw's list of vertices make a triangle or a face, and which corner provokes (spec table
// 2.12: the last vertex of the primitive, but a polygon's first). Quads are split along the diagonal that
// ends in their last vertex.
#pragma once

#include <cstdint>

#include "raster/api/types.h"

namespace halfspace::raster {

struct Corners {
  uint32_t v[3];  // places in the draw's list of vertices
};

// kTriangles: of a face; 0: all of the draw's. face(k, i): corner i of the face that triangle k is the first
// of. kFlagged: the vertices' edge flags count (spec 2.6.2).
struct ListTriangles {
  static constexpr uint8_t kProvoking = 2;
  static constexpr uint32_t kTriangles = 1, kProvokingCorner = 2;
  static constexpr bool kFlagged = true;
  static Corners at(uint32_t k) { return {{3 * k, 3 * k + 1, 3 * k + 2}}; }
  static uint32_t face(uint32_t k, uint32_t i) { return at(k).v[i]; }
};
struct StripTriangles {
  static constexpr uint8_t kProvoking = 2;
  static constexpr uint32_t kTriangles = 1, kProvokingCorner = 2;
  static constexpr bool kFlagged = false;
  static Corners at(uint32_t k) { return {{k + (k & 1), k + 1 - (k & 1), k + 2}}; }
  static uint32_t face(uint32_t k, uint32_t i) { return at(k).v[i]; }
};
struct FanTriangles {
  static constexpr uint8_t kProvoking = 2;
  static constexpr uint32_t kTriangles = 1, kProvokingCorner = 2;
  static constexpr bool kFlagged = false;
  static Corners at(uint32_t k) { return {{0, k + 1, k + 2}}; }
  static uint32_t face(uint32_t k, uint32_t i) { return at(k).v[i]; }
};
struct PolygonTriangles {
  static constexpr uint8_t kProvoking = 0;
  static constexpr uint32_t kTriangles = 0, kProvokingCorner = 0;
  static constexpr bool kFlagged = true;
  static Corners at(uint32_t k) { return {{0, k + 1, k + 2}}; }
  static uint32_t face(uint32_t, uint32_t i) { return i; }
};
struct QuadTriangles {
  static constexpr uint8_t kProvoking = 2;
  static constexpr uint32_t kTriangles = 2, kProvokingCorner = 3;
  static constexpr bool kFlagged = true;
  static Corners at(uint32_t k) {
    const uint32_t q = k / 2 * 4;
    return k & 1 ? Corners{{q + 1, q + 2, q + 3}} : Corners{{q, q + 1, q + 3}};
  }
  static uint32_t face(uint32_t k, uint32_t i) { return k / 2 * 4 + i; }
};
// Quad i has the corners 2i, 2i + 1, 2i + 3, 2i + 2 in turn.
struct QuadStripTriangles {
  static constexpr uint8_t kProvoking = 2;
  static constexpr uint32_t kTriangles = 2, kProvokingCorner = 2;
  static constexpr bool kFlagged = false;
  static Corners at(uint32_t k) {
    const uint32_t q = k / 2 * 2;
    return k & 1 ? Corners{{q, q + 1, q + 3}} : Corners{{q + 2, q, q + 3}};
  }
  static uint32_t face(uint32_t k, uint32_t i) { return k / 2 * 2 + (i < 2 ? i : 5 - i); }
};

// Has `assembler` take primitives [first, first + count) of a draw: points(), lines() or, by their pattern, faces<>().
template <class Assembler>
void assemble_by_mode(Assembler& assembler, Primitive mode, uint32_t first, uint32_t count) {
  switch (mode) {
    case Primitive::points:
      return assembler.points(first, count);
    case Primitive::lines:
    case Primitive::line_loop:
    case Primitive::line_strip:
      return assembler.lines(mode, first, count);
    case Primitive::triangles:
      return assembler.template faces<ListTriangles>(first, count);
    case Primitive::triangle_strip:
      return assembler.template faces<StripTriangles>(first, count);
    case Primitive::triangle_fan:
      return assembler.template faces<FanTriangles>(first, count);
    case Primitive::polygon:
      return assembler.template faces<PolygonTriangles>(first, count);
    case Primitive::quads:
      return assembler.template faces<QuadTriangles>(first, count);
    case Primitive::quad_strip:
      return assembler.template faces<QuadStripTriangles>(first, count);
  }
}

}  // namespace halfspace::raster
