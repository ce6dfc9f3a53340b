// Client vertex arrays (spec 2.8).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "raster/api/index_ranges.h"
#include "state/gl_types.h"

namespace halfspace::state {

struct ClientArray {
  bool enabled = false;
  GLint size = 4;
  GLenum type = GL_FLOAT;
  GLsizei stride = 0;  // as given; 0: packed
  const void* pointer = nullptr;
  GLsizei count = 0;  // elements that stay as they are, as GL_EXT_vertex_array promises; kept and queried
};

struct VertexArrayState {
  ClientArray vertex, color, tex_coord;
  ClientArray normal{.size = 3};
  ClientArray edge_flag{.size = 1, .type = GL_UNSIGNED_BYTE};
  ClientArray index{.size = 1};
  bool bad_memory_reported = false;  // said once a context

  // Pages known to be readable, by the low bits of the page number (vertex_array.cpp).
  std::array<uintptr_t, 64> readable_pages{};

  // Scratch of the draw in flight; kept so that the steady state allocates nothing.
  std::vector<float> position_scratch, color_scratch, tex_coord_scratch, normal_scratch;
  std::vector<uint8_t> edge_flag_scratch;
  std::vector<uint32_t> index_scratch;
  std::vector<raster::IndexRange> range_scratch;
};

// The array GL_VERTEX_ARRAY, GL_COLOR_ARRAY ... names, or null.
ClientArray* find_client_array(VertexArrayState& arrays, GLenum name);

}  // namespace halfspace::state
