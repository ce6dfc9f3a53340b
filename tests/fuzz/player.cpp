// player LIBRARY: plays streams on a libOSMesa that is loaded by path, so that each process has one GL and
// only that.
//
// In, for each stream: width, height, size of the stream (uint32 each), the stream. Out: "DONE" (uint32),
// number of errors, (call, error) for each (uint32), the pixels (RGBA, bottom row first), their depths
// (uint32, as OSMesaGetDepthBuffer gives them).
#include <GL/osmesa.h>
#include <dlfcn.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "call.h"
#include "protocol.h"

namespace {

using namespace halfspace::fuzz;

void* library;

void* symbol(const char* name) {
  void* found = dlsym(library, name);
  if (!found) {
    std::fprintf(stderr, "player: no %s in the library\n", name);
    std::exit(3);
  }
  return found;
}

template <typename Function>
Function* function(const char* name) {
  return reinterpret_cast<Function*>(symbol(name));
}

struct Error {
  uint32_t call, error;
};

std::vector<Error> play_all(const Stream& stream) {
  const auto get_error = function<decltype(glGetError)>("glGetError");
  std::vector<Error> errors;
  bool inside = false;
  for (uint32_t i = 0; i < stream.size(); ++i) {
    play(stream[i], symbol(name_of(stream[i].command)));
    if (stream[i].command == Command::glBegin) inside = true;
    if (stream[i].command == Command::glEnd) inside = false;
    if (inside) continue;
    // glGetError is not allowed after a Begin that was hidden in a list; then it answers without end.
    if (const GLenum error = get_error()) errors.push_back({i, error});
  }
  return errors;
}

std::vector<uint32_t> read_depth(OSMesaContext context, size_t count) {
  std::vector<uint32_t> depth(count);
  GLint width, height, bytes;
  void* values = nullptr;
  if (function<decltype(OSMesaGetDepthBuffer)>("OSMesaGetDepthBuffer")(context, &width, &height, &bytes,
                                                                       &values) &&
      bytes == sizeof(uint32_t) && size_t(width) * size_t(height) == count)
    std::memcpy(depth.data(), values, count * sizeof(uint32_t));
  return depth;
}

bool answer_one() {
  uint32_t header[3];
  if (!read_all(STDIN_FILENO, header, sizeof(header))) return false;
  const auto [width, height, size] = header;
  std::vector<uint8_t> bytes(size);
  if (!read_all(STDIN_FILENO, bytes.data(), size)) return false;
  const Stream stream = deserialize(bytes);

  std::vector<uint8_t> pixels(size_t{4} * width * height);
  OSMesaContext context =
      function<decltype(OSMesaCreateContextExt)>("OSMesaCreateContextExt")(OSMESA_RGBA, 24, 8, 16, nullptr);
  if (!context ||
      !function<decltype(OSMesaMakeCurrent)>("OSMesaMakeCurrent")(
          context, pixels.data(), GL_UNSIGNED_BYTE, static_cast<int>(width), static_cast<int>(height)))
    std::exit(4);
  // What is in new buffers is anybody's guess.
  function<decltype(glClear)>("glClear")(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT |
                                         GL_ACCUM_BUFFER_BIT);
  const std::vector<Error> errors = play_all(stream);
  function<decltype(glFinish)>("glFinish")();
  const std::vector<uint8_t> picture = pixels;
  const std::vector<uint32_t> depth = read_depth(context, pixels.size() / 4);
  function<decltype(OSMesaDestroyContext)>("OSMesaDestroyContext")(context);

  const uint32_t start[2] = {kDone, static_cast<uint32_t>(errors.size())};
  return write_all(STDOUT_FILENO, start, sizeof(start)) &&
         write_all(STDOUT_FILENO, errors.data(), errors.size() * sizeof(Error)) &&
         write_all(STDOUT_FILENO, picture.data(), picture.size()) &&
         write_all(STDOUT_FILENO, depth.data(), depth.size() * sizeof(uint32_t));
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: player LIBRARY\n");
    return 2;
  }
  library = dlopen(arguments[1], RTLD_NOW | RTLD_LOCAL);
  if (!library) {
    std::fprintf(stderr, "player: %s\n", dlerror());
    return 3;
  }
  while (answer_one()) {
  }
  return 0;
}
