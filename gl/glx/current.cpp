#include "gl/glx/current.h"

#include <unistd.h>

#include <atomic>
#include <utility>

#include "state/operations.gen.h"
#include "state/report.h"

namespace halfspace::gl::glx {
namespace {

constinit thread_local GlxContext* current = nullptr;

// Lets go of the current context. Work pending is executed first, and shown where it is visible without a
// swap.
void release() {
  GlxContext* old = std::exchange(current, nullptr);
  {
    const GlxDrawable::QuietScope quiet(old->draw.get());
    state::make_current(nullptr, nullptr);
  }
  old->gl->device.begin_pass(nullptr);  // the buffers may go before the context does
  old->gl->read_drawable = nullptr;
  old->draw->unbind();
  if (old->read != old->draw) old->read->unbind();
  old->draw.reset();
  old->read.reset();
  old->draw_id = old->read_id = None;
  old->current = false;
  if (old->destroyed) Registry::get().destroy(old);
}

// A thread that ends lets go of its context, so that another can take it. The main thread ends with the
// process, which needs no order in its last moments.
struct ThreadEnd {
  ~ThreadEnd() {
    if (!current || getpid() == gettid()) return;
    const std::lock_guard lock(Registry::get().mutex);
    release();
  }
  void arm() {}
};
thread_local ThreadEnd thread_end;

void report_once(std::atomic<bool>& reported, const char* text) {
  if (!reported.exchange(true)) state::report("%s", text);
}

void report_mismatch() {
  static std::atomic<bool> reported{false};
  report_once(
      reported,
      "glXMakeCurrent: the context and the drawable were made for different visuals (BadMatch); create the "
      "window with the visual the context was created with");
}

// An X window nobody told GLX of: any whose pixels are laid out as the config's are.
std::shared_ptr<GlxDrawable> adopt_window(DisplayData& data, XID id, const FbConfig& config) {
  data.sweep();
  XWindowAttributes attributes;
  {
    RequestScope scope(*data.connection);
    if (!XGetWindowAttributes(data.connection->display(), id, &attributes)) return nullptr;
  }
  const Visual* visual = attributes.visual;
  const bool same_pixels = attributes.c_class == InputOutput && attributes.depth == config.depth &&
                           visual->red_mask == config.visual->red_mask &&
                           visual->green_mask == config.visual->green_mask &&
                           visual->blue_mask == config.visual->blue_mask;
  if (!same_pixels) {
    report_mismatch();
    return nullptr;
  }
  auto drawable = std::make_shared<GlxDrawable>(data.connection, GlxDrawable::Kind::window, id, id, config);
  if (!drawable->refresh()) return nullptr;
  data.drawables[id] = drawable;
  return drawable;
}

std::shared_ptr<GlxDrawable> resolve(DisplayData& data, XID id, const FbConfig& config) {
  std::shared_ptr<GlxDrawable> drawable = data.find_drawable(id);
  if (!drawable) return adopt_window(data, id, config);
  if (!drawable->refresh()) {
    if (!drawable->is_x_window()) return nullptr;
    data.drawables.erase(id);  // the id may have become another window's
    return adopt_window(data, id, config);
  }
  if (!drawable->accepts(config)) {
    report_mismatch();
    return nullptr;
  }
  return drawable;
}

// Makes the state room look at the drawables anew.
void tell_state(GlxContext& context) {
  state::make_current(context.gl.get(), context.draw.get());
  context.gl->read_drawable = context.read == context.draw ? nullptr : context.read.get();
}

void bind(GlxContext& context, std::shared_ptr<GlxDrawable> draw, std::shared_ptr<GlxDrawable> read) {
  draw->bind();
  if (read != draw) read->bind();
  for (GlxDrawable* drawable : {draw.get(), read.get()}) {
    if (drawable->is_x_window()) drawable->adopt_config(context.config);
    drawable->apply_size();
  }
  context.draw = std::move(draw);
  context.read = std::move(read);
  context.current = true;
  current = &context;
  tell_state(context);
}

// The drawable of the current context has changed its size.
void follow_size(GlxContext* context, const std::shared_ptr<GlxDrawable>& drawable) {
  const std::lock_guard lock(Registry::get().mutex);
  if (context) context->gl->device.begin_pass(nullptr);
  drawable->apply_size();
  if (context) tell_state(*context);
}

// Swapping with no context at hand: any renderer can read the buffers.
template <class Show>
void show_without_context(Show&& show) {
  raster::DeviceOptions options;
  options.threads = 1;
  raster::Device device(options);
  show(device);
  device.begin_pass(nullptr);
}

}  // namespace

GlxContext* current_context() { return current; }

bool make_current(Display* display, GLXDrawable draw_id, GLXDrawable read_id, GLXContext handle) {
  if (current && current->gl->immediate.inside) return false;  // GLXBadContextState
  Registry& registry = Registry::get();
  const std::lock_guard lock(registry.mutex);
  if (!handle) {
    if (draw_id || read_id) return false;
    if (current) release();
    return true;
  }
  GlxContext* next = registry.find(handle);
  const bool usable = next && display && next->display == display && draw_id && read_id &&
                      (next == current || (!next->current && !next->destroyed));
  if (!usable) return false;

  DisplayData& data = registry.display(display);
  std::shared_ptr<GlxDrawable> draw = resolve(data, draw_id, next->config);
  std::shared_ptr<GlxDrawable> read = read_id == draw_id ? draw : resolve(data, read_id, next->config);
  if (!draw || !read) return false;
  const bool unchanged = next == current && draw == next->draw && read == next->read;
  if (unchanged && !draw->resized() && !read->resized()) {
    next->draw_id = draw_id;
    next->read_id = read_id;
    return true;
  }

  thread_end.arm();
  const bool doomed = std::exchange(next->destroyed, false);  // must outlive its own release
  if (current) release();
  next->destroyed = doomed;
  next->draw_id = draw_id;
  next->read_id = read_id;
  bind(*next, std::move(draw), std::move(read));
  return true;
}

void swap_buffers(Display* display, GLXDrawable id, const raster::Rect* part) {
  std::shared_ptr<GlxDrawable> drawable;
  {
    const std::lock_guard lock(Registry::get().mutex);
    drawable = Registry::get().display(display).find_drawable(id);
  }
  if (!drawable) {
    static std::atomic<bool> reported{false};
    return report_once(reported, "glXSwapBuffers: no such drawable (GLXBadDrawable)");
  }
  const auto show = [&](raster::Device& device) {
    if (part) {
      drawable->show_part(device, *part);
    } else {
      drawable->swap(device);
    }
  };
  GlxContext* context = current && current->draw == drawable ? current : nullptr;
  if (context && context->gl->immediate.inside) return;
  // Before the picture is made: the answer also says that the server has read the previous one.
  const bool alive = drawable->refresh();
  if (context) {
    drawable->about_to_show();
    state::op::flush(*context->gl);
    show(context->gl->device);
  } else {
    show_without_context(show);
  }
  if (alive && drawable->resized()) follow_size(context, drawable);
}

void destroy_context(GLXContext handle) {
  Registry& registry = Registry::get();
  const std::lock_guard lock(registry.mutex);
  GlxContext* context = registry.find(handle);
  if (!context) return;
  if (context->current) {
    context->destroyed = true;
  } else {
    registry.destroy(context);
  }
}

}  // namespace halfspace::gl::glx
