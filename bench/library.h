// A libOSMesa by path, and a context of it.
#pragma once

#include <GL/gl.h>
#include <GL/osmesa.h>

#include <cstdint>
#include <string>
#include <vector>

namespace halfspace::bench {

struct Screen {
  int width = 1024, height = 1024;
};

// The commands come from the symbols it exports, as in a program that is linked to it. Stays loaded.
class Library {
 public:
  // Throws std::runtime_error when it cannot be loaded or lacks a command.
  explicit Library(const std::string& path);
  const std::string& path() const { return path_; }

 private:
  friend class Context;
  std::string path_;
  decltype(&::OSMesaCreateContextExt) create_context_;
  decltype(&::OSMesaMakeCurrent) make_current_;
  decltype(&::OSMesaDestroyContext) destroy_context_;
};

// RGBA8 with 24 bits of depth, current as long as it lives.
class Context {
 public:
  Context(const Library& library, Screen screen);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  // What glFinish left: the bottom row first.
  const std::vector<uint32_t>& pixels() const { return pixels_; }

 private:
  const Library& library_;
  std::vector<uint32_t> pixels_;
  OSMesaContext context_;
};

}  // namespace halfspace::bench
