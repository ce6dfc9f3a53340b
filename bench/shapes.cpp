#include "bench/shapes.h"

#include <cmath>

#include "bench/gl.h"

namespace halfspace::bench {
namespace {

float height_at(float x, float y) {
  return 0.06F * std::sin(5 * x + 1) * std::cos(4 * y) + 0.04F * std::sin(13 * x - 7 * y) +
         0.02F * std::sin(31 * y + 3 * x);
}

std::array<float, 3> normal_at(float x, float y) {
  constexpr float kStep = 1e-3F;
  const float dx = (height_at(x + kStep, y) - height_at(x - kStep, y)) / (2 * kStep);
  const float dy = (height_at(x, y + kStep) - height_at(x, y - kStep)) / (2 * kStep);
  const float length = std::sqrt(dx * dx + dy * dy + 1);
  return {-dx / length, -dy / length, 1 / length};
}

std::array<uint8_t, 4> terrain_color(float height, Numbers& numbers) {
  const float level = (height + 0.12F) / 0.24F;
  const float noise = numbers.between(-12, 12);
  const auto byte = [noise](float value) {
    return static_cast<uint8_t>(std::min(255.0F, std::max(0.0F, value + noise)));
  };
  return {byte(60 + 150 * level), byte(150 - 30 * level), byte(70 + 90 * level), 255};
}

using Texels = std::vector<std::array<uint8_t, 4>>;

Texels make_texels(int size, uint64_t seed) {
  Numbers numbers(seed);
  const std::array<uint8_t, 4> dark = random_color(numbers), light = random_color(numbers);
  Texels texels(static_cast<size_t>(size) * static_cast<size_t>(size));
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const bool check = ((x * 8 / size) ^ (y * 8 / size)) & 1;
      std::array<uint8_t, 4>& texel = texels[static_cast<size_t>(y * size + x)];
      texel = check ? dark : light;
      texel[1] = static_cast<uint8_t>(255 * x / size);
      texel[3] = static_cast<uint8_t>(64 + 191 * y / size);
    }
  return texels;
}

Texels half_of(const Texels& texels, int size) {
  const int half = size / 2;
  Texels smaller(static_cast<size_t>(half) * static_cast<size_t>(half));
  const auto at = [&](int x, int y, size_t channel) {
    return static_cast<int>(texels[static_cast<size_t>(y * size + x)][channel]);
  };
  for (int y = 0; y < half; ++y)
    for (int x = 0; x < half; ++x)
      for (size_t c = 0; c < 4; ++c)
        smaller[static_cast<size_t>(y * half + x)][c] =
            static_cast<uint8_t>((at(2 * x, 2 * y, c) + at(2 * x + 1, 2 * y, c) + at(2 * x, 2 * y + 1, c) +
                                  at(2 * x + 1, 2 * y + 1, c) + 2) /
                                 4);
  return smaller;
}

}  // namespace

uint64_t Numbers::bits() {
  uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

float Numbers::between(float low, float high) {
  return low + (high - low) * static_cast<float>(bits() >> 40) * 0x1p-24F;
}

PlanarColor::PlanarColor(Numbers& numbers) {
  for (size_t channel = 0; channel < 3; ++channel) {
    middle_[channel] = numbers.between(0.4F, 0.6F);
    across_[channel] = numbers.between(-0.2F, 0.2F);
    up_[channel] = numbers.between(-0.2F, 0.2F);
  }
}

std::array<float, 3> PlanarColor::at(float x, float y) const {
  std::array<float, 3> color{};
  for (size_t channel = 0; channel < 3; ++channel)
    color[channel] = middle_[channel] + across_[channel] * x + up_[channel] * y;
  return color;
}

std::array<uint8_t, 4> random_color(Numbers& numbers, uint8_t alpha) {
  const uint64_t bits = numbers.bits();
  return {static_cast<uint8_t>(bits), static_cast<uint8_t>(bits >> 8), static_cast<uint8_t>(bits >> 16),
          alpha};
}

void use_arrays(const std::vector<Vertex>& vertices, Arrays arrays) {
  gl.EnableClientState(GL_VERTEX_ARRAY);
  gl.VertexPointer(3, GL_FLOAT, sizeof(Vertex), vertices[0].position.data());
  gl.EnableClientState(GL_COLOR_ARRAY);
  gl.ColorPointer(4, GL_UNSIGNED_BYTE, sizeof(Vertex), vertices[0].color.data());
  if (arrays == Arrays::position_color) return;
  gl.EnableClientState(GL_NORMAL_ARRAY);
  gl.NormalPointer(GL_FLOAT, sizeof(Vertex), vertices[0].normal.data());
}

Mesh terrain(int cells) {
  Mesh mesh;
  Numbers numbers(1);
  const auto side = static_cast<GLuint>(cells + 1);
  // No more than is needed, and nothing left behind that a library's memory could hide in.
  mesh.vertices.reserve(static_cast<size_t>(side) * side);
  mesh.indices.reserve(static_cast<size_t>(cells) * static_cast<size_t>(cells) * 6);
  for (GLuint row = 0; row < side; ++row)
    for (GLuint column = 0; column < side; ++column) {
      const float x = 2 * static_cast<float>(column) / static_cast<float>(cells) - 1;
      const float y = 2 * static_cast<float>(row) / static_cast<float>(cells) - 1;
      const float z = height_at(x, y);
      mesh.vertices.push_back({{x, y, z}, terrain_color(z, numbers), normal_at(x, y)});
    }
  for (GLuint row = 0; row + 1 < side; ++row)
    for (GLuint column = 0; column + 1 < side; ++column) {
      const GLuint a = row * side + column, b = a + 1, c = a + side, d = c + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
    }
  return mesh;
}

void look_at_terrain() {
  gl.MatrixMode(GL_PROJECTION);
  gl.LoadIdentity();
  gl.Frustum(-0.5, 0.5, -0.5, 0.5, 1, 10);
  gl.MatrixMode(GL_MODELVIEW);
  gl.LoadIdentity();
  gl.Translatef(0, 0, -2);
  gl.Rotatef(-30, 1, 0, 0);
}

GLuint make_texture(int size, uint64_t seed, bool mipmaps) {
  static GLuint last_name = 0;
  const GLuint name = ++last_name;
  gl.BindTexture(GL_TEXTURE_2D, name);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, mipmaps ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, mipmaps ? GL_LINEAR : GL_NEAREST);
  Texels texels = make_texels(size, seed);
  for (int level = 0;; ++level) {
    gl.TexImage2D(GL_TEXTURE_2D, level, GL_RGBA, size, size, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
    if (!mipmaps || size == 1) return name;
    texels = half_of(texels, size);
    size /= 2;
  }
}

void use_pixel_coordinates(Screen screen) {
  gl.MatrixMode(GL_PROJECTION);
  gl.LoadIdentity();
  gl.Ortho(0, screen.width, 0, screen.height, -1, 1);
  gl.MatrixMode(GL_MODELVIEW);
  gl.LoadIdentity();
}

}  // namespace halfspace::bench
