// Triangles: grids of a stated size, terrains, lights, immediate mode and display lists.
#include <array>
#include <cmath>
#include <memory>

#include "bench/gl.h"
#include "bench/parts.h"
#include "bench/shapes.h"
#include "bench/workload.h"

namespace halfspace::bench {
namespace {

constexpr int kLitCells = 316;  // squared and doubled: 200,000 triangles

// A grid over the screen whose inner corners are moved by up to a quarter of a cell, with depths of their
// own.
void add_layer(Mesh& mesh, Screen screen, float cell, Numbers& numbers) {
  const auto columns = static_cast<GLuint>(std::lround(static_cast<float>(screen.width) / cell));
  const auto rows = static_cast<GLuint>(std::lround(static_cast<float>(screen.height) / cell));
  const auto first = static_cast<GLuint>(mesh.vertices.size());
  const auto place = [&](GLuint number, GLuint count, int size) {
    const bool inside = number > 0 && number < count;
    return (static_cast<float>(number) + (inside ? numbers.between(-0.25F, 0.25F) : 0)) *
           static_cast<float>(size) / static_cast<float>(count);
  };
  for (GLuint row = 0; row <= rows; ++row)
    for (GLuint column = 0; column <= columns; ++column)
      mesh.vertices.push_back({{place(column, columns, screen.width), place(row, rows, screen.height),
                                numbers.between(-0.9F, 0.9F)},
                               random_color(numbers),
                               {}});
  for (GLuint row = 0; row < rows; ++row)
    for (GLuint column = 0; column < columns; ++column) {
      const GLuint a = first + row * (columns + 1) + column, b = a + 1, c = a + columns + 1, d = c + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
    }
}

Frame draw_elements(std::shared_ptr<const Mesh> mesh, Arrays arrays) {
  use_arrays(mesh->vertices, arrays);
  return [mesh] {
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(mesh->indices.size()), GL_UNSIGNED_INT,
                    mesh->indices.data());
    gl.Finish();
  };
}

// Four layers of triangles of so many pixels.
Frame triangles_of(float pixels, Screen screen) {
  auto mesh = std::make_shared<Mesh>();
  Numbers numbers(5);
  for (int layer = 0; layer < 4; ++layer) add_layer(*mesh, screen, std::sqrt(2 * pixels), numbers);
  use_pixel_coordinates(screen);
  gl.Enable(GL_DEPTH_TEST);
  return draw_elements(mesh, Arrays::position_color);
}

std::shared_ptr<const Mesh> use_lit_terrain() {
  look_at_terrain();
  gl.Enable(GL_DEPTH_TEST);
  gl.Enable(GL_LIGHTING);
  gl.ColorMaterial(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE);
  gl.Enable(GL_COLOR_MATERIAL);
  return std::make_shared<Mesh>(terrain(kLitCells));
}

void use_directional_light() {
  constexpr std::array<float, 4> kDirection{0.5F, 0.6F, 0.7F, 0};
  gl.Lightfv(GL_LIGHT0, GL_POSITION, kDirection.data());
  gl.Enable(GL_LIGHT0);
}

// In a ring above the ground, each of its own colour.
void use_eight_lights() {
  constexpr std::array<float, 4> kShine{0.5F, 0.5F, 0.5F, 1};
  gl.Materialfv(GL_FRONT_AND_BACK, GL_SPECULAR, kShine.data());
  gl.Materialf(GL_FRONT_AND_BACK, GL_SHININESS, 20);
  for (int i = 0; i < 8; ++i) {
    const auto light = static_cast<GLenum>(GL_LIGHT0 + i);
    const float angle = 0.785F * static_cast<float>(i);
    const std::array<float, 4> position{std::cos(angle), std::sin(angle), 0.5F, 1};
    const std::array<float, 4> color{0.15F + 0.1F * static_cast<float>(i & 1),
                                     0.15F + 0.1F * static_cast<float>(i >> 1 & 1),
                                     0.15F + 0.1F * static_cast<float>(i >> 2), 1};
    gl.Lightfv(light, GL_POSITION, position.data());
    gl.Lightfv(light, GL_DIFFUSE, color.data());
    gl.Lightfv(light, GL_SPECULAR, color.data());
    gl.Lightf(light, GL_LINEAR_ATTENUATION, 0.5F);
    gl.Enable(light);
  }
}

// A glBegin a row of cells.
void draw_immediately(const Mesh& mesh) {
  constexpr size_t kRow = kLitCells * 6;
  for (size_t first = 0; first < mesh.indices.size(); first += kRow) {
    gl.Begin(GL_TRIANGLES);
    for (size_t i = first; i < first + kRow; ++i) {
      const Vertex& vertex = mesh.vertices[mesh.indices[i]];
      gl.Color4ubv(vertex.color.data());
      gl.Normal3fv(vertex.normal.data());
      gl.Vertex3fv(vertex.position.data());
    }
    gl.End();
  }
}

}  // namespace

Frame tri_10px(Screen screen) { return triangles_of(10, screen); }
Frame tri_100px(Screen screen) { return triangles_of(100, screen); }
Frame tri_1000px(Screen screen) { return triangles_of(1000, screen); }

Frame draw_terrain(int cells) {
  look_at_terrain();
  gl.Enable(GL_DEPTH_TEST);
  return draw_elements(std::make_shared<Mesh>(terrain(cells)), Arrays::position_color);
}

Frame mesh_indexed_1M(Screen) { return draw_terrain(708); }

Frame mesh_lit(Screen) {
  const auto mesh = use_lit_terrain();
  use_directional_light();
  return draw_elements(mesh, Arrays::position_color_normal);
}

Frame mesh_lit8(Screen) {
  const auto mesh = use_lit_terrain();
  use_eight_lights();
  return draw_elements(mesh, Arrays::position_color_normal);
}

Frame immediate_200k(Screen) {
  const auto mesh = use_lit_terrain();
  use_directional_light();
  return [mesh] {
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw_immediately(*mesh);
    gl.Finish();
  };
}

Frame dlist_200k(Screen) {
  const auto mesh = use_lit_terrain();
  use_directional_light();
  const GLuint list = gl.GenLists(1);
  gl.NewList(list, GL_COMPILE);
  draw_immediately(*mesh);
  gl.EndList();
  return [list] {
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.CallList(list);
    gl.Finish();
  };
}

}  // namespace halfspace::bench
