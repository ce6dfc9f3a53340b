#include "gl/glx/registry.h"

#include <X11/Xutil.h>

#include <utility>

namespace halfspace::gl::glx {

const std::vector<FbConfig>* DisplayData::screen(int number) const {
  if (number < 0 || size_t(number) >= screens.size()) return nullptr;
  return &screens[size_t(number)];
}

const FbConfig* DisplayData::find_config(GLXFBConfig handle) const {
  const FbConfig* wanted = reinterpret_cast<const FbConfig*>(handle);
  for (const auto& configs : screens) {
    for (const FbConfig& config : configs) {
      if (&config == wanted) return wanted;
    }
  }
  return nullptr;
}

const FbConfig* DisplayData::config_of(const XVisualInfo& visual) const {
  if (const auto exact = handed_out.find(&visual); exact != handed_out.end()) {
    // The address may have been freed and be another visual's by now.
    if (exact->second->visual_id == visual.visualid) return exact->second;
  }
  if (const auto last = last_chosen.find(visual.visualid); last != last_chosen.end()) return last->second;
  const std::vector<FbConfig>* configs = screen(visual.screen);
  if (!configs) return nullptr;
  // Nobody chose: the program looks through X's visuals by itself. The richest one serves most.
  for (const FbConfig& config : *configs) {
    if (config.visual_id == visual.visualid && config.bits.double_buffered && config.bits.alpha_bits)
      return &config;
  }
  return nullptr;
}

XVisualInfo* DisplayData::visual_info(const FbConfig& config) {
  XVisualInfo wanted{};
  wanted.visualid = config.visual_id;
  wanted.screen = config.screen;
  int count = 0;
  XVisualInfo* info = XGetVisualInfo(connection->display(), VisualIDMask | VisualScreenMask, &wanted, &count);
  if (!info) return nullptr;
  handed_out[info] = &config;
  last_chosen[config.visual_id] = &config;
  return info;
}

std::shared_ptr<GlxDrawable> DisplayData::find_drawable(XID id) const {
  if (const auto found = drawables.find(id); found != drawables.end()) return found->second;
  for (const auto& [_, drawable] : drawables) {
    if (drawable->kind() == GlxDrawable::Kind::window && drawable->target() == id) return drawable;
  }
  return nullptr;
}

void DisplayData::sweep() {
  std::erase_if(drawables, [](const auto& entry) {
    GlxDrawable& drawable = *entry.second;
    const bool is_x_window =
        drawable.kind() == GlxDrawable::Kind::window && drawable.id() == drawable.target();
    return is_x_window && !drawable.bound() && !drawable.refresh();
  });
}

Registry& Registry::get() {
  static Registry* const registry = new Registry;
  return *registry;
}

DisplayData& Registry::display(Display* display) {
  std::unique_ptr<DisplayData>& slot = displays_[display];
  if (slot) return *slot;
  auto data = std::make_unique<DisplayData>();
  data->connection = std::make_shared<Connection>(display, &Registry::close);
  int next_id = 1;
  for (int screen = 0; screen < ScreenCount(display); ++screen) {
    data->screens.push_back(make_configs(display, screen, next_id));
    next_id += int(data->screens.back().size());
  }
  slot = std::move(data);
  return *slot;
}

void Registry::close(Display* display) {
  Registry& registry = get();
  const std::lock_guard lock(registry.mutex);
  const auto found = registry.displays_.find(display);
  if (found == registry.displays_.end()) return;
  // What is still current somewhere lives on without X.
  for (const auto& [_, drawable] : found->second->drawables) drawable->release();
  for (const auto& [context, _] : registry.contexts_) {
    if (context->display == display && context->draw) context->draw->release();
    if (context->display == display && context->read) context->read->release();
  }
  std::erase_if(registry.contexts_, [display](const auto& entry) {
    return entry.first->display == display && !entry.first->current;
  });
  for (const auto& [context, _] : registry.contexts_) {
    if (context->display == display) context->destroyed = true;
  }
  found->second->connection->close();
  registry.displays_.erase(found);
}

GLXContext Registry::add(std::unique_ptr<GlxContext> context) {
  GlxContext* raw = context.get();
  contexts_[raw] = std::move(context);
  return raw->handle();
}

GlxContext* Registry::find(GLXContext handle) const {
  GlxContext* context = reinterpret_cast<GlxContext*>(handle);
  return contexts_.count(context) ? context : nullptr;
}

void Registry::destroy(GlxContext* context) { contexts_.erase(context); }

}  // namespace halfspace::gl::glx
