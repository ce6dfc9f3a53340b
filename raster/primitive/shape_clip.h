// Clipping where polygons are not simply filled, or lines and points not one pixel wide: what is cut keeps
// all that is interpolated, and polygons keep their edge flags.
#pragma once

#include <vector>

#include "raster/primitive/clip_planes.h"
#include "raster/primitive/segment.h"

namespace halfspace::raster {

// A point of a primitive on its way through the clipper.
struct ShapeVertex {
  ClipVertex clip;
  double user[kMaxClipPlanes];   // distances from the user planes
  double value[kMaxPlanes - 2];  // attributes
  int64_t original;              // the vertex it is, or -1 when it was made by a cut
  bool edge;                     // of a polygon: the edge that starts here is drawn
};

// Vertex v of the draw; `back`: of a polygon that faces away.
ShapeVertex shape_vertex(const DrawRecord& draw, uint32_t v, bool back);

// Cuts a convex polygon by those of the user planes that `codes` names. An edge made by a cut is drawn, and
// what is left of an edge keeps its flag (spec 2.11). `scratch` is used on the way.
void cut_by_user_planes(unsigned codes, std::vector<ShapeVertex>& polygon, std::vector<ShapeVertex>& scratch);

// And by the planes of the view volume that `codes` names. What they make is no edge of the polygon: HACKING,
// "Rules of the picture".
void cut_by_view_volume(const WindowTransform& window, unsigned codes, std::vector<ShapeVertex>& polygon,
                        std::vector<ShapeVertex>& scratch);

// Cuts a line by the planes that `codes` names: near, far, w, guard band, user planes; `sides`: those of the
// view volume too. False: nothing is left.
bool cut_shape_line(const WindowTransform& window, unsigned codes, bool sides, ShapeVertex (&ends)[2]);

// Where the vertex lies in the window, 16.8. One of the draw's own keeps the place the vertex stage gave it.
void place_vertex(const DrawRecord& draw, const WindowTransform& window, const ShapeVertex& vertex,
                  int32_t& x, int32_t& y);

// Planes of a line from out.x[0] to out.x[1]. `along_major`: values depend on the place along the longer axis
// alone, so that replicated fragments are alike; else on the place along the line (spec 3.4.1). `offset` is
// added to depth. False: some value is not finite.
bool line_planes(const DrawRecord& draw, const WindowTransform& window, const ShapeVertex (&ends)[2],
                 bool along_major, double offset, const CutTriangle& line, PlaneSource& out);

// Planes of a point: constants.
bool point_planes(const DrawRecord& draw, const WindowTransform& window, const ShapeVertex& vertex,
                  double offset, const CutTriangle& point, PlaneSource& out);

}  // namespace halfspace::raster
