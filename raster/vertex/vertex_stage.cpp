// Compiled once an ISA level. All arithmetic is IEEE double in a fixed order, so that the levels agree to the
// bit.
#include "raster/vertex/vertex_stage.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <type_traits>

#include "raster/isa.h"
#include "raster/vertex/effect_columns.h"
#include "raster/vertex/exact_attributes.h"
#include "raster/vertex/lighting.h"
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

constexpr uint32_t kGroup = kVertexGroup;

struct alignas(64) Group {
  float position[4][kGroup];
  VertexHead heads[kGroup];
  uint64_t outcode[kGroup];
  bool all_inside;
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

struct Fixed {
  hn::Vec<hn::Rebind<int32_t, Doubles>> value;
  hn::Vec<hn::Rebind<float, Doubles>> rest;
};

// Clip coordinates over w, where `usable`. x / w, not x * (1 / w): correctly rounded, so that a vertex meant
// to lie on the grid does. In a parallel projection nothing is divided, since x / 1 is x.
struct DividedVec {
  Vec x, y, z, inv_w;

  HWY_INLINE DividedVec(const ClipVec& c, Mask usable) {
    const Doubles d;
    const Vec one = hn::Set(d, 1.0), w = hn::IfThenElse(usable, c.w, one);
    x = c.x, y = c.y, z = c.z, inv_w = one;
    if (hn::AllTrue(d, hn::Eq(w, one))) return;
    x = hn::Div(x, w), y = hn::Div(y, w), z = hn::Div(z, w), inv_w = hn::Div(one, w);
  }
};

// `place`: between -1 and 1 in the viewport.
HWY_INLINE Fixed to_fixed(Vec place, Mask usable, double scale, double offset) {
  const Doubles d;
  const hn::Rebind<int32_t, Doubles> di;
  const hn::Rebind<float, Doubles> df;
  const Vec ideal = hn::Mul(place, hn::Set(d, scale));
  const Vec grid = hn::Floor(hn::Add(ideal, hn::Set(d, 0.5)));
  const auto rest = hn::DemoteTo(df, hn::IfThenElseZero(usable, hn::Sub(ideal, grid)));
  Vec v = hn::Add(grid, hn::Set(d, offset));
  v = hn::IfThenElse(usable, v, hn::Set(d, double{kNoPlace}));
  const Vec high = hn::Set(d, double(kGuardBandMax) * kSubpixelScale - 1);  // may have been rounded up to it
  v = hn::IfThenElse(hn::Gt(v, high), high, v);
  return {hn::DemoteTo(di, v), rest};
}

// Two 32-bit values a lane as they lie one after the other in memory.
template <class V>
HWY_INLINE hn::Vec<Words> join(V low, V high) {
  const hn::Rebind<uint32_t, Doubles> half;
  return hn::Or(hn::PromoteTo(Words(), hn::BitCast(half, low)),
                hn::ShiftLeft<32>(hn::PromoteTo(Words(), hn::BitCast(half, high))));
}

// `place`: between -1 and 1 in the depth range.
HWY_INLINE Vec window_depth(Vec place, const WindowTransform& t) {
  const Doubles d;
  const Vec z = hn::Add(hn::Mul(place, hn::Set(d, t.depth_scale)), hn::Set(d, t.depth_offset));
  const Vec low = hn::Set(d, t.depth_low), high = hn::Set(d, t.depth_high);  // an ulp beyond, at most
  const Vec held = hn::IfThenElse(hn::Lt(z, low), low, z);
  return hn::IfThenElse(hn::Gt(held, high), high, held);
}

HWY_INLINE void store_window(const ClipVec& c, Mask usable, const WindowTransform& t, Group& g, uint32_t i) {
  const Doubles d;
  const DividedVec place(c, usable);
  const Fixed x = to_fixed(place.x, usable, t.scale_x, t.offset_x);
  const Fixed y = to_fixed(place.y, usable, t.scale_y, t.offset_y);
  const Vec z = window_depth(place.z, t);
  const Vec inv_w = hn::IfThenElseZero(usable, place.inv_w);
  // A head's four words, in their order: x and y, z, 1/w, what snapping took.
  static_assert(sizeof(VertexHead) == 4 * sizeof(double) && offsetof(VertexHead, inv_w) == 16);
  hn::StoreInterleaved4(hn::BitCast(d, join(x.value, y.value)), hn::IfThenElseZero(usable, z), inv_w,
                        hn::BitCast(d, join(x.rest, y.rest)), d, reinterpret_cast<double*>(g.heads + i));
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

HWY_INLINE ClipVec clip_position(const ShadeJob& job, const float (*position)[kGroup], uint32_t i) {
  const Vec x = load_column(position[0] + i), y = load_column(position[1] + i);
  const Vec z = load_column(position[2] + i), w = load_column(position[3] + i);
  const double* m = job.m;
  return {row_times(m, x, y, z, w), row_times(m + 1, x, y, z, w), row_times(m + 2, x, y, z, w),
          row_times(m + 3, x, y, z, w)};
}

// Of outcodes: not to be cut, and finite.
HWY_INLINE Mask is_usable(Vec code) {
  const Doubles d;
  const Vec bad = hn::BitCast(d, hn::Set(Words(), uint64_t{kOutCutMask | kOutNotFinite}));
  return hn::RebindMask(d, hn::Eq(hn::BitCast(Words(), hn::And(code, bad)), hn::Zero(Words())));
}

HWY_INLINE void shade_lanes(const ShadeJob& job, Group& g, uint32_t i) {
  const Doubles d;
  const ClipVec c = clip_position(job, g.position, i);
  Mask usable = surely_inside(c);
  if (HWY_LIKELY(job.window.inside_guard && hn::AllTrue(d, usable))) {
    hn::Store(hn::Zero(Words()), Words(), g.outcode + i);
  } else {
    g.all_inside = false;
    const Vec code = outcodes(c, job.window);
    usable = is_usable(code);
    hn::Store(hn::BitCast(Words(), code), Words(), g.outcode + i);
  }
  store_window(c, usable, job.window, g, i);
}

HWY_INLINE void store_heads(const ShadeJob& job, uint32_t first, uint32_t count, const Group& g) {
  unsigned char* record = job.records + size_t{first} * job.record_stride;
  for (uint32_t i = 0; i < count; ++i, record += job.record_stride) memcpy(record, g.heads + i, sizeof g.heads[i]);
}

HWY_INLINE void store_outcodes(const ShadeJob& job, uint32_t first, uint32_t count, const Group& g) {
  uint16_t* outcode = job.outcodes + first;
  if (HWY_LIKELY(g.all_inside)) {
    memset(outcode, 0, count * sizeof *outcode);
  } else {
    for (uint32_t i = 0; i < count; ++i) outcode[i] = uint16_t(g.outcode[i]);
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

inline constexpr uint32_t kLongestVector = 16;            // lanes
inline constexpr float kDefaults[4] = {0, 0, 0, 1};  // of a position's, colour's and coordinate's components

// Each uses what stands in those before it.
// clang-format off
#include "raster/vertex/streams.inl"
#include "raster/vertex/point_places.inl"
#include "raster/vertex/line_ends.inl"
#include "raster/exact_math.inl"
#include "raster/vertex/power.inl"
#include "raster/vertex/lighting.inl"
#include "raster/vertex/eye_space.inl"
#include "raster/vertex/tex_gen.inl"
// clang-format on

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

// `g`, `e`: what texgen makes coordinates from.
HWY_INLINE void shade_tex_coords(const ShadeJob& job, uint32_t first, uint32_t count, const Group& g,
                                 const EffectColumns* e) {
  if (!job.use_texture_matrix && job.tex_coord_count == 2 && job.tex_coord.size >= 2 && !job.tex_gen.any) {
    return shade_plain_tex_coords(job, first, count);
  }
  const unsigned char* p = job.tex_coord.data + size_t{first} * job.tex_coord.stride;
  unsigned char* out = job.records + size_t{first} * job.record_stride + job.tex_coord_offset;
  for (uint32_t i = 0; i < count; ++i, p += job.tex_coord.stride, out += job.record_stride) {
    float v[4];
    load_element(p, job.tex_coord.size, kDefaults, v);
    for (int k = 0; k < 4; ++k) v[k] = bounded(v[k]);
    if (job.tex_gen.any) generate_coords(job.tex_gen, g, *e, i, v);
    float result[4] = {v[0], v[1], v[2], v[3]};
    if (job.use_texture_matrix) transform_tex_coord(job.texture_matrix, v, result);
    if (job.tex_coord_count == 3) result[2] = result[3];
    memcpy(out, result, size_t(job.tex_coord_count) * sizeof(float));
  }
}

// A colour a vertex from columns.
HWY_INLINE void store_colors(const ShadeJob& job, const float (*columns)[kVertexGroup], int offset,
                             uint32_t first, uint32_t count) {
  unsigned char* out = job.records + size_t{first} * job.record_stride + offset;
  for (uint32_t i = 0; i < count; ++i, out += job.record_stride) {
    const float rgba[4] = {columns[0][i], columns[1][i], columns[2][i], columns[3][i]};
    memcpy(out, rgba, sizeof rgba);
  }
}

HWY_INLINE void shade_lit_colors(const ShadeJob& job, uint32_t first, uint32_t count, EffectColumns& e) {
  if (job.lighting->tracks_color) load_columns(job.color, first, count, 4, kDefaults, e.color);
  light_group(*job.lighting, job.material_index ? job.material_index + first : nullptr, count, e);
  store_colors(job, e.lit[0], job.color_offset, first, count);
  if (job.back_color_offset >= 0) store_colors(job, e.lit[1], job.back_color_offset, first, count);
}

HWY_INLINE void shade_fog_distances(const ShadeJob& job, uint32_t first, uint32_t count,
                                    const EffectColumns& e) {
  unsigned char* out = job.records + size_t{first} * job.record_stride + job.fog_offset;
  for (uint32_t i = 0; i < count; ++i, out += job.record_stride) {
    const double z = e.eye[2][i];
    const float distance = bounded_double(z < 0 ? -z : z);
    memcpy(out, &distance, sizeof distance);
  }
}

// Lighting, fog and whatever else looks at eye coordinates; kept away from the draws that have none of it.
HWY_NOINLINE void shade_effects(const ShadeJob& job, const Group& g, uint32_t first, uint32_t count) {
  EffectColumns e;
  if (job.needs_eye) eye_group(job, g, count, e);
  if (job.needs_normal) normal_group(job, first, count, e);
  if (job.lighting && job.color_offset >= 0) shade_lit_colors(job, first, count, e);
  if (job.fog_offset >= 0) shade_fog_distances(job, first, count, e);
  if (job.tex_gen.any && job.tex_coord_offset >= 0) shade_tex_coords(job, first, count, g, &e);
}

void shade(const ShadeJob& job, uint32_t first, uint32_t count) {
  Group group;
  while (count > 0) {
    const uint32_t n = count < kGroup ? count : kGroup;
    load_columns(job.position, first, n, 4, kDefaults, group.position);
    group.all_inside = true;
    for (uint32_t i = 0; i < n; i += uint32_t(hn::Lanes(Doubles()))) shade_lanes(job, group, i);
    store_heads(job, first, n, group);
    store_outcodes(job, first, n, group);
    if (job.color_offset >= 0 && !job.lighting) shade_colors(job, first, n);
    if (job.tex_coord_offset >= 0 && !job.tex_gen.any) shade_tex_coords(job, first, n, group, nullptr);
    if (job.needs_eye || job.needs_normal || job.lighting || job.tex_gen.any)
      shade_effects(job, group, first, n);
    first += n;
    count -= n;
  }
}

VertexKernels kernels() { return {shade, power_columns, place_points, shade_ends}; }

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
  if (!stream.data) return {reinterpret_cast<const unsigned char*>(fallback), 0, 4, false};
  return {static_cast<const unsigned char*>(stream.data), stream.stride, stream.size, stream.bytes};
}

int byte_offset(int float_offset) {
  return float_offset < 0 ? -1 : int(sizeof(VertexHead)) + float_offset * int(sizeof(float));
}

constexpr float kDefaultNormal[4] = {0, 0, 1, 0};

bool calls_for_effects(const DrawState& state, const VertexLayout& layout) {
  return (state.lighting.enabled && layout.color >= 0) || layout.fog >= 0 ||
         (layout.tex_coord >= 0 && state.tex_gen.any());
}

// With GL_NORMALIZE lengths do not matter: the matrix is scaled so that no float overflows.
void store_normal_matrix(const DrawState& state, float (&out)[9]) {
  double longest = 0;
  for (double v : state.normal_from_object) longest = std::max(longest, std::fabs(v));
  const bool scale = state.normalize && longest > 0 && std::isfinite(longest);
  for (size_t i = 0; i < 9; ++i) {
    const double v = scale ? state.normal_from_object[i] / longest : state.normal_from_object[i];
    out[i] = float(std::clamp(v, -1e30, 1e30));
  }
}

TexGenJob make_tex_gen_job(const DrawState& state) {
  TexGenJob job{};
  job.any = true;
  for (size_t k = 0; k < 4; ++k) {
    const TexGenCoord& coord = state.tex_gen.coord[k];
    if (coord.mode == TexGenMode::off) continue;
    job.kind[k] = coord.mode == TexGenMode::sphere_map ? TexGenJob::kSphere : TexGenJob::kPlane;
    job.sphere |= coord.mode == TexGenMode::sphere_map;
    const auto& m = state.eye_from_object;
    for (size_t i = 0; i < 4; ++i) {
      const auto& p = coord.eye_plane;
      job.plane[k][i] =
          coord.mode == TexGenMode::object_linear
              ? coord.object_plane[i]
              : p[0] * m[4 * i] + p[1] * m[4 * i + 1] + p[2] * m[4 * i + 2] + p[3] * m[4 * i + 3];
    }
  }
  return job;
}

void prepare_effects(const DrawState& state, const VertexBatch& batch,
                     std::span<const MaterialPair> materials, const VertexLayout& layout, ShadeJob& job,
                     LightingJob& lighting) {
  job.eye = state.eye_from_object.data();
  job.needs_eye = layout.fog >= 0;
  if (layout.tex_coord >= 0 && state.tex_gen.any()) {
    job.tex_gen = make_tex_gen_job(state);
    job.needs_eye |= job.tex_gen.sphere;
    job.needs_normal |= job.tex_gen.sphere;
  }
  if (state.lighting.enabled && layout.color >= 0) {
    lighting =
        make_lighting_job(state.lighting, batch.material_index ? materials : std::span<const MaterialPair>());
    lighting.power = state.accuracy.power;
    job.lighting = &lighting;
    job.material_index = batch.material_index;
    job.needs_eye |= lighting.needs_eye;
    job.needs_normal |= lighting.light_count > 0;
  }
  if (!job.needs_normal) return;
  job.normal = stream_ref(batch.normal, kDefaultNormal);
  job.normalize = state.normalize;
  store_normal_matrix(state, job.normal_matrix);
}

}  // namespace

namespace {

// Where vertices go; `first` and `count` say which.
struct Target {
  const VertexLayout& layout;
  void* records;
  uint16_t* outcodes;
};

// Positions and colours, as they are.
ShadeJob plain_job(const DrawState& state, const double* clip_from_object, const VertexBatch& batch,
                   const VertexLayout& layout) {
  ShadeJob job;
  job.m = clip_from_object;
  job.window = make_window_transform(state.viewport);
  job.position = stream_ref(batch.position, kDefaultCoord);
  job.color = stream_ref(batch.color, kDefaultColor);
  job.color_offset = byte_offset(layout.color);
  return job;
}

void run_job(const DrawState& state, const double* clip_from_object, const VertexBatch& batch,
             std::span<const MaterialPair> materials, int tex_coord_count, uint32_t first, uint32_t count,
             const Target& target) {
  ShadeJob job = plain_job(state, clip_from_object, batch, target.layout);
  job.texture_matrix = state.texture.matrix.data();
  job.use_texture_matrix = !state.texture.matrix_is_identity;
  job.tex_coord_count = tex_coord_count;
  job.tex_coord = stream_ref(batch.tex_coord, kDefaultCoord);
  job.back_color_offset = byte_offset(target.layout.back_color);
  job.fog_offset = byte_offset(target.layout.fog);
  job.tex_coord_offset = byte_offset(target.layout.tex_coord);
  job.records = static_cast<unsigned char*>(target.records);
  job.record_stride = target.layout.stride();
  job.outcodes = target.outcodes;
  LightingJob lighting;
  if (calls_for_effects(state, target.layout)) {
    prepare_effects(state, batch, materials, target.layout, job, lighting);
  }
  vertex_kernels().shade(job, first, count);
  if (state.accuracy.transform != Level::exact) return;
  shade_exactly(state, batch, materials, target.layout, tex_coord_count, first, count,
                static_cast<std::byte*>(target.records));
}

// A record of all there is.
struct FullRecord {
  VertexHead head;
  float color[4], tex_coord[4], fog, back_color[4];
};
static_assert(sizeof(FullRecord) == sizeof(VertexHead) + 14 * sizeof(float));  // 13, and what aligns the next

VertexAttributes attributes_of(const FullRecord& r, bool two_sided) {
  const auto color_of = [](const float(&c)[4]) { return Color{c[0], c[1], c[2], c[3]}; };
  VertexAttributes out{color_of(r.color), color_of(two_sided ? r.back_color : r.color), {}, r.fog};
  std::memcpy(out.tex_coord, r.tex_coord, sizeof r.tex_coord);
  return out;
}

}  // namespace

void shade_vertices(const DrawState& state, const double* clip_from_object, const VertexBatch& batch,
                    std::span<const MaterialPair> materials, uint32_t first, uint32_t count,
                    ShadedVertices& out) {
  run_job(state, clip_from_object, batch, materials, out.layout.projective ? 3 : 2, first, count,
          {out.layout, out.records, out.outcodes.data()});
}

void shade_vertices(const DrawState& state, const VertexBatch& batch, std::span<const MaterialPair> materials,
                    uint32_t first, uint32_t count, ShadedVertices& out) {
  shade_vertices(state, state.clip_from_object.data(), batch, materials, first, count, out);
}

void place_points(const DrawState& state, const VertexBatch& batch, const VertexLayout& layout,
                  const PointJob& points, uint32_t first, uint32_t count) {
  vertex_kernels().place_points(plain_job(state, state.clip_from_object.data(), batch, layout), points, first,
                                count);
}

LineEndShader::LineEndShader(const DrawState& state, const VertexBatch& batch, const VertexLayout& layout)
    : job_(plain_job(state, state.clip_from_object.data(), batch, layout)), run_(vertex_kernels().shade_ends) {}

void shade_attributes(const DrawState& state, const VertexBatch& batch, std::span<const MaterialPair> materials,
                      std::span<VertexAttributes> out) {
  VertexLayout layout;
  layout.color = 0;
  layout.tex_coord = 4;
  layout.fog = 8;
  layout.back_color = layout.attribute_count = 9;
  const bool two_sided = state.lighting.enabled && state.lighting.two_sided;
  FullRecord records[kVertexGroup];
  uint16_t outcodes[kVertexGroup];
  for (size_t first = 0; first < out.size(); first += kVertexGroup) {
    const size_t count = std::min<size_t>(kVertexGroup, out.size() - first);
    run_job(state, state.clip_from_object.data(), part_of(batch, uint32_t(first), uint32_t(count)), materials,
            4, 0, uint32_t(count), {layout, records, outcodes});
    for (size_t i = 0; i < count; ++i) out[first + i] = attributes_of(records[i], two_sided);
  }
}

void power(const float* x, const float* s, float* out, size_t count, Level level) {
  vertex_kernels().power(x, s, out, count, level);
}

}  // namespace halfspace::raster
#endif  // HWY_ONCE
