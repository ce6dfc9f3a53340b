// What glX entry points have in common.
#pragma once

#define GLX_GLXEXT_PROTOTYPES 1
#include <GL/glx.h>

#include <mutex>
#include <new>
#include <utility>

#include "gl/entry.h"
#include "gl/glx/current.h"
#include "gl/glx/registry.h"

namespace halfspace::gl::glx {

// Runs `work`; out of memory gives `failed`, for no exception may leave the C ABI.
template <class Result, class Work>
Result guarded(Result failed, Work&& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return failed;
  }
}

// The same with the data of `display` in hand and the registry locked; `failed` without a display.
template <class Result, class Work>
Result with_display(Display* display, Result failed, Work&& work) {
  if (!display) return failed;
  return guarded(failed, [&] {
    Registry& registry = Registry::get();
    const std::lock_guard lock(registry.mutex);
    return static_cast<Result>(work(registry.display(display)));
  });
}

inline GLXFBConfig handle_of(const FbConfig* config) {
  return reinterpret_cast<GLXFBConfig>(const_cast<FbConfig*>(config));
}

// Calls visit(attribute, value) for each pair up to None.
template <class Attribute, class Visit>
void for_each_attribute(const Attribute* attributes, Visit&& visit) {
  for (; attributes && *attributes != None; attributes += 2) visit(attributes[0], attributes[1]);
}

}  // namespace halfspace::gl::glx
