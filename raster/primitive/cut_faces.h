// The triangles of a draw that are cut, some at a time, since vectors cut several in the time of one.
#pragma once

#include <cstdint>

#include "raster/primitive/clip.h"
#include "raster/primitive/segment.h"
#include "raster/primitive/triangle_cut.h"

namespace halfspace::raster {

// Which way triangles face, by the sign of their area, and which are dropped.
struct FacingRule {
  explicit FacingRule(const RasterState& raster)
      : front_is_ccw(raster.front_is_ccw),
        cull_ccw(front_is_ccw ? raster.cull_front : raster.cull_back),
        cull_cw(front_is_ccw ? raster.cull_back : raster.cull_front) {}
  bool is_back(int64_t area) const { return (area > 0) != front_is_ccw; }
  bool is_culled(int64_t area) const { return area > 0 ? cull_ccw : area < 0 ? cull_cw : true; }

  bool front_is_ccw, cull_ccw, cull_cw;
};

class CutFaces {
 public:
  static constexpr uint32_t kMost = 128;

  // What is left of a triangle: some of the segment's cut_triangles.
  struct Pieces {
    uint32_t first, count;
    bool back;
  };

  CutFaces(const DrawRecord& draw, const Clipper& clipper, const FacingRule& facing, Segment& segment);

  // `outcodes`: the union of those of the vertices.
  void add(const uint32_t* v, unsigned outcodes, uint8_t provoking);
  // Cuts all that were added since they were last asked for.
  void cut();
  // Of the first triangle that was not asked for, in the order they were added.
  const Pieces& next() { return faces_[asked_++].pieces; }

 private:
  struct Face {
    uint32_t v[3];
    ClipVertex clip[3];
    unsigned outcodes;
    uint32_t provoking;
    Pieces pieces;
  };

  void cut_at_depth(const uint32_t* faces, uint32_t count);
  void cut_by_all(uint32_t face);
  void take(uint32_t face, int64_t area, int32_t anchor_x, int32_t anchor_y);
  void add_piece(uint32_t face, const CutTriangle& piece);
  void make_planes();

  const DrawRecord& draw_;
  const Clipper& clipper_;
  const FacingRule& facing_;
  Segment& segment_;
  const WindowTransform window_;
  const TriangleCutFunctions functions_ = triangle_cut_functions();
  uint32_t count_ = 0, asked_ = 0;
  Face faces_[kMost];
  // Of those whose planes are to be made.
  PlaneJob job_;
  uint32_t of_job_[kCutLanes];
};

}  // namespace halfspace::raster
