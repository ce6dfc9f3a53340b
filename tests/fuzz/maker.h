// Makes up a stream from a seed. What it avoids is what GL leaves open by more than a pixel or a few levels:
// then two right renderers differ, and nothing can be said.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "call.h"

namespace halfspace::fuzz {

inline constexpr int kWidth = 96, kHeight = 72;

// The same numbers from a seed on every machine and with every standard library.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {
    // Neighbouring seeds may not start at neighbouring places of one sequence.
    state_ = mixed() ^ 0x2545F4914F6CDD1Du;
  }
  uint32_t bits() { return static_cast<uint32_t>(mixed() >> 32); }
  int below(int count) { return static_cast<int>((uint64_t{bits()} * static_cast<uint64_t>(count)) >> 32); }
  int between(int low, int high) { return low + below(high - low + 1); }
  bool chance(int percent) { return below(100) < percent; }
  // A float, in steps that print short.
  double real(double low, double high) {
    return double(static_cast<float>(low + (high - low) * below(1025) / 1024.0));
  }
  // In 1/255: what 8 bits hold exactly.
  double level() { return double(static_cast<float>(below(256) / 255.0)); }
  template <typename Item>
  Item pick(std::initializer_list<Item> items) {
    return items.begin()[below(static_cast<int>(items.size()))];
  }

 private:
  // SplitMix64.
  uint64_t mixed() {
    uint64_t z = state_ += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }

  uint64_t state_;
};

struct Vertex {
  double position[4] = {0, 0, 0, 1};
  double color[4] = {1, 1, 1, 1};
  double normal[3] = {0, 0, 1};
  double tex_coord[4] = {0, 0, 0, 1};
  bool edge = true;
};

struct Shape {
  GLenum mode = GL_TRIANGLES;
  std::vector<Vertex> vertices;
};

struct Maker {
  explicit Maker(uint64_t seed) : random(seed) {}

  Random random;
  Stream stream;
  // Only colours all renderers agree on to the last bit: what follows (a logic op) would blow up a difference
  // of one level. No interpolation, no filter, no blending then.
  bool exact = false;
  // Colours are not linear over a polygon's plane, so how it is cut into triangles shows: draw triangles
  // only.
  bool triangles_only = false;
  // GL_DECAL is undefined but for RGB and RGBA: either there is no GL_DECAL in a stream, or nothing else.
  bool decal = false;
  bool in_list = false;
  // No smooth shading from here on.
  bool flat = false;
  bool stippled = false;
  // Pixels are changed on their way.
  bool transfers = false;
  // Polygons may be drawn as points or lines.
  bool polygon_points = false;
  // Points and lines are not just pixels.
  bool smooth = false;
  // There are clip planes.
  bool clip_planes = false;
  int pushed_matrices = 0, pushed_attributes = 0, pushed_client_attributes = 0;
  std::vector<double> lists;  // names of display lists that can be called

  void call(Command command, std::initializer_list<double> arguments = {}) {
    stream.push_back({command, arguments, {}});
  }
  void call(Command command, std::initializer_list<double> arguments, std::vector<uint8_t> data) {
    stream.push_back({command, arguments, std::move(data)});
  }
  template <typename Number>
  void call(Command command, std::initializer_list<double> arguments, const std::vector<Number>& numbers) {
    stream.push_back({command, arguments, bytes_of(numbers)});
  }
  void set_enabled(GLenum capability, bool on) {
    call(on ? Command::glEnable : Command::glDisable, {static_cast<double>(capability)});
  }
  std::vector<float> color(int alpha_percent = 60) {
    auto value = [&] { return static_cast<float>(exact ? random.level() : random.real(0, 1)); };
    return {value(), value(), value(), random.chance(alpha_percent) ? value() : 1};
  }
  void lose_linearity() { triangles_only = true; }
};

// A thing a stream may do; `group` is what --groups names.
struct Feature {
  const char* group;
  void (*add)(Maker&);
  int weight = 1;
  bool draws = false;
  // Works to the bit, so that it may be used when `exact` is asked for.
  bool exact = true;
};

const std::vector<Feature>& state_features();
const std::vector<Feature>& fragment_features();
const std::vector<Feature>& lighting_features();
const std::vector<Feature>& texture_features();
const std::vector<Feature>& drawing_features();
const std::vector<Feature>& pixel_features();
const std::vector<Feature>& list_features();
const std::vector<Feature>& capture_features();
const std::vector<Feature>& refused_features();
const std::vector<Feature>& client_features();

// By one of the ways GL has: immediate mode, arrays, elements.
void draw_shape(Maker& maker, const Shape& shape);
void draw_with_arrays(Maker& maker, const Shape& shape);
// The current colour is undefined after an array of colours was drawn.
void reset_current(Maker& maker);
Shape random_shape(Maker& maker);
// A valid one, and the state in which what is drawn there is not open.
void set_raster_position(Maker& maker);
// Before polygons are drawn as lines or points.
void prepare_for_edges(Maker& maker);

// Everything above.
std::vector<Feature> all_features();
std::vector<std::string> all_groups();
// `groups` (none: all) but those left out.
std::vector<std::string> groups_without(const std::vector<std::string>& groups,
                                        const std::vector<std::string>& left_out);
// `groups`: the names of those allowed; none: all.
Stream make_stream(uint64_t seed, const std::vector<std::string>& groups);

}  // namespace halfspace::fuzz
