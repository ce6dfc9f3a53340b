#include "state/display_list.h"

#include <algorithm>
#include <cstring>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"

namespace halfspace::state {
namespace {

std::shared_ptr<const DisplayList> find_list(ListNamespace& names, GLuint name) {
  const std::lock_guard lock(names.mutex);
  const auto entry = names.lists.find(name);
  return entry == names.lists.end() ? nullptr : entry->second;
}

// A list that does not exist, or is too deep in others, does nothing (spec 5.4).
void play(Context& context, GLuint name) {
  ListMachine& machine = context.lists;
  if (machine.nesting >= kMaxListNesting) return;
  const std::shared_ptr<const DisplayList> list = find_list(*machine.names, name);
  if (list == nullptr) return;
  ++machine.nesting;
  for (const ListNode* node = list->first; node != nullptr; node = node->next) node->play(context, *node);
  --machine.nesting;
}

// glCallLists' array: an offset to the list base for each element (spec 5.4). Names wrap around as GLuint
// does.
template <class T>
void play_each(Context& context, GLsizei n, const void* names) {
  const auto* bytes = static_cast<const std::byte*>(names);
  for (GLsizei i = 0; i < n; ++i, bytes += sizeof(T)) {
    T offset;
    std::memcpy(&offset, bytes, sizeof offset);
    play(context, context.list.base + GLuint(GLint64(offset)));
  }
}

// GL_2_BYTES ...: the highest byte first.
template <int kBytes>
void play_each_bytes(Context& context, GLsizei n, const void* names) {
  const auto* bytes = static_cast<const GLubyte*>(names);
  for (GLsizei i = 0; i < n; ++i) {
    GLuint offset = 0;
    for (int k = 0; k < kBytes; ++k) offset = offset << 8 | *bytes++;
    play(context, context.list.base + offset);
  }
}

using PlayEach = void (*)(Context& context, GLsizei n, const void* names);

PlayEach find_player(GLenum type) {
  switch (type) {
    case GL_BYTE:
      return play_each<GLbyte>;
    case GL_UNSIGNED_BYTE:
      return play_each<GLubyte>;
    case GL_SHORT:
      return play_each<GLshort>;
    case GL_UNSIGNED_SHORT:
      return play_each<GLushort>;
    case GL_INT:
      return play_each<GLint>;
    case GL_UNSIGNED_INT:
      return play_each<GLuint>;
    case GL_FLOAT:
      return play_each<GLfloat>;
    case GL_2_BYTES:
      return play_each_bytes<2>;
    case GL_3_BYTES:
      return play_each_bytes<3>;
    case GL_4_BYTES:
      return play_each_bytes<4>;
    default:
      return nullptr;
  }
}

// The lowest name with `range` free ones from it on, or 0. Called with the lock held.
GLuint find_free_range(const ListNamespace& names, GLuint range) {
  uint64_t candidate = 1;
  for (const auto& entry : names.lists) {
    if (entry.first >= candidate + range) break;
    candidate = uint64_t{entry.first} + 1;
  }
  return candidate + range - 1 <= UINT32_MAX ? GLuint(candidate) : 0;
}

// Replaces the list of that name.
void publish(ListNamespace& names, GLuint name, std::shared_ptr<const DisplayList> list) {
  std::shared_ptr<const DisplayList> former;  // goes away after the lock
  const std::lock_guard lock(names.mutex);
  former = std::exchange(names.lists[name], std::move(list));
}

// May throw std::bad_alloc, and then leaves no name behind.
GLuint reserve_lists(ListNamespace& names, GLuint range) {
  const auto empty = std::make_shared<const DisplayList>();
  const std::lock_guard lock(names.mutex);
  const GLuint first = find_free_range(names, range);
  if (first == 0) return 0;
  const auto behind = names.lists.lower_bound(first);
  try {
    for (GLuint i = 0; i < range; ++i) names.lists.emplace_hint(behind, first + i, empty);
  } catch (...) {
    names.lists.erase(names.lists.lower_bound(first), behind);
    throw;
  }
  return first;
}

}  // namespace

namespace op {

void new_list(Context& context, GLuint name, GLenum mode) {
  ListCompiler& compiler = context.lists.compiler;
  if (name == 0) return record_error(context, GL_INVALID_VALUE);
  if (mode != GL_COMPILE && mode != GL_COMPILE_AND_EXECUTE) return record_error(context, GL_INVALID_ENUM);
  if (compiler.active()) return record_error(context, GL_INVALID_OPERATION);
  guard_memory(
      context, [&] { compiler.start(name, mode); }, "new_list");
  set_table(context, *context.table);
}

// Without memory for it, the list of that name stays what it was.
void end_list(Context& context) try {
  ListCompiler& compiler = context.lists.compiler;
  if (!compiler.active()) return record_error(context, GL_INVALID_OPERATION);
  const GLuint name = compiler.name;
  std::shared_ptr<const DisplayList> list = compiler.finish();
  set_table(context, *context.table);
  if (list == nullptr) return record_error(context, GL_OUT_OF_MEMORY);
  publish(*context.lists.names, name, std::move(list));
} catch (const std::bad_alloc&) {
  context.lists.compiler.abandon();
  set_table(context, *context.table);
  record_error(context, GL_OUT_OF_MEMORY, "end_list");
}

void call_list(Context& context, GLuint name) { play(context, name); }

void call_lists(Context& context, GLsizei n, GLenum type, const GLvoid* names) {
  const PlayEach player = find_player(type);
  if (player == nullptr) return record_error(context, GL_INVALID_ENUM);
  if (n < 0) return record_error(context, GL_INVALID_VALUE);
  if (names != nullptr) player(context, n, names);
}

void list_base(Context& context, GLuint base) { context.list.base = base; }

GLuint gen_lists(Context& context, GLsizei range) {
  if (range < 0) record_error(context, GL_INVALID_VALUE);
  if (range <= 0) return 0;
  GLuint first = 0;
  guard_memory(
      context, [&] { first = reserve_lists(*context.lists.names, GLuint(range)); }, "gen_lists");
  return first;
}

void delete_lists(Context& context, GLuint name, GLsizei range) {
  if (range < 0) return record_error(context, GL_INVALID_VALUE);
  ListNamespace& names = *context.lists.names;
  const std::lock_guard lock(names.mutex);
  const uint64_t end = uint64_t{name} + uint64_t(range);
  const auto first = names.lists.lower_bound(name);
  const auto last = end > UINT32_MAX ? names.lists.end() : names.lists.lower_bound(GLuint(end));
  names.lists.erase(first, last);
}

GLboolean is_list(Context& context, GLuint name) {
  return find_list(*context.lists.names, name) != nullptr ? GL_TRUE : GL_FALSE;
}

}  // namespace op

std::span<const GetRow> list_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_LIST_BASE, GetKind::integer, 1, [](const Context& c, double* out) { *out = c.list.base; }},
      {GL_LIST_INDEX, GetKind::integer, 1,
       [](const Context& c, double* out) { *out = c.lists.compiler.name; }},
      {GL_LIST_MODE, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.lists.compiler.mode; }},
      {GL_MAX_LIST_NESTING, GetKind::integer, 1, [](const Context&, double* out) { *out = kMaxListNesting; }},
  };
  return kRows;
}

}  // namespace halfspace::state
