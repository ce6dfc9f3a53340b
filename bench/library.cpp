#include "bench/library.h"

#include <dlfcn.h>

#include <stdexcept>

#include "bench/gl.h"

namespace halfspace::bench {

Gl gl;

namespace {

template <typename Function>
void load(void* handle, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(handle, name));
  if (function == nullptr) throw std::runtime_error(std::string("the library has no ") + name);
}

}  // namespace

Library::Library(const std::string& path) : path_(path) {
  void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) throw std::runtime_error(dlerror());
  load(handle, "OSMesaCreateContextExt", create_context_);
  load(handle, "OSMesaMakeCurrent", make_current_);
  load(handle, "OSMesaDestroyContext", destroy_context_);
#define GL_FUNCTION(name) load(handle, "gl" #name, gl.name);
#include "bench/gl_functions.def"
#undef GL_FUNCTION
}

Context::Context(const Library& library, Screen screen)
    : library_(library),
      pixels_(static_cast<size_t>(screen.width) * static_cast<size_t>(screen.height)),
      context_(library.create_context_(OSMESA_RGBA, 24, 0, 0, nullptr)) {
  if (context_ == nullptr) throw std::runtime_error("OSMesaCreateContextExt gave no context");
  if (!library.make_current_(context_, pixels_.data(), GL_UNSIGNED_BYTE, screen.width, screen.height)) {
    library.destroy_context_(context_);
    throw std::runtime_error("OSMesaMakeCurrent failed");
  }
}

Context::~Context() { library_.destroy_context_(context_); }

}  // namespace halfspace::bench
