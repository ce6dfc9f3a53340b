#include "state/context.h"

#include <cstdlib>
#include <new>
#include <string_view>

#include "state/derive/accuracy.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"

namespace halfspace::state {

thread_local constinit CurrentBinding current_binding
    __attribute__((tls_model("initial-exec"))) = {nullptr, &kNoContextTable};

Context::Context(const VisualConfig& config, Context* share)
    : visual(config),
      table(&kExecuteTable),
      texture(share ? &share->texture : nullptr),
      lists(share ? &share->lists : nullptr) {
  color_buffer.draw_buffer = color_buffer.read_buffer = config.double_buffered ? GL_BACK : GL_FRONT;
  hint.accuracy = accuracy_from_environment();
  const char* view = std::getenv("HALFSPACE_VIEW");
  wireframe = view && std::string_view(view) == "wireframe";
}

Context::~Context() {
  if (current_binding.context == this) current_binding = {nullptr, &kNoContextTable};
}

namespace {

// What entry points call.
const OperationTable& entry_table(const Context& context) {
  return context.lists.compiler.active() ? kCompileTable : *context.table;
}

// Executes what is pending, shows what can be seen without a swap, and lets go of the drawable's buffers.
void release(Context& context) try {
  op::flush(context);
  context.device.begin_pass(nullptr);
  context.drawable = context.read_drawable = nullptr;
} catch (const std::bad_alloc&) {
  context.drawable = context.read_drawable = nullptr;
  record_error(context, GL_OUT_OF_MEMORY, "make_current");
}

void size_to_drawable(Context& context) {
  const int width = context.drawable->width(), height = context.drawable->height();
  context.viewport.x = context.viewport.y = context.scissor.x = context.scissor.y = 0;
  context.viewport.width = context.scissor.width = width;
  context.viewport.height = context.scissor.height = height;
  mark_dirty(context, kDirtyViewport | kDirtyRaster);
}

void finish_drawing(Context& context, const char* operation) {
  guard_memory(
      context, [&] { execute_drawing(context); }, operation);
}

}  // namespace

void make_current(Context* context, Drawable* drawable) {
  Context* previous = current_binding.context;
  const bool same = previous == context && context && context->drawable == drawable;
  // With the same pair again the drawable may have changed its size: its buffers are looked up anew.
  if (previous && !same) release(*previous);
  if (!context) {
    current_binding = {nullptr, &kNoContextTable};
    return;
  }
  flush_vertices(*context);
  context->drawable = drawable;
  context->read_drawable = nullptr;
  current_binding = {context, &entry_table(*context)};
  mark_dirty(*context, kDirtyFragment);  // the front end may have changed the visual
  if (drawable && !context->was_current) {
    context->was_current = true;
    size_to_drawable(*context);
  }
}

void execute_drawing(Context& context) {
  raster::Framebuffer* framebuffer = draw_framebuffer(context);
  if (!framebuffer) return;
  context.device.begin_pass(framebuffer);
  context.drawable->finish(context.device, draw_planes(context));
}

void set_table(Context& context, const OperationTable& table) {
  context.table = &table;
  if (current_binding.context == &context) current_binding.table = &entry_table(context);
}

namespace op {

void finish(Context& context) { finish_drawing(context, "finish"); }

void flush(Context& context) { finish_drawing(context, "flush"); }

}  // namespace op
}  // namespace halfspace::state
