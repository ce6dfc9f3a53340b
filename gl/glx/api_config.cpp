// Configs and visuals.
#include <X11/Xutil.h>

#include <cstdlib>

#include "gl/glx/choose.h"
#include "gl/glx/entry.h"

using namespace halfspace::gl::glx;

namespace {

// An array the caller gives to XFree, while the configs it points to live on.
GLXFBConfig* handle_array(const std::vector<const FbConfig*>& configs, int* count) {
  if (configs.empty()) return nullptr;
  auto* handles = static_cast<GLXFBConfig*>(std::malloc(configs.size() * sizeof(GLXFBConfig)));
  if (!handles) return nullptr;
  for (size_t i = 0; i < configs.size(); ++i) handles[i] = handle_of(configs[i]);
  *count = int(configs.size());
  return handles;
}

}  // namespace

extern "C" {

HALFSPACE_EXPORT GLXFBConfig* glXChooseFBConfig(Display* display, int screen, const int* attributes,
                                                int* count) {
  int ignored = 0;
  int* out = count ? count : &ignored;
  *out = 0;
  return with_display(display, static_cast<GLXFBConfig*>(nullptr), [&](DisplayData& data) -> GLXFBConfig* {
    const std::vector<FbConfig>* configs = data.screen(screen);
    return configs ? handle_array(choose_configs(*configs, attributes), out) : nullptr;
  });
}

HALFSPACE_EXPORT GLXFBConfig* glXGetFBConfigs(Display* display, int screen, int* count) {
  int ignored = 0;
  int* out = count ? count : &ignored;
  *out = 0;
  return with_display(display, static_cast<GLXFBConfig*>(nullptr), [&](DisplayData& data) -> GLXFBConfig* {
    std::vector<const FbConfig*> all;
    if (const std::vector<FbConfig>* configs = data.screen(screen)) {
      for (const FbConfig& config : *configs) all.push_back(&config);
    }
    return handle_array(all, out);
  });
}

HALFSPACE_EXPORT int glXGetFBConfigAttrib(Display* display, GLXFBConfig handle, int attribute, int* value) {
  // GLX 1.4 has no code of its own for what is no config.
  return with_display(display, GLX_NO_EXTENSION, [&](DisplayData& data) {
    const FbConfig* config = data.find_config(handle);
    if (!config) return GLX_BAD_VALUE;
    int ignored = 0;
    return config_attribute(*config, attribute, value ? value : &ignored);
  });
}

HALFSPACE_EXPORT XVisualInfo* glXGetVisualFromFBConfig(Display* display, GLXFBConfig handle) {
  return with_display(display, static_cast<XVisualInfo*>(nullptr), [&](DisplayData& data) -> XVisualInfo* {
    const FbConfig* config = data.find_config(handle);
    return config ? data.visual_info(*config) : nullptr;
  });
}

HALFSPACE_EXPORT XVisualInfo* glXChooseVisual(Display* display, int screen, int* attributes) {
  return with_display(display, static_cast<XVisualInfo*>(nullptr), [&](DisplayData& data) -> XVisualInfo* {
    const std::vector<FbConfig>* configs = data.screen(screen);
    const FbConfig* config = configs ? choose_visual(*configs, attributes) : nullptr;
    return config ? data.visual_info(*config) : nullptr;
  });
}

HALFSPACE_EXPORT int glXGetConfig(Display* display, XVisualInfo* visual, int attribute, int* value) {
  return with_display(display, GLX_NO_EXTENSION, [&](DisplayData& data) -> int {
    if (!visual || !value) return GLX_BAD_VISUAL;
    if (!data.screen(visual->screen)) return GLX_BAD_SCREEN;
    if (const FbConfig* config = data.config_of(*visual)) return config_attribute(*config, attribute, value);
    // A visual of X that GL does not draw to. All it has is the answer no.
    *value = 0;
    return attribute == GLX_USE_GL ? 0 : GLX_BAD_VISUAL;
  });
}

// --- GLX_SGIX_fbconfig

HALFSPACE_EXPORT GLXFBConfigSGIX* glXChooseFBConfigSGIX(Display* display, int screen, int* attributes,
                                                        int* count) {
  return glXChooseFBConfig(display, screen, attributes, count);
}

HALFSPACE_EXPORT int glXGetFBConfigAttribSGIX(Display* display, GLXFBConfigSGIX config, int attribute,
                                              int* value) {
  return glXGetFBConfigAttrib(display, config, attribute, value);
}

HALFSPACE_EXPORT XVisualInfo* glXGetVisualFromFBConfigSGIX(Display* display, GLXFBConfigSGIX config) {
  return glXGetVisualFromFBConfig(display, config);
}

HALFSPACE_EXPORT GLXFBConfigSGIX glXGetFBConfigFromVisualSGIX(Display* display, XVisualInfo* visual) {
  return with_display(display, static_cast<GLXFBConfigSGIX>(nullptr),
                      [&](DisplayData& data) -> GLXFBConfigSGIX {
                        return visual ? handle_of(data.config_of(*visual)) : nullptr;
                      });
}

}  // extern "C"
