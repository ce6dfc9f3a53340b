// Lighting (spec 2.14): what the vertex stage computes colours from. All positions, directions and half
// vectors are in eye coordinates.
#pragma once

#include <array>
#include <vector>

#include "raster/api/types.h"

namespace halfspace::raster {

inline constexpr int kMaxLights = 8;

struct Light {
  bool enabled = false;
  Color ambient{0, 0, 0, 1}, diffuse{0, 0, 0, 1}, specular{0, 0, 0, 1};
  std::array<double, 4> position{0, 0, 1, 0};  // w == 0: directional
  std::array<double, 3> spot_direction{0, 0, -1};
  float spot_exponent = 0;  // 0 .. 128
  float spot_cutoff = 180;   // degrees: 0 .. 90, or 180 for no spot
  double spot_cosine = -1;   // of the cutoff
  float constant_attenuation = 1, linear_attenuation = 0, quadratic_attenuation = 0;
};

struct Material {
  Color ambient{0.2f, 0.2f, 0.2f, 1}, diffuse{0.8f, 0.8f, 0.8f, 1}, specular{0, 0, 0, 1},
      emission{0, 0, 0, 1};
  float shininess = 0;  // 0 .. 128
  bool operator==(const Material&) const = default;
};

// A draw with several materials (glMaterial between Begin and End) says for each vertex which pair it has:
// VertexBatch::material_index into DrawPacket::materials.
struct MaterialPair {
  Material front, back;
  bool operator==(const MaterialPair&) const = default;
};

struct LightingState {
  bool enabled = false;
  bool local_viewer = false, two_sided = false;
  Color model_ambient{0.2f, 0.2f, 0.2f, 1};
  std::array<Light, kMaxLights> lights;
  MaterialPair material;  // for draws that bring no materials of their own
  // GL_COLOR_MATERIAL: the vertex's colour replaces these properties of the material.
  struct ColorMaterial {
    bool ambient = false, diffuse = false, specular = false, emission = false;
    bool any() const { return ambient || diffuse || specular || emission; }
  } color_material_front, color_material_back;
};

}  // namespace halfspace::raster
