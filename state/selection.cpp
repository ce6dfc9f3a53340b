#include "state/selection.h"

#include <algorithm>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace {

void write_word(SelectionState& selection, GLuint word) {
  if (selection.written < selection.size) selection.buffer[selection.written] = word;
  ++selection.written;
}

GLuint depth_word(double z) { return GLuint(std::clamp(z, 0.0, 1.0) * 4294967295.0 + 0.5); }

// Whatever changes the names says first what was hit under the old ones.
void write_record(SelectionState& selection) {
  if (!selection.hit) return;
  write_word(selection, GLuint(selection.depth));
  write_word(selection, depth_word(selection.lowest));
  write_word(selection, depth_word(selection.highest));
  for (size_t i = 0; i < selection.depth; ++i) write_word(selection, selection.names[i]);
  ++selection.records;
  selection.hit = false;
  selection.lowest = 1;
  selection.highest = 0;
}

// Elsewhere than in selection mode the names' commands do nothing, and nothing is wrong with them.
bool is_selecting(const Context& context) { return context.render_mode.mode == GL_SELECT; }

// The stack is about to change: what waits is drawn under the old names.
SelectionState& before_change(Context& context) {
  flush_vertices(context);
  write_record(context.selection);
  return context.selection;
}

}  // namespace

void record_hit(SelectionState& selection, double z) {
  selection.hit = true;
  selection.lowest = std::min(selection.lowest, z);
  selection.highest = std::max(selection.highest, z);
}

void start_selection(SelectionState& selection) {
  selection.written = selection.depth = 0;
  selection.records = 0;
  selection.hit = false;
  selection.lowest = 1;
  selection.highest = 0;
}

GLint finish_selection(SelectionState& selection) {
  write_record(selection);
  const bool overflow = selection.written > selection.size;
  return overflow ? -1 : selection.records;
}

namespace op {

void select_buffer(Context& context, GLsizei size, GLuint* buffer) {
  if (size < 0) return record_error(context, GL_INVALID_VALUE);
  if (is_selecting(context)) return record_error(context, GL_INVALID_OPERATION);
  context.selection.given = true;
  context.selection.buffer = buffer;
  context.selection.size = buffer ? size_t(size) : 0;
}

void init_names(Context& context) {
  if (is_selecting(context)) before_change(context).depth = 0;
}

void load_name(Context& context, GLuint name) {
  if (!is_selecting(context)) return;
  if (context.selection.depth == 0) return record_error(context, GL_INVALID_OPERATION);
  SelectionState& selection = before_change(context);
  selection.names[selection.depth - 1] = name;
}

void push_name(Context& context, GLuint name) {
  if (!is_selecting(context)) return;
  if (context.selection.depth == kMaxNameStackDepth) return record_error(context, GL_STACK_OVERFLOW);
  SelectionState& selection = before_change(context);
  selection.names[selection.depth++] = name;
}

void pop_name(Context& context) {
  if (!is_selecting(context)) return;
  if (context.selection.depth == 0) return record_error(context, GL_STACK_UNDERFLOW);
  --before_change(context).depth;
}

}  // namespace op

std::span<const GetRow> selection_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_NAME_STACK_DEPTH, GetKind::integer, 1,
       [](const Context& c, double* out) { *out = double(c.selection.depth); }},
      {GL_MAX_NAME_STACK_DEPTH, GetKind::integer, 1,
       [](const Context&, double* out) { *out = double(kMaxNameStackDepth); }},
      {GL_SELECTION_BUFFER_SIZE, GetKind::integer, 1,
       [](const Context& c, double* out) { *out = double(c.selection.size); }},
  };
  return kRows;
}

}  // namespace halfspace::state
