// Set-up, first half: corners and attribute values of eight primitives, from records to columns.

using DD = hn::CappedTag<double, kSetupLanes>;
using DDi = hn::Rebind<int32_t, DD>;  // as many int32 lanes as DD has doubles
using DDf = hn::Rebind<float, DD>;
using VD = hn::Vec<DD>;
inline constexpr int kDoubleLanes = static_cast<int>(hn::MaxLanes(DD()));

// Attributes are taken in whole quads of floats. The last ends where the attributes end: a quad more than half filled
// begins in what stands before, so that nothing behind a record is read.
inline constexpr int kAttributeQuads = (kMaxPlanes - 2 + 3) / 4;
struct QuadPlan {
  int count, last;  // quads, and the float the last one starts at; less than 0: in the head
  HWY_INLINE explicit QuadPlan(int attributes) : count((attributes + 3) / 4), last(attributes - 4) {}
  HWY_INLINE int Start(int quad) const { return quad == count - 1 ? last : 4 * quad; }
};

struct SetupInput {
  // Corners as they lay in memory: a head is four words, attributes come in quads as QuadPlan says.
  alignas(64) VertexHead head[3][kSetupLanes];
  alignas(64) float quad[3][kAttributeQuads][kSetupLanes][4];
  alignas(64) uint64_t in_order[kSetupLanes];  // not 0: corners are in the order they are wanted in
  // The same a column a value, in the order set-up wants the corners in.
  alignas(64) int32_t x[3][kSetupLanes], y[3][kSetupLanes];
  alignas(64) double rest_x[3][kSetupLanes], rest_y[3][kSetupLanes];
  alignas(64) double z[3][kSetupLanes], inv_w[3][kSetupLanes];
  alignas(64) double attribute[kMaxPlanes - 2][3][kSetupLanes];

  HWY_INLINE void Clear() {
    memset(head, 0, sizeof head);
    memset(quad, 0, sizeof quad);
    memset(in_order, 0, sizeof in_order);
  }
};

HWY_INLINE const VertexHead* Head(const ShadedVertices& vertices, size_t stride, uint32_t i) {
  return reinterpret_cast<const VertexHead*>(vertices.records + i * stride);
}
HWY_INLINE const float* Attributes(const VertexHead* head) { return reinterpret_cast<const float*>(head + 1); }

// Of corners that are made, in the order they are wanted in.
HWY_INLINE bool Below(const VertexHead* a, const VertexHead* b) {
  return a->y < b->y || (a->y == b->y && a->x < b->x);
}

// Corners that are not the draw's own vertices lie in `made`: those of a cut primitive, and the third one of a line. A
// line's planes have their gradient along it: a corner at right angles, as snapped and as it was before, with the first
// one's values, makes the triangle's formula the line's. A point gets two such corners. False: set-up is to choose the
// corners' order.
HWY_INLINE bool FindCorners(const Segment& segment, const ShadedVertices& vertices, size_t stride,
                            const PrimitiveRef& ref, VertexHead made[3], const VertexHead* v[3]) {
  const int given = ref.kind <= PrimitiveKind::smooth_triangle ? 3 : (ref.kind == PrimitiveKind::line ? 2 : 1);
  for (int k = 0; k < given; ++k) {
    if (ref.cut) {
      const CutTriangle& cut = segment.cut_triangles.data()[ref.v[0]];
      made[k] = {cut.x[k], cut.y[k], 0, 1, 0, 0};
      v[k] = &made[k];
    } else {
      v[k] = Head(vertices, stride, ref.v[k]);
    }
  }
  if (given == 3) return false;
  if (given == 2) {
    if (Below(v[1], v[0])) {
      const VertexHead* first = v[1];
      v[1] = v[0];
      v[0] = first;
    }
    made[2] = {v[0]->x - (v[1]->y - v[0]->y), v[0]->y + (v[1]->x - v[0]->x), v[0]->z, v[0]->inv_w,
               v[0]->rest_x - (v[1]->rest_y - v[0]->rest_y), v[0]->rest_y + (v[1]->rest_x - v[0]->rest_x)};
  } else {
    made[1] = {v[0]->x + kSubpixelScale, v[0]->y, v[0]->z, v[0]->inv_w, 0, 0};
    made[2] = {v[0]->x, v[0]->y + kSubpixelScale, v[0]->z, v[0]->inv_w, 0, 0};
    v[1] = &made[1];
  }
  v[2] = &made[2];
  return true;
}

HWY_INLINE void CopyQuads(const VertexHead* head, const QuadPlan& quads, int corner, int lane, SetupInput& in) {
  const auto* after = reinterpret_cast<const unsigned char*>(head + 1);
  for (int q = 0; q < quads.count; ++q)
    memcpy(in.quad[corner][q][lane], after + quads.Start(q) * static_cast<int>(sizeof(float)), 4 * sizeof(float));
}

// A back-facing primitive's colour stands behind the attributes. Colours are the first ones, and the first quad.
HWY_INLINE void CopyBackColor(const VertexHead* head, const VertexLayout& layout, int corner, int lane, SetupInput& in) {
  memcpy(in.quad[corner][0][lane], Attributes(head) + layout.back_color, 4 * sizeof(float));
}

// A primitive's corners as they are. A cut one brings its planes along: its attributes are not asked for. A made corner
// has the first one's.
HWY_INLINE void CopyCorners(const Segment& segment, const ShadedVertices& vertices, size_t stride,
                            const PrimitiveRef& ref, const QuadPlan& quads, int lane, SetupInput& in) {
  const bool back = ref.back_facing && vertices.layout.back_color >= 0;
  if (HWY_LIKELY(ref.kind == PrimitiveKind::triangle && !ref.cut)) {
    in.in_order[lane] = 0;
    for (int k = 0; k < 3; ++k) {
      const VertexHead* head = Head(vertices, stride, ref.v[k]);
      memcpy(&in.head[k][lane], head, sizeof *head);
      CopyQuads(head, quads, k, lane, in);
      if (HWY_UNLIKELY(back)) CopyBackColor(head, vertices.layout, k, lane, in);
    }
    return;
  }
  VertexHead made[3];
  const VertexHead* v[3];
  in.in_order[lane] = FindCorners(segment, vertices, stride, ref, made, v) ? 1 : 0;
  for (int k = 0; k < 3; ++k) {
    memcpy(&in.head[k][lane], v[k], sizeof *v[k]);
    if (ref.cut) continue;
    const VertexHead* head = v[k] == &made[k] ? v[0] : v[k];
    CopyQuads(head, quads, k, lane, in);
    if (back) CopyBackColor(head, vertices.layout, k, lane, in);
  }
}

// The reference vertex is the one farthest from the eye, of those the lowest, of those the leftmost; the others follow
// counter-clockwise. So planes and edges depend on where the corners are, not on the order they were given in. Farthest
// since there 1/w is least, and floats round least where they start from.
struct CornerOrder {
  hn::Mask<DD> clockwise, second_first, third_first;

  HWY_INLINE CornerOrder(const VD x[3], const VD y[3], const VD w[3], hn::Mask<DD> in_order) {
    const DD d;
    const VD area = hn::Sub(hn::Mul(hn::Sub(x[1], x[0]), hn::Sub(y[2], y[0])),
                            hn::Mul(hn::Sub(x[2], x[0]), hn::Sub(y[1], y[0])));
    clockwise = hn::AndNot(in_order, hn::Lt(area, hn::Zero(d)));
    const VD xb = hn::IfThenElse(clockwise, x[2], x[1]), xc = hn::IfThenElse(clockwise, x[1], x[2]);
    const VD yb = hn::IfThenElse(clockwise, y[2], y[1]), yc = hn::IfThenElse(clockwise, y[1], y[2]);
    const VD wb = hn::IfThenElse(clockwise, w[2], w[1]), wc = hn::IfThenElse(clockwise, w[1], w[2]);
    const auto b_first = IsBefore(xb, yb, wb, x[0], y[0], w[0]), c_first = IsBefore(xc, yc, wc, x[0], y[0], w[0]);
    second_first = hn::AndNot(in_order, hn::AndNot(IsBefore(xc, yc, wc, xb, yb, wb), b_first));
    third_first = hn::AndNot(in_order, hn::AndNot(second_first, c_first));
  }

  HWY_INLINE void Apply(VD v[3]) const {
    const VD a = v[0], b = hn::IfThenElse(clockwise, v[2], v[1]), c = hn::IfThenElse(clockwise, v[1], v[2]);
    v[0] = hn::IfThenElse(second_first, b, hn::IfThenElse(third_first, c, a));
    v[1] = hn::IfThenElse(second_first, c, hn::IfThenElse(third_first, a, b));
    v[2] = hn::IfThenElse(second_first, a, hn::IfThenElse(third_first, b, c));
  }

 private:
  // aw, bw: 1/w.
  static HWY_INLINE hn::Mask<DD> IsBefore(VD ax, VD ay, VD aw, VD bx, VD by, VD bw) {
    const auto below = hn::Or(hn::Lt(ay, by), hn::And(hn::Eq(ay, by), hn::Lt(ax, bx)));
    return hn::Or(hn::Lt(aw, bw), hn::And(hn::Eq(aw, bw), below));
  }
};

// The 32-bit halves of a word a lane.
template <class To>
HWY_INLINE hn::Vec<To> LowHalf(To to, VD word) {
  return hn::BitCast(to, hn::TruncateTo(hn::Rebind<uint32_t, DD>(), hn::BitCast(hn::RebindToUnsigned<DD>(), word)));
}
template <class To>
HWY_INLINE hn::Vec<To> HighHalf(To to, VD word) {
  const auto shifted = hn::ShiftRight<32>(hn::BitCast(hn::RebindToUnsigned<DD>(), word));
  return hn::BitCast(to, hn::TruncateTo(hn::Rebind<uint32_t, DD>(), shifted));
}

// Lanes [i, i + kDoubleLanes) from memory's order to columns.
HWY_INLINE void SpreadCorners(const QuadPlan& quads, int attributes, int i, SetupInput& in) {
  const DD d;
  const DDi di;
  const DDf df;
  VD place[3], z[3], inv_w[3], rest[3], x[3], y[3];
  for (int k = 0; k < 3; ++k) {
    hn::LoadInterleaved4(d, reinterpret_cast<const double*>(in.head[k] + i), place[k], z[k], inv_w[k], rest[k]);
    x[k] = hn::PromoteTo(d, LowHalf(di, place[k]));
    y[k] = hn::PromoteTo(d, HighHalf(di, place[k]));
  }
  const hn::RebindToUnsigned<DD> words;
  const auto in_order = hn::RebindMask(d, hn::Ne(hn::Load(words, in.in_order + i), hn::Zero(words)));
  const CornerOrder order(x, y, inv_w, in_order);
  order.Apply(place), order.Apply(z), order.Apply(inv_w), order.Apply(rest);
  for (int k = 0; k < 3; ++k) {
    hn::Store(LowHalf(di, place[k]), di, in.x[k] + i);
    hn::Store(HighHalf(di, place[k]), di, in.y[k] + i);
    hn::Store(z[k], d, in.z[k] + i);
    hn::Store(inv_w[k], d, in.inv_w[k] + i);
    hn::Store(hn::PromoteTo(d, LowHalf(df, rest[k])), d, in.rest_x[k] + i);
    hn::Store(hn::PromoteTo(d, HighHalf(df, rest[k])), d, in.rest_y[k] + i);
  }
  for (int q = 0; q < quads.count; ++q) {
    hn::Vec<DDf> v[3][4];
    for (int k = 0; k < 3; ++k) hn::LoadInterleaved4(df, in.quad[k][q][i], v[k][0], v[k][1], v[k][2], v[k][3]);
    for (int f = 0; f < 4; ++f) {
      const int a = quads.Start(q) + f;
      if (a < 4 * q || a >= attributes) continue;
      VD value[3] = {hn::PromoteTo(d, v[0][f]), hn::PromoteTo(d, v[1][f]), hn::PromoteTo(d, v[2][f])};
      order.Apply(value);
      for (int k = 0; k < 3; ++k) hn::Store(value[k], d, in.attribute[a][k] + i);
    }
  }
}

// Asks for the next batch's vertices while this one is drawn.
HWY_INLINE void PrefetchCorners(const Segment& segment, const ShadedVertices& vertices, size_t stride,
                                const uint32_t* ids, size_t count) {
  for (size_t lane = 0; lane < count; ++lane) {
    const PrimitiveRef& ref = segment.primitives.data()[ids[lane]];
    if (ref.cut) continue;
    for (int k = 0; k < 3; ++k) __builtin_prefetch(vertices.records + ref.v[k] * stride);
  }
}
