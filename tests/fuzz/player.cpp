// player LIBRARY: plays streams on a libOSMesa that is loaded by path, so that each process has one GL and
// only that.
//
// In, for each stream: width, height, size of the stream (uint32 each), the stream. Out: "DONE" (uint32),
// number of errors, (call, error) for each (uint32), the pixels (RGBA, bottom row first), their depths
// (uint32, as OSMesaGetDepthBuffer gives them), their depths again (float, as glReadPixels does), stencil
// (bytes), number of captures, (call, mode, type, result, number of words, the words) for each (uint32).
#include <GL/osmesa.h>
#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <string>
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

// Words that selection wrote: for each hit the number of names, two depths, the names.
size_t hit_words(const std::vector<uint8_t>& buffer, int hits) {
  const size_t most = buffer.size() / sizeof(uint32_t);
  size_t words = 0;
  for (int i = 0; i < hits && words < most; ++i) {
    uint32_t names;
    std::memcpy(&names, buffer.data() + words * sizeof(uint32_t), sizeof(names));
    words += 3 + names;
  }
  return std::min(words, most);
}

// Watches selection and feedback.
class Observer {
 public:
  void play_call(const Call& call, uint32_t index, bool inside) {
    if (call.command != Command::glRenderMode) return play(call, symbol(name_of(call.command)));
    GLint mode = GL_RENDER;
    if (!inside) function<decltype(glGetIntegerv)>("glGetIntegerv")(GL_RENDER_MODE, &mode);
    const GLint result =
        function<decltype(glRenderMode)>("glRenderMode")(static_cast<GLenum>(call.arguments[0]));
    if (!inside && mode != GL_RENDER) add(index, static_cast<uint32_t>(mode), result);
  }
  // After a call that was not refused.
  void accepted(const Call& call) {
    if (call.command == Command::glFeedbackBuffer) feedback_ = &call;
    if (call.command == Command::glSelectBuffer) selection_ = &call;
  }
  bool send() const {
    const auto count = static_cast<uint32_t>(captures_.size());
    bool sent = write_all(STDOUT_FILENO, &count, sizeof(count));
    for (const std::vector<uint32_t>& capture : captures_)
      sent = sent && write_all(STDOUT_FILENO, capture.data(), capture.size() * sizeof(uint32_t));
    return sent;
  }

 private:
  void add(uint32_t index, uint32_t mode, GLint result) {
    const Call* buffer = mode == GL_SELECT ? selection_ : feedback_;
    if (!buffer) return;
    const std::vector<uint8_t>& data = buffer->data;
    const size_t words = mode == GL_SELECT ? hit_words(data, result)
                                           : std::min(data.size() / sizeof(uint32_t),
                                                      static_cast<size_t>(std::max(result, 0)));
    const auto type = mode == GL_SELECT ? 0u : static_cast<uint32_t>(buffer->arguments[1]);
    std::vector<uint32_t> capture = {index, mode, type, static_cast<uint32_t>(result),
                                     static_cast<uint32_t>(words)};
    capture.resize(5 + words);
    std::memcpy(capture.data() + 5, data.data(), words * sizeof(uint32_t));
    captures_.push_back(std::move(capture));
  }

  const Call *feedback_ = nullptr, *selection_ = nullptr;
  std::vector<std::vector<uint32_t>> captures_;
};

std::vector<Error> play_all(const Stream& stream, Observer& observer) {
  const auto get_error = function<decltype(glGetError)>("glGetError");
  std::vector<Error> errors;
  bool inside = false;
  for (uint32_t i = 0; i < stream.size(); ++i) {
    observer.play_call(stream[i], i, inside);
    if (stream[i].command == Command::glBegin && stream[i].arguments[0] <= GL_POLYGON) inside = true;
    if (stream[i].command == Command::glEnd) inside = false;
    if (inside) continue;
    // glGetError is not allowed after a Begin that was hidden in a list; then it answers without end.
    if (const GLenum error = get_error())
      errors.push_back({i, error});
    else
      observer.accepted(stream[i]);
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

// Images that are read as other unpacking says than they were made for have zeros behind them.
void pad_images(Stream& stream) {
  constexpr size_t kPadding = 1 << 16;
  for (Call& call : stream) {
    const std::string name = name_of(call.command);
    const bool image = name == "glDrawPixels" || name == "glBitmap" || name == "glPolygonStipple" ||
                       name.starts_with("glTexImage") || name.starts_with("glTexSubImage");
    if (image && !call.data.empty()) call.data.resize(call.data.size() + kPadding);
  }
}

// What the stream has left behind would change what is read.
void read_depth_and_stencil(GLsizei width, GLsizei height, std::vector<float>& depth,
                            std::vector<uint8_t>& stencil) {
  function<decltype(glEnd)>("glEnd")();
  function<decltype(glRenderMode)>("glRenderMode")(GL_RENDER);
  const auto store = function<decltype(glPixelStorei)>("glPixelStorei");
  for (const GLenum name : std::initializer_list<GLenum>{GL_PACK_SWAP_BYTES, GL_PACK_ROW_LENGTH,
                                                         GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS})
    store(name, 0);
  store(GL_PACK_ALIGNMENT, 1);
  const auto transfer = function<decltype(glPixelTransferf)>("glPixelTransferf");
  for (const GLenum name :
       std::initializer_list<GLenum>{GL_MAP_STENCIL, GL_INDEX_SHIFT, GL_INDEX_OFFSET, GL_DEPTH_BIAS})
    transfer(name, 0);
  transfer(GL_DEPTH_SCALE, 1);
  const auto read = function<decltype(glReadPixels)>("glReadPixels");
  read(0, 0, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, depth.data());
  read(0, 0, width, height, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, stencil.data());
}

bool answer_one() {
  uint32_t header[3];
  if (!read_all(STDIN_FILENO, header, sizeof(header))) return false;
  const auto [width, height, size] = header;
  std::vector<uint8_t> bytes(size);
  if (!read_all(STDIN_FILENO, bytes.data(), size)) return false;
  Stream stream = deserialize(bytes);
  pad_images(stream);

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
  Observer observer;
  const std::vector<Error> errors = play_all(stream, observer);
  function<decltype(glFinish)>("glFinish")();
  const std::vector<uint8_t> picture = pixels;
  const std::vector<uint32_t> raw_depth = read_depth(context, pixels.size() / 4);
  std::vector<float> depth(size_t{width} * height);
  std::vector<uint8_t> stencil(depth.size());
  read_depth_and_stencil(static_cast<GLsizei>(width), static_cast<GLsizei>(height), depth, stencil);
  function<decltype(OSMesaDestroyContext)>("OSMesaDestroyContext")(context);

  const uint32_t start[2] = {kDone, static_cast<uint32_t>(errors.size())};
  return write_all(STDOUT_FILENO, start, sizeof(start)) &&
         write_all(STDOUT_FILENO, errors.data(), errors.size() * sizeof(Error)) &&
         write_all(STDOUT_FILENO, picture.data(), picture.size()) &&
         write_all(STDOUT_FILENO, raw_depth.data(), raw_depth.size() * sizeof(uint32_t)) &&
         write_all(STDOUT_FILENO, depth.data(), depth.size() * sizeof(float)) &&
         write_all(STDOUT_FILENO, stencil.data(), stencil.size()) && observer.send();
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
