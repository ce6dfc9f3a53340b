// Set-up, second half: edges and planes of eight primitives at once, in double. Compiled once per ISA level.
// All integers here stay below 2^53, so edge values are exact.

inline constexpr double kDepthScale = static_cast<double>(kDepthMax);

inline constexpr double kTexelTolerance = 1.0 / 1024;  // texels of level 0 the float path may be off
inline constexpr double kColorTolerance = 1.0 / 64;    // levels of 255
// docs/numerics.md, "Precision on demand".
inline constexpr double kRounding = 1.0 / (1 << 24);
inline constexpr double kFloatUlps = 3 * kRounding;
inline constexpr double kCloseLook = 4.0 / 3;  // the part of a tolerance that the closer look may use up

HWY_INLINE void StoreInt(VD v, int32_t* to) { hn::Store(hn::DemoteTo(DDi(), v), DDi(), to); }

// For what is made from one primitive after the other.
HWY_INLINE void StorePlaces(const CornerVectors& v, int i, SetupInput& in) {
  for (int k = 0; k < 3; ++k)
    hn::Store(v.place_x[k], DDi(), in.x[k] + i), hn::Store(v.place_y[k], DDi(), in.y[k] + i);
}

HWY_INLINE void StoreSide(VD v, int32_t* to) { StoreInt(v, to); }
HWY_INLINE void StoreSide(VDi v, int32_t* to) { hn::Store(v, DDi(), to); }

// Drops the sub-pixel bits.
HWY_INLINE void StoreEdgeValue(VD e, int32_t* to) {
  const DD d;
  e = hn::Floor(hn::Mul(e, hn::Set(d, 1.0 / kSubpixelScale)));
  // Beyond 2^30 the sign holds all over the tile.
  const VD limit = hn::Set(d, 1073741824.0);
  StoreInt(hn::Min(hn::Max(e, hn::Sub(hn::Neg(limit), hn::Set(d, 1.0))), limit), to);
}
HWY_INLINE void StoreEdgeValue(VDi e, int32_t* to) { hn::Store(hn::ShiftRight<kSubpixelBits>(e), DDi(), to); }

// Edge from corner a to corner b of a counter-clockwise triangle at the tile's first pixel centre. Top-left
// rule, y up: a pixel centre on the edge is inside if the edge goes down (a left edge) or runs leftward (a
// top edge).
template <class V>
HWY_INLINE void SetEdge(const V x[3], const V y[3], int a, int b, int i, V center_x, V center_y, SetupBatch& out) {
  const hn::DFromV<V> d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1);
  const V dx = hn::Sub(x[b], x[a]), dy = hn::Sub(y[b], y[a]);
  const V e = hn::Sub(hn::Mul(dx, hn::Sub(center_y, y[a])), hn::Mul(dy, hn::Sub(center_x, x[a])));
  const auto inclusive = hn::Or(hn::Lt(dy, zero), hn::And(hn::Eq(dy, zero), hn::Lt(dx, zero)));
  StoreEdgeValue(hn::Sub(e, hn::IfThenZeroElse(inclusive, one)), &out.edge[a][i]);
  StoreSide(hn::Neg(dy), &out.step_x[a][i]);
  StoreSide(dx, &out.step_y[a][i]);
}

// What a primitive spans along an axis, 16.8.
struct Span {
  VDi least, most;
  HWY_INLINE explicit Span(const VDi p[3])
      : least(hn::Min(hn::Min(p[0], p[1]), p[2])), most(hn::Max(hn::Max(p[0], p[1]), p[2])) {}
  HWY_INLINE VDi Size() const { return hn::Sub(most, least); }
};

// Pixels whose centres lie in a span and in [low, high) of the tile.
HWY_INLINE void SetBox(const Span& span, int32_t center, int low, int high, int32_t* least, int32_t* most) {
  const DDi d;
  const VDi first = hn::Sub(span.least, hn::Set(d, center - (kSubpixelScale - 1)));
  const VDi last = hn::Sub(span.most, hn::Set(d, center));
  hn::Store(hn::Max(hn::ShiftRight<kSubpixelBits>(first), hn::Set(d, low)), d, least);
  hn::Store(hn::Min(hn::ShiftRight<kSubpixelBits>(last), hn::Set(d, high - 1)), d, most);
}

// Which pixels the primitives cover. `plain`: triangles that reach into the tile.
HWY_INLINE void SetCoverage(const CornerVectors& v, int i, bool plain, int32_t center_x, int32_t center_y,
                            const Rect& limit, SetupBatch& out) {
  const DD d;
  const DDi di;
  const Span x(v.place_x), y(v.place_y);
  SetBox(x, center_x, limit.x0, limit.x1, out.min_x + i, out.max_x + i);
  SetBox(y, center_y, limit.y0, limit.y1, out.min_y + i, out.max_y + i);
  // No larger than a tile, they are nowhere further from its first pixel than two tiles: edge values stay below 2^31.
  const VDi size = hn::Max(x.Size(), y.Size());
  hn::Store(size, di, out.size + i);
  if (plain && hn::AllTrue(di, hn::Lt(size, hn::Set(di, kTileSize * kSubpixelScale)))) {
    const VDi cx = hn::Set(di, center_x), cy = hn::Set(di, center_y);
    for (int k = 0; k < 3; ++k) SetEdge(v.place_x, v.place_y, k, (k + 1) % 3, i, cx, cy, out);
  } else {
    const VD cx = hn::Set(d, static_cast<double>(center_x)), cy = hn::Set(d, static_cast<double>(center_y));
    for (int k = 0; k < 3; ++k) SetEdge(v.x, v.y, k, (k + 1) % 3, i, cx, cy, out);
  }
}

// What the planes of a group of lanes are made from, and how wrong floats would be. Coverage takes the
// corners where they were snapped to; planes belong to the corners as they were before, so that what is drawn
// does not move with the snapping. That needs a triangle which snapping hardly changes: one it does is taken
// as snapped.
struct PlaneMaker {
  VD ex1, ey1, ex2, ey2, scale;
  const VD* inv_w;    // of the three corners
  VD rest_x, rest_y;  // from the reference vertex as snapped to where it was, pixels
  VD moved;           // the most a corner was moved along either axis, pixels
  hn::Mask<DD> affine;
  bool all_affine;
  VD width, height;     // pixels
  VD w_error, w_least;  // of the 1/w plane in float; its least value at a covered pixel
  VD w_spread;          // 1 / w_least
  VD w_excess;          // 1/w at the corner where it is least over w_least
  hn::Mask<DD> needs_double;

  HWY_INLINE explicit PlaneMaker(const CornerVectors& v) : inv_w(v.inv_w) {
    const DD d;
    const VD pixel = hn::Set(d, 1.0 / kSubpixelScale);
    affine = hn::And(hn::Eq(inv_w[0], inv_w[1]), hn::Eq(inv_w[0], inv_w[2]));
    all_affine = hn::AllTrue(d, affine);
    ex1 = hn::Sub(v.x[1], v.x[0]), ey1 = hn::Sub(v.y[1], v.y[0]);
    ex2 = hn::Sub(v.x[2], v.x[0]), ey2 = hn::Sub(v.y[2], v.y[0]);
    VD area = hn::Sub(hn::Mul(ex1, ey2), hn::Mul(ex2, ey1));
    TakeBackSnapping(v, area);
    const auto flat = hn::Eq(area, hn::Zero(d));
    scale = hn::IfThenZeroElse(flat, hn::Div(hn::Set(d, 256.0), hn::IfThenElse(flat, hn::Set(d, 1.0), area)));
    width = hn::Mul(Extent(v.x), pixel);
    height = hn::Mul(Extent(v.y), pixel);
    needs_double = NoLane();
    w_error = hn::Zero(d);
    w_least = w_spread = w_excess = hn::Set(d, 1.0);
  }

  // Moves the corners to where they were before snapping. A covered pixel may then lie outside the triangle,
  // by half a sub-pixel: no barycentric coordinate, and no 1/w in parts of its least value, may change over
  // that by more than a quarter, or else the corners stay.
  HWY_INLINE void TakeBackSnapping(const CornerVectors& v, VD& area) {
    const DD d;
    const VD *rx = v.rest_x, *ry = v.rest_y;
    const VD x1 = hn::Add(ex1, hn::Sub(rx[1], rx[0])), y1 = hn::Add(ey1, hn::Sub(ry[1], ry[0]));
    const VD x2 = hn::Add(ex2, hn::Sub(rx[2], rx[0])), y2 = hn::Add(ey2, hn::Sub(ry[2], ry[0]));
    const VD true_area = hn::Sub(hn::Mul(x1, y2), hn::Mul(x2, y1));
    const VD longest =
        hn::Max(hn::Max(Length(x1, y1), Length(x2, y2)), Length(hn::Sub(x2, x1), hn::Sub(y2, y1)));
    const VD half = hn::Mul(true_area, hn::Set(d, 0.5));  // a quarter over half a sub-pixel
    auto use = hn::Le(longest, half);
    if (!all_affine) {
      const VD d1 = hn::Sub(inv_w[1], inv_w[0]), d2 = hn::Sub(inv_w[2], inv_w[0]);
      const VD slope =
          Length(hn::Sub(hn::Mul(d1, y2), hn::Mul(d2, y1)), hn::Sub(hn::Mul(d2, x1), hn::Mul(d1, x2)));
      const VD least = hn::Min(hn::Min(inv_w[0], inv_w[1]), inv_w[2]);
      use = hn::And(use, hn::Le(slope, hn::Mul(least, half)));
    }
    ex1 = hn::IfThenElse(use, x1, ex1), ey1 = hn::IfThenElse(use, y1, ey1);
    ex2 = hn::IfThenElse(use, x2, ex2), ey2 = hn::IfThenElse(use, y2, ey2);
    area = hn::IfThenElse(use, true_area, area);
    VD most = hn::Zero(d);
    for (int k = 0; k < 3; ++k) most = hn::Max(most, hn::Max(hn::Abs(rx[k]), hn::Abs(ry[k])));
    const VD pixel = hn::Set(d, 1.0 / kSubpixelScale);
    rest_x = hn::IfThenElseZero(use, hn::Mul(rx[0], pixel));
    rest_y = hn::IfThenElseZero(use, hn::Mul(ry[0], pixel));
    moved = hn::IfThenElseZero(use, hn::Mul(most, pixel));
  }

  static HWY_INLINE VD Length(VD x, VD y) { return hn::Add(hn::Abs(x), hn::Abs(y)); }
  static HWY_INLINE VD Extent(const VD p[3]) {
    return hn::Sub(hn::Max(hn::Max(p[0], p[1]), p[2]), hn::Min(hn::Min(p[0], p[1]), p[2]));
  }

  struct Bounds {
    VD error;  // of PlaneAt in float
    VD drift;  // of a corner's value by snapping
  };

  // Stores the plane through the corners' values.
  HWY_INLINE Bounds Store(const VD value[3], int plane, int i, SetupBatch& out) const {
    const DD d;
    const VD d1 = hn::Sub(value[1], value[0]), d2 = hn::Sub(value[2], value[0]);
    const VD dfdx = hn::Mul(hn::Sub(hn::Mul(d1, ey2), hn::Mul(d2, ey1)), scale);
    const VD dfdy = hn::Mul(hn::Sub(hn::Mul(d2, ex1), hn::Mul(d1, ex2)), scale);
    const VD f0 = hn::Sub(value[0], hn::Add(hn::Mul(dfdx, rest_x), hn::Mul(dfdy, rest_y)));
    hn::Store(f0, d, out.f0[plane] + i);
    hn::Store(dfdx, d, out.dfdx[plane] + i);
    hn::Store(dfdy, d, out.dfdy[plane] + i);
    const DDf f;
    hn::Store(hn::DemoteTo(f, f0), f, out.f0_f[plane] + i);
    hn::Store(hn::DemoteTo(f, dfdx), f, out.dfdx_f[plane] + i);
    hn::Store(hn::DemoteTo(f, dfdy), f, out.dfdy_f[plane] + i);
    const VD reach =
        hn::Add(hn::Abs(f0), hn::Add(hn::Mul(hn::Abs(dfdx), width), hn::Mul(hn::Abs(dfdy), height)));
    return {hn::Mul(reach, hn::Set(d, kFloatUlps)), hn::Mul(Length(dfdx, dfdy), moved)};
  }

  HWY_INLINE void StoreInvW(int i, SetupBatch& out) {
    const DD d;
    const VD one = hn::Set(d, 1.0);
    const Bounds bounds = Store(inv_w, 1, i, out);
    w_error = hn::IfThenZeroElse(affine, bounds.error);
    const VD least = hn::Min(hn::Min(inv_w[0], inv_w[1]), inv_w[2]);
    w_least = hn::IfThenElse(affine, one, hn::Sub(least, bounds.drift));
    w_spread = hn::Div(one, w_least);
    w_excess = hn::IfThenElse(affine, one, hn::Mul(least, w_spread));
    // The bounds of attributes take 1/w in float for nearly right, and for a normal number.
    const VD nearly = hn::Max(w_error, hn::Set(d, 0x1p-108));
    needs_double =
        hn::Not(hn::Ge(hn::Mul(w_least, hn::Set(d, 1.0 / 256)), hn::IfThenZeroElse(affine, nearly)));
  }

  // Whether the bounds of StoreAttribute, for a colour, hold whatever its values in [0, 255] are. All four planes are
  // judged at once; where this says no, each is judged by its own values. The least of these bounds is looser than
  // the closest of those by 256 / 255, far more than either is rounded by.
  HWY_INLINE hn::Mask<DD> ColorsAreNear() const {
    const DD d;
    const VD most = hn::Set(d, 256.0), ulps = hn::Set(d, kFloatUlps);
    VD value = most;
    if (!all_affine) {
      const VD highest = hn::Max(hn::Max(inv_w[0], inv_w[1]), inv_w[2]);
      value = hn::IfThenElse(affine, most, hn::Mul(most, highest));
    }
    const VD steep = hn::Mul(value, scale);
    const VD dfdx = hn::Mul(Length(ey1, ey2), steep), dfdy = hn::Mul(Length(ex1, ex2), steep);
    const VD sides = hn::Add(hn::Mul(dfdx, hn::Add(width, moved)), hn::Mul(dfdy, hn::Add(height, moved)));
    const VD reach = hn::Add(value, sides);
    const VD drift = hn::Mul(hn::Add(dfdx, dfdy), moved);
    const VD largest = hn::Add(hn::Mul(most, w_excess), hn::Mul(drift, w_spread));
    const VD left = hn::Add(hn::Mul(reach, ulps), hn::Mul(largest, w_error));
    const VD right = hn::Mul(hn::Sub(hn::Set(d, kColorTolerance), hn::Mul(largest, ulps)), w_least);
    return hn::Le(left, right);
  }

  // The three values an attribute's plane goes through.
  HWY_INLINE void Weigh(const VD value[3], bool divided, VD weighted[3]) const {
    for (int k = 0; k < 3; ++k) weighted[k] = value[k];
    if (all_affine && !divided) return;
    for (int k = 0; k < 3; ++k) {
      const VD by_w = hn::Mul(value[k], inv_w[k]);
      weighted[k] = divided ? by_w : hn::IfThenElse(affine, value[k], by_w);
    }
  }

  // An attribute: plane of value / w, or of the value itself where w is constant (unless `divided` anyway). A
  // pixel's value errs by (error of value/w + value * error of 1/w) * w, and by the roundings of the divide.
  // It is largest at a snapped corner, where neither value/w nor 1/w differ by more than their drift from
  // what they are at the corner.
  HWY_INLINE void StoreAttribute(const VD value[3], int plane, int i, bool divided, VD tolerance,
                                 SetupBatch& out) {
    const DD d;
    VD weighted[3];
    Weigh(value, divided, weighted);
    const Bounds bounds = Store(weighted, plane, i, out);
    const VD at_corners = hn::Max(hn::Max(hn::Abs(value[0]), hn::Abs(value[1])), hn::Abs(value[2]));
    const VD largest = hn::Add(hn::Mul(at_corners, w_excess), hn::Mul(bounds.drift, w_spread));
    const VD left = hn::Add(bounds.error, hn::Mul(largest, w_error));
    const VD right = hn::Mul(hn::Sub(tolerance, hn::Mul(largest, hn::Set(d, kFloatUlps))), w_least);
    needs_double = hn::Or(needs_double, hn::Not(hn::Le(left, right)));
  }
};

// REPEAT: the whole turns that come off before anything becomes float, so that what is left lies around 0. `mips`: there
// lies what is near the eye, since what is far is looked up in large texels.
HWY_INLINE VD WholeTurns(const VD inv_w[3], bool mips, const VD value[3]) {
  const DD d;
  const VD least = hn::Min(hn::Min(value[0], value[1]), value[2]);
  const VD most = hn::Max(hn::Max(value[0], value[1]), value[2]);
  VD middle = hn::Mul(hn::Add(least, most), hn::Set(d, 0.5));
  if (mips) {
    VD sum = hn::Zero(d), weights = hn::Zero(d);
    for (int k = 0; k < 3; ++k) {
      const VD weight = hn::Mul(inv_w[k], inv_w[k]);
      sum = hn::Add(sum, hn::Mul(value[k], weight));
      weights = hn::Add(weights, weight);
    }
    middle = hn::Div(sum, weights);
  }
  return hn::Floor(middle);
}

#include "raster/tile/corner_bounds.inl"
#include "raster/tile/cut_planes.inl"

// The accuracy axes' say in which planes a primitive is interpolated by.
HWY_NOINLINE void ApplyPlaneRule(const FragmentParams& params, PlaneMaker& maker) {
  if (params.plane_rule == PlaneRule::in_double) maker.needs_double = hn::Eq(maker.scale, maker.scale);
  if (params.plane_rule == PlaneRule::in_float) maker.needs_double = NoLane();
}

HWY_INLINE VD LoadAttribute(const SetupInput& in, const VertexLayout& layout, int a, int k, int i) {
  const DD d;
  const VD value = hn::PromoteTo(d, hn::Load(DDf(), in.attribute[a][k] + i));
  return HWY_LIKELY(layout.low < 0) ? value : hn::Add(value, hn::Load(d, in.low[a][k] + i));
}

HWY_INLINE void StoreColors(const SetupInput& in, const VertexLayout& layout, int i, PlaneMaker& maker, SetupBatch& out) {
  const DD d;
  const bool near = hn::AllTrue(d, maker.ColorsAreNear());
  for (int a = layout.color; a < layout.color + 4; ++a) {
    VD value[3];
    for (int k = 0; k < 3; ++k) value[k] = hn::Mul(LoadAttribute(in, layout, a, k, i), hn::Set(d, 255.0));
    if (HWY_LIKELY(near)) {
      VD weighted[3];
      maker.Weigh(value, false, weighted);
      maker.Store(weighted, 2 + a, i, out);
    } else {
      maker.StoreAttribute(value, 2 + a, i, false, hn::Set(d, kColorTolerance), out);
    }
  }
}

// Gives the variants.
HWY_INLINE VD SetPlanes(const SetupInput& in, const VertexLayout& layout, const FragmentParams& params,
                          const CornerVectors& v, bool with_depth, int i, SetupBatch& out) {
  const DD d;
  PlaneMaker maker(v);
  VD value[3];
  if (with_depth) {
    for (int k = 0; k < 3; ++k) value[k] = hn::Mul(v.z[k], hn::Set(d, kDepthScale));
    maker.Store(value, 0, i, out);
    hn::Store(hn::Add(hn::Load(d, out.f0[0] + i), hn::Set(d, 0.5)), d,
              out.f0[0] + i);  // truncation then rounds to nearest
  }
  if (!maker.all_affine || layout.projective) maker.StoreInvW(i, out);
  if (layout.color >= 0) StoreColors(in, layout, i, maker, out);
  if (layout.tex_coord >= 0) {
    const double size[3] = {static_cast<double>(params.levels[0].width),
                            static_cast<double>(params.levels[0].height), 1};
    const Wrap wrap[3] = {params.sampler.wrap_s, params.sampler.wrap_t, Wrap::clamp};
    for (int a = 0; a < (layout.projective ? 3 : 2); ++a) {
      for (int k = 0; k < 3; ++k) value[k] = LoadAttribute(in, layout, layout.tex_coord + a, k, i);
      if (!layout.projective && wrap[a] == Wrap::repeat) {
        const VD turns = WholeTurns(maker.inv_w, params.level_count > 1, value);
        for (VD& corner : value) corner = hn::Sub(corner, turns);
      }
      maker.StoreAttribute(value, 2 + layout.tex_coord + a, i, layout.projective,
                           hn::Set(d, kTexelTolerance / size[a]), out);
    }
  }
  if (layout.fog >= 0) {
    for (int k = 0; k < 3; ++k) value[k] = LoadAttribute(in, layout, layout.fog, k, i);
    maker.StoreAttribute(value, 2 + layout.fog, i, false, hn::Set(d, kColorTolerance * params.fog.level_span),
                         out);
  }
  if (layout.projective) maker.needs_double = hn::Eq(maker.scale, maker.scale);
  else if (!hn::AllFalse(d, maker.needs_double)) LookCloser(layout, params, v, i, out, maker);
  if (HWY_UNLIKELY(params.plane_rule != PlaneRule::by_bound)) ApplyPlaneRule(params, maker);
  // Variant bits by way of integers: one small number a lane.
  const VD bits = hn::Add(hn::IfThenElseZero(maker.affine, hn::Set(d, static_cast<double>(kAffine))),
                          hn::IfThenElseZero(maker.needs_double, hn::Set(d, static_cast<double>(kDouble))));
  alignas(64) int32_t variant[kSetupLanes];
  StoreInt(bits, variant);
  for (int k = 0; k < kDoubleLanes; ++k) out.variant[i + k] = static_cast<uint8_t>(variant[k]);
  return bits;
}

HWY_INLINE void SetFlatColor(const Segment& segment, const DrawRecord& draw, const PrimitiveRef& ref,
                             int lane, SetupBatch& out) {
  const uint32_t vertex =
      ref.cut ? segment.plane_sources.data()[ref.v[2]].provoking : ref.v[ref.provoking];
  const VertexLayout& layout = draw.vertices.layout;
  const int place = ref.back_facing && layout.back_color >= 0 ? layout.back_color : layout.color;
  const float* color = Attributes(Head(draw.vertices, layout.stride(), vertex)) + place;
  for (int k = 0; k < 4; ++k) {
    out.flat[k][lane] = color_level(color[k], draw.program->params.rounds_to_bytes);
    const double rest = layout.low < 0 ? 0 : static_cast<double>(color[k + layout.low]);
    out.exact_flat[k][lane] = (static_cast<double>(color[k]) + rest) * 255.0;
  }
}

// The draft level's lambda (spec 3.8.8) of a whole primitive: at the middle of its corners.
HWY_INLINE float LambdaOf(const SetupInput& in, const FragmentParams& params, const VertexLayout& layout,
                          int lane, int32_t center_x, int32_t center_y, const SetupBatch& s) {
  constexpr double kThird = 1.0 / (3 * kSubpixelScale);
  const int64_t sum_x = int64_t{in.x[0][lane]} + in.x[1][lane] + in.x[2][lane] - 3 * int64_t{center_x};
  const int64_t sum_y = int64_t{in.y[0][lane]} + in.y[1][lane] + in.y[2][lane] - 3 * int64_t{center_y};
  const double x = static_cast<double>(sum_x) * kThird + s.anchor_x[lane];
  const double y = static_cast<double>(sum_y) * kThird + s.anchor_y[lane];
  const int first = params.tex_plane, divisor = layout.projective ? first + 2 : 1;
  const bool affine = !layout.projective && (s.variant[lane] & kAffine) != 0;
  const auto at = [&](int plane) HWY_ATTR {
    return (s.f0[plane][lane] + s.dfdy[plane][lane] * y) + s.dfdx[plane][lane] * x;
  };
  const double q = affine ? 1 : at(divisor);
  double x2 = 0, y2 = 0;
  for (int axis = 0; axis < 2; ++axis) {
    const int p = first + axis;
    const double value = affine ? 0 : at(p) / q;
    const double gx =
        (s.dfdx[p][lane] - (affine ? 0 : value * s.dfdx[divisor][lane])) / q * params.lod_scale[axis];
    const double gy =
        (s.dfdy[p][lane] - (affine ? 0 : value * s.dfdy[divisor][lane])) / q * params.lod_scale[axis];
    x2 += gx * gx;
    y2 += gy * gy;
  }
  const double rho2 = x2 > y2 ? x2 : y2;
  return static_cast<float>(0.5 * ExactLog2(rho2 > 1e-30 ? (rho2 < 1e30 ? rho2 : 1e30) : 1e-30));
}

// Moves a filled polygon's depth (spec 3.5.5). Lines and points of polygons bring their offset along.
HWY_INLINE void OffsetDepth(const PolygonState& polygon, int lane, SetupBatch& out) {
  const double gx = out.dfdx[0][lane] < 0 ? -out.dfdx[0][lane] : out.dfdx[0][lane];
  const double gy = out.dfdy[0][lane] < 0 ? -out.dfdy[0][lane] : out.dfdy[0][lane];
  out.f0[0][lane] += depth_offset(polygon, gx > gy ? gx : gy);
}

// What the attributes' floats have left of doubles (VertexLayout::low).
HWY_NOINLINE void LoadLowParts(const Segment& segment, const ShadedVertices& vertices, const uint32_t* ids,
                               int first, int count, SetupInput& in) {
  const VertexLayout& layout = vertices.layout;
  for (int lane = first; lane < first + count; ++lane) {
    const PrimitiveRef& ref = segment.primitives.data()[ids[lane]];
    if (ref.cut) continue;
    const bool back = ref.back_facing && layout.back_color >= 0;
    VertexHead made[3];
    const VertexHead* v[3];
    FindCorners(segment, vertices, layout.stride(), ref, made, v);
    for (int k = 0; k < 3; ++k) {
      int j = 0;  // the corner that has come to stand here
      while (j < 2 && (v[j]->x != in.x[k][lane] || v[j]->y != in.y[k][lane])) ++j;
      const float* attributes = Attributes(v[j] == &made[j] ? v[0] : v[j]);
      for (int a = 0; a < layout.attribute_count; ++a)
        in.low[a][k][lane] = static_cast<double>(attributes[layout.place(a, back) + layout.low]);
    }
  }
}

// What is made from one primitive after the other, where a draw asks for it.
HWY_NOINLINE void FinishLanes(const Segment& segment, const DrawRecord& draw, const uint32_t* ids, int count,
                              int32_t center_x, int32_t center_y, const SetupInput& in, SetupBatch& out) {
  const VertexLayout& layout = draw.vertices.layout;
  const FragmentParams& params = draw.program->params;
  const bool flat = layout.color >= 0 && draw.program->flat_shading;
  for (int lane = 0; lane < count; ++lane) {
    const PrimitiveRef& ref = segment.primitives.data()[ids[lane]];
    if (flat) SetFlatColor(segment, draw, ref, lane, out);
    if (params.one_lambda) out.lambda[lane] = LambdaOf(in, params, layout, lane, center_x, center_y, out);
    if (draw.shape.offset_fill && ref.kind <= PrimitiveKind::smooth_triangle)
      OffsetDepth(draw.state->polygon, lane, out);
  }
}

HWY_INLINE void SetAnchor(const CornerVectors& v, int i, VD center_x, VD center_y, SetupBatch& out) {
  const DD d;
  const VD pixel = hn::Set(d, 1.0 / kSubpixelScale);
  const VD x = hn::Mul(hn::Sub(center_x, v.x[0]), pixel), y = hn::Mul(hn::Sub(center_y, v.y[0]), pixel);
  hn::Store(x, d, out.anchor_x + i);
  hn::Store(y, d, out.anchor_y + i);
  const DDf f;
  hn::Store(hn::DemoteTo(f, x), f, out.anchor_x_f + i);
  hn::Store(hn::DemoteTo(f, y), f, out.anchor_y_f + i);
}

// What set-up makes of the corners of a batch, which lie as `from` knows.
template <class Corners>
HWY_INLINE void SetUpCorners(const Corners& from, const Segment& segment, const DrawRecord& draw, const uint32_t* ids,
                             int count, int32_t center_x, int32_t center_y, const Rect& limit, SetupInput& in,
                             SetupBatch& out) {
  const DD d;
  const VertexLayout& layout = draw.vertices.layout;
  const FragmentParams& params = draw.program->params;
  const QuadPlan quads(layout.attribute_count);
  const VD cx = hn::Set(d, static_cast<double>(center_x)), cy = hn::Set(d, static_cast<double>(center_y));
  for (int i = 0; i < count; i += kDoubleLanes) {
    CornerVectors v;
    SpreadCorners(from, quads, layout.attribute_count, i, v, in);
    if (HWY_UNLIKELY(layout.low >= 0 || params.one_lambda)) StorePlaces(v, i, in);
    if (HWY_UNLIKELY(layout.low >= 0)) {
      const int left = count - i;
      LoadLowParts(segment, draw.vertices, ids, i, left < kDoubleLanes ? left : kDoubleLanes, in);
    }
    SetCoverage(v, i, Corners::kPlain, center_x, center_y, limit, out);
    SetAnchor(v, i, cx, cy, out);
    SetPlanes(in, layout, params, v, true, i, out);
  }
}

// Fills `out` for the primitives ids[0 .. count) of `segment`, all of one draw. `limit`: the draw's bounds
// relative to the tile whose lowest pixel is (tile_x, tile_y).
void SetUp(const Segment& segment, const DrawRecord& draw, const uint32_t* ids, const BatchRefs& refs, int count,
           int tile_x, int tile_y, const Rect& limit, SetupInput& in, SetupBatch& out) {
  const VertexLayout& layout = draw.vertices.layout;
  const size_t stride = layout.stride();
  const int32_t center_x = tile_x * kSubpixelScale + kSubpixelScale / 2;
  const int32_t center_y = tile_y * kSubpixelScale + kSubpixelScale / 2;
#if HALFSPACE_DIRECT_CORNERS
  // With the colours that come first.
  if (HWY_LIKELY(refs.triangles && !(refs.any_back && layout.back_color >= 0))) {
    const auto set_up = [&](const auto& at) HWY_ATTR {
      SetUpCorners(DirectCorners{at}, segment, draw, ids, count, center_x, center_y, limit, in, out);
    };
    if (HWY_LIKELY(refs.cut == 0)) set_up(refs.at);
    else set_up(CutCorners(segment, refs, ids, count).at);
  } else
#endif
  {
    const QuadPlan quads(layout.attribute_count);
    for (int lane = 0; lane < count; ++lane)
      CopyCorners(segment, draw.vertices, stride, segment.primitives.data()[ids[lane]], quads, lane, in);
    SetUpCorners(StagedCorners{in}, segment, draw, ids, count, center_x, center_y, limit, in, out);
  }
  const bool flat = layout.color >= 0 && draw.program->flat_shading;
  for (unsigned todo = refs.cut & ((1u << count) - 1); HWY_UNLIKELY(todo != 0); todo &= todo - 1) {
    const int lane = __builtin_ctz(todo);
    const PlaneSource& planes = segment.plane_sources.data()[segment.primitives.data()[ids[lane]].v[2]];
    TakeSettled(planes, 2 + layout.attribute_count, center_x, center_y, lane, out);
  }
  if (flat || draw.shape.offset_fill || draw.program->params.one_lambda)
    FinishLanes(segment, draw, ids, count, center_x, center_y, in, out);
}
