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
  // Corners as they lay in memory, of batches whose primitives are not all plain triangles: a head is four words,
  // attributes come in quads as QuadPlan says.
  alignas(64) VertexHead head[3][kSetupLanes];
  alignas(64) float quad[3][kAttributeQuads][kSetupLanes][4];
  alignas(64) uint64_t in_order[kSetupLanes];  // not 0: corners are in the order they are wanted in
  // A column a value, in the order set-up wants the corners in.
  alignas(64) float attribute[kMaxPlanes - 2][3][kSetupLanes];
  // The same, where somebody asks for them only: positions, and what the attributes' floats have left of doubles.
  alignas(64) int32_t x[3][kSetupLanes], y[3][kSetupLanes];
  alignas(64) double low[kMaxPlanes - 2][3][kSetupLanes];

  HWY_INLINE void Clear() {
    memset(head, 0, sizeof head);
    memset(quad, 0, sizeof quad);
    memset(in_order, 0, sizeof in_order);
  }
};

// Corners of a group of lanes, in the order set-up wants them in.
using VDi = hn::Vec<DDi>;
struct CornerVectors {
  VDi place_x[3], place_y[3];           // 16.8
  VD x[3], y[3], rest_x[3], rest_y[3];  // 1/256 px
  VD z[3], inv_w[3];
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

// The reference vertex is the one farthest from the eye, of those the lowest, of those the leftmost; the others follow
// counter-clockwise. So planes and edges depend on where the corners are, not on the order they were given in. Farthest
// since there 1/w is least, and floats round least where they start from.
struct CornerOrder {
  hn::Mask<DD> clockwise, second_first, third_first;

  HWY_INLINE CornerOrder(const VD x[3], const VD y[3], const VD w[3]) {
    const DD d;
    const VD area = hn::Sub(hn::Mul(hn::Sub(x[1], x[0]), hn::Sub(y[2], y[0])),
                            hn::Mul(hn::Sub(x[2], x[0]), hn::Sub(y[1], y[0])));
    clockwise = hn::Lt(area, hn::Zero(d));
    const VD xb = hn::IfThenElse(clockwise, x[2], x[1]), xc = hn::IfThenElse(clockwise, x[1], x[2]);
    const VD yb = hn::IfThenElse(clockwise, y[2], y[1]), yc = hn::IfThenElse(clockwise, y[1], y[2]);
    const VD wb = hn::IfThenElse(clockwise, w[2], w[1]), wc = hn::IfThenElse(clockwise, w[1], w[2]);
    const auto b_first = IsBefore(xb, yb, wb, x[0], y[0], w[0]), c_first = IsBefore(xc, yc, wc, x[0], y[0], w[0]);
    second_first = hn::AndNot(IsBefore(xc, yc, wc, xb, yb, wb), b_first);
    third_first = hn::AndNot(second_first, c_first);
  }

  // Corners of these lanes are in order.
  HWY_INLINE void Except(hn::Mask<DD> in_order) {
    for (hn::Mask<DD>* move : {&clockwise, &second_first, &third_first}) *move = hn::AndNot(in_order, *move);
  }

  HWY_INLINE void Apply(VD v[3]) const { Apply(clockwise, second_first, third_first, v); }
  HWY_INLINE void Apply(hn::Vec<DDf> v[3]) const {
    Apply(OfFloats(clockwise), OfFloats(second_first), OfFloats(third_first), v);
  }
  HWY_INLINE void Apply(VDi v[3]) const {
    hn::Vec<DDf> words[3];
    for (int k = 0; k < 3; ++k) words[k] = hn::BitCast(DDf(), v[k]);
    Apply(words);
    for (int k = 0; k < 3; ++k) v[k] = hn::BitCast(DDi(), words[k]);
  }

 private:
  static HWY_INLINE hn::Mask<DDf> OfFloats(hn::Mask<DD> mask) {
#if HWY_TARGET == HWY_AVX3
    return hn::Mask<DDf>{mask.raw};
#else
    return hn::MaskFromVec(LowHalf(DDf(), hn::VecFromMask(DD(), mask)));
#endif
  }

  template <class Mask, class V>
  static HWY_INLINE void Apply(Mask clockwise, Mask second_first, Mask third_first, V v[3]) {
    const V a = v[0], b = hn::IfThenElse(clockwise, v[2], v[1]), c = hn::IfThenElse(clockwise, v[1], v[2]);
    v[0] = hn::IfThenElse(second_first, b, hn::IfThenElse(third_first, c, a));
    v[1] = hn::IfThenElse(second_first, c, hn::IfThenElse(third_first, a, b));
    v[2] = hn::IfThenElse(second_first, a, hn::IfThenElse(third_first, b, c));
  }

  // aw, bw: 1/w.
  static HWY_INLINE hn::Mask<DD> IsBefore(VD ax, VD ay, VD aw, VD bx, VD by, VD bw) {
    const auto below = hn::Or(hn::Lt(ay, by), hn::And(hn::Eq(ay, by), hn::Lt(ax, bx)));
    return hn::Or(hn::Lt(aw, bw), hn::And(hn::Eq(aw, bw), below));
  }
};

HWY_INLINE hn::Mask<DD> NoLane() { return hn::MaskFromVec(hn::Zero(DD())); }

// Whether plain triangles' corners are taken straight from the vertices' records.
#undef HALFSPACE_DIRECT_CORNERS
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
#define HALFSPACE_DIRECT_CORNERS 1
#else
#define HALFSPACE_DIRECT_CORNERS 0
#endif

// What the references of a batch say: where its vertices lie, and what its primitives have in common.
struct BatchRefs {
  // Of a cut primitive, nowhere.
  alignas(64) const unsigned char* at[3][kSetupLanes];
  bool triangles;  // and nothing else; whole or cut
  bool any_back;
  unsigned cut;  // bits of the lanes that are, beyond the last one also

  // Lanes beyond `count` are as the first one, so that they can be computed with.
  HWY_INLINE void Read(const Segment& segment, const ShadedVertices& vertices, size_t stride, const uint32_t* ids,
                       int count) {
    uint32_t some[kSetupLanes];
    if (HWY_UNLIKELY(count < kSetupLanes)) {
      for (int lane = 0; lane < kSetupLanes; ++lane) some[lane] = ids[lane < count ? lane : 0];
      ids = some;
    }
    ReadAll(segment.primitives.data(), reinterpret_cast<const unsigned char*>(vertices.records), stride, ids);
  }

 private:
#if HALFSPACE_DIRECT_CORNERS
  HWY_INLINE void ReadAll(const PrimitiveRef* refs, const unsigned char* records, size_t stride, const uint32_t* ids) {
    const auto one = [&](int lane) HWY_ATTR { return _mm_loadu_si128(reinterpret_cast<const __m128i*>(refs + ids[lane])); };
    const auto two = [&](int a, int b)
                         HWY_ATTR { return _mm256_inserti128_si256(_mm256_castsi128_si256(one(a)), one(b), 1); };
    const __m256i a = two(0, 4), b = two(1, 5), c = two(2, 6), e = two(3, 7);
    const __m256i low_ab = _mm256_unpacklo_epi32(a, b), low_ce = _mm256_unpacklo_epi32(c, e);
    const __m256i high_ab = _mm256_unpackhi_epi32(a, b), high_ce = _mm256_unpackhi_epi32(c, e);
    Place(_mm256_unpacklo_epi64(low_ab, low_ce), records, stride, at[0]);
    Place(_mm256_unpackhi_epi64(low_ab, low_ce), records, stride, at[1]);
    Place(_mm256_unpacklo_epi64(high_ab, high_ce), records, stride, at[2]);
    const __m256i traits = _mm256_unpackhi_epi64(high_ab, high_ce);  // a byte each, as they stand in PrimitiveRef
    const auto any = [&](int bits) HWY_ATTR { return _mm256_testz_si256(traits, _mm256_set1_epi32(bits)) == 0; };
    static_assert(offsetof(PrimitiveRef, kind) == 12 && PrimitiveKind{} == PrimitiveKind::triangle);
    triangles = !any(0xff), any_back = any(0xff0000);
    // Of a bool, its one bit where a float's sign is.
    static_assert(offsetof(PrimitiveRef, cut) == 13 && sizeof(bool) == 1);
    cut = static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(_mm256_slli_epi32(traits, 31 - 8))));
  }

  static HWY_INLINE void Place(__m256i vertex, const unsigned char* records, size_t stride, const unsigned char** out) {
    const auto first = static_cast<long long>(reinterpret_cast<uintptr_t>(records)), step = static_cast<long long>(stride);
#if HWY_TARGET == HWY_AVX3
    const __m512i offset = _mm512_mul_epu32(_mm512_cvtepu32_epi64(vertex), _mm512_set1_epi64(step));
    _mm512_store_si512(out, _mm512_add_epi64(offset, _mm512_set1_epi64(first)));
#else
    for (int half = 0; half < 2; ++half) {
      const __m128i four = half == 0 ? _mm256_castsi256_si128(vertex) : _mm256_extracti128_si256(vertex, 1);
      const __m256i offset = _mm256_mul_epu32(_mm256_cvtepu32_epi64(four), _mm256_set1_epi64x(step));
      _mm256_store_si256(reinterpret_cast<__m256i*>(out + half * 4), _mm256_add_epi64(offset, _mm256_set1_epi64x(first)));
    }
#endif
  }
#else
  HWY_INLINE void ReadAll(const PrimitiveRef* refs, const unsigned char* records, size_t stride, const uint32_t* ids) {
    triangles = true, any_back = false, cut = 0;
    for (int lane = 0; lane < kSetupLanes; ++lane) {
      const PrimitiveRef& ref = refs[ids[lane]];
      triangles &= ref.kind == PrimitiveKind::triangle;
      cut |= unsigned{ref.cut} << lane;
      any_back |= ref.back_facing;
      for (int k = 0; k < 3; ++k) at[k][lane] = records + ref.v[k] * stride;
    }
  }
#endif
};

// Corners of a batch as SetupInput has them.
struct StagedCorners {
  static constexpr bool kPlain = false;
  const SetupInput& in;

  HWY_INLINE void KeepOrdered(int i, CornerOrder& order) const {
    const hn::RebindToUnsigned<DD> words;
    order.Except(hn::RebindMask(DD(), hn::Ne(hn::Load(words, in.in_order + i), hn::Zero(words))));
  }
  HWY_INLINE void Heads(int k, int i, VD out[4]) const {
    hn::LoadInterleaved4(DD(), reinterpret_cast<const double*>(in.head[k] + i), out[0], out[1], out[2], out[3]);
  }
  HWY_INLINE void Quad(const QuadPlan&, int q, int k, int i, hn::Vec<DDf> out[4]) const {
    hn::LoadInterleaved4(DDf(), in.quad[k][q][i], out[0], out[1], out[2], out[3]);
  }
};

#if HALFSPACE_DIRECT_CORNERS
// Corners of a batch of triangles where they lie: nothing is stored narrow to be read wide.
struct DirectCorners {
  static constexpr bool kPlain = true;
  const unsigned char* const (&at)[3][kSetupLanes];

  HWY_INLINE void KeepOrdered(int, CornerOrder&) const {}

#if HWY_TARGET == HWY_AVX3
  HWY_INLINE void Heads(int k, int, VD out[4]) const {
    const auto two = [&](int a, int b) HWY_ATTR {
      const __m256d low = _mm256_loadu_pd(reinterpret_cast<const double*>(at[k][a]));
      return _mm512_insertf64x4(_mm512_castpd256_pd512(low),
                                _mm256_loadu_pd(reinterpret_cast<const double*>(at[k][b])), 1);
    };
    const __m512d a = two(0, 2), b = two(1, 3), c = two(4, 6), e = two(5, 7);
    const __m512d low_ab = _mm512_unpacklo_pd(a, b), low_ce = _mm512_unpacklo_pd(c, e);
    const __m512d high_ab = _mm512_unpackhi_pd(a, b), high_ce = _mm512_unpackhi_pd(c, e);
    out[0] = VD{_mm512_shuffle_f64x2(low_ab, low_ce, 0x88)}, out[2] = VD{_mm512_shuffle_f64x2(low_ab, low_ce, 0xdd)};
    out[1] = VD{_mm512_shuffle_f64x2(high_ab, high_ce, 0x88)}, out[3] = VD{_mm512_shuffle_f64x2(high_ab, high_ce, 0xdd)};
  }
  HWY_INLINE void Quad(const QuadPlan& quads, int q, int k, int, hn::Vec<DDf> out[4]) const {
    const auto after = static_cast<ptrdiff_t>(sizeof(VertexHead)) + quads.Start(q) * ptrdiff_t{sizeof(float)};
    const auto two = [&](int a, int b) HWY_ATTR {
      const __m128 low = _mm_loadu_ps(reinterpret_cast<const float*>(at[k][a] + after));
      return _mm256_insertf128_ps(_mm256_castps128_ps256(low),
                                  _mm_loadu_ps(reinterpret_cast<const float*>(at[k][b] + after)), 1);
    };
    const __m256 a = two(0, 4), b = two(1, 5), c = two(2, 6), e = two(3, 7);
    const __m256 low_ac = _mm256_unpacklo_ps(a, c), low_be = _mm256_unpacklo_ps(b, e);
    const __m256 high_ac = _mm256_unpackhi_ps(a, c), high_be = _mm256_unpackhi_ps(b, e);
    out[0].raw = _mm256_unpacklo_ps(low_ac, low_be), out[1].raw = _mm256_unpackhi_ps(low_ac, low_be);
    out[2].raw = _mm256_unpacklo_ps(high_ac, high_be), out[3].raw = _mm256_unpackhi_ps(high_ac, high_be);
  }
#else
  HWY_INLINE void Heads(int k, int i, VD out[4]) const {
    const auto one = [&](int j) HWY_ATTR { return _mm256_loadu_pd(reinterpret_cast<const double*>(at[k][i + j])); };
    const __m256d a = one(0), b = one(1), c = one(2), e = one(3);
    const __m256d low_ab = _mm256_unpacklo_pd(a, b), low_ce = _mm256_unpacklo_pd(c, e);
    const __m256d high_ab = _mm256_unpackhi_pd(a, b), high_ce = _mm256_unpackhi_pd(c, e);
    out[0].raw = _mm256_permute2f128_pd(low_ab, low_ce, 0x20), out[2].raw = _mm256_permute2f128_pd(low_ab, low_ce, 0x31);
    out[1].raw = _mm256_permute2f128_pd(high_ab, high_ce, 0x20);
    out[3].raw = _mm256_permute2f128_pd(high_ab, high_ce, 0x31);
  }
  HWY_INLINE void Quad(const QuadPlan& quads, int q, int k, int i, hn::Vec<DDf> out[4]) const {
    const auto after = static_cast<ptrdiff_t>(sizeof(VertexHead)) + quads.Start(q) * ptrdiff_t{sizeof(float)};
    const auto one = [&](int j) HWY_ATTR { return _mm_loadu_ps(reinterpret_cast<const float*>(at[k][i + j] + after)); };
    __m128 a = one(0), b = one(1), c = one(2), e = one(3);
    _MM_TRANSPOSE4_PS(a, b, c, e);
    out[0].raw = a, out[1].raw = b, out[2].raw = c, out[3].raw = e;
  }
#endif
};

// Where the corners of a batch with cut triangles lie: theirs are made here. Nobody looks at their attributes.
struct CutCorners {
  struct Made {
    alignas(64) uint64_t head[4];  // a VertexHead
    float attributes[kMaxPlanes - 2];
  };
  alignas(64) const unsigned char* at[3][kSetupLanes];
  Made made[3][kSetupLanes];

  HWY_INLINE CutCorners(const Segment& segment, const BatchRefs& refs, const uint32_t* ids, int count) {
    memcpy(at, refs.at, sizeof at);
    for (unsigned todo = refs.cut; todo != 0; todo &= todo - 1) {
      const int lane = __builtin_ctz(todo);
      const PrimitiveRef& ref = segment.primitives.data()[ids[lane < count ? lane : 0]];
      Make(segment.plane_sources.data()[ref.v[2]], lane);
    }
  }

 private:
  HWY_INLINE void Make(const PlaneSource& cut, int lane) {
    const __m256i rest = _mm256_castpd_si256(_mm256_setr_pd(0, 0, 1, 0));  // 1/w is 1
    for (int k = 0; k < 3; ++k) {
      const uint64_t place = static_cast<uint32_t>(cut.x[k]) | uint64_t{static_cast<uint32_t>(cut.y[k])} << 32;
      const __m128i first = _mm_cvtsi64_si128(static_cast<int64_t>(place));
      _mm256_store_si256(reinterpret_cast<__m256i*>(made[k][lane].head), _mm256_inserti128_si256(rest, first, 0));
      _mm256_store_ps(made[k][lane].attributes, _mm256_setzero_ps());
      at[k][lane] = reinterpret_cast<const unsigned char*>(&made[k][lane]);
    }
  }
};
#endif

// Lanes [i, i + kDoubleLanes) from where they lie, `from`, to vectors, and attributes to columns of `in`.
template <class Corners>
HWY_INLINE void SpreadCorners(const Corners& from, const QuadPlan& quads, int attributes, int i, CornerVectors& v,
                              SetupInput& in) {
  const DD d;
  const DDi di;
  const DDf df;
  VD rest[3];
  for (int k = 0; k < 3; ++k) {
    VD words[4];
    from.Heads(k, i, words);
    v.z[k] = words[1], v.inv_w[k] = words[2], rest[k] = words[3];
    v.place_x[k] = LowHalf(di, words[0]), v.place_y[k] = HighHalf(di, words[0]);
    v.x[k] = hn::PromoteTo(d, v.place_x[k]), v.y[k] = hn::PromoteTo(d, v.place_y[k]);
  }
  CornerOrder order(v.x, v.y, v.inv_w);
  from.KeepOrdered(i, order);
  order.Apply(v.place_x), order.Apply(v.place_y), order.Apply(v.z), order.Apply(v.inv_w), order.Apply(rest);
  for (int k = 0; k < 3; ++k) {
    v.x[k] = hn::PromoteTo(d, v.place_x[k]), v.y[k] = hn::PromoteTo(d, v.place_y[k]);
    v.rest_x[k] = hn::PromoteTo(d, LowHalf(df, rest[k]));
    v.rest_y[k] = hn::PromoteTo(d, HighHalf(df, rest[k]));
  }
  for (int q = 0; q < quads.count; ++q) {
    hn::Vec<DDf> quad[3][4];
    for (int k = 0; k < 3; ++k) from.Quad(quads, q, k, i, quad[k]);
    for (int f = 0; f < 4; ++f) {
      const int a = quads.Start(q) + f;
      if (a < 4 * q || a >= attributes) continue;
      hn::Vec<DDf> value[3] = {quad[0][f], quad[1][f], quad[2][f]};
      order.Apply(value);
      for (int k = 0; k < 3; ++k) hn::Store(value[k], df, in.attribute[a][k] + i);
    }
  }
}

// How far ahead of the vertices a primitive is asked for.
inline constexpr size_t kRefsAhead = kSetupLanes;

// As PrefetchCorners, of one point.
HWY_INLINE void PrefetchPoint(const Segment& segment, const ShadedVertices& vertices, const uint32_t* ids, size_t at,
                              size_t total) {
  const PrimitiveRef* primitives = segment.primitives.data();
  if (at + kRefsAhead < total) __builtin_prefetch(primitives + ids[at + kRefsAhead]);
  if (at < total) __builtin_prefetch(Head(vertices, vertices.layout.stride(), primitives[ids[at]].v[0]));
}

HWY_INLINE void PrefetchCut(const Segment& segment, const PrimitiveRef& ref) {
  const auto* planes = reinterpret_cast<const char*>(segment.plane_sources.data() + ref.v[2]);
  for (int k = 0; k < 3; ++k) __builtin_prefetch(planes + k * 64);
}

// Asks for what the next batch's `count` primitives ids[at ...], of `total`, are made from while this one is drawn.
HWY_INLINE void PrefetchCorners(const Segment& segment, const BatchRefs& refs, const uint32_t* ids, size_t at, size_t total,
                                int count) {
  const PrimitiveRef* primitives = segment.primitives.data();
  for (size_t i = at + kRefsAhead; i < at + 2 * kRefsAhead && i < total; ++i) __builtin_prefetch(primitives + ids[i]);
  // Of what is cut, somewhere, too: a branch would cost more.
  for (int k = 0; k < 3; ++k)
    for (int lane = 0; lane < kSetupLanes; ++lane) __builtin_prefetch(refs.at[k][lane]);
  const unsigned lanes = (1u << count) - 1;
  for (unsigned todo = refs.cut & lanes; HWY_UNLIKELY(todo != 0); todo &= todo - 1)
    PrefetchCut(segment, primitives[ids[at + static_cast<size_t>(__builtin_ctz(todo))]]);
}
