// Vectors and the group of lanes a stage works on. Compiled once per ISA level, inside its namespace.
//
// A group is kLanes neighbouring pixels of one row of the block (a whole row of 8, or a part of it on narrower
// machines), so a value at a pixel never depends on how wide the machine is.

using DF = hn::CappedTag<float, 8>;
using DI = hn::RebindToSigned<DF>;
using DU = hn::RebindToUnsigned<DF>;
using VF = hn::Vec<DF>;
using VI = hn::Vec<DI>;
using VU = hn::Vec<DU>;
using MF = hn::Mask<DF>;
inline constexpr int kLanes = static_cast<int>(hn::MaxLanes(DF()));

// Doubles of a group come in one or two vectors.
using DD = hn::CappedTag<double, 8>;
inline constexpr int kDoubleLanes = static_cast<int>(hn::MaxLanes(DD()));
inline constexpr int kDoubleParts = kLanes / kDoubleLanes;
struct VD {
  hn::Vec<DD> part[kDoubleParts];
};

template <class To>
HWY_INLINE hn::Vec<To> DemoteGroup(To d, const VD& v) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (kDoubleParts == 2) {
    const hn::Half<To> half;
    return hn::Combine(d, hn::DemoteTo(half, v.part[1]), hn::DemoteTo(half, v.part[0]));
  } else
#endif
  {
    return hn::DemoteTo(d, v.part[0]);
  }
}

// Towards zero, for values an int32 can hold; anything else gives some int32. Highway's ConvertTo saturates, which takes
// four instructions more.
HWY_INLINE VI TruncateInRange(VF v) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  return VI{_mm256_cvttps_epi32(v.raw)};
#elif HWY_TARGET == HWY_SSE4
  return VI{_mm_cvttps_epi32(v.raw)};
#else
  return hn::ConvertTo(DI(), v);
#endif
}

// Iota is always taken from 0, a constant: from a variable it goes through memory and stalls.

// What the stages of a fused kernel hand on in registers.
struct Lanes {
  VF slot[kSlotCount];
  MF live;
};
// g++ takes slots a run never touches for uninitialised reads in the scalar build.
#if HWY_TARGET == HWY_SCALAR && defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

HWY_INLINE unsigned MaskBits(MF mask) {
#if HWY_TARGET == HWY_SCALAR
  return hn::AllFalse(DF(), mask) ? 0u : 1u;
#else
  uint8_t bits[8] = {};
  hn::StoreMaskBits(DF(), mask, bits);
  return bits[0] & ((1u << kLanes) - 1);
#endif
}

template <CompareFunc F, class V>
HWY_INLINE auto Compare(V a, V b) {
  if constexpr (F == CompareFunc::less) return hn::Lt(a, b);
  if constexpr (F == CompareFunc::equal) return hn::Eq(a, b);
  if constexpr (F == CompareFunc::less_equal) return hn::Not(hn::Gt(a, b));
  if constexpr (F == CompareFunc::greater) return hn::Gt(a, b);
  if constexpr (F == CompareFunc::not_equal) return hn::Ne(a, b);
  if constexpr (F == CompareFunc::greater_equal) return hn::Not(hn::Lt(a, b));
  if constexpr (F == CompareFunc::always) return hn::Eq(a, a);
  if constexpr (F == CompareFunc::never) return hn::Ne(a, a);
}

// (f0 + dfdy * dy) + dfdx * dx, always in this order, in double. Rows of a block only.
HWY_INLINE VD PlaneAtDouble(const BlockContext& c, int plane, int i) {
  const int k = c.lane;
  const SetupBatch& s = *c.setup;
  const double row = s.f0[plane][k] + s.dfdy[plane][k] * (c.dy + i / kBlockSize);
  VD v;
  for (int p = 0; p < kDoubleParts; ++p) {
    const auto dx = hn::Add(hn::Iota(DD(), 0), hn::Set(DD(), c.dx + (i % kBlockSize + p * kDoubleLanes)));
    v.part[p] = hn::Add(hn::Set(DD(), row), hn::Mul(hn::Set(DD(), s.dfdx[plane][k]), dx));
  }
  return v;
}

// --- Where a stage's lanes come from. Both give the same bits for the same pixel.

// Rows of one block, one primitive: planes are evaluated here, memory is contiguous.
struct BlockLanes {
  static HWY_INLINE bool IsLive(const BlockContext& c, int i) {
    return ((c.live >> i) & ((uint64_t{1} << kLanes) - 1)) != 0;
  }
  static HWY_INLINE MF LoadLive(const BlockContext& c, int i) {
    const auto bits = static_cast<uint8_t>(c.live >> i);
#if HWY_TARGET == HWY_SCALAR
    return hn::MaskFromVec(hn::BitCast(DF(), hn::Set(DU(), (bits & 1) != 0 ? ~0u : 0u)));
#else
    return hn::LoadMaskBits(DF(), &bits);
#endif
  }
  static HWY_INLINE void StoreLive(BlockContext& c, int i, MF mask) {
    const uint64_t field = ((uint64_t{1} << kLanes) - 1) << i;
    c.live = (c.live & ~field) | (uint64_t{MaskBits(mask)} << i);
  }
  static HWY_INLINE VF Plane(const BlockContext& c, int plane, int i) {
    const int k = c.lane;
    const SetupBatch& s = *c.setup;
    const float dy = static_cast<float>(c.dy) + static_cast<float>(i / kBlockSize);
    const float row = s.f0_f[plane][k] + s.dfdy_f[plane][k] * dy;
    const VF dx = hn::Add(hn::Iota(DF(), 0), hn::Set(DF(), static_cast<float>(c.dx) + static_cast<float>(i % kBlockSize)));
    return hn::Add(hn::Set(DF(), row), hn::Mul(hn::Set(DF(), s.dfdx_f[plane][k]), dx));
  }
  static HWY_INLINE VF FlatColor(const BlockContext& c, int channel, int) {
    return hn::Set(DF(), c.setup->flat[channel][c.lane]);
  }
  static HWY_INLINE void StoreRgba8(const BlockContext& c, int i, VI packed, MF live) {
    int32_t* memory = reinterpret_cast<int32_t*>(c.color) + i;
    const DI d;
    hn::Store(hn::IfThenElse(hn::RebindMask(d, live), packed, hn::Load(d, memory)), d, memory);
  }
};

// Fragments of many small triangles, packed after their depth test; plane values were evaluated when they came in.
// Stored in the order of the triangles, so where two fragments share a pixel the later one stays.
struct PackedLanes {
  static HWY_INLINE bool IsLive(const BlockContext& c, int i) { return i < c.queue->count; }
  static HWY_INLINE MF LoadLive(const BlockContext&, int) { return hn::Eq(hn::Zero(DF()), hn::Zero(DF())); }
  static HWY_INLINE void StoreLive(BlockContext&, int, MF) {}
  static HWY_INLINE VF Plane(const BlockContext& c, int plane, int i) {
    return hn::Load(DF(), c.queue->plane[plane] + i);
  }
  static HWY_INLINE VF FlatColor(const BlockContext& c, int channel, int i) {
    return Plane(c, c.params->color_plane + channel, i);
  }
  static HWY_INLINE void StoreRgba8(const BlockContext& c, int i, VI packed, MF) {
    alignas(64) int32_t pixels[8];
    hn::Store(packed, DI(), pixels);
    const int32_t* offset = c.queue->offset + i;
    const int left = c.queue->count - i;
    for (int j = 0; j < kLanes; ++j)
      if (j < left) c.color[offset[j]] = static_cast<uint32_t>(pixels[j]);
  }
};
