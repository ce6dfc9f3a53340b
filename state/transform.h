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
  bool normalize = false;
  MatrixStack<kMaxModelviewDepth> modelview;
  MatrixStack<kMaxProjectionDepth> projection;
  MatrixStack<kMaxTextureDepth> texture;
};

// The inverse transpose of the upper left 3x3 of `m`, column-major; without an inverse, something finite.
std::array<double, 9> normal_matrix(const Matrix& m);

// The plane `p` of object coordinates, in eye coordinates: p M^-1 (spec 2.11.4, 2.12). As given where M has no inverse.
std::array<double, 4> eye_plane(const Matrix& m, const double* p);

// a * b, summed in double.
std::array<double, 16> multiply(const double* a, const double* b);

}  // namespace halfspace::state
