// What the workloads draw with: vertices, meshes, textures and numbers, the same on every run.
#pragma once

#include <GL/gl.h>

#include <array>
#include <cstdint>
#include <vector>

#include "bench/library.h"

namespace halfspace::bench {

// Numbers of a fixed sequence (splitmix64); std's distributions differ between libraries.
class Numbers {
 public:
  explicit Numbers(uint64_t seed) : state_(seed) {}
  uint64_t bits();
  // Evenly from [low, high).
  float between(float low, float high);

 private:
  uint64_t state_;
};

struct Vertex {
  std::array<float, 3> position;
  std::array<uint8_t, 4> color;
  std::array<float, 3> normal;
};

struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<GLuint> indices;  // of triangles
};

// A colour that is an affine function of position: a quad looks the same whichever way it is split, which GL
// leaves open (2.6.1).
class PlanarColor {
 public:
  explicit PlanarColor(Numbers& numbers);
  // x and y from -1 to 1.
  std::array<float, 3> at(float x, float y) const;

 private:
  std::array<float, 3> middle_, across_, up_;
};

std::array<uint8_t, 4> random_color(Numbers& numbers, uint8_t alpha = 255);

// Points client arrays at the vertices, which have to stay where they are.
enum class Arrays { position_color, position_color_normal };
void use_arrays(const std::vector<Vertex>& vertices, Arrays arrays);

// A square of cells by cells, each two triangles, over [-1, 1] x [-1, 1]; hills in z of at most 0.15,
// colours, normals.
Mesh terrain(int cells);

// A look down on the terrain from a slant; it takes three quarters of the screen.
void look_at_terrain();

// Binds a new texture of size x size RGBA with edges, gradients and alpha 64 .. 255; all levels on request.
GLuint make_texture(int size, uint64_t seed, bool mipmaps);

// Modelview and projection such that x and y are in pixels from the lower left.
void use_pixel_coordinates(Screen screen);

}  // namespace halfspace::bench
