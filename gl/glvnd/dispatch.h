// GLX's functions beyond 1.4, which libglvnd's libGLX knows nothing of: for each a function that finds the
// vendor its arguments belong to and calls that vendor's.
#pragma once

#include <glvnd/libglxabi.h>

namespace halfspace::gl::glvnd {

// What libGLX offers, and our own handle in it. Set once, by __glx_Main.
struct Loader {
  const __GLXapiExports* exports = nullptr;
  __GLXvendorInfo* vendor = nullptr;
};
extern Loader loader;

// Null for a name that is not dispatched here.
void* dispatch_address(const char* name);
// The place of `name` in every vendor's table.
void set_dispatch_index(const char* name, int index);

}  // namespace halfspace::gl::glvnd
