#include "bench/scales.h"

#include <cmath>
#include <stdexcept>

#include "bench/gl.h"
#include "bench/parts.h"

namespace halfspace::bench {
namespace {

Frame triangles(int amount, Screen) {
  return draw_terrain(static_cast<int>(std::lround(std::sqrt(static_cast<double>(amount) / 2))));
}

Frame pixels(int, Screen) { return draw_quads(8, {.four_colors = true}); }

Frame overdraw(int amount, Screen) {
  gl.Enable(GL_DEPTH_TEST);
  return draw_quads(amount, {.four_colors = true, .first_depth = 0.9F, .last_depth = -0.9F});
}

Frame textures(int amount, Screen screen) { return draw_small_squares(5000, amount, screen); }

Frame state_changes(int amount, Screen screen) { return draw_small_squares(amount, 16, screen); }

}  // namespace

const std::vector<Scale>& all_scales() {
  static const std::vector<Scale> scales{
#define SCALE(name, what, ...) {#name, what, {__VA_ARGS__}, name},
#include "bench/scales.def"
#undef SCALE
  };
  return scales;
}

const Scale& scale_named(const std::string& name) {
  for (const Scale& scale : all_scales())
    if (scale.name == name) return scale;
  throw std::runtime_error("there is no scale " + name);
}

Screen screen_of(const Scale& scale, int amount, Screen usual) {
  return scale.prepare == pixels ? Screen{amount, amount} : usual;
}

}  // namespace halfspace::bench
