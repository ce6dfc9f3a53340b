// Compiled once an ISA level. All arithmetic is IEEE double in a fixed order, so that the levels agree to the
// bit.
#include "raster/vertex/vertex_stage.h"

#include <cstring>

#include "raster/isa.h"
#include "raster/vertex/vertex_kernels.h"
#include "raster/vertex/window_transform.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/vertex/vertex_stage.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace halfspace::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::ScalableTag<double>;
using Vec = hn::Vec<Doubles>;
using Mask = hn::Mask<Doubles>;
using Words = hn::RebindToUnsigned<Doubles>;

// Vertices taken at once: their columns stay in L1. A multiple of every vector length.
constexpr uint32_t kGroup = 32;

struct alignas(64) Group {
  float position[4][kGroup];
  double z[kGroup], inv_w[kGroup];
  int32_t x[kGroup], y[kGroup];
  float rest_x[kGroup], rest_y[kGroup];
  uint64_t outcode[kGroup];
};

struct ClipVec {
  Vec x, y, z, w;
};

HWY_INLINE Vec row_times(const double* m, Vec x, Vec y, Vec z, Vec w) {
  const Doubles d;
  Vec sum = hn::Add(hn::Mul(hn::Set(d, m[0]), x), hn::Mul(hn::Set(d, m[4]), y));
  sum = hn::Add(sum, hn::Mul(hn::Set(d, m[8]), z));
  return hn::Add(sum, hn::Mul(hn::Set(d, m[12]), w));
}

// The bits of `code` where `mask`.
HWY_INLINE Vec code_if(Mask mask, uint64_t code) {
  const Doubles d;
  return hn::IfThenElseZero(mask, hn::BitCast(d, hn::Set(Words(), code)));
}

HWY_INLINE Vec frustum_codes(const ClipVec& c) {
  const Vec minus_w = hn::Neg(c.w);
  const Vec x = hn::Or(code_if(hn::Lt(c.x, minus_w), kOutLeft), code_if(hn::Gt(c.x, c.w), kOutRight));
  const Vec y = hn::Or(code_if(hn::Lt(c.y, minus_w), kOutBottom), code_if(hn::Gt(c.y, c.w), kOutTop));
  const Vec z = hn::Or(code_if(hn::Lt(c.z, minus_w), kOutNear), code_if(hn::Gt(c.z, c.w), kOutFar));
  return hn::Or(hn::Or(x, y), z);
}

// Window coordinates times w against the band times w: linear, so it holds for w <= 0 too and the clipper can
// rely on "no corner has the bit" meaning "no point has".
HWY_INLINE Vec guard_codes(Vec clip, Vec w, double scale, double offset, uint64_t low, uint64_t high) {
  const Doubles d;
  const Vec v = hn::Mul(clip, hn::Set(d, scale));
  const double low_edge = double(kGuardBandMin) * kSubpixelScale - offset;
  const double high_edge = double(kGuardBandMax) * kSubpixelScale - offset;
  return hn::Or(code_if(hn::Lt(v, hn::Mul(hn::Set(d, low_edge), w)), low),
                code_if(hn::Gt(v, hn::Mul(hn::Set(d, high_edge), w)), high));
}

HWY_INLINE Mask is_finite(Vec v) { return hn::Le(hn::Abs(v), hn::Set(Doubles(), 1.7976931348623157e308)); }

HWY_INLINE Vec outcodes(const ClipVec& c, const WindowTransform& t) {
  const Mask finite =
      hn::And(hn::And(is_finite(c.x), is_finite(c.y)), hn::And(is_finite(c.z), is_finite(c.w)));
  Vec code = frustum_codes(c);
  code = hn::Or(code, guard_codes(c.x, c.w, t.scale_x, t.offset_x, kOutGuardLeft, kOutGuardRight));
  code = hn::Or(code, guard_codes(c.y, c.w, t.scale_y, t.offset_y, kOutGuardBottom, kOutGuardTop));
  code = hn::Or(code, code_if(hn::Lt(c.w, hn::Set(Doubles(), kMinW)), kOutW));
  return hn::IfThenElse(finite, code, code_if(hn::Not(finite), kOutNotFinite));
}

// x / w, not x * (1 / w): correctly rounded, so that a vertex meant to lie on the grid does.
HWY_INLINE void store_fixed(Vec clip, Vec w, Mask usable, double scale, double offset, int32_t* out,
                            float* rest) {
  const Doubles d;
  const hn::Rebind<int32_t, Doubles> di;
  const hn::Rebind<float, Doubles> df;
  const Vec ideal = hn::Mul(hn::Div(clip, w), hn::Set(d, scale));
  const Vec grid = hn::Floor(hn::Add(ideal, hn::Set(d, 0.5)));
  hn::StoreU(hn::DemoteTo(df, hn::IfThenElseZero(usable, hn::Sub(ideal, grid))), df, rest);
  Vec v = hn::Add(grid, hn::Set(d, offset));
  v = hn::IfThenElseZero(usable, v);
  const Vec high = hn::Set(d, double(kGuardBandMax) * kSubpixelScale - 1);  // may have been rounded up to it
  v = hn::IfThenElse(hn::Gt(v, high), high, v);
  hn::StoreU(hn::DemoteTo(di, v), di, out);
}

HWY_INLINE void store_window(const ClipVec& c, Mask usable, const WindowTransform& t, Group& g, uint32_t i) {
  const Doubles d;
  const Vec one = hn::Set(d, 1.0);
  const Vec w = hn::IfThenElse(usable, c.w, one);
  store_fixed(c.x, w, usable, t.scale_x, t.offset_x, g.x + i, g.rest_x + i);
  store_fixed(c.y, w, usable, t.scale_y, t.offset_y, g.y + i, g.rest_y + i);
  Vec z = hn::Add(hn::Mul(hn::Div(c.z, w), hn::Set(d, t.depth_scale)), hn::Set(d, t.depth_offset));
  const Vec low = hn::Set(d, t.depth_low), high = hn::Set(d, t.depth_high);  // an ulp beyond, at most
  z = hn::IfThenElse(hn::Lt(z, low), low, z);
  z = hn::IfThenElse(hn::Gt(z, high), high, z);
  hn::Store(hn::IfThenElseZero(usable, z), d, g.z + i);
  hn::Store(hn::IfThenElseZero(usable, hn::Div(one, w)), d, g.inv_w + i);
}

HWY_INLINE Vec load_column(const float* column) {
  const hn::Rebind<float, Doubles> df;
  return hn::PromoteTo(Doubles(), hn::Load(df, column));
}

// Inside the frustum, w trustworthy, and (as |x| <= w <= max) finite: nothing else can be wrong with it.
HWY_INLINE Mask surely_inside(const ClipVec& c) {
  const Doubles d;
  const Mask xy = hn::And(hn::Le(hn::Abs(c.x), c.w), hn::Le(hn::Abs(c.y), c.w));
  const Mask zw = hn::And(hn::Le(hn::Abs(c.z), c.w), hn::Ge(c.w, hn::Set(d, kMinW)));
  return hn::And(hn::And(xy, zw), is_finite(c.w));
}

HWY_INLINE void shade_lanes(const ShadeJob& job, Group& g, uint32_t i, ClipVertex* clip) {
  const Doubles d;
  const Vec x = load_column(g.position[0] + i), y = load_column(g.position[1] + i);
  const Vec z = load_column(g.position[2] + i), w = load_column(g.position[3] + i);
  const double* m = job.m;
  const ClipVec c{row_times(m, x, y, z, w), row_times(m + 1, x, y, z, w), row_times(m + 2, x, y, z, w),
                  row_times(m + 3, x, y, z, w)};
  hn::StoreInterleaved4(c.x, c.y, c.z, c.w, d, &clip[i].x);
  Mask usable = surely_inside(c);
  if (HWY_LIKELY(job.window.inside_guard && hn::AllTrue(d, usable))) {
    hn::Store(hn::Zero(Words()), Words(), g.outcode + i);
  } else {
    const Vec code = outcodes(c, job.window);
    const Vec bad = hn::BitCast(d, hn::Set(Words(), uint64_t{kOutCutMask | kOutNotFinite}));
    usable = hn::RebindMask(d, hn::Eq(hn::BitCast(Words(), hn::And(code, bad)), hn::Zero(Words())));
    hn::Store(hn::BitCast(Words(), code), Words(), g.outcode + i);
  }
  store_window(c, usable, job.window, g, i);
}

HWY_INLINE void load_positions(const StreamRef& stream, uint32_t first, uint32_t count, Group& g) {
  const unsigned char* p = stream.data + size_t{first} * stream.stride;
  if (stream.size == 4) {
    for (uint32_t i = 0; i < count; ++i, p += stream.stride) {
      float v[4];
      memcpy(v, p, sizeof v);
      for (int k = 0; k < 4; ++k) g.position[k][i] = v[k];
    }
  } else {
    const size_t bytes = size_t(stream.size) * sizeof(float);
    for (uint32_t i = 0; i < count; ++i, p += stream.stride) {
      float v[4] = {0, 0, 0, 1};
      memcpy(v, p, bytes);
      for (int k = 0; k < 4; ++k) g.position[k][i] = v[k];
    }
  }
  for (uint32_t i = count; i % kGroup != 0; ++i) {
    for (int k = 0; k < 4; ++k) g.position[k][i] = 1.0f;
  }
}

// Field by field: a head built aside and copied would be read back wider than it was written, which stalls.
HWY_INLINE void store_heads(const ShadeJob& job, uint32_t first, uint32_t count, const Group& g) {
  const size_t stride = job.record_stride;
  unsigned char* record = job.records + size_t{first} * stride;
  uint16_t* outcode = job.outcodes + first;
  for (uint32_t i = 0; i < count; ++i, record += stride) {
    VertexHead* head = reinterpret_cast<VertexHead*>(record);
    head->x = g.x[i];
    head->y = g.y[i];
    head->z = g.z[i];
    head->inv_w = g.inv_w[i];
    head->rest_x = g.rest_x[i];
    head->rest_y = g.rest_y[i];
    outcode[i] = uint16_t(g.outcode[i]);
  }
}

// Comparisons and selects rather than min and max: those disagree between levels about NaN and -0.
HWY_INLINE void shade_colors(const ShadeJob& job, uint32_t first, uint32_t count) {
  const hn::CappedTag<float, 4> d;
  const auto one = hn::Set(d, 1.0f);
  const unsigned char* p = job.color.data + size_t{first} * job.color.stride;
  unsigned char* out = job.records + size_t{first} * job.record_stride + job.color_offset;
  const size_t bytes = size_t(job.color.size) * sizeof(float);
  for (uint32_t i = 0; i < count; ++i, p += job.color.stride, out += job.record_stride) {
    alignas(16) float rgba[4] = {0, 0, 0, 1};
    memcpy(rgba, p, bytes);
    for (size_t k = 0; k < 4; k += hn::Lanes(d)) {
      auto v = hn::Load(d, rgba + k);
      v = hn::IfThenElseZero(hn::Gt(v, hn::Zero(d)), v);
      hn::Store(hn::IfThenElse(hn::Lt(v, one), v, one), d, rgba + k);
    }
    memcpy(out, rgba, sizeof rgba);
  }
}

HWY_INLINE float bounded(float v) {
  if (v >= -kMaxTexCoord && v <= kMaxTexCoord) return v;
  if (v > 0) return kMaxTexCoord;
  return v < 0 ? -kMaxTexCoord : 0.0f;
}

HWY_INLINE float bounded_double(double v) {
  if (v >= double(-kMaxTexCoord) && v <= double(kMaxTexCoord)) return float(v);
  if (v > 0) return kMaxTexCoord;
  return v < 0 ? -kMaxTexCoord : 0.0f;
}

HWY_INLINE void transform_tex_coord(const double* m, const float* v, float* out) {
  for (int r = 0; r < 4; ++r) {
    const double xy = m[r] * double(v[0]) + m[4 + r] * double(v[1]);
    out[r] = bounded_double((xy + m[8 + r] * double(v[2])) + m[12 + r] * double(v[3]));
  }
}

// Two floats a vertex, as they are: the common case.
HWY_INLINE void shade_plain_tex_coords(const ShadeJob& job, uint32_t first, uint32_t count) {
  const unsigned char* p = job.tex_coord.data + size_t{first} * job.tex_coord.stride;
  unsigned char* out = job.records + size_t{first} * job.record_stride + job.tex_coord_offset;
  for (uint32_t i = 0; i < count; ++i, p += job.tex_coord.stride, out += job.record_stride) {
    float v[2];
    memcpy(v, p, sizeof v);
    v[0] = bounded(v[0]);
    v[1] = bounded(v[1]);
    memcpy(out, v, sizeof v);
  }
}

HWY_INLINE void shade_tex_coords(const ShadeJob& job, uint32_t first, uint32_t count) {
  if (!job.use_texture_matrix && !job.texture_projective && job.tex_coord.size >= 2) {
    return shade_plain_tex_coords(job, first, count);
  }
  const unsigned char* p = job.tex_coord.data + size_t{first} * job.tex_coord.stride;
  unsigned char* out = job.records + size_t{first} * job.record_stride + job.tex_coord_offset;
  const size_t bytes = size_t(job.tex_coord.size) * sizeof(float);
  for (uint32_t i = 0; i < count; ++i, p += job.tex_coord.stride, out += job.record_stride) {
    float v[4] = {0, 0, 0, 1};
    memcpy(v, p, bytes);
    for (int k = 0; k < 4; ++k) v[k] = bounded(v[k]);
    float result[4] = {v[0], v[1], v[2], v[3]};
    if (job.use_texture_matrix) transform_tex_coord(job.texture_matrix, v, result);
    const float stq[3] = {result[0], result[1], result[3]};
    memcpy(out, stq, (job.texture_projective ? 3 : 2) * sizeof(float));
  }
}

void shade(const ShadeJob& job, uint32_t first, uint32_t count) {
  Group group;
  ClipVertex tail[kGroup];
  while (count > 0) {
    const uint32_t n = count < kGroup ? count : kGroup;
    const bool whole = n == kGroup;
    ClipVertex* clip = whole ? job.clip + first : tail;
    load_positions(job.position, first, n, group);
    for (uint32_t i = 0; i < kGroup; i += uint32_t(hn::Lanes(Doubles()))) shade_lanes(job, group, i, clip);
    if (!whole) memcpy(job.clip + first, tail, n * sizeof(ClipVertex));
    store_heads(job, first, n, group);
    if (job.color_offset >= 0) shade_colors(job, first, n);
    if (job.tex_coord_offset >= 0) shade_tex_coords(job, first, n);
    first += n;
    count -= n;
  }
}

VertexKernels kernels() { return {shade}; }

}  // namespace HWY_NAMESPACE
}  // namespace halfspace::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace halfspace::raster {
namespace {

VertexKernels vertex_kernels() { HALFSPACE_SELECT(kernels) }

constexpr float kDefaultColor[4] = {1, 1, 1, 1};
constexpr float kDefaultCoord[4] = {0, 0, 0, 1};

StreamRef stream_ref(const AttributeStream& stream, const float* fallback) {
  if (!stream.data) return {reinterpret_cast<const unsigned char*>(fallback), 0, 4};
  return {static_cast<const unsigned char*>(stream.data), stream.stride, stream.size};
}

int byte_offset(int float_offset) {
  return float_offset < 0 ? -1 : int(sizeof(VertexHead)) + float_offset * int(sizeof(float));
}

}  // namespace

void shade_vertices(const DrawState& state, const VertexBatch& batch, uint32_t first, uint32_t count,
                    ShadedVertices& out) {
  ShadeJob job{};
  std::memcpy(job.m, state.clip_from_object.data(), sizeof job.m);
  job.window = make_window_transform(state.viewport);
  std::memcpy(job.texture_matrix, state.texture.matrix.data(), sizeof job.texture_matrix);
  job.use_texture_matrix = !state.texture.matrix_is_identity;
  job.texture_projective = out.layout.projective;
  job.position = stream_ref(batch.position, kDefaultCoord);
  job.color = stream_ref(batch.color, kDefaultColor);
  job.tex_coord = stream_ref(batch.tex_coord, kDefaultCoord);
  job.color_offset = byte_offset(out.layout.color);
  job.tex_coord_offset = byte_offset(out.layout.tex_coord);
  job.records = reinterpret_cast<unsigned char*>(out.records);
  job.record_stride = out.layout.stride();
  job.outcodes = out.outcodes.data();
  job.clip = out.clip.data();
  vertex_kernels().shade(job, first, count);
}

}  // namespace halfspace::raster
#endif  // HWY_ONCE
