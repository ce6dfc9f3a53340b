// Matrices (spec 2.10.2).
#pragma once

#include <array>
#include <cstddef>

#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

using Matrix = std::array<float, 16>;  // column-major
inline constexpr Matrix kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

inline constexpr int kMaxModelviewDepth = 32;
inline constexpr int kMaxProjectionDepth = 32;
inline constexpr int kMaxTextureDepth = 10;

template <int kDepth>
struct MatrixStack {
  std::array<Matrix, kDepth> matrices{kIdentity};
  int depth = 1;  // matrices on the stack, the current one included
  const Matrix& top() const { return matrices[size_t(depth - 1)]; }
};

struct TransformState {
  GLenum mode = GL_MODELVIEW;
  MatrixStack<kMaxModelviewDepth> modelview;
  MatrixStack<kMaxProjectionDepth> projection;
  MatrixStack<kMaxTextureDepth> texture;
};

// a * b, summed in double.
std::array<double, 16> multiply(const double* a, const double* b);

}  // namespace halfspace::state
