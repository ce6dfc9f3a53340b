#include "state/clip_plane.h"

#include <algorithm>
#include <cmath>

#include "state/context.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace {

bool is_clip_plane(GLenum plane) {
  return plane >= GL_CLIP_PLANE0 && plane < GL_CLIP_PLANE0 + raster::kMaxClipPlanes;
}

// p M^-1 (spec 2.11), M column-major: solves x M = p by elimination with the largest pivot. A singular M
// leaves the result undefined; then the plane stays as it was given.
std::array<double, 4> to_eye(const Matrix& m, const GLdouble* p) {
  double a[4][5];  // row i: sum over j of x_j M_ji = p_i
  for (size_t i = 0; i < 4; ++i) {
    for (size_t j = 0; j < 4; ++j) a[i][j] = double(m[4 * i + j]);
    a[i][4] = p[i];
  }
  const std::array<double, 4> given{p[0], p[1], p[2], p[3]};
  for (size_t column = 0; column < 4; ++column) {
    size_t pivot = column;
    for (size_t i = column + 1; i < 4; ++i) {
      if (std::abs(a[i][column]) > std::abs(a[pivot][column])) pivot = i;
    }
    if (a[pivot][column] == 0 || !std::isfinite(a[pivot][column])) return given;
    for (size_t j = 0; j < 5; ++j) std::swap(a[column][j], a[pivot][j]);
    for (size_t i = 0; i < 4; ++i) {
      if (i == column) continue;
      const double factor = a[i][column] / a[column][column];
      for (size_t j = column; j < 5; ++j) a[i][j] -= factor * a[column][j];
    }
  }
  return {a[0][4] / a[0][0], a[1][4] / a[1][1], a[2][4] / a[2][2], a[3][4] / a[3][3]};
}

}  // namespace

namespace op {

void clip_plane(Context& context, GLenum plane, const GLdouble* equation) {
  if (!is_clip_plane(plane)) return record_error(context, GL_INVALID_ENUM);
  context.clip_plane.planes[plane - GL_CLIP_PLANE0] = to_eye(context.transform.modelview.top(), equation);
  mark_dirty(context, kDirtyClipPlanes);
}

void get_clip_plane(Context& context, GLenum plane, GLdouble* equation) {
  if (!is_clip_plane(plane)) return record_error(context, GL_INVALID_ENUM);
  const auto& p = context.clip_plane.planes[plane - GL_CLIP_PLANE0];
  std::copy(p.begin(), p.end(), equation);
}

}  // namespace op
}  // namespace halfspace::state
