// Triangles that are cut, eight at once: what the near or the far plane leaves of them, and the planes of
// their attributes. What the other planes cut, or more than one, is Clipper::clip_triangle's.
#pragma once

#include <cstdint>

#include "raster/primitive/clip_planes.h"
#include "raster/primitive/segment.h"

namespace halfspace::raster {

inline constexpr uint32_t kCutLanes = 8;

// Whether of the planes that cut triangles there is only near or far among the outcodes. What either leaves
// normally has a w that is large enough.
constexpr bool crosses_depth_alone(unsigned outcodes) {
  const unsigned planes = outcodes & kOutCutMask & ~unsigned{kOutW};
  return planes == kOutNear || planes == kOutFar;
}

// Corners of triangles, and what is left of them.
struct DepthCut {
  uint32_t count;            // at most kCutLanes; all cross one of both planes alone
  uint32_t v[kCutLanes][3];  // vertices
  const ClipVertex* clip[kCutLanes];  // three each
  bool far[kCutLanes];       // it is the far plane
  // Bits of those that are left to Clipper: their w is too small, or snapping has bent what is left.
  uint32_t not_cut;
  // Of the others: four corners to be fanned from the first, which is the lowest; two are the same where
  // there are three. Twice the signed area, 16.8 squared; without one, nothing is left.
  alignas(64) double area[kCutLanes];
  alignas(64) int32_t x[4][kCutLanes], y[4][kCutLanes];  // 16.8
  uint32_t has_piece[2];  // bits of those whose first or second triangle of the fan has an area
};

// Triangles as their vertices say, whether they face away, and the anchors of their planes, 16.8.
struct PlaneJob {
  uint32_t count;  // at most kCutLanes
  uint32_t v[kCutLanes][3];
  const ClipVertex* clip[kCutLanes];  // three each
  bool back[kCutLanes];
  int32_t anchor_x[kCutLanes], anchor_y[kCutLanes];
  uint32_t usable;                // bits of those whose planes are finite
  PlaneSource planes[kCutLanes];  // but for what provokes
};

struct TriangleCutFunctions {
  void (*cut_at_depth)(const ShadedVertices& vertices, const WindowTransform& window, DepthCut& cut);
  void (*make_planes)(const ShadedVertices& vertices, const WindowTransform& window, PlaneJob& job);
};
TriangleCutFunctions triangle_cut_functions();

}  // namespace halfspace::raster
