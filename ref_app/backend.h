// Where a program's pictures are drawn. Each program is linked with one source that defines make_backend:
// glx_backend.cpp, osmesa_backend.cpp or raster_backend.cpp.
#pragma once

#include <memory>
#include <string>

#include "ref_app/gapi.h"

namespace ref_app {

enum class Key : uint8_t { none, left, right, up, down, space, next, previous, digit, quit };

struct KeyStroke {
  Key key = Key::none;
  int digit = 0;  // 1..9 with Key::digit
};

// What a backend that can show its pictures offers the viewer.
class Window {
 public:
  virtual ~Window() = default;
  virtual void set_title(const std::string& title) = 0;
  // The next key pressed since the last call, Key::none when there is none. Takes in resizing and closing.
  virtual KeyStroke next_key() = 0;
  virtual void present() = 0;
};

struct BackendStrings {
  std::string renderer, version, vendor;
};

class Backend {
 public:
  virtual ~Backend() = default;
  virtual Renderer& renderer() = 0;
  virtual Window* window() = 0;  // null when there is nothing to look at
  virtual BackendStrings strings() = 0;
  // Errors recorded since the last call; empty when all is well.
  virtual std::string take_errors() = 0;
};

struct BackendOptions {
  int width = 1024, height = 1024;
  bool visible = false;
  int stencil_bits = 0;  // at least; only OSMesa looks at it
};

// Throws std::runtime_error, with a message for people, when there is no display, no visual or no memory.
std::unique_ptr<Backend> make_backend(const BackendOptions& options);
// "glx", "osmesa" or "raster".
const char* backend_name();

}  // namespace ref_app
