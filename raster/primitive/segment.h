// What assembly leaves for the tiles: references to primitives, binned. Set-up (edges and planes) is done by the
// tile's worker, eight primitives at once, so a primitive costs 16 bytes here and set-up runs on all threads.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "raster/api/draw_packet.h"
#include "raster/primitive/packet_bins.h"
#include "raster/primitive/shape_plan.h"
#include "raster/vertex/shaded_vertices.h"

namespace halfspace::raster {

inline constexpr int kTileSize = 64;    // pixels a side
inline constexpr int kBlockSize = 8;    // pixels a side; a tile has 8x8 blocks of 64 pixels
inline constexpr int kMaxPlanes = 10;   // depth, 1/w, then up to 8 attributes

// f(x, y) = f0 + dfdx * (x - x0) + dfdy * (y - y0), x and y in pixels at pixel centres.
struct Plane {
  double f0, dfdx, dfdy;
};

// Attribute planes of a triangle that was cut, from the whole (uncut) triangle in homogeneous coordinates,
// all relative to one anchor (x0, y0) in 16.8. Planes: [0] depth in [0,1], [1] 1/w, [2 + i] attribute i / w.
// Settled they are those of a piece, as SetupBatch has them (raster/tile/settled_planes.h).
struct alignas(64) PlaneSource {
  PlaneSource() {}     // lists of them grow without being cleared
  int32_t x[3], y[3];  // corners of the piece, where they are settled
  int32_t x0, y0;
  uint32_t provoking;  // vertex that gives the flat colour
  uint8_t variant;     // where they are settled, as in SetupBatch
  Plane planes[kMaxPlanes];
};

// A triangle of a cut polygon: its own corners. Lines have two corners, points one.
struct CutTriangle {
  int32_t x[3], y[3];  // 16.8, counter-clockwise or clockwise as the source was
  uint32_t source;     // index of its PlaneSource, which is settled in a segment
};

// A smooth triangle makes a fragment wherever it touches a pixel. A run is of points or lines
// on one tile that are packets: v[0] is its index in the segment's `packets`.
enum class PrimitiveKind : uint8_t { triangle, smooth_triangle, line, point, point_run, line_run };

struct PrimitiveRef {
  // Vertices of the draw, in submission order; the edge of a polygon has the polygon's provoking vertex last. Cut:
  // v[0] indexes cut_triangles, v[2] their plane_sources, and of a stippled line v[1] is where its stipple starts.
  uint32_t v[3];
  PrimitiveKind kind;
  bool cut;
  bool back_facing;
  uint8_t provoking;      // 0..2: which of v gives the flat colour
};
static_assert(sizeof(PrimitiveRef) == 16);

struct PipelineProgram;  // raster/fragment/program.h
struct PixelImage;       // raster/primitive/pixel_rect.h

// A draw as the tiles see it. Lives until the pass is finished.
struct DrawRecord {
  std::shared_ptr<const DrawState> state;
  ShadedVertices vertices;
  Rect bounds;  // framebuffer cut by scissor and viewport; fragments outside are never made
  Rect window;  // framebuffer cut by scissor: where points and lines may reach that are wider than a pixel
  const PipelineProgram* program = nullptr;  // what its fragments go through
  ShapePlan shape;
  // Until the draw is assembled: signed distances from the user clip planes, kMaxClipPlanes a vertex, and which of the
  // planes in use the vertex lies outside of (null: none is in use); the batch's edge flags.
  const double* clip_distances = nullptr;
  const uint8_t* clip_codes = nullptr;
  const uint8_t* edge_flags = nullptr;
  uint32_t first_vertex = 0;   // what its indices name that vertex by which is the first one here
  uint32_t stipple_start = 0;  // where the first line's stipple starts
  bool runs_points = false;  // its points are binned as runs
  bool runs_lines = false;   // its lines are, as far as they are not cut and floats will do
  // What vertices are made from, until the draw is assembled, where runs are all that they are for. Of points
  // there are no records; of lines, those that somebody else asks for are made then, at `unshaded`.
  const VertexBatch* given_vertices = nullptr;
  ShadedVertices* unshaded = nullptr;
  const PixelImage* image = nullptr;  // fragments come from it; there are no vertices
};

// Primitives of one stretch of the command stream, in order, with their bins. Filled by one thread at a time.
// A bin holds indices into `primitives`, ascending.
struct Segment {
  struct DrawStart {
    uint32_t first_primitive;
    const DrawRecord* draw;
  };
  std::vector<PrimitiveRef> primitives;
  std::vector<CutTriangle> cut_triangles;
  std::vector<PlaneSource> plane_sources;
  std::vector<DrawStart> draws;  // ascending first_primitive
  std::vector<std::vector<uint32_t>> bins;  // tiles_x * tiles_y, row by row from the bottom
  std::vector<uint32_t> touched;            // tiles whose bin is not empty
  PacketBins packets;
  size_t packet_bytes = 0;
  bool refers_to_vertices = false;  // of the last draw whose lines are packets: some are not
  int tiles_x = 0, tiles_y = 0;
  uint32_t stipple_end = 0;  // where the stipple of a line strip stands after the last draw
  uint64_t triangles_in = 0, culled = 0, clipped = 0;  // statistics

  void reset(int new_tiles_x, int new_tiles_y) {
    if (new_tiles_x != tiles_x || new_tiles_y != tiles_y) {
      bins.clear();
      bins.resize(size_t(new_tiles_x) * size_t(new_tiles_y));
      tiles_x = new_tiles_x;
      tiles_y = new_tiles_y;
    } else {
      for (uint32_t t : touched) bins[t].clear();
    }
    touched.clear();
    packets.clear();
    primitives.clear();
    cut_triangles.clear();
    plane_sources.clear();
    draws.clear();
    packet_bytes = 0;
    triangles_in = culled = clipped = 0;
  }
};

}  // namespace halfspace::raster
