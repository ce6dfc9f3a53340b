// Evaluators (spec 5.1): polynomial maps from a domain coordinate, or two, to vertices and their attributes.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

inline constexpr int kMaxEvalOrder = 30;

// What maps yield, in the order of GL_MAP1_COLOR_4 ... and GL_MAP2_COLOR_4 ...
enum MapKind : size_t {
  kMapColor,
  kMapIndex,
  kMapNormal,
  kMapTexCoord1,
  kMapTexCoord2,
  kMapTexCoord3,
  kMapTexCoord4,
  kMapVertex3,
  kMapVertex4,
};
inline constexpr size_t kMapKinds = 9;
inline constexpr std::array<size_t, kMapKinds> kMapComponents{4, 1, 3, 1, 2, 3, 4, 3, 4};

// One direction of a map: the domain is low .. high, the order one more than the degree.
struct MapAxis {
  double low = 0, high = 1;
  int order = 1;  // 1 .. kMaxEvalOrder
};

// Control points, packed; those of a 2D map with v running fastest (which is GetMap's order).
struct Map1 {
  MapAxis u;
  std::vector<float> points;
};
struct Map2 {
  MapAxis u, v;
  std::vector<float> points;
};

struct MapGrid {
  GLint segments = 1;
  double low = 0, high = 1;
};

// The group of GL_EVAL_BIT: the maps themselves are not in it.
struct EvaluatorState {
  std::array<bool, kMapKinds> map1{}, map2{};  // enabled
  bool auto_normal = false;
  MapGrid grid1, grid2_u, grid2_v;
};

struct EvaluatorMaps {
  EvaluatorMaps();
  std::array<Map1, kMapKinds> map1;
  std::array<Map2, kMapKinds> map2;
};

// How many numbers glMap1 and glMap2 read at `points`; 0 where the command is going to be refused.
size_t map1_values(GLenum target, GLint stride, GLint order);
size_t map2_values(GLenum target, GLint u_stride, GLint u_order, GLint v_stride, GLint v_order);

// --- within the evaluator files

// Vertices of the maps that are enabled, as glEvalCoord makes them.
void evaluate1(Context& context, double u);
void evaluate2(Context& context, double u, double v);

}  // namespace halfspace::state
