// The maps, the grids, and what can be asked about them.
#include "state/evaluator.h"

#include <algorithm>
#include <cmath>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"

namespace halfspace::state {
namespace {

// Spec table 5.1's kinds; kMapKinds: `target` names none.
size_t kind_of(GLenum target, GLenum first) {
  const GLenum kind = target - first;
  return kind < kMapKinds ? kind : kMapKinds;
}
size_t map1_kind(GLenum target) { return kind_of(target, GL_MAP1_COLOR_4); }
size_t map2_kind(GLenum target) { return kind_of(target, GL_MAP2_COLOR_4); }

bool is_order(GLint order) { return order >= 1 && order <= kMaxEvalOrder; }

// `stride` counts numbers, and is at least a point's own.
bool is_axis(const MapAxis& axis, GLint stride, size_t kind) {
  return is_order(axis.order) && stride >= GLint(kMapComponents[kind]) && axis.low != axis.high;
}

template <class T>
void set_map1(Context& context, GLenum target, const MapAxis& u, GLint stride, const T* points,
              const char* operation) {
  const size_t kind = map1_kind(target);
  if (kind == kMapKinds) return record_error(context, GL_INVALID_ENUM, operation);
  if (!is_axis(u, stride, kind)) return record_error(context, GL_INVALID_VALUE, operation);
  const auto set = [&] {
    std::vector<float> packed;
    packed.reserve(size_t(u.order) * kMapComponents[kind]);
    for (GLint i = 0; i < u.order; ++i) {
      const T* point = points + ptrdiff_t{i} * stride;
      for (size_t k = 0; k < kMapComponents[kind]; ++k) packed.push_back(float(point[k]));
    }
    context.maps.map1[kind] = {u, std::move(packed)};
  };
  guard_memory(context, set, operation);
}

template <class T>
void set_map2(Context& context, GLenum target, const MapAxis& u, GLint u_stride, const MapAxis& v,
              GLint v_stride, const T* points, const char* operation) {
  const size_t kind = map2_kind(target);
  if (kind == kMapKinds) return record_error(context, GL_INVALID_ENUM, operation);
  if (!is_axis(u, u_stride, kind) || !is_axis(v, v_stride, kind))
    return record_error(context, GL_INVALID_VALUE, operation);
  const auto set = [&] {
    std::vector<float> packed;
    packed.reserve(size_t(u.order) * size_t(v.order) * kMapComponents[kind]);
    for (GLint i = 0; i < u.order; ++i) {
      for (GLint j = 0; j < v.order; ++j) {
        const T* point = points + ptrdiff_t{i} * u_stride + ptrdiff_t{j} * v_stride;
        for (size_t k = 0; k < kMapComponents[kind]; ++k) packed.push_back(float(point[k]));
      }
    }
    context.maps.map2[kind] = {u, v, std::move(packed)};
  };
  guard_memory(context, set, operation);
}

template <class T>
T answer(double value) {
  if constexpr (std::is_integral_v<T>) {
    return to_integer(value, GetKind::real);
  } else {
    return T(value);
  }
}

template <class T>
void get_map1(const Map1& map, GLenum query, T* out) {
  switch (query) {
    case GL_COEFF:
      std::transform(map.points.begin(), map.points.end(), out, [](float v) { return answer<T>(double(v)); });
      return;
    case GL_ORDER:
      *out = T(map.u.order);
      return;
    default:
      out[0] = answer<T>(map.u.low);
      out[1] = answer<T>(map.u.high);
  }
}

template <class T>
void get_map2(const Map2& map, GLenum query, T* out) {
  switch (query) {
    case GL_COEFF:
      std::transform(map.points.begin(), map.points.end(), out, [](float v) { return answer<T>(double(v)); });
      return;
    case GL_ORDER:
      out[0] = T(map.u.order);
      out[1] = T(map.v.order);
      return;
    default:
      out[0] = answer<T>(map.u.low);
      out[1] = answer<T>(map.u.high);
      out[2] = answer<T>(map.v.low);
      out[3] = answer<T>(map.v.high);
  }
}

template <class T>
void get_map(Context& context, GLenum target, GLenum query, T* out, const char* operation) {
  const bool is_query = query == GL_COEFF || query == GL_ORDER || query == GL_DOMAIN;
  const size_t kind1 = map1_kind(target), kind2 = map2_kind(target);
  if (!is_query || (kind1 == kMapKinds && kind2 == kMapKinds))
    return record_error(context, GL_INVALID_ENUM, operation);
  if (kind1 < kMapKinds) return get_map1(context.maps.map1[kind1], query, out);
  get_map2(context.maps.map2[kind2], query, out);
}

// A step of the grid; its ends are exact (spec 5.1: u2 itself where i is n).
double grid_coordinate(const MapGrid& grid, GLint i) {
  if (i == grid.segments) return grid.high;
  return double(i) * ((grid.high - grid.low) / double(grid.segments)) + grid.low;
}

void evaluate_point1(Context& context, GLint i) {
  evaluate1(context, grid_coordinate(context.evaluator.grid1, i));
}

void evaluate_point2(Context& context, GLint i, GLint j) {
  evaluate2(context, grid_coordinate(context.evaluator.grid2_u, i),
            grid_coordinate(context.evaluator.grid2_v, j));
}

// The loops count in 64 bits: a mesh may end at the last number.
void draw_strip1(Context& context, GLenum primitive, GLint i1, GLint i2) {
  op::begin(context, primitive);
  for (GLint64 i = i1; i <= i2; ++i) evaluate_point1(context, GLint(i));
  op::end(context);
}

void draw_quads(Context& context, GLint i1, GLint i2, GLint j1, GLint j2) {
  for (GLint64 j = j1; j < j2; ++j) {
    op::begin(context, GL_QUAD_STRIP);
    for (GLint64 i = i1; i <= i2; ++i) {
      evaluate_point2(context, GLint(i), GLint(j));
      evaluate_point2(context, GLint(i), GLint(j + 1));
    }
    op::end(context);
  }
}

void draw_grid_lines(Context& context, GLint i1, GLint i2, GLint j1, GLint j2) {
  for (GLint64 j = j1; j <= j2; ++j) {
    op::begin(context, GL_LINE_STRIP);
    for (GLint64 i = i1; i <= i2; ++i) evaluate_point2(context, GLint(i), GLint(j));
    op::end(context);
  }
  for (GLint64 i = i1; i <= i2; ++i) {
    op::begin(context, GL_LINE_STRIP);
    for (GLint64 j = j1; j <= j2; ++j) evaluate_point2(context, GLint(i), GLint(j));
    op::end(context);
  }
}

void draw_grid_points(Context& context, GLint i1, GLint i2, GLint j1, GLint j2) {
  op::begin(context, GL_POINTS);
  for (GLint64 j = j1; j <= j2; ++j) {
    for (GLint64 i = i1; i <= i2; ++i) evaluate_point2(context, GLint(i), GLint(j));
  }
  op::end(context);
}

// The initial maps: one point, the initial current value (spec table 6.22).
std::vector<float> initial_points(size_t kind) {
  switch (kind) {
    case kMapColor:
      return {1, 1, 1, 1};
    case kMapIndex:
      return {1};
    case kMapNormal:
      return {0, 0, 1};
    default: {
      std::vector<float> point(kMapComponents[kind], 0.0f);
      if (point.size() == 4) point[3] = 1;
      return point;
    }
  }
}

}  // namespace

EvaluatorMaps::EvaluatorMaps() {
  for (size_t kind = 0; kind < kMapKinds; ++kind)
    map1[kind].points = map2[kind].points = initial_points(kind);
}

size_t map1_values(GLenum target, GLint stride, GLint order) {
  const size_t kind = map1_kind(target);
  if (kind == kMapKinds || !is_axis({0, 1, order}, stride, kind)) return 0;
  return size_t(order - 1) * size_t(stride) + kMapComponents[kind];
}

size_t map2_values(GLenum target, GLint u_stride, GLint u_order, GLint v_stride, GLint v_order) {
  const size_t kind = map2_kind(target);
  if (kind == kMapKinds || !is_axis({0, 1, u_order}, u_stride, kind) ||
      !is_axis({0, 1, v_order}, v_stride, kind))
    return 0;
  return size_t(u_order - 1) * size_t(u_stride) + size_t(v_order - 1) * size_t(v_stride) +
         kMapComponents[kind];
}

namespace op {

void map1f(Context& context, GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order,
           const GLfloat* points) {
  set_map1(context, target, {double(u1), double(u2), order}, stride, points, __func__);
}

void map1d(Context& context, GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
           const GLdouble* points) {
  set_map1(context, target, {u1, u2, order}, stride, points, __func__);
}

void map2f(Context& context, GLenum target, GLfloat u1, GLfloat u2, GLint u_stride, GLint u_order, GLfloat v1,
           GLfloat v2, GLint v_stride, GLint v_order, const GLfloat* points) {
  set_map2(context, target, {double(u1), double(u2), u_order}, u_stride, {double(v1), double(v2), v_order},
           v_stride, points, __func__);
}

void map2d(Context& context, GLenum target, GLdouble u1, GLdouble u2, GLint u_stride, GLint u_order,
           GLdouble v1, GLdouble v2, GLint v_stride, GLint v_order, const GLdouble* points) {
  set_map2(context, target, {u1, u2, u_order}, u_stride, {v1, v2, v_order}, v_stride, points, __func__);
}

void get_mapdv(Context& context, GLenum target, GLenum query, GLdouble* v) {
  get_map(context, target, query, v, __func__);
}

void get_mapfv(Context& context, GLenum target, GLenum query, GLfloat* v) {
  get_map(context, target, query, v, __func__);
}

void get_mapiv(Context& context, GLenum target, GLenum query, GLint* v) {
  get_map(context, target, query, v, __func__);
}

void map_grid1(Context& context, GLint n, GLdouble u1, GLdouble u2) {
  if (n < 1) return record_error(context, GL_INVALID_VALUE);
  context.evaluator.grid1 = {n, u1, u2};
}

void map_grid2(Context& context, GLint u_n, GLdouble u1, GLdouble u2, GLint v_n, GLdouble v1, GLdouble v2) {
  if (u_n < 1 || v_n < 1) return record_error(context, GL_INVALID_VALUE);
  context.evaluator.grid2_u = {u_n, u1, u2};
  context.evaluator.grid2_v = {v_n, v1, v2};
}

void eval_coord1(Context& context, GLdouble u) { evaluate1(context, u); }

void eval_coord2(Context& context, GLdouble u, GLdouble v) { evaluate2(context, u, v); }

void eval_point1(Context& context, GLint i) { evaluate_point1(context, i); }

void eval_point2(Context& context, GLint i, GLint j) { evaluate_point2(context, i, j); }

void eval_mesh1(Context& context, GLenum mode, GLint i1, GLint i2) {
  if (mode != GL_POINT && mode != GL_LINE) return record_error(context, GL_INVALID_ENUM);
  draw_strip1(context, mode == GL_POINT ? GL_POINTS : GL_LINE_STRIP, i1, i2);
}

void eval_mesh2(Context& context, GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
  switch (mode) {
    case GL_FILL:
      return draw_quads(context, i1, i2, j1, j2);
    case GL_LINE:
      return draw_grid_lines(context, i1, i2, j1, j2);
    case GL_POINT:
      return draw_grid_points(context, i1, i2, j1, j2);
    default:
      return record_error(context, GL_INVALID_ENUM);
  }
}

}  // namespace op

std::span<const GetRow> evaluator_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_MAX_EVAL_ORDER, GetKind::integer, 1, [](const Context&, double* out) { *out = kMaxEvalOrder; }},
      {GL_MAP1_GRID_SEGMENTS, GetKind::integer, 1,
       [](const Context& c, double* out) { *out = c.evaluator.grid1.segments; }},
      {GL_MAP1_GRID_DOMAIN, GetKind::real, 2,
       [](const Context& c, double* out) {
         out[0] = c.evaluator.grid1.low;
         out[1] = c.evaluator.grid1.high;
       }},
      {GL_MAP2_GRID_SEGMENTS, GetKind::integer, 2,
       [](const Context& c, double* out) {
         out[0] = c.evaluator.grid2_u.segments;
         out[1] = c.evaluator.grid2_v.segments;
       }},
      {GL_MAP2_GRID_DOMAIN, GetKind::real, 4,
       [](const Context& c, double* out) {
         out[0] = c.evaluator.grid2_u.low;
         out[1] = c.evaluator.grid2_u.high;
         out[2] = c.evaluator.grid2_v.low;
         out[3] = c.evaluator.grid2_v.high;
       }},
  };
  return kRows;
}

}  // namespace halfspace::state
