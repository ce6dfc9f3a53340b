// Selection (spec 5.2): which named primitives lie in the clip volume.
#pragma once

#include <array>
#include <cstddef>

#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

inline constexpr size_t kMaxNameStackDepth = 64;

struct SelectionState {
  bool given = false;  // glSelectBuffer has been called
  GLuint* buffer = nullptr;
  size_t size = 0;     // words
  size_t written = 0;  // words of all records so far, with those there was no room for
  GLint records = 0;
  std::array<GLuint, kMaxNameStackDepth> names{};
  size_t depth = 0;
  bool hit = false;                // since the last record
  double lowest = 1, highest = 0;  // window depth of what was hit, in [0, 1]
};

// What is drawn, or a raster position, at window depth `z` was inside the clip volume.
void record_hit(SelectionState& selection, double z);

// Entering and leaving GL_SELECT; leaving gives the number of records, or -1 if there were too many.
void start_selection(SelectionState& selection);
GLint finish_selection(SelectionState& selection);

}  // namespace halfspace::state
