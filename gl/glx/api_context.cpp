// Contexts, and which one is current.
#include <X11/Xutil.h>

#include <cstdio>

#include "gl/glx/entry.h"
#include "state/attribute_stack.h"
#include "state/operations.gen.h"

using namespace halfspace;
using namespace halfspace::gl::glx;

namespace {

GLXContext create_context(DisplayData& data, const FbConfig& config, GLXContext share) {
  Registry& registry = Registry::get();
  GlxContext* shared = registry.find(share);
  if (share && !shared) return nullptr;
  auto context = std::make_unique<GlxContext>();
  context->config = config;
  context->display = data.connection->display();
  context->id = data.connection->allocate_id();
  context->share_id = shared ? shared->id : 0;
  context->gl = std::make_unique<state::Context>(config.bits, shared ? shared->gl.get() : nullptr);
  return registry.add(std::move(context));
}

// GLX_ARB_create_context's list.
struct ContextRequest {
  int major = 1, minor = 0;
  bool known = true;  // all attributes and values of it
};

ContextRequest parse_request(const int* attributes) {
  ContextRequest request;
  for_each_attribute(attributes, [&request](int attribute, int value) {
    switch (attribute) {
      case GLX_CONTEXT_MAJOR_VERSION_ARB:
        request.major = value;
        break;
      case GLX_CONTEXT_MINOR_VERSION_ARB:
        request.minor = value;
        break;
      // A debug context may behave as any other; "forward compatible" is for 3.0 and up.
      case GLX_CONTEXT_FLAGS_ARB:
        request.known &= (value & ~GLX_CONTEXT_DEBUG_BIT_ARB) == 0;
        break;
      // Ignored below 3.2, as long as it does not ask for OpenGL ES.
      case GLX_CONTEXT_PROFILE_MASK_ARB:
        request.known &=
            (value & ~(GLX_CONTEXT_CORE_PROFILE_BIT_ARB | GLX_CONTEXT_COMPATIBILITY_PROFILE_BIT_ARB)) == 0;
        break;
      case GLX_RENDER_TYPE:
        request.known &= value == GLX_RGBA_TYPE;
        break;
      default:
        request.known = false;
    }
  });
  return request;
}

bool has_version(state::Context& context, const ContextRequest& request) {
  int major = 0, minor = 0;
  const auto* version = reinterpret_cast<const char*>(state::op::get_string(context, GL_VERSION));
  if (std::sscanf(version, "%d.%d", &major, &minor) != 2) return false;
  return request.major >= 1 && request.minor >= 0 &&
         (request.major < major || (request.major == major && request.minor <= minor));
}

}  // namespace

extern "C" {

HALFSPACE_EXPORT GLXContext glXCreateContext(Display* display, XVisualInfo* visual, GLXContext share, Bool) {
  return with_display(display, static_cast<GLXContext>(nullptr), [&](DisplayData& data) -> GLXContext {
    const FbConfig* config = visual ? data.config_of(*visual) : nullptr;
    return config ? create_context(data, *config, share) : nullptr;
  });
}

HALFSPACE_EXPORT GLXContext glXCreateNewContext(Display* display, GLXFBConfig handle, int render_type,
                                                GLXContext share, Bool) {
  return with_display(display, static_cast<GLXContext>(nullptr), [&](DisplayData& data) -> GLXContext {
    const FbConfig* config = data.find_config(handle);
    return config && render_type == GLX_RGBA_TYPE ? create_context(data, *config, share) : nullptr;
  });
}

HALFSPACE_EXPORT GLXContext glXCreateContextWithConfigSGIX(Display* display, GLXFBConfigSGIX config,
                                                           int render_type, GLXContext share, Bool direct) {
  return glXCreateNewContext(display, config, render_type, share, direct);
}

HALFSPACE_EXPORT GLXContext glXCreateContextAttribsARB(Display* display, GLXFBConfig handle, GLXContext share,
                                                       Bool, const int* attributes) {
  const ContextRequest request = parse_request(attributes);
  if (!request.known) return nullptr;
  return with_display(display, static_cast<GLXContext>(nullptr), [&](DisplayData& data) -> GLXContext {
    const FbConfig* config = data.find_config(handle);
    const GLXContext context = config ? create_context(data, *config, share) : nullptr;
    if (!context) return nullptr;
    GlxContext* created = Registry::get().find(context);
    if (has_version(*created->gl, request)) return context;
    Registry::get().destroy(created);
    return nullptr;
  });
}

HALFSPACE_EXPORT void glXDestroyContext(Display*, GLXContext context) { destroy_context(context); }

HALFSPACE_EXPORT Bool glXMakeContextCurrent(Display* display, GLXDrawable draw, GLXDrawable read,
                                            GLXContext context) {
  return guarded(False, [&] { return make_current(display, draw, read, context) ? True : False; });
}

HALFSPACE_EXPORT Bool glXMakeCurrent(Display* display, GLXDrawable drawable, GLXContext context) {
  return glXMakeContextCurrent(display, drawable, drawable, context);
}

HALFSPACE_EXPORT Bool glXMakeCurrentReadSGI(Display* display, GLXDrawable draw, GLXDrawable read,
                                            GLXContext context) {
  return glXMakeContextCurrent(display, draw, read, context);
}

HALFSPACE_EXPORT void glXCopyContext(Display* display, GLXContext source, GLXContext destination,
                                     unsigned long mask) {
  with_display(display, 0, [&](DisplayData&) {
    GlxContext* from = Registry::get().find(source);
    GlxContext* to = Registry::get().find(destination);
    // BadAccess, where it is current to someone.
    if (from && to && from != to && !to->current)
      state::copy_attributes(*from->gl, *to->gl, static_cast<GLbitfield>(mask));
    return 0;
  });
}

HALFSPACE_EXPORT Bool glXIsDirect(Display*, GLXContext context) {
  const std::lock_guard lock(Registry::get().mutex);
  return Registry::get().find(context) ? True : False;
}

HALFSPACE_EXPORT int glXQueryContext(Display*, GLXContext handle, int attribute, int* value) {
  const std::lock_guard lock(Registry::get().mutex);
  const GlxContext* context = Registry::get().find(handle);
  if (!context || !value) return GLX_BAD_CONTEXT;
  switch (attribute) {
    case GLX_FBCONFIG_ID:
      *value = context->config.id;
      return Success;
    case GLX_RENDER_TYPE:
      *value = GLX_RGBA_TYPE;
      return Success;
    case GLX_SCREEN:
      *value = context->config.screen;
      return Success;
    case GLX_VISUAL_ID_EXT:
      *value = int(context->config.visual_id);
      return Success;
    case GLX_SHARE_CONTEXT_EXT:
      *value = int(context->share_id);
      return Success;
    default:
      return GLX_BAD_ATTRIBUTE;
  }
}

HALFSPACE_EXPORT int glXQueryContextInfoEXT(Display* display, GLXContext context, int attribute, int* value) {
  return glXQueryContext(display, context, attribute, value);
}

HALFSPACE_EXPORT GLXContextID glXGetContextIDEXT(const GLXContext handle) {
  const std::lock_guard lock(Registry::get().mutex);
  const GlxContext* context = Registry::get().find(handle);
  return context ? context->id : None;
}

HALFSPACE_EXPORT GLXContext glXGetCurrentContext() {
  GlxContext* context = current_context();
  return context ? context->handle() : nullptr;
}

HALFSPACE_EXPORT Display* glXGetCurrentDisplay() {
  const GlxContext* context = current_context();
  return context ? context->display : nullptr;
}

HALFSPACE_EXPORT Display* glXGetCurrentDisplayEXT() { return glXGetCurrentDisplay(); }

HALFSPACE_EXPORT GLXDrawable glXGetCurrentDrawable() {
  const GlxContext* context = current_context();
  return context ? context->draw_id : None;
}

HALFSPACE_EXPORT GLXDrawable glXGetCurrentReadDrawable() {
  const GlxContext* context = current_context();
  return context ? context->read_id : None;
}

HALFSPACE_EXPORT GLXDrawable glXGetCurrentReadDrawableSGI() { return glXGetCurrentReadDrawable(); }

}  // extern "C"
