#include "call.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <set>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace halfspace::fuzz {
namespace {

template <typename Parameter>
Parameter argument_of(const Call& call, size_t index) {
  if constexpr (std::is_pointer_v<Parameter>) {
    // GL writes to the buffers of selection and feedback; those of a stream that is played are not constant.
    auto* data = const_cast<uint8_t*>(call.data.data());
    return call.data.empty() ? nullptr : reinterpret_cast<Parameter>(data);
  } else if constexpr (std::is_integral_v<Parameter>) {
    return static_cast<Parameter>(static_cast<long long>(call.arguments[index]));
  } else {
    return static_cast<Parameter>(call.arguments[index]);
  }
}

template <typename Function>
struct Player;

template <typename Result, typename... Parameters>
struct Player<Result(Parameters...)> {
  static void play(const Call& call, void* function) {
    play_indexed(call, function, std::index_sequence_for<Parameters...>());
  }
  template <size_t... kIndices>
  static void play_indexed([[maybe_unused]] const Call& call, void* function,
                           std::index_sequence<kIndices...>) {
    reinterpret_cast<Result (*)(Parameters...)>(function)(argument_of<Parameters>(call, kIndices)...);
  }
  static constexpr size_t kCount = sizeof...(Parameters);
};

struct Row {
  const char* name;
  size_t parameters;
  void (*play)(const Call&, void*);
};

const Row kRows[] = {
#define HALFSPACE_COMMAND(name, groups) \
  {#name, Player<decltype(::name)>::kCount, Player<decltype(::name)>::play},
#include "commands.gen.def"
#undef HALFSPACE_COMMAND
};

const Row& row_of(Command command) { return kRows[static_cast<size_t>(command)]; }

// The spec's section 2.6.3, without glCallList(s): a list may hold whatever it likes.
bool is_allowed_inside(Command command) {
  static const std::set<std::string> kPrefixes = {"glVertex",    "glColor",    "glIndex",    "glNormal",
                                                  "glTexCoord",  "glEdgeFlag", "glMaterial", "glArrayElement",
                                                  "glEvalCoord", "glEvalPoint"};
  static const std::set<std::string> kOthers = {"glColorMask",     "glColorMaterial",   "glColorPointer",
                                                "glIndexMask",     "glIndexPointer",    "glNormalPointer",
                                                "glVertexPointer", "glTexCoordPointer", "glEdgeFlagPointer"};
  const std::string name = name_of(command);
  if (kOthers.count(name)) return false;
  for (const std::string& prefix : kPrefixes) {
    if (name.starts_with(prefix)) return true;
  }
  return false;
}

// What everyone refuses between Begin and End. Of the client's state, of lists and of images some is let
// through.
bool is_refused_inside(Command command) {
  static const char* const kParts[] = {"Pointer", "Client", "List",   "Pixel",  "Interleaved", "Draw",
                                       "Tex",     "Render", "Buffer", "Bitmap", "Map",         "Is"};
  const std::string name = name_of(command);
  return std::none_of(std::begin(kParts), std::end(kParts),
                      [&](const char* part) { return name.find(part) != std::string::npos; });
}

bool makes_vertex(Command command) {
  const std::string name = name_of(command);
  return name.starts_with("glVertex") || name.starts_with("glArrayElement") || name.starts_with("glEval");
}

// Whether a stream may be played, one call after the other. A stream that is cut down must not slip from the
// difference it had to what Mesa makes of display lists: it joins halves of primitives there, and records an
// error for attributes that first come after a vertex.
class Grammar {
 public:
  bool accepts(const Call& call) {
    switch (call.command) {
      case Command::glBegin:
        if (call.arguments[0] > GL_POLYGON) return true;  // refused
        return !std::exchange(inside_, true) && begin(static_cast<int>(call.arguments[0]));
      case Command::glEnd:
        return std::exchange(inside_, false) && is_whole() && (!listing_ || last_is_vertex_);
      case Command::glNewList:
        return !inside_ && new_list();
      case Command::glEndList:
        return !inside_ && std::exchange(listing_, false);
      default:
        return !inside_ || accepts_inside(call.command);
    }
  }
  bool is_complete() const { return !inside_ && !listing_; }

 private:
  bool begin(int mode) {
    mode_ = mode;
    vertices_ = 0;
    if (!listing_) attributes_.clear();
    return true;
  }

  bool new_list() {
    attributes_.clear();
    any_vertices_ = false;
    return !std::exchange(listing_, true);
  }

  bool accepts_inside(Command command) {
    if (!is_allowed_inside(command)) return !listing_ && is_refused_inside(command);
    last_is_vertex_ = makes_vertex(command);
    if (last_is_vertex_) {
      ++vertices_;
      any_vertices_ = true;
    } else if (listing_ ? !any_vertices_ : vertices_ == 0) {
      attributes_.insert(command);
    } else if (listing_) {
      return attributes_.count(command) > 0;
    }
    return true;
  }

  bool is_whole() const {
    switch (mode_) {
      case GL_LINES:
        return vertices_ >= 2 && (!listing_ || vertices_ % 2 == 0);
      case GL_TRIANGLES:
        return vertices_ >= 3 && (!listing_ || vertices_ % 3 == 0);
      case GL_QUADS:
        return vertices_ >= 4 && (!listing_ || vertices_ % 4 == 0);
      case GL_TRIANGLE_STRIP:
      case GL_TRIANGLE_FAN:
      case GL_POLYGON:
        return vertices_ >= 3;
      case GL_QUAD_STRIP:
        return vertices_ >= 4 && vertices_ % 2 == 0;
      case GL_LINE_STRIP:
      case GL_LINE_LOOP:
        return vertices_ >= 2;
      default:
        return vertices_ >= 1;
    }
  }

  bool inside_ = false, listing_ = false, any_vertices_ = false, last_is_vertex_ = false;
  int mode_ = 0, vertices_ = 0;
  std::set<Command> attributes_;
};

class Writer {
 public:
  template <typename Number>
  void number(Number value) {
    const size_t at = bytes_.size();
    bytes_.resize(at + sizeof(value));
    std::memcpy(bytes_.data() + at, &value, sizeof(value));
  }
  void append(const std::vector<uint8_t>& data) { bytes_.insert(bytes_.end(), data.begin(), data.end()); }
  std::vector<uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<uint8_t> bytes_;
};

class Reader {
 public:
  explicit Reader(const std::vector<uint8_t>& bytes) : bytes_(bytes) {}
  template <typename Number>
  Number number() {
    Number value;
    need(sizeof(value));
    std::memcpy(&value, bytes_.data() + at_, sizeof(value));
    at_ += sizeof(value);
    return value;
  }
  std::vector<uint8_t> data(size_t size) {
    need(size);
    const auto first = bytes_.begin() + static_cast<std::ptrdiff_t>(at_);
    at_ += size;
    return {first, first + static_cast<std::ptrdiff_t>(size)};
  }

 private:
  void need(size_t size) const {
    if (size > bytes_.size() - at_) throw std::runtime_error("a stream is cut short");
  }
  const std::vector<uint8_t>& bytes_;
  size_t at_ = 0;
};

}  // namespace

const char* name_of(Command command) { return row_of(command).name; }

void play(const Call& call, void* function) {
  if (call.arguments.size() != row_of(call.command).parameters)
    throw std::runtime_error(std::string(name_of(call.command)) + ": wrong number of arguments");
  row_of(call.command).play(call, function);
}

bool is_well_formed(const Stream& stream) {
  Grammar grammar;
  for (const Call& call : stream) {
    if (!grammar.accepts(call)) return false;
  }
  return grammar.is_complete();
}

std::vector<uint8_t> serialize(const Stream& stream) {
  Writer writer;
  writer.number(static_cast<uint32_t>(stream.size()));
  for (const Call& call : stream) {
    writer.number(call.command);
    writer.number(static_cast<uint16_t>(call.arguments.size()));
    for (double argument : call.arguments) writer.number(argument);
    writer.number(static_cast<uint32_t>(call.data.size()));
    writer.append(call.data);
  }
  return writer.take();
}

Stream deserialize(const std::vector<uint8_t>& bytes) {
  Reader reader(bytes);
  Stream stream(reader.number<uint32_t>());
  for (Call& call : stream) {
    call.command = reader.number<Command>();
    call.arguments.resize(reader.number<uint16_t>());
    for (double& argument : call.arguments) argument = reader.number<double>();
    call.data = reader.data(reader.number<uint32_t>());
  }
  return stream;
}

}  // namespace halfspace::fuzz
