// Martin Newell's teapot (University of Utah, 1975).
#pragma once

#include <glm/vec3.hpp>

#include "ref_app/gapi.h"

namespace ref_app {

inline constexpr int kTeapotTriangles = 4096;  // 32 patches of 8 x 8 quads

struct TeapotLook {
  glm::vec3 color{1.0F};
  glm::vec3 light{0, 1, 0};  // towards the light, unit length, in the teapot's own space
  glm::vec3 eye{0, 0, 1};    // towards the viewer, likewise; only the highlight asks
};

// The look's colour as it appears where the surface's unit normal is `normal`.
glm::vec3 baked_color(const TeapotLook& look, const glm::vec3& normal);

// Stands on y = 0, its axis the y axis, the spout towards +x; 3.15 high, 6.5 from handle to spout.
// The light is baked into the vertex colours. Texture coordinates run from 0 to 1 over each patch.
Geometry make_teapot(const TeapotLook& look);

}  // namespace ref_app
