// Full-screen textured planes in perspective.
#include <array>
#include <cmath>

#include "bench/gl.h"
#include "bench/shapes.h"
#include "bench/workload.h"

namespace halfspace::bench {
namespace {

constexpr int kPlanes = 20;
constexpr int kTextureSize = 256;

struct Corner {
  std::array<float, 3> position;
  std::array<float, 4> color;
  std::array<float, 2> texture;
};
using Plane = std::array<Corner, 4>;

// A plane that fills the screen: 1/w = middle + across x + up y, x and y from -1 to 1; w is the distance.
struct Perspective {
  float middle, across, up;
  float w_at(float x, float y) const { return 1 / (middle + across * x + up * y); }
};

constexpr std::array<std::array<float, 2>, 4> kCorners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

void use_perspective() {
  constexpr double kNear = 0.25, kFar = 64;
  gl.MatrixMode(GL_PROJECTION);
  gl.LoadIdentity();
  gl.Frustum(-kNear, kNear, -kNear, kNear, kNear, kFar);
  gl.MatrixMode(GL_MODELVIEW);
}

// `largest` w of the plane: divided by it, the colour stays between 0 and 1.
Corner make_corner(float x, float y, float w, float largest, const PlanarColor& planar) {
  const float share = w / largest;
  const auto [red, green, blue] = planar.at(x * share, y * share);
  return {{x * w, y * w, -w}, {red, green, blue, 0.8F + 0.2F * x * share}, {}};
}

// Planes behind each other, the last one nearest; the texture is turned on each, and about a texel a pixel
// wide.
Plane make_plane(int number, Screen screen, Numbers& numbers) {
  const float angle = 2 * static_cast<float>(number);
  const float near = 0.7F + 0.3F * static_cast<float>(number) / kPlanes;
  const Perspective perspective{near, 0.28F * near, 0.14F * near};
  const float repeats = static_cast<float>(screen.width) / kTextureSize / 2 * near;
  const PlanarColor color(numbers);
  Plane plane;
  for (size_t i = 0; i < 4; ++i) {
    const auto [x, y] = kCorners[i];
    const float w = perspective.w_at(x, y);
    plane[i] = make_corner(x, y, w, perspective.w_at(-1, -1), color);
    plane[i].texture = {repeats * w * (x * std::cos(angle) - y * std::sin(angle)),
                        repeats * w * (x * std::sin(angle) + y * std::cos(angle))};
  }
  return plane;
}

// A floor that runs away upwards until 16 times as far, where a pixel is 16 texels wide and 256 long:
// level 8. At the bottom it is one texel a pixel: level 0.
Plane make_floor(int number, Screen screen, Numbers& numbers) {
  constexpr float kFar = 16;
  const Perspective perspective{(1 + 1 / kFar) / 2, 0, (1 / kFar - 1) / 2};
  const float across = static_cast<float>(screen.width) / kTextureSize / 2;
  const float away = static_cast<float>(screen.height) / kTextureSize / 2 / -perspective.up;
  const PlanarColor color(numbers);
  Plane plane;
  for (size_t i = 0; i < 4; ++i) {
    const auto [x, y] = kCorners[i];
    const float w = perspective.w_at(x, y);
    plane[i] = make_corner(x, y, w, kFar, color);
    plane[i].texture = {across * w * x + 0.37F * static_cast<float>(number), away * w};
  }
  return plane;
}

using MakePlane = Plane (*)(int number, Screen screen, Numbers& numbers);

Frame draw_planes(MakePlane make, Screen screen) {
  Numbers numbers(11);
  std::vector<Plane> planes;
  for (int i = 0; i < kPlanes; ++i) planes.push_back(make(i, screen, numbers));
  use_perspective();
  return [planes] {
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.Begin(GL_QUADS);
    for (const Plane& plane : planes)
      for (const Corner& corner : plane) {
        gl.Color4f(corner.color[0], corner.color[1], corner.color[2], corner.color[3]);
        gl.TexCoord2f(corner.texture[0], corner.texture[1]);
        gl.Vertex3fv(corner.position.data());
      }
    gl.End();
    gl.Finish();
  };
}

void use_texture(bool mipmaps, GLint filter) {
  make_texture(kTextureSize, 3, mipmaps);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter == GL_NEAREST ? GL_NEAREST : GL_LINEAR);
  gl.Enable(GL_TEXTURE_2D);
}

void use_blend_and_depth() {
  gl.Enable(GL_BLEND);
  gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_LEQUAL);
}

}  // namespace

Frame tex_nearest(Screen screen) {
  use_texture(false, GL_NEAREST);
  return draw_planes(make_plane, screen);
}

Frame tex_bilinear(Screen screen) {
  use_texture(false, GL_LINEAR);
  return draw_planes(make_plane, screen);
}

Frame tex_trilinear(Screen screen) {
  use_texture(true, GL_LINEAR_MIPMAP_LINEAR);
  return draw_planes(make_floor, screen);
}

Frame tex_bilinear_blend_depth(Screen screen) {
  use_texture(false, GL_LINEAR);
  use_blend_and_depth();
  return draw_planes(make_plane, screen);
}

Frame tex_full(Screen screen) {
  use_texture(false, GL_LINEAR);
  use_blend_and_depth();
  gl.Enable(GL_ALPHA_TEST);
  gl.AlphaFunc(GL_GREATER, 0.25F);
  constexpr std::array<float, 4> kFogColor{0.6F, 0.7F, 0.8F, 1};
  gl.Enable(GL_FOG);
  gl.Fogi(GL_FOG_MODE, GL_EXP2);
  gl.Fogf(GL_FOG_DENSITY, 0.5F);
  gl.Fogfv(GL_FOG_COLOR, kFogColor.data());
  return draw_planes(make_plane, screen);
}

}  // namespace halfspace::bench
