// Lighting, materials and shading (spec 2.14).
#pragma once

#include <array>

#include "raster/api/lighting.h"
#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

struct MaterialState {
  float ambient[4] = {0.2f, 0.2f, 0.2f, 1};
  float diffuse[4] = {0.8f, 0.8f, 0.8f, 1};
  float specular[4] = {0, 0, 0, 1};
  float emission[4] = {0, 0, 0, 1};
  float shininess = 0;                 // 0 .. 128
  float color_indexes[3] = {0, 1, 1};  // ambient, diffuse, specular
};

// Spec table 6.10: the first light is white, the others are black.
inline std::array<raster::Light, raster::kMaxLights> initial_lights() {
  std::array<raster::Light, raster::kMaxLights> lights;
  lights[0].diffuse = lights[0].specular = {1, 1, 1, 1};
  return lights;
}

struct LightingState {
  GLenum shade_model = GL_SMOOTH;
  bool enabled = false;
  bool local_viewer = false, two_side = false;
  raster::Color model_ambient{0.2f, 0.2f, 0.2f, 1};
  std::array<raster::Light, raster::kMaxLights> lights = initial_lights();  // in eye coordinates
  // While colour material is on, what it replaces is not kept up to date here: settle_color_material.
  MaterialState material[2];  // front, back
  bool color_material = false;
  GLenum color_material_face = GL_FRONT_AND_BACK, color_material_mode = GL_AMBIENT_AND_DIFFUSE;
};

// While GL_COLOR_MATERIAL is on, some properties of the material are the current colour (spec 2.14.3). This
// gives them its value; to be called before they are read and before they stop following it.
void settle_color_material(Context& context);

// Both faces' materials as the raster room has them.
raster::MaterialPair material_pair(const LightingState& lighting);

}  // namespace halfspace::state
