// Many small things: clipped triangles, draws with state changes between them, lines, points.
#include <array>
#include <cmath>
#include <memory>

#include "bench/gl.h"
#include "bench/parts.h"
#include "bench/shapes.h"
#include "bench/workload.h"

namespace halfspace::bench {
namespace {

Frame draw_arrays(GLenum mode, std::vector<Vertex> made) {
  const auto vertices = std::make_shared<std::vector<Vertex>>(std::move(made));
  use_arrays(*vertices, Arrays::position_color);
  return [mode, vertices] {
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.DrawArrays(mode, 0, static_cast<GLsizei>(vertices->size()));
    gl.Finish();
  };
}

// A point on plane 0 .. 5 of the frustum of clipheavy, or inside it for others. Eye coordinates, the eye
// looks down negative z; the frustum's slope is 1/2 on all sides, near is 1, far is 10.
std::array<float, 3> point_on_plane(uint64_t plane, Numbers& numbers) {
  const float depth = plane == 4 ? 1 : plane == 5 ? 10 : numbers.between(1, 10);
  const float edge = depth / 2;
  float x = numbers.between(-edge, edge), y = numbers.between(-edge, edge);
  if (plane < 2) x = plane == 0 ? -edge : edge;
  if (plane == 2 || plane == 3) y = plane == 2 ? -edge : edge;
  return {x, y, -depth};
}

// About 40 pixels from end to end and slim, in any direction.
void add_sliver(std::vector<Vertex>& vertices, Numbers& numbers) {
  constexpr uint64_t kPlanesAndInside = 7;
  const std::array<float, 3> middle = point_on_plane(numbers.bits() % kPlanesAndInside, numbers);
  const float reach = -middle[2] / 2 * 0.04F;
  for (int corner = 0; corner < 3; ++corner) {
    Vertex vertex{middle, random_color(numbers), {}};
    for (float& coordinate : vertex.position) coordinate += numbers.between(-reach, reach);
    vertices.push_back(vertex);
  }
}

std::array<float, 3> random_place(Screen screen, float margin, Numbers& numbers) {
  return {numbers.between(margin, static_cast<float>(screen.width) - margin),
          numbers.between(margin, static_cast<float>(screen.height) - margin), 0};
}

struct SmallDraw {
  GLuint texture;
  std::array<float, 16> matrix;
};

// In a grid; every texture in turn.
std::vector<SmallDraw> small_draws(int count, const std::vector<GLuint>& textures, Screen screen) {
  const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<float>(count))));
  const float width = static_cast<float>(screen.width) / static_cast<float>(columns);
  const float height = static_cast<float>(screen.height) / static_cast<float>(columns);
  std::vector<SmallDraw> draws;
  for (int i = 0; i < count; ++i) {
    const float x = width * static_cast<float>(i % columns), y = height * static_cast<float>(i / columns);
    draws.push_back({textures[static_cast<size_t>(i) % textures.size()],
                     {width, 0, 0, 0, 0, height, 0, 0, 0, 0, 1, 0, x, y, 0, 1}});
  }
  return draws;
}

}  // namespace

Frame clipheavy(Screen) {
  Numbers numbers(13);
  std::vector<Vertex> vertices;
  for (int i = 0; i < 50000; ++i) add_sliver(vertices, numbers);
  gl.MatrixMode(GL_PROJECTION);
  gl.LoadIdentity();
  gl.Frustum(-0.5, 0.5, -0.5, 0.5, 1, 10);
  gl.MatrixMode(GL_MODELVIEW);
  gl.LoadIdentity();
  gl.Enable(GL_DEPTH_TEST);
  return draw_arrays(GL_TRIANGLES, std::move(vertices));
}

Frame many_state_changes(Screen screen) { return draw_small_squares(20000, 16, screen); }

Frame draw_small_squares(int count, int texture_count, Screen screen) {
  std::vector<GLuint> textures;
  for (int i = 0; i < texture_count; ++i)
    textures.push_back(make_texture(64, 100 + static_cast<uint64_t>(i), false));
  const std::vector<SmallDraw> draws = small_draws(count, textures, screen);
  use_pixel_coordinates(screen);
  gl.Enable(GL_TEXTURE_2D);
  // A little smaller than its cell.
  static constexpr std::array<float, 8> kSquare{0.05F, 0.05F, 0.95F, 0.05F, 0.05F, 0.95F, 0.95F, 0.95F};
  static constexpr std::array<float, 8> kTexture{0, 0, 1, 0, 0, 1, 1, 1};
  gl.EnableClientState(GL_VERTEX_ARRAY);
  gl.VertexPointer(2, GL_FLOAT, 0, kSquare.data());
  gl.EnableClientState(GL_TEXTURE_COORD_ARRAY);
  gl.TexCoordPointer(2, GL_FLOAT, 0, kTexture.data());
  return [draws] {
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    for (const SmallDraw& draw : draws) {
      gl.BindTexture(GL_TEXTURE_2D, draw.texture);
      gl.LoadMatrixf(draw.matrix.data());
      gl.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    }
    gl.Finish();
  };
}

Frame lines(Screen screen) {
  constexpr float kLength = 20;
  Numbers numbers(17);
  std::vector<Vertex> vertices;
  for (int i = 0; i < 100000; ++i) {
    const float angle = numbers.between(0, 6.2831853F);
    std::array<float, 3> place = random_place(screen, kLength, numbers);
    vertices.push_back({place, random_color(numbers), {}});
    place[0] += kLength * std::cos(angle);
    place[1] += kLength * std::sin(angle);
    vertices.push_back({place, random_color(numbers), {}});
  }
  use_pixel_coordinates(screen);
  return draw_arrays(GL_LINES, std::move(vertices));
}

Frame points(Screen screen) {
  Numbers numbers(19);
  std::vector<Vertex> vertices;
  for (int i = 0; i < 1000000; ++i)
    vertices.push_back({random_place(screen, 0, numbers), random_color(numbers), {}});
  use_pixel_coordinates(screen);
  return draw_arrays(GL_POINTS, std::move(vertices));
}

}  // namespace halfspace::bench
