// Showing pictures, and waiting.
#include "gl/glx/entry.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"

using namespace halfspace;
using namespace halfspace::gl::glx;

namespace {

// Out of memory is the current context's to hear of.
template <class Work>
void show(Work&& work) {
  if (GlxContext* context = current_context()) return state::guard_memory(*context->gl, work);
  guarded(0, [&work] { return work(), 0; });
}

// GLX_SGI_swap_control and its kin set it for the current drawable.
int set_interval(int interval, int least) {
  const GlxContext* context = current_context();
  if (!context) return GLX_BAD_CONTEXT;
  if (interval < least) return GLX_BAD_VALUE;
  context->draw->swap_interval = interval;
  return 0;
}

}  // namespace

extern "C" {

HALFSPACE_EXPORT void glXSwapBuffers(Display* display, GLXDrawable drawable) {
  if (display) show([=] { swap_buffers(display, drawable); });
}

HALFSPACE_EXPORT void glXCopySubBufferMESA(Display* display, GLXDrawable drawable, int x, int y, int width,
                                           int height) {
  const raster::Rect part{x, y, x + width, y + height};
  if (display) show([&] { swap_buffers(display, drawable, &part); });
}

HALFSPACE_EXPORT void glXWaitGL() {
  if (GlxContext* context = current_context()) state::op::finish(*context->gl);
}

HALFSPACE_EXPORT void glXWaitX() {
  const GlxContext* context = current_context();
  if (context && context->display) XSync(context->display, False);
}

HALFSPACE_EXPORT int glXSwapIntervalSGI(int interval) { return set_interval(interval, 1); }
HALFSPACE_EXPORT int glXSwapIntervalMESA(unsigned interval) {
  return set_interval(interval > unsigned(kMaxSwapInterval) ? -1 : int(interval), 0);
}

HALFSPACE_EXPORT int glXGetSwapIntervalMESA() {
  const GlxContext* context = current_context();
  return context ? context->draw->swap_interval : 0;
}

HALFSPACE_EXPORT void glXSwapIntervalEXT(Display* display, GLXDrawable id, int interval) {
  if (interval < 0) return;  // BadValue
  with_display(display, 0, [&](DisplayData& data) {
    if (const auto drawable = data.find_drawable(id)) drawable->swap_interval = interval;
    return 0;
  });
}

}  // extern "C"
