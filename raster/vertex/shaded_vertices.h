// What the vertex stage leaves for assembly and set-up: one record a vertex, only the attributes the state calls for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "raster/api/types.h"
#include "raster/vertex/clip_positions.h"

namespace halfspace::raster {

inline constexpr int kSubpixelBits = 8;                   // 16.8 fixed-point window coordinates
inline constexpr int kSubpixelScale = 1 << kSubpixelBits;
// Window coordinates are cut beyond this band only: [kGuardBandMin, kGuardBandMax) pixels. With it every edge
// vector fits 24 bits and every edge value of a 64x64 tile fits an int32 once the sub-pixel bits are dropped.
inline constexpr int kGuardBandMin = -8192;
inline constexpr int kGuardBandMax = 24576;

// Not within the band.
inline constexpr int32_t kNoPlace = -(1 << 24);

// Head of a record; `attribute_count` floats of VertexLayout follow it at once.
struct VertexHead {
  int32_t x, y;  // window position, 16.8, snapped: floor(v * 256 + 0.5); kNoPlace when the outcode says clip.
  double z;       // window depth in [0, 1], after the depth range
  double inv_w;   // 1 / clip-space w
  // What snapping took away, in 1/256 px, [-0.5, 0.5]: x + rest_x is where the vertex would be.
  float rest_x, rest_y;
};

// Which floats a record holds. Offsets count floats from the end of VertexHead; -1: not there.
struct VertexLayout {
  int attribute_count = 0;
  int color = -1;          // 4 floats: r, g, b, a, clamped to [0, 1]
  int tex_coord = -1;      // 2 floats s, t; or 3 floats s, t, q when `projective`
  bool projective = false;
  int fog = -1;            // 1 float: distance from the eye, |z_e|
  // Behind the attributes, and none of them: 4 floats, which back-facing polygons have in place of `color`.
  int back_color = -1;
  // Floats from each of these to what it leaves of a double; at the exact level of the transform axis only.
  int low = -1;
  bool coverage = false;   // fragments may cover their pixel in part: points, lines or polygons are smooth
  Color constant_color{1, 1, 1, 1};  // used (already clamped) when color == -1
  // Pixel rectangles: each fragment brings its own colour, and its own depth.
  bool given_color = false, given_depth = false;
  size_t stride() const { return sizeof(VertexHead) + ((size_t(float_count() * (low >= 0 ? 2 : 1)) * 4 + 7) & ~size_t{7}); }
  // Which float is attribute `a`, on a front- or back-facing polygon.
  int place(int a, bool back) const {
    return back && back_color >= 0 && a >= color && a < color + 4 ? back_color + a - color : a;
  }
  int float_count() const { return attribute_count + (back_color >= 0 ? 4 : 0); }
};

// Why a vertex may need more than a look: zero means inside the frustum, finite and w > 0.
enum Outcode : uint16_t {
  kOutLeft = 1, kOutRight = 2, kOutBottom = 4, kOutTop = 8,  // frustum in x and y: reject only, never cut
  kOutNear = 16, kOutFar = 32,
  kOutGuardLeft = 64, kOutGuardRight = 128, kOutGuardBottom = 256, kOutGuardTop = 512,
  kOutW = 1024,            // w <= 0 or so small that the divide is not to be trusted
  kOutNotFinite = 2048,    // NaN or infinity: every primitive of this vertex is dropped
  kOutCutMask = kOutNear | kOutFar | kOutGuardLeft | kOutGuardRight | kOutGuardBottom | kOutGuardTop | kOutW,
};

// All vertices of one draw. Records are contiguous so that set-up can index them; clip coordinates and
// outcodes are needed, and valid, only until assembly is done.
struct ShadedVertices {
  VertexLayout layout;
  std::byte* records = nullptr;            // count * layout.stride() bytes, owned by the device's arena
  uint32_t count = 0;
  std::vector<uint16_t> outcodes;          // count
  ClipPositions clip;
  const VertexHead& head(uint32_t i) const {
    return *reinterpret_cast<const VertexHead*>(records + i * layout.stride());
  }
  const float* attributes(uint32_t i) const {
    return reinterpret_cast<const float*>(records + i * layout.stride() + sizeof(VertexHead));
  }
  // The float at `place`, and what it leaves.
  double attribute(uint32_t i, int place) const {
    const float* a = attributes(i);
    return layout.low < 0 ? double(a[place]) : double(a[place]) + double(a[place + layout.low]);
  }
};

}  // namespace halfspace::raster
