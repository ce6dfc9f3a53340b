// libGLX_halfspace.so.0: us as a vendor of libglvnd, whose libGL.so.1 a system may have in place of ours. It
// loads us when __GLX_VENDOR_LIBRARY_NAME=halfspace, or when the X server names us, and takes both GL's and
// GLX's functions from here. The contract is glvnd/libglxabi.h's.
#include <GL/glx.h>

#include <cstring>

#include "gl/entry.h"
#include "gl/glvnd/dispatch.h"

namespace {

using namespace halfspace::gl;

// Wherever pixels can be put.
Bool is_screen_supported(Display* display, int screen) {
  return screen >= 0 && screen < ScreenCount(display);
}

// A function of GLX beyond 1.4 that is not dispatched would be taken for one of GL's and called without a
// context.
constexpr const char* kNotOffered[] = {"glXGetCurrentDisplayEXT",      "glXMakeCurrentReadSGI",
                                       "glXGetCurrentReadDrawableSGI", "glXCreateGLXPbufferSGIX",
                                       "glXDestroyGLXPbufferSGIX",     "glXQueryGLXPbufferSGIX",
                                       "glXSelectEventSGIX",           "glXGetSelectedEventSGIX",
                                       "glXCreateGLXPixmapMESA",       "glXCreateGLXPixmapWithConfigSGIX"};

void* get_proc_address(const GLubyte* name) {
  for (const char* without : kNotOffered)
    if (std::strcmp(reinterpret_cast<const char*>(name), without) == 0) return nullptr;
  return reinterpret_cast<void*>(glXGetProcAddressARB(name));
}

void* get_dispatch_address(const GLubyte* name) {
  return glvnd::dispatch_address(reinterpret_cast<const char*>(name));
}

void set_dispatch_index(const GLubyte* name, int index) {
  glvnd::set_dispatch_index(reinterpret_cast<const char*>(name), index);
}

}  // namespace

extern "C" HALFSPACE_EXPORT Bool __glx_Main(uint32_t version, const __GLXapiExports* exports,
                                            __GLXvendorInfo* vendor, __GLXapiImports* imports) {
  // A new minor version only adds at the ends.
  if (GLX_VENDOR_ABI_GET_MAJOR_VERSION(version) != GLX_VENDOR_ABI_MAJOR_VERSION) return False;
  glvnd::loader = {exports, vendor};
  imports->isScreenSupported = is_screen_supported;
  imports->getProcAddress = get_proc_address;
  imports->getDispatchAddress = get_dispatch_address;
  imports->setDispatchIndex = set_dispatch_index;
  return True;
}
