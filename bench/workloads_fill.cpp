// Near full-screen quads.
#include <array>

#include "bench/gl.h"
#include "bench/parts.h"
#include "bench/shapes.h"
#include "bench/workload.h"

namespace halfspace::bench {
namespace {

struct Corner {
  std::array<float, 3> position;
  std::array<float, 3> color;
};
using Quad = std::array<Corner, 4>;

// Each a little smaller than the one before, so that all show in the picture; `share` is 0 for the first,
// nearly 1 for the last. Tilted ones lean in depth as well.
Quad make_quad(float share, const QuadStyle& style, Numbers& numbers) {
  const float edge = 0.995F - 0.03F * share;
  const float depth = style.first_depth + (style.last_depth - style.first_depth) * share;
  const PlanarColor color(numbers);
  constexpr std::array<std::array<float, 2>, 4> kCorners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  Quad quad;
  for (size_t i = 0; i < 4; ++i) {
    const float lean = style.tilted ? 0.02F * static_cast<float>(i % 2) : 0;
    const float x = kCorners[i][0] * (edge - lean), y = kCorners[i][1] * (edge - lean * 0.7F);
    const float slope = style.first_depth == style.last_depth ? 0 : 0.003F * (x + y);
    quad[i].position = {x, y, depth + slope};
    quad[i].color = style.four_colors ? color.at(x, y) : color.at(1, 1);
  }
  return quad;
}

Frame fill(const QuadStyle& style) { return draw_quads(100, style); }

}  // namespace

Frame draw_quads(int count, const QuadStyle& style) {
  Numbers numbers(7);
  std::vector<Quad> quads;
  for (int i = 0; i < count; ++i)
    quads.push_back(make_quad(static_cast<float>(i) / static_cast<float>(count), style, numbers));
  gl.ShadeModel(style.four_colors ? GL_SMOOTH : GL_FLAT);
  const float alpha = style.translucent ? 0.4F : 1;
  return [quads, alpha] {
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.Begin(GL_QUADS);
    for (const Quad& quad : quads)
      for (const Corner& corner : quad) {
        gl.Color4f(corner.color[0], corner.color[1], corner.color[2], alpha);
        gl.Vertex3fv(corner.position.data());
      }
    gl.End();
    gl.Finish();
  };
}

Frame clear(Screen) {
  return [frame = 0]() mutable {
    gl.ClearColor(0.25F * static_cast<float>(++frame % 4), 0.5F, 0.25F, 1);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.Finish();
  };
}

Frame fill_flat(Screen) { return fill({}); }

Frame fill_rect(Screen) { return fill({.tilted = false}); }

Frame fill_smooth(Screen) { return fill({.four_colors = true}); }

Frame fill_depth(Screen) {
  gl.Enable(GL_DEPTH_TEST);
  return fill({.first_depth = 0.9F, .last_depth = -0.9F});
}

Frame fill_depth_reject(Screen) {
  gl.Enable(GL_DEPTH_TEST);
  return fill({.first_depth = -0.9F, .last_depth = 0.9F});
}

Frame fill_blend(Screen) {
  gl.Enable(GL_BLEND);
  gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  return fill({.four_colors = true, .translucent = true});
}

}  // namespace halfspace::bench
