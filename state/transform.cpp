#include "state/transform.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"
#include "state/trigonometry.h"

namespace halfspace::state {

std::array<double, 16> multiply(const double* a, const double* b) {
  std::array<double, 16> product;
  for (size_t column = 0; column < 4; ++column) {
    const double* v = b + 4 * column;
    for (size_t row = 0; row < 4; ++row) {
      product[4 * column + row] = a[row] * v[0] + a[4 + row] * v[1] + a[8 + row] * v[2] + a[12 + row] * v[3];
    }
  }
  return product;
}

// Cofactors over the determinant. They alone point the right way, so that a matrix which flattens everything,
// or one so small that its determinant vanishes, still leaves normals that GL_NORMALIZE can use.
std::array<double, 9> normal_matrix(const Matrix& m) {
  const auto at = [&m](size_t row, size_t column) { return double(m[4 * column + row]); };
  std::array<double, 9> cofactors;
  for (size_t column = 0; column < 3; ++column) {
    const size_t c1 = (column + 1) % 3, c2 = (column + 2) % 3;
    for (size_t row = 0; row < 3; ++row) {
      const size_t r1 = (row + 1) % 3, r2 = (row + 2) % 3;
      cofactors[3 * column + row] = at(r1, c1) * at(r2, c2) - at(r1, c2) * at(r2, c1);
    }
  }
  const double det = at(0, 0) * cofactors[0] + at(1, 0) * cofactors[1] + at(2, 0) * cofactors[2];
  std::array<double, 9> inverse;
  bool usable = true;
  for (size_t i = 0; i < 9; ++i) {
    inverse[i] = cofactors[i] / det;
    usable = usable && std::isfinite(inverse[i]);
  }
  if (usable) return inverse;
  if (det < 0) {
    for (double& c : cofactors) c = -c;
  }
  return cofactors;
}

// Solves x M = p by elimination with the largest pivot.
std::array<double, 4> eye_plane(const Matrix& m, const double* p) {
  double a[4][5];  // row i: the sum over j of x_j M_ji = p_i
  for (size_t i = 0; i < 4; ++i) {
    for (size_t j = 0; j < 4; ++j) a[i][j] = double(m[4 * i + j]);
    a[i][4] = p[i];
  }
  for (size_t k = 0; k < 4; ++k) {
    size_t pivot = k;
    for (size_t i = k + 1; i < 4; ++i) {
      if (std::fabs(a[i][k]) > std::fabs(a[pivot][k])) pivot = i;
    }
    const double largest = std::fabs(a[pivot][k]);
    if (!(largest > 0) || !std::isfinite(largest)) return {p[0], p[1], p[2], p[3]};
    std::swap(a[k], a[pivot]);
    for (size_t i = 0; i < 4; ++i) {
      if (i == k) continue;
      const double factor = a[i][k] / a[k][k];
      for (size_t j = k; j < 5; ++j) a[i][j] -= factor * a[k][j];
    }
  }
  return {a[0][4] / a[0][0], a[1][4] / a[1][1], a[2][4] / a[2][2], a[3][4] / a[3][3]};
}

namespace {

using DoubleMatrix = std::array<double, 16>;

// The stack that matrix commands work on.
struct StackView {
  Matrix* matrices;
  int& depth;
  int capacity;
  uint32_t dirty;
  Matrix& top() const { return matrices[depth - 1]; }
};

StackView active_stack(Context& context) {
  TransformState& t = context.transform;
  switch (t.mode) {
    case GL_PROJECTION:
      return {t.projection.matrices.data(), t.projection.depth, kMaxProjectionDepth, kDirtyTransform};
    case GL_TEXTURE:
      return {t.texture.matrices.data(), t.texture.depth, kMaxTextureDepth, kDirtyTexCoords};
    default:
      return {t.modelview.matrices.data(), t.modelview.depth, kMaxModelviewDepth, kDirtyTransform};
  }
}

// Rounds to the float the stack holds.
void replace_top(Context& context, const double* m) {
  const StackView stack = active_stack(context);
  for (size_t i = 0; i < 16; ++i) stack.top()[i] = float(m[i]);
  mark_dirty(context, stack.dirty);
}

void multiply_top(Context& context, const double* m) {
  DoubleMatrix top;
  std::copy_n(active_stack(context).top().begin(), 16, top.begin());
  replace_top(context, multiply(top.data(), m).data());
}

// Rotation about the unit vector (x, y, z): spec 2.10.2's R = uu^T + cos(a) (I - uu^T) + sin(a) S.
DoubleMatrix rotation(const SineCosine& angle, double x, double y, double z) {
  const double c = angle.cosine, s = angle.sine;
  // A vector along the axis stays exactly as it is: u*u + c * (1 - u*u) is 1 at u = 1 and c at u = 0.
  const auto diagonal = [c](double u) { return u * u + c * (1 - u * u); };
  const auto off = [c](double u, double v) { return u * v * (1 - c); };
  return {diagonal(x),
          off(x, y) + z * s,
          off(x, z) - y * s,
          0,  //
          off(x, y) - z * s,
          diagonal(y),
          off(y, z) + x * s,
          0,  //
          off(x, z) + y * s,
          off(y, z) - x * s,
          diagonal(z),
          0,  //
          0,
          0,
          0,
          1};
}

template <int kDepth>
void read_matrix(const MatrixStack<kDepth>& stack, double* out) {
  std::copy_n(stack.top().begin(), 16, out);
}

}  // namespace

namespace op {

void matrix_mode(Context& context, GLenum mode) {
  if (mode != GL_MODELVIEW && mode != GL_PROJECTION && mode != GL_TEXTURE) {
    return record_error(context, GL_INVALID_ENUM);
  }
  context.transform.mode = mode;
}

void load_identity(Context& context) {
  const StackView stack = active_stack(context);
  stack.top() = kIdentity;
  mark_dirty(context, stack.dirty);
}

void load_matrix(Context& context, const GLdouble* m) { replace_top(context, m); }

void mult_matrix(Context& context, const GLdouble* m) { multiply_top(context, m); }

void push_matrix(Context& context) {
  const StackView stack = active_stack(context);
  if (stack.depth == stack.capacity) return record_error(context, GL_STACK_OVERFLOW);
  stack.matrices[stack.depth] = stack.top();
  ++stack.depth;
}

void pop_matrix(Context& context) {
  const StackView stack = active_stack(context);
  if (stack.depth == 1) return record_error(context, GL_STACK_UNDERFLOW);
  --stack.depth;
  mark_dirty(context, stack.dirty);
}

void rotate(Context& context, GLdouble angle, GLdouble x, GLdouble y, GLdouble z) {
  // Scaled by the longest component first, so that the squares neither overflow nor vanish.
  const double longest = std::max({std::fabs(x), std::fabs(y), std::fabs(z)});
  if (!(longest > 0)) return;  // no axis: the spec has no answer; nothing is turned
  x /= longest;
  y /= longest;
  z /= longest;
  const double length = std::sqrt(x * x + y * y + z * z);
  multiply_top(context, rotation(sine_cosine_degrees(angle), x / length, y / length, z / length).data());
}

void scale(Context& context, GLdouble x, GLdouble y, GLdouble z) {
  const StackView stack = active_stack(context);
  Matrix& m = stack.top();
  for (size_t row = 0; row < 4; ++row) {
    m[row] = float(double(m[row]) * x);
    m[4 + row] = float(double(m[4 + row]) * y);
    m[8 + row] = float(double(m[8 + row]) * z);
  }
  mark_dirty(context, stack.dirty);
}

void translate(Context& context, GLdouble x, GLdouble y, GLdouble z) {
  const StackView stack = active_stack(context);
  Matrix& m = stack.top();
  for (size_t row = 0; row < 4; ++row) {
    m[12 + row] =
        float(double(m[row]) * x + double(m[4 + row]) * y + double(m[8 + row]) * z + double(m[12 + row]));
  }
  mark_dirty(context, stack.dirty);
}

// Spec 2.10.2. A NaN fails these conditions as a zero-sized volume does.
void frustum(Context& context, GLdouble left, GLdouble right, GLdouble bottom, GLdouble top, GLdouble z_near,
             GLdouble z_far) {
  const bool valid = z_near > 0 && z_far > 0 && (left < right || left > right) &&
                     (bottom < top || bottom > top) && (z_near < z_far || z_near > z_far);
  if (!valid) return record_error(context, GL_INVALID_VALUE);
  const double width = right - left, height = top - bottom, depth = z_far - z_near;
  DoubleMatrix m{};
  m[0] = 2 * z_near / width;
  m[5] = 2 * z_near / height;
  m[8] = (right + left) / width;
  m[9] = (top + bottom) / height;
  m[10] = -(z_far + z_near) / depth;
  m[11] = -1;
  m[14] = -2 * z_far * z_near / depth;
  multiply_top(context, m.data());
}

void ortho(Context& context, GLdouble left, GLdouble right, GLdouble bottom, GLdouble top, GLdouble z_near,
           GLdouble z_far) {
  const bool valid =
      (left < right || left > right) && (bottom < top || bottom > top) && (z_near < z_far || z_near > z_far);
  if (!valid) return record_error(context, GL_INVALID_VALUE);
  const double width = right - left, height = top - bottom, depth = z_far - z_near;
  DoubleMatrix m{};
  m[0] = 2 / width;
  m[5] = 2 / height;
  m[10] = -2 / depth;
  m[12] = -(right + left) / width;
  m[13] = -(top + bottom) / height;
  m[14] = -(z_far + z_near) / depth;
  m[15] = 1;
  multiply_top(context, m.data());
}

}  // namespace op

std::span<const GetRow> transform_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_MATRIX_MODE, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.transform.mode; }},
      {GL_MODELVIEW_MATRIX, GetKind::real, 16,
       [](const Context& c, double* out) { read_matrix(c.transform.modelview, out); }},
      {GL_PROJECTION_MATRIX, GetKind::real, 16,
       [](const Context& c, double* out) { read_matrix(c.transform.projection, out); }},
      {GL_TEXTURE_MATRIX, GetKind::real, 16,
       [](const Context& c, double* out) { read_matrix(c.transform.texture, out); }},
      {GL_MODELVIEW_STACK_DEPTH, GetKind::integer, 1,
       [](const Context& c, double* out) { *out = c.transform.modelview.depth; }},
      {GL_PROJECTION_STACK_DEPTH, GetKind::integer, 1,
       [](const Context& c, double* out) { *out = c.transform.projection.depth; }},
      {GL_TEXTURE_STACK_DEPTH, GetKind::integer, 1,
       [](const Context& c, double* out) { *out = c.transform.texture.depth; }},
      {GL_MAX_MODELVIEW_STACK_DEPTH, GetKind::integer, 1,
       [](const Context&, double* out) { *out = kMaxModelviewDepth; }},
      {GL_MAX_PROJECTION_STACK_DEPTH, GetKind::integer, 1,
       [](const Context&, double* out) { *out = kMaxProjectionDepth; }},
      {GL_MAX_TEXTURE_STACK_DEPTH, GetKind::integer, 1,
       [](const Context&, double* out) { *out = kMaxTextureDepth; }},
  };
  return kRows;
}

}  // namespace halfspace::state
