// Small meshes. Lighting is off in every scene, so what shading there is lies in the vertex colours.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "ref_app/gapi.h"

namespace ref_app {

// Towards the light, unit length, in world space: y up.
glm::vec3 light_direction();

// Square base of side 2 at y = -1, apex at y = 1. Colours: the apex, then the base's corners.
Geometry make_pyramid(const std::array<glm::vec3, 5>& colors);
// Side 2 about the origin. Colours of the faces +x -x +y -y +z -z; every face carries the whole texture.
Geometry make_cube(const std::array<glm::vec3, 6>& colors);
// The cube's faces in grey, as the light falls on them.
std::array<glm::vec3, 6> shaded_faces();

struct Plane {
  float half_size = 1;  // it spans [-half_size, half_size] in x and z, at y = 0
  float repeats = 1;    // how often the texture repeats along a side
  int divisions = 1;    // quads along a side
};
// White, two triangles a quad.
Geometry make_plane(const Plane& plane);
// A soft round shadow: vertices within `radius` of (x, z) darken towards `darkest` in the middle.
void darken(Geometry& plane, float x, float z, float radius, float darkest);

}  // namespace ref_app
