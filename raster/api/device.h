// The renderer: begin a pass on a framebuffer, clear and draw, end it. Work is binned and done when someone
// looks.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "raster/api/draw_packet.h"
#include "raster/api/feedback.h"
#include "raster/api/framebuffer.h"
#include "raster/api/pixel_packet.h"

namespace halfspace::raster {

struct ClearCommand {
  bool color = false, depth = false, stencil = false, accum = false;
  uint8_t color_targets = kBackPlane;  // bits of ColorPlane
  Color color_value;                   // clamped to [0, 1] for rgba8
  double depth_value = 1;              // in [0, 1]
  ColorMask color_mask;
  bool depth_write = true;
  uint8_t stencil_value = 0, stencil_mask = 0xff;
  Color accum_value;  // in [-1, 1]
  bool scissor_test = false;
  Rect scissor;
};

// glAccum (spec 4.2.4); values are kept in 16-bit signed fixed point, 32767 is 1.0.
enum class AccumOp : uint8_t { accum, load, return_, mult, add };
struct AccumCommand {
  AccumOp op = AccumOp::accum;
  float value = 0;
  ColorPlane read_plane = kBackPlane;  // accum, load: where colours come from
  uint8_t color_targets = kBackPlane;  // return_: where they go, under the mask
  ColorMask color_mask;
  bool scissor_test = false;
  Rect scissor;
};

// What the vertex stage makes of one vertex (glRasterPos, spec 2.13).
struct ShadedPoint {
  bool valid = false;                  // false: clipped, and the rest is undefined
  double x = 0, y = 0, z = 0, w = 1;   // window coordinates, depth in [0, 1]; clip-space w
  double eye_distance = 0;             // |z_e|
  Color color;                         // lit if lighting is on, clamped
  double tex_coord[4] = {0, 0, 0, 1};  // s t r q, generated and through the texture matrix
};

// What a stage of the fragment programs did: raster/fragment/stages.def has the names.
struct StageCount {
  std::string_view name;
  uint64_t fragments = 0;    // that were alive when it began
  uint64_t nanoseconds = 0;  // over all threads
};

// Counters since creation.
struct DeviceStatistics {
  uint64_t draws = 0, vertices = 0, triangles = 0, culled = 0, clipped = 0, passes = 0;
  uint64_t fragments = 0;         // lanes that reached a fragment program
  uint64_t double_fragments = 0;  // of these, interpolated in double
  // Only where stages are metered: what ran, in the order of stages.def, and the time of the vertex stage.
  std::vector<StageCount> stages;
  uint64_t vertex_nanoseconds = 0;
  uint64_t lit_vertices = 0, generated_vertices = 0;  // of `vertices`: with lighting, with texture coordinate generation
};

struct DeviceOptions {
  int threads = 0;   // 0: HALFSPACE_THREADS, or else all cores
  // Counts what each stage does, with every stage alone; or HALFSPACE_STATS=1, which also prints the counts of each
  // picture that is shown, on stderr.
  bool meter = false;
  bool fuse = true;  // false, or HALFSPACE_FUSE=0: every stage runs alone. The same bytes, slower
};

// Not thread-safe; one Device a context. Any call may throw std::bad_alloc; what was drawn before stands.
class Device {
 public:
  explicit Device(const DeviceOptions& options = {});
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  // Draws and clears go to `target` from now on. Work pending for another target is finished first.
  // The framebuffer must outlive its pass; null ends the pass.
  void begin_pass(Framebuffer* target);
  void clear(const ClearCommand& command);
  void draw(const DrawPacket& packet);
  void draw_pixels(const PixelPacket& packet);
  void accumulate(const AccumCommand& command);

  // Vertex 0 of the batch alone. Draws nothing.
  ShadedPoint shade_point(const DrawState& state, const VertexBatch& batch);
  // Takes the packet through the vertex stage, clipping, culling and the polygon mode, and no further.
  void feedback(const DrawPacket& packet, FeedbackSink& sink);

  // Executes all pending work. With `image`, also converts the picture to it, tile by tile while it is hot.
  void finish(const LinearImage* image = nullptr, ColorPlane plane = kBackPlane);

  // Reads pixels of the current target (finishing first). `out`: row 0 is the lowest row of `rect`, rows
  // packed. Pixels of `rect` outside the framebuffer are left as they are. read_color: 4 bytes a pixel, R, G,
  // B, A (float framebuffers are clamped and rounded).
  void read_color(const Rect& rect, uint8_t* out, ColorPlane plane = kBackPlane);
  // 4 floats a pixel; for rgba8, c / 255.
  void read_color_float(const Rect& rect, float* out, ColorPlane plane = kBackPlane);
  // Depth as unsigned 24-bit integers, 0 .. 2^24 - 1.
  void read_depth(const Rect& rect, uint32_t* out);
  void read_stencil(const Rect& rect, uint8_t* out);

  // Copies pixels from one colour plane of the current target to the other (finishing first).
  void copy_plane(ColorPlane from, ColorPlane to, const Rect& rect);

  const DeviceStatistics& statistics() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The instruction set in use: "scalar", "sse4", "avx2", "avx512" or "neon". Chosen once, by the CPU or by
// HALFSPACE_ISA; a level this machine lacks falls to the next lower one.
std::string_view isa_name();
// All levels this machine and this build have, lowest first, separated by spaces.
std::string_view isa_available();
// For tests: force a level; returns false (and changes nothing) when it is not available.
bool set_isa(std::string_view name);

}  // namespace halfspace::raster
