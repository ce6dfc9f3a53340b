// What there is: versions, extensions, names.
#include <array>
#include <cstring>

#include "gl/glx/entry.h"
#include "gl/proc_address.h"

using namespace halfspace::gl::glx;

namespace {

// What works, and nothing else.
constexpr char kExtensions[] =
    "GLX_ARB_create_context GLX_ARB_create_context_profile GLX_ARB_get_proc_address GLX_EXT_swap_control "
    "GLX_EXT_visual_info GLX_EXT_visual_rating GLX_MESA_copy_sub_buffer GLX_MESA_swap_control "
    "GLX_SGIX_fbconfig "
    "GLX_SGIX_pbuffer GLX_SGI_make_current_read GLX_SGI_swap_control";

const char* text_of(int name) {
  switch (name) {
    case GLX_VENDOR:
      return "Halfspace";
    case GLX_VERSION:
      return "1.4";
    case GLX_EXTENSIONS:
      return kExtensions;
    default:
      return nullptr;
  }
}

struct Name {
  const char* name;
  halfspace::gl::Proc proc;
};

constexpr size_t kNameCount = 0
#define HALFSPACE_GLX_NAME(name) +1
#include "gl/glx/names.def"
#undef HALFSPACE_GLX_NAME
    ;

const std::array<Name, kNameCount> kNames{{
#define HALFSPACE_GLX_NAME(name) {#name, reinterpret_cast<halfspace::gl::Proc>(name)},
#include "gl/glx/names.def"
#undef HALFSPACE_GLX_NAME
}};

halfspace::gl::Proc proc_address(const char* name) {
  if (!name) return nullptr;
  if (std::strncmp(name, "glX", 3) != 0) return halfspace::gl::get_proc_address(name);
  for (const Name& known : kNames) {
    if (std::strcmp(known.name, name) == 0) return known.proc;
  }
  return nullptr;
}

}  // namespace

extern "C" {

// The server need not know GLX: everything happens on this side. There are no GLX events or errors, hence no
// bases.
HALFSPACE_EXPORT Bool glXQueryExtension(Display*, int* error_base, int* event_base) {
  if (error_base) *error_base = 0;
  if (event_base) *event_base = 0;
  return True;
}

HALFSPACE_EXPORT Bool glXQueryVersion(Display*, int* major, int* minor) {
  if (major) *major = 1;
  if (minor) *minor = 4;
  return True;
}

HALFSPACE_EXPORT const char* glXQueryExtensionsString(Display*, int) { return kExtensions; }
HALFSPACE_EXPORT const char* glXQueryServerString(Display*, int, int name) { return text_of(name); }
HALFSPACE_EXPORT const char* glXGetClientString(Display*, int name) { return text_of(name); }

HALFSPACE_EXPORT __GLXextFuncPtr glXGetProcAddress(const GLubyte* name) {
  return proc_address(reinterpret_cast<const char*>(name));
}

HALFSPACE_EXPORT __GLXextFuncPtr glXGetProcAddressARB(const GLubyte* name) { return glXGetProcAddress(name); }

}  // extern "C"
