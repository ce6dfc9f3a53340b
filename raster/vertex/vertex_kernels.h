// Between the vertex stage and its per-ISA kernels: raw pointers and numbers only, since a template or inline
// function instantiated in per-ISA code might be the one the linker keeps for all.
#pragma once

#include <cstddef>
#include <cstdint>

#include "raster/primitive/point_packet.h"
#include "raster/vertex/end_columns.h"
#include "raster/vertex/lighting_job.h"
#include "raster/vertex/shaded_vertices.h"

namespace halfspace::raster {

struct StreamRef {
  const unsigned char* data;  // never null
  size_t stride;              // bytes
  int size;                   // floats, 1..4
  bool bytes;                 // four of 255ths instead
};

// Clip to window, with everything that does not change over a draw worked out once.
//   x_fixed = floor(x / w * scale_x + 0.5) + offset_x   (16.8)
//   depth   = z / w * depth_scale + depth_offset        ([0, 1])
// Snapping the part that depends on the vertex, then adding an integer, makes a picture independent of where
// the viewport lies, to the bit.
struct WindowTransform {
  double scale_x, scale_y;    // half the viewport, in 1/256 pixels
  double offset_x, offset_y;  // its centre, in 1/256 pixels: integers
  double depth_scale, depth_offset;
  double depth_low, depth_high;  // the depth range, ordered
  bool inside_guard;             // the whole viewport lies within the guard band
};

// Which coordinates are made, and from what (spec 2.11.4).
struct TexGenJob {
  enum Kind : uint8_t { kGiven, kPlane, kSphere };
  bool any = false, sphere = false;
  Kind kind[4];        // s, t, r, q
  double plane[4][4];  // on object coordinates: eye planes are taken there
};

// What has no value here is set where it is looked at: a draw of four vertices should not have to clear it all.
struct ShadeJob {
  const double* m;  // clip_from_object, column-major
  WindowTransform window;
  const double* texture_matrix;
  bool use_texture_matrix;
  int tex_coord_count;  // floats stored: s t, s t q or s t r q
  TexGenJob tex_gen;
  StreamRef position, color, tex_coord;
  int color_offset, tex_coord_offset;  // bytes from the start of a record; -1: not there
  // What follows matters where its flag says so.
  bool needs_eye = false, needs_normal = false, normalize = false;
  const double* eye;       // eye_from_object
  float normal_matrix[9];  // column-major; of any length under `normalize`
  StreamRef normal;
  const LightingJob* lighting = nullptr;     // null: the vertex's own colour
  const uint32_t* material_index = nullptr;  // with lighting->materials
  int back_color_offset, fog_offset;
  unsigned char* records;
  size_t record_stride;
  uint16_t* outcodes;
};

// Where points of one pixel go.
struct PointJob {
  Rect bounds;  // in the framebuffer; points outside are not drawn
  int tiles_x;
  double depth_steps;  // the greatest depth; 0: nobody asks for depths
  PointKind kind;
  uint32_t constant_pixel;  // of all points, where their colours do not vary
  PacketBin* bins;     // of each tile
  void (*open_run)(void* owner, uint32_t tile);
  void* owner;
};

// w below this is behind the eye for all purposes: 1/w times any finite float still is a finite float's
// square.
inline constexpr double kMinW = 1e-30;
// Texture coordinates are bounded by this, so that no product with 1/w overflows a double.
inline constexpr float kMaxTexCoord = 1e30f;

struct VertexKernels {
  void (*shade)(const ShadeJob& job, uint32_t first, uint32_t count);
  void (*power)(const float* x, const float* s, float* out, size_t count, Level level);
  void (*place_points)(const ShadeJob& job, const PointJob& points, uint32_t first, uint32_t count);
  void (*shade_ends)(const ShadeJob& job, uint32_t first, uint32_t lines, EndColumns& out);
};

}  // namespace halfspace::raster
