// The operations as they are between glNewList and glEndList: what the generated table is made of.
#pragma once

#include <cstddef>
#include <new>
#include <tuple>

#include "state/context.h"
#include "state/display_list.h"
#include "state/operations.gen.h"

namespace halfspace::state {

// Runs `work`, which adds to the list. Without memory the rest of the list is lost, and glEndList says so.
template <class Work>
void compiling(Context& context, Work&& work) {
  ListCompiler& compiler = context.lists.compiler;
  if (compiler.failed) return;
  try {
    work();
  } catch (const std::bad_alloc&) {
    compiler.failed = true;
  }
}

template <class T>
const T* keep(Context& context, const T* source, size_t count) {
  return context.lists.compiler.list->memory.copy(source, count);
}
// What is behind a void pointer is counted in bytes.
const void* keep(Context& context, const void* source, size_t bytes);

// An image, taken out of client memory as glPixelStore says, with its rows packed, its bytes in our own order
// and a bitmap's highest bit first. Null where the command is going to be refused.
const void* keep_image(Context& context, GLsizei width, GLsizei height, GLenum format, GLenum type,
                       const void* pixels);

// For the life of this object images are read as keep_image stores them.
class KeptImageStore {
 public:
  explicit KeptImageStore(Context& context);
  ~KeptImageStore();
  KeptImageStore(const KeptImageStore&) = delete;
  KeptImageStore& operator=(const KeptImageStore&) = delete;

 private:
  Context& context_;
  PixelStore unpack_;
};

// How many numbers `params` holds, for any pname of GL 1.1 (no name has two meanings that differ in this).
// One is read even for a name that is none: the scalar commands of that name have one, and vectors cannot be
// shorter.
size_t pname_values(GLenum pname);
// The length of an array; a negative one is going to be refused.
inline size_t count_of(GLsizei n) { return n > 0 ? size_t(n) : 0; }
// The size of glCallLists' array.
size_t call_lists_bytes(GLsizei n, GLenum type);
bool is_proxy(GLenum target);

// One operation, named by its place in the tables.
template <auto kOperation>
struct Compiled;

template <class Result, class... Arguments, Result (*OperationTable::*kOperation)(Context&, Arguments...)>
struct Compiled<kOperation> {
  struct Node : ListNode {
    std::tuple<Arguments...> arguments;
  };

  static Result call(Context& context, const Node& node) {
    return std::apply([&](Arguments... a) { return (context.table->*kOperation)(context, a...); },
                      node.arguments);
  }
  static void play(Context& context, const ListNode& node) { call(context, static_cast<const Node&>(node)); }
  static void play_image(Context& context, const ListNode& node) {
    const KeptImageStore store(context);
    call(context, static_cast<const Node&>(node));
  }

  static void add(Context& context, void (*player)(Context&, const ListNode&), Arguments... arguments) {
    ListCompiler& compiler = context.lists.compiler;
    compiler.settle();
    Node* node = compiler.list->memory.make<Node>();
    node->play = player;
    node->arguments = {arguments...};
    compiler.append(node);
  }

  // Not compiled.
  static Result pass(Context& context, Arguments... arguments) {
    return (context.table->*kOperation)(context, arguments...);
  }
  static void record(Context& context, Arguments... arguments) { add(context, play, arguments...); }
  static void record_image(Context& context, Arguments... arguments) {
    add(context, play_image, arguments...);
  }
  static void execute(Context& context, Arguments... arguments) {
    if (context.lists.compiler.executes()) (context.table->*kOperation)(context, arguments...);
  }
  static void compile(Context& context, Arguments... arguments) {
    compiling(context, [&] { record(context, arguments...); });
    execute(context, arguments...);
  }
};

// The operations that make batches.
namespace compile {
void begin(Context& context, GLenum mode);
void end(Context& context);
void vertex(Context& context, GLfloat x, GLfloat y, GLfloat z, GLfloat w);
void color(Context& context, GLfloat r, GLfloat g, GLfloat b, GLfloat a);
void normal(Context& context, GLfloat x, GLfloat y, GLfloat z);
void tex_coord(Context& context, GLfloat s, GLfloat t, GLfloat r, GLfloat q);
void edge_flag(Context& context, GLboolean flag);
void index(Context& context, GLfloat c);
void material(Context& context, GLenum face, GLenum pname, const GLfloat* params);
void array_element(Context& context, GLint i);
void draw_arrays(Context& context, GLenum mode, GLint first, GLsizei count);
void draw_elements(Context& context, GLenum mode, GLsizei count, GLenum type, const GLvoid* indices);
}  // namespace compile

}  // namespace halfspace::state
