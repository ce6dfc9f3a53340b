// Client vertex arrays (spec 2.8).
#pragma once

#include <cstdint>
#include <vector>

#include "state/gl_types.h"

namespace halfspace::state {

struct ClientArray {
  bool enabled = false;
  GLint size = 4;
  GLenum type = GL_FLOAT;
  GLsizei stride = 0;  // as given; 0: packed
  const void* pointer = nullptr;
};

struct VertexArrayState {
  ClientArray vertex, color, tex_coord;
  ClientArray normal{.size = 3};
  ClientArray edge_flag{.size = 1, .type = GL_UNSIGNED_BYTE};
  ClientArray index{.size = 1};
  bool null_reported = false;  // "an enabled array is null" is said once

  // Scratch of the draw in flight; kept so that the steady state allocates nothing.
  std::vector<float> position_scratch, color_scratch, tex_coord_scratch;
  std::vector<uint32_t> index_scratch;
};

}  // namespace halfspace::state
