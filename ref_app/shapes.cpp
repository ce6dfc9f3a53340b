#include "ref_app/shapes.h"

#include <glm/geometric.hpp>

#include "ref_app/noise.h"

namespace ref_app {
namespace {

void add_quad(Geometry& mesh, const std::array<glm::vec3, 4>& corners, const glm::vec3& color) {
  static constexpr std::array<glm::vec2, 4> kTexCoords{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  const auto base = static_cast<uint32_t>(mesh.vertices.size());
  for (size_t i = 0; i < 4; ++i) mesh.vertices.push_back({{corners[i], 1.0F}, {color, 1.0F}, kTexCoords[i]});
  for (const uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(base + i);
}

struct CubeFace {
  glm::vec3 normal, right, up;
};
constexpr std::array<CubeFace, 6> kCubeFaces{{
    {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
    {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
    {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}},
    {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
    {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},
    {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}},
}};

}  // namespace

glm::vec3 light_direction() { return glm::normalize(glm::vec3(0.45F, 0.80F, 0.55F)); }

Geometry make_pyramid(const std::array<glm::vec3, 5>& colors) {
  Geometry mesh;
  mesh.vertices = {
      {{0, 1, 0, 1}, {colors[0], 1.0F}, {0.5F, 1.0F}}, {{-1, -1, 1, 1}, {colors[1], 1.0F}, {0, 0}},
      {{1, -1, 1, 1}, {colors[2], 1.0F}, {1, 0}},      {{1, -1, -1, 1}, {colors[3], 1.0F}, {0, 0}},
      {{-1, -1, -1, 1}, {colors[4], 1.0F}, {1, 0}},
  };
  mesh.indices = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1, 1, 4, 3, 1, 3, 2};
  return mesh;
}

Geometry make_cube(const std::array<glm::vec3, 6>& colors) {
  Geometry mesh;
  for (size_t i = 0; i < kCubeFaces.size(); ++i) {
    const CubeFace& f = kCubeFaces[i];
    add_quad(mesh,
             {f.normal - f.right - f.up, f.normal + f.right - f.up, f.normal + f.right + f.up,
              f.normal - f.right + f.up},
             colors[i]);
  }
  return mesh;
}

std::array<glm::vec3, 6> shaded_faces() {
  std::array<glm::vec3, 6> shades{};
  for (size_t i = 0; i < shades.size(); ++i) {
    const float toward_light = glm::dot(kCubeFaces[i].normal, light_direction());
    shades[i] = glm::vec3(0.62F + (toward_light > 0 ? 0.45F : 0.30F) * toward_light);
    const auto level = static_cast<int>(clamp_unit(shades[i].r) * 255.0F + 0.5F);
    shades[i] = levels(level, level, level);
  }
  return shades;
}

Geometry make_plane(const Plane& plane) {
  Geometry mesh;
  const auto n = static_cast<uint32_t>(plane.divisions);
  for (uint32_t row = 0; row <= n; ++row) {
    for (uint32_t column = 0; column <= n; ++column) {
      const float u = static_cast<float>(column) / static_cast<float>(n);
      const float v = static_cast<float>(row) / static_cast<float>(n);
      mesh.vertices.push_back({{plane.half_size * (2 * u - 1), 0.0F, plane.half_size * (1 - 2 * v), 1.0F},
                               glm::vec4(1.0F),
                               {u * plane.repeats, v * plane.repeats}});
    }
  }
  for (uint32_t row = 0; row < n; ++row) {
    for (uint32_t column = 0; column < n; ++column) {
      const uint32_t i = row * (n + 1) + column;
      for (const uint32_t k : {i, i + 1, i + n + 2, i, i + n + 2, i + n + 1}) mesh.indices.push_back(k);
    }
  }
  return mesh;
}

void darken(Geometry& plane, float x, float z, float radius, float darkest) {
  for (Vertex& vertex : plane.vertices) {
    const float distance = glm::length(glm::vec2(vertex.position.x - x, vertex.position.z - z));
    const float shade = mix(darkest, 1.0F, smooth_step(0.0F, radius, distance));
    vertex.color = {glm::vec3(vertex.color) * shade, 1.0F};
  }
}

}  // namespace ref_app
