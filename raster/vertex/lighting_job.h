// Lighting of one draw with everything worked out that no vertex changes. Plain numbers, for the per-ISA
// kernels.
#pragma once

#include <cstdint>

#include "raster/api/accuracy.h"
#include "raster/api/lighting.h"

namespace halfspace::raster {

struct LightTerm {
  bool local;       // has a position; otherwise it is too far away to be seen from elsewhere
  bool attenuated;  // by distance
  bool spot;
  bool ambient_varies;  // its ambient part is not in LightingJob::ambient
  double position[3];   // local: in eye coordinates
  float direction[3];   // not local: the unit vector to it
  float half[3];        // not local, and the viewer neither: the unit half vector
  float weight;         // not local: its attenuation
  float spot_direction[3];
  float spot_cosine, spot_exponent;
  float attenuation[3];  // constant, linear, quadratic
  float ambient[3], diffuse[3], specular[3];
};

struct MaterialTerms {
  float ambient[4], diffuse[4], specular[4], emission[4];  // r, g, b; diffuse: a too
  float shininess;
};

struct LightingJob {
  int light_count;
  LightTerm lights[kMaxLights];
  float ambient[3];  // what meets the material's ambient colour whatever the vertex
  bool local_viewer;
  bool two_sided;
  bool specular;   // some light and some material have a specular colour
  bool needs_eye;  // the vertices' eye coordinates
  bool tracks_color;
  Level power;  // of cosines
  MaterialTerms material[2];  // front, back
  LightingState::ColorMaterial tracked[2];
  const MaterialPair* materials;  // null: `material` for all
};

}  // namespace halfspace::raster
