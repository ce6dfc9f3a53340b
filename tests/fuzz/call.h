// A stream of GL calls as data: it can be made up, sent to another process, played, cut down and printed as
// C.
#pragma once

#include <GL/gl.h>
#include <GL/glext.h>

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

namespace halfspace::fuzz {

#define HALFSPACE_COMMAND(name, groups) name,
enum class Command : uint16_t {
#include "commands.gen.def"
};
#undef HALFSPACE_COMMAND

struct Call {
  Command command{};
  // One for each parameter, in order; the pointer's is not looked at. Doubles hold every GL number exactly.
  std::vector<double> arguments;
  // What the pointer points to; empty: a null pointer. It lives as long as the stream, so arrays may point to
  // it.
  std::vector<uint8_t> data;

  bool operator==(const Call&) const = default;
};

using Stream = std::vector<Call>;

template <typename Number>
std::vector<uint8_t> bytes_of(const std::vector<Number>& numbers) {
  const auto* bytes = reinterpret_cast<const uint8_t*>(numbers.data());
  return {bytes, bytes + numbers.size() * sizeof(Number)};
}

const char* name_of(Command command);

// Calls `function`, which has the command's type.
void play(const Call& call, void* function);

// Begin and End, NewList and EndList alternate, what GL forbids between Begin and End is not there, and
// primitives have vertices enough.
bool is_well_formed(const Stream& stream);

std::vector<uint8_t> serialize(const Stream& stream);
Stream deserialize(const std::vector<uint8_t>& bytes);

// One statement for each call; data is a compound literal.
std::string print_call(const Call& call);
// A program which plays the stream on libOSMesa and writes a PPM file to standard output.
std::string print_program(const Stream& stream, int width, int height);

}  // namespace halfspace::fuzz
