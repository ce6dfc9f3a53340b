#define GLX_GLXEXT_PROTOTYPES 1
#include "gl/glvnd/dispatch.h"

#include <GL/glx.h>

#include <cstring>
#include <type_traits>

namespace halfspace::gl::glvnd {

Loader loader;

namespace {

// --- Whose a call is. Null: nobody's.

__GLXvendorInfo* of_screen(Display* display, int screen, ...) {
  return loader.exports->getDynDispatch(display, screen);
}
__GLXvendorInfo* of_visual(Display* display, XVisualInfo* visual) {
  return visual ? loader.exports->getDynDispatch(display, visual->screen) : nullptr;
}
template <class... Others>
__GLXvendorInfo* of_config(Display* display, GLXFBConfig config, Others...) {
  return loader.exports->vendorFromFBConfig(display, config);
}
template <class... Others>
__GLXvendorInfo* of_drawable(Display* display, GLXDrawable drawable, Others...) {
  return loader.exports->vendorFromDrawable(display, drawable);
}
__GLXvendorInfo* of_context(GLXContext context) { return loader.exports->vendorFromContext(context); }
template <class... Others>
__GLXvendorInfo* of_displays_context(Display*, GLXContext context, Others...) {
  return of_context(context);
}
template <class... Others>
__GLXvendorInfo* of_current(Others...) {
  return loader.exports->getCurrentDynDispatch();
}

// --- What libGLX has to know of a result, to find its vendor another time.

template <class Result, class... Others>
void keep_nothing(__GLXvendorInfo*, Result, Others...) {}
template <class... Others>
void keep_context(__GLXvendorInfo* vendor, GLXContext context, Display* display, Others...) {
  if (context) loader.exports->addVendorContextMapping(display, context, vendor);
}
void keep_config(__GLXvendorInfo* vendor, GLXFBConfig config, Display* display, XVisualInfo*) {
  if (config) loader.exports->addVendorFBConfigMapping(display, config, vendor);
}
void keep_configs(__GLXvendorInfo* vendor, GLXFBConfig* configs, Display* display, int, int*, int* count) {
  for (int i = 0; configs && i < *count; ++i)
    loader.exports->addVendorFBConfigMapping(display, configs[i], vendor);
}

// --- A function each.

enum Name {
#define HALFSPACE_DISPATCHED(function, owner, keep) k_##function,
#include "gl/glvnd/dispatched.def"
#undef HALFSPACE_DISPATCHED
  kNames
};
int indices[kNames];

template <class Function>
struct Signature;
template <class R, class... A>
struct Signature<R (*)(A...)> {
  using Result = R;
  using Function = R (*)(A...);

  static Function theirs(Name name, __GLXvendorInfo* vendor) {
    return vendor ? reinterpret_cast<Function>(loader.exports->fetchDispatchEntry(vendor, indices[name]))
                  : nullptr;
  }
};

// The signature is that of the declaration in glxext.h.
template <Name kName, class Owner, class Keep, class R, class... A>
auto dispatcher(R (*)(A...)) {
  return +[](A... arguments) -> R {
    __GLXvendorInfo* vendor = Owner()(arguments...);
    const auto function = Signature<R (*)(A...)>::theirs(kName, vendor);
    if constexpr (std::is_void_v<R>) {
      if (function) function(arguments...);
    } else {
      const R result = function ? function(arguments...) : R();
      Keep()(vendor, result, arguments...);
      return result;
    }
  };
}

struct Dispatched {
  const char* name;
  void* address;
};

#define HALFSPACE_DISPATCHED(function, owner, keep) \
  struct owner_of_##function {                      \
    template <class... A>                           \
    auto operator()(A... arguments) const {         \
      return owner(arguments...);                   \
    }                                               \
  };                                                \
  struct keep_of_##function {                       \
    template <class... A>                           \
    void operator()(A... arguments) const {         \
      keep(arguments...);                           \
    }                                               \
  };
#include "gl/glvnd/dispatched.def"
#undef HALFSPACE_DISPATCHED

const Dispatched* table() {
  static const Dispatched entries[kNames] = {
#define HALFSPACE_DISPATCHED(function, owner, keep)                                                      \
  {#function, reinterpret_cast<void*>(dispatcher<k_##function, owner_of_##function, keep_of_##function>( \
                  decltype (&function)(nullptr)))},
#include "gl/glvnd/dispatched.def"
#undef HALFSPACE_DISPATCHED
  };
  return entries;
}

int find(const char* name) {
  for (int i = 0; i < kNames; ++i)
    if (std::strcmp(table()[i].name, name) == 0) return i;
  return -1;
}

}  // namespace

void* dispatch_address(const char* name) {
  const int i = find(name);
  return i < 0 ? nullptr : table()[i].address;
}

void set_dispatch_index(const char* name, int index) {
  if (const int i = find(name); i >= 0) indices[i] = index;
}

}  // namespace halfspace::gl::glvnd
