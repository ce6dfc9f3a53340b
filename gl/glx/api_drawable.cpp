// Windows, pixmaps and pbuffers.
#include <X11/Xutil.h>

#include <algorithm>

#include "gl/glx/entry.h"

using namespace halfspace::gl::glx;
using halfspace::raster::kMaxSurfaceSize;
using Kind = GlxDrawable::Kind;

namespace {

// A GLXWindow or GLXPixmap for something of X that exists and has the config's depth; None otherwise.
XID create_for(DisplayData& data, Kind kind, const FbConfig* config, XID target) {
  if (!config) return None;
  const XID id = data.connection->allocate_id();
  auto drawable = std::make_shared<GlxDrawable>(data.connection, kind, id, target, *config);
  if (!drawable->refresh()) return None;
  drawable->apply_size();
  data.drawables[id] = std::move(drawable);
  return id;
}

XID create_for(Display* display, Kind kind, GLXFBConfig config, XID target) {
  return with_display(display, XID{None}, [&](DisplayData& data) {
    return create_for(data, kind, data.find_config(config), target);
  });
}

// The drawable itself stays for as long as a context is current on it.
void destroy(Display* display, XID id) {
  with_display(display, 0, [id](DisplayData& data) {
    data.drawables.erase(id);
    return 0;
  });
}

struct PbufferRequest {
  long width = 0, height = 0;
  bool largest = false, preserved = true;
};

XID create_pbuffer(DisplayData& data, const FbConfig* config, PbufferRequest request) {
  if (!config || request.width < 0 || request.height < 0) return None;  // GLXBadFBConfig, BadValue
  const bool too_large = request.width > kMaxSurfaceSize || request.height > kMaxSurfaceSize;
  if (too_large && !request.largest) return None;  // BadAlloc
  const Size size{int(std::min<long>(request.width, kMaxSurfaceSize)),
                  int(std::min<long>(request.height, kMaxSurfaceSize))};
  const XID id = data.connection->allocate_id();
  auto drawable = std::make_shared<GlxDrawable>(id, *config, size);
  drawable->preserved_contents = request.preserved;
  drawable->largest = request.largest;
  data.drawables[id] = std::move(drawable);
  return id;
}

// False for an attribute nobody knows.
bool query(const GlxDrawable& drawable, int attribute, unsigned* value) {
  switch (attribute) {
    case GLX_WIDTH:
      *value = unsigned(drawable.server_size().width);
      return true;
    case GLX_HEIGHT:
      *value = unsigned(drawable.server_size().height);
      return true;
    case GLX_PRESERVED_CONTENTS:
      *value = drawable.preserved_contents;
      return true;
    case GLX_LARGEST_PBUFFER:
      *value = drawable.largest;
      return true;
    case GLX_FBCONFIG_ID:
      *value = unsigned(drawable.config().id);
      return true;
    case GLX_EVENT_MASK:
      *value = unsigned(drawable.event_mask);
      return true;
    case GLX_SWAP_INTERVAL_EXT:
      *value = unsigned(drawable.swap_interval);
      return true;
    case GLX_MAX_SWAP_INTERVAL_EXT:
      *value = unsigned(kMaxSwapInterval);
      return true;
    default:
      return false;
  }
}

}  // namespace

extern "C" {

HALFSPACE_EXPORT GLXWindow glXCreateWindow(Display* display, GLXFBConfig config, Window window, const int*) {
  return create_for(display, Kind::window, config, window);
}

HALFSPACE_EXPORT GLXPixmap glXCreatePixmap(Display* display, GLXFBConfig config, Pixmap pixmap, const int*) {
  return create_for(display, Kind::pixmap, config, pixmap);
}

HALFSPACE_EXPORT GLXPixmap glXCreateGLXPixmap(Display* display, XVisualInfo* visual, Pixmap pixmap) {
  return with_display(display, GLXPixmap{None}, [&](DisplayData& data) {
    return create_for(data, Kind::pixmap, visual ? data.config_of(*visual) : nullptr, pixmap);
  });
}

HALFSPACE_EXPORT GLXPixmap glXCreateGLXPixmapWithConfigSGIX(Display* display, GLXFBConfigSGIX config,
                                                            Pixmap pixmap) {
  return glXCreatePixmap(display, config, pixmap, nullptr);
}

// The colormap matters to colour-index rendering only.
HALFSPACE_EXPORT GLXPixmap glXCreateGLXPixmapMESA(Display* display, XVisualInfo* visual, Pixmap pixmap,
                                                  Colormap) {
  return glXCreateGLXPixmap(display, visual, pixmap);
}

HALFSPACE_EXPORT GLXPbuffer glXCreatePbuffer(Display* display, GLXFBConfig config, const int* attributes) {
  PbufferRequest request;
  bool known = true;
  for_each_attribute(attributes, [&](int attribute, int value) {
    switch (attribute) {
      case GLX_PBUFFER_WIDTH:
        request.width = value;
        break;
      case GLX_PBUFFER_HEIGHT:
        request.height = value;
        break;
      case GLX_LARGEST_PBUFFER:
        request.largest = value != 0;
        break;
      case GLX_PRESERVED_CONTENTS:
        request.preserved = value != 0;
        break;
      default:
        known = false;
    }
  });
  if (!known) return None;
  return with_display(display, GLXPbuffer{None}, [&](DisplayData& data) {
    return create_pbuffer(data, data.find_config(config), request);
  });
}

HALFSPACE_EXPORT GLXPbufferSGIX glXCreateGLXPbufferSGIX(Display* display, GLXFBConfigSGIX config,
                                                        unsigned width, unsigned height, int* attributes) {
  PbufferRequest request;
  request.width = width;
  request.height = height;
  request.preserved = false;
  for_each_attribute(attributes, [&](int attribute, int value) {
    if (attribute == GLX_LARGEST_PBUFFER_SGIX) request.largest = value != 0;
    if (attribute == GLX_PRESERVED_CONTENTS_SGIX) request.preserved = value != 0;
  });
  return with_display(display, GLXPbufferSGIX{None}, [&](DisplayData& data) {
    return create_pbuffer(data, data.find_config(config), request);
  });
}

HALFSPACE_EXPORT void glXDestroyWindow(Display* display, GLXWindow window) { destroy(display, window); }
HALFSPACE_EXPORT void glXDestroyPixmap(Display* display, GLXPixmap pixmap) { destroy(display, pixmap); }
HALFSPACE_EXPORT void glXDestroyGLXPixmap(Display* display, GLXPixmap pixmap) { destroy(display, pixmap); }
HALFSPACE_EXPORT void glXDestroyPbuffer(Display* display, GLXPbuffer pbuffer) { destroy(display, pbuffer); }
HALFSPACE_EXPORT void glXDestroyGLXPbufferSGIX(Display* display, GLXPbufferSGIX pbuffer) {
  destroy(display, pbuffer);
}

HALFSPACE_EXPORT void glXQueryDrawable(Display* display, GLXDrawable id, int attribute, unsigned* value) {
  if (!value) return;
  *value = 0;
  with_display(display, 0, [&](DisplayData& data) {
    if (const auto drawable = data.find_drawable(id)) {
      if (attribute == GLX_WIDTH || attribute == GLX_HEIGHT) drawable->refresh();
      query(*drawable, attribute, value);
      return 0;
    }
    // An X window nothing was drawn to yet.
    if (attribute == GLX_WIDTH || attribute == GLX_HEIGHT) {
      Window root;
      int x, y;
      unsigned width = 0, height = 0, border, depth;
      RequestScope scope(*data.connection);
      XGetGeometry(display, id, &root, &x, &y, &width, &height, &border, &depth);
      *value = attribute == GLX_WIDTH ? width : height;
    }
    return 0;
  });
}

HALFSPACE_EXPORT void glXQueryGLXPbufferSGIX(Display* display, GLXPbufferSGIX pbuffer, int attribute,
                                             unsigned* value) {
  glXQueryDrawable(display, pbuffer, attribute, value);
}

// Nothing ever clobbers a pbuffer of ours, so the one event there is never comes; the mask is kept.
HALFSPACE_EXPORT void glXSelectEvent(Display* display, GLXDrawable id, unsigned long mask) {
  with_display(display, 0, [&](DisplayData& data) {
    if (const auto drawable = data.find_drawable(id)) drawable->event_mask = mask;
    return 0;
  });
}

HALFSPACE_EXPORT void glXGetSelectedEvent(Display* display, GLXDrawable id, unsigned long* mask) {
  if (!mask) return;
  *mask = with_display(display, 0ul, [&](DisplayData& data) {
    const auto drawable = data.find_drawable(id);
    return drawable ? drawable->event_mask : 0ul;
  });
}

HALFSPACE_EXPORT void glXSelectEventSGIX(Display* display, GLXDrawable drawable, unsigned long mask) {
  glXSelectEvent(display, drawable, mask);
}

HALFSPACE_EXPORT void glXGetSelectedEventSGIX(Display* display, GLXDrawable drawable, unsigned long* mask) {
  glXGetSelectedEvent(display, drawable, mask);
}

}  // extern "C"
