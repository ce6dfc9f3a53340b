// What a scene asks of a renderer, kept instead of drawn.
#pragma once

#include <map>
#include <vector>

#include "ref_app/gapi.h"

namespace halfspace::differential {

struct Recording {
  struct Draw {
    ref_app::PipelineState state;
    ref_app::Geometry geometry;
  };
  int width = 0, height = 0;
  ref_app::Pass pass;
  std::vector<Draw> draws;
  std::map<ref_app::ImageHandle, ref_app::Image> images;

  // The image a draw is textured with; null when texturing is off, also for want of an image (spec 3.8.8).
  const ref_app::Image* image_of(const Draw& draw) const;
};

// The first frame of a scene, 1 .. 8, at rest.
Recording record_scene(int number, int width, int height);

// Corners of a primitive, three or four, in the geometry's vertices.
struct PrimitiveCorners {
  int count = 0;
  uint32_t vertex[4] = {};
};
size_t primitive_count(const ref_app::Geometry& geometry);
PrimitiveCorners primitive_at(const ref_app::Geometry& geometry, size_t index);

}  // namespace halfspace::differential
