// Vectors and the group of lanes a stage works on. Compiled once per ISA level, inside its namespace.
//
// A group is kLanes neighbouring pixels of the block: two rows of 8, one, or a part of one on narrower
// machines. A value at a pixel never depends on which.

inline constexpr int kMaxLanes = 16;
using DF = hn::CappedTag<float, kMaxLanes>;
using DI = hn::RebindToSigned<DF>;
using DU = hn::RebindToUnsigned<DF>;
using VF = hn::Vec<DF>;
using VI = hn::Vec<DI>;
using VU = hn::Vec<DU>;
using MF = hn::Mask<DF>;
inline constexpr int kLanes = static_cast<int>(hn::MaxLanes(DF()));

// Doubles of a group come in one vector or two, each within one row.
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

// The same to int32, towards zero, for values it can hold; anything else gives some int32. Highway's DemoteTo saturates.
HWY_INLINE VI TruncateGroupInRange(const VD& v) {
#if HWY_TARGET == HWY_AVX3
  using Half = hn::Vec<hn::Half<DI>>;
  return hn::Combine(DI(), Half{_mm512_cvttpd_epi32(v.part[1].raw)}, Half{_mm512_cvttpd_epi32(v.part[0].raw)});
#else
  return DemoteGroup(DI(), v);
#endif
}

// Towards zero, for values an int32 can hold; anything else gives some int32. Highway's ConvertTo saturates,
// which takes four instructions more.
HWY_INLINE VI TruncateInRange(VF v) {
#if HWY_TARGET == HWY_AVX3
  return VI{_mm512_cvttps_epi32(v.raw)};
#elif HWY_TARGET == HWY_AVX2
  return VI{_mm256_cvttps_epi32(v.raw)};
#elif HWY_TARGET == HWY_SSE4
  return VI{_mm_cvttps_epi32(v.raw)};
#else
  return hn::ConvertTo(DI(), v);
#endif
}

// To the nearest, of two the even one; for such values, too.
HWY_INLINE VI NearestInRange(VF v) {
#if HWY_TARGET == HWY_AVX3
  return VI{_mm512_cvtps_epi32(v.raw)};
#elif HWY_TARGET == HWY_AVX2
  return VI{_mm256_cvtps_epi32(v.raw)};
#elif HWY_TARGET == HWY_SSE4
  return VI{_mm_cvtps_epi32(v.raw)};
#else
  return hn::NearestInt(v);
#endif
}

// Held from above or below by something that is not negative: floats then have the order of their bits. A comparison of
// integers takes any unit, one of floats those that add. A NaN is held, too, or is as a negative number would be.
HWY_INLINE VF HeldBelow(VF v, VF most) {
  return hn::BitCast(DF(), hn::Min(hn::BitCast(DI(), v), hn::BitCast(DI(), most)));
}
HWY_INLINE VF NotNegative(VF v) { return hn::BitCast(DF(), hn::Max(hn::BitCast(DI(), v), hn::Zero(DI()))); }

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

inline constexpr uint64_t kGroupBits = (uint64_t{1} << kLanes) - 1;

HWY_INLINE MF MaskFromBits(uint64_t group) {
#if HWY_TARGET == HWY_SCALAR
  return hn::MaskFromVec(hn::BitCast(DF(), hn::Set(DU(), group != 0 ? ~0u : 0u)));
#else
#if HWY_TARGET == HWY_AVX3
  return MF{static_cast<__mmask16>(group)};
#else
  const auto bits = static_cast<uint8_t>(group);
  return hn::LoadMaskBits(DF(), &bits);
#endif
#endif
}

HWY_INLINE unsigned MaskBits(MF mask) {
#if HWY_TARGET == HWY_SCALAR
  return hn::AllFalse(DF(), mask) ? 0u : 1u;
#elif HWY_TARGET == HWY_AVX3
  return _cvtmask16_u32(mask.raw);
#else
  uint8_t bits[8] = {};
  hn::StoreMaskBits(DF(), mask, bits);
  return (bits[0] | unsigned{bits[1]} << 8) & static_cast<unsigned>(kGroupBits);
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

// --- Planes at the pixels of a block: (f0 + dfdy * dy) + dfdx * dx, always in this order. What is the same
// for all rows is worked out once a block; the compiler could not tell, since rows write to memory.

inline constexpr int kGroupsPerRow = kLanes < kBlockSize ? kBlockSize / kLanes : 1;
inline constexpr int kRowsPerGroup = kLanes > kBlockSize ? kLanes / kBlockSize : 1;

// A group's rows, each filled with its own value: `rows` counts from the group's first.
HWY_INLINE VF FillRows(const float* rows) {
#if HWY_TARGET == HWY_AVX3
  const __m512 first = _mm512_castps256_ps512(_mm256_broadcast_ss(rows));
  return VF{_mm512_castpd_ps(
      _mm512_insertf64x4(_mm512_castps_pd(first), _mm256_castps_pd(_mm256_broadcast_ss(rows + 1)), 1))};
#else
  static_assert(kRowsPerGroup == 1);
  return hn::Set(DF(), rows[0]);
#endif
}

// A group's columns, the same in each of its rows.
HWY_INLINE VF RepeatColumns(const float* columns) {
#if HWY_TARGET == HWY_AVX3
  return VF{_mm512_castpd_ps(_mm512_broadcast_f64x4(_mm256_castps_pd(_mm256_load_ps(columns))))};
#else
  return hn::Load(DF(), columns);
#endif
}

struct BlockPlane {
  VF across[kGroupsPerRow];           // dfdx * dx
  alignas(32) float row[kBlockSize];  // f0 + dfdy * dy
  HWY_INLINE BlockPlane(const BlockContext& c, int plane) {
    const SetupBatch& s = *c.setup;
    const DF d;
    const VF dfdx = hn::Set(d, s.dfdx_f[plane][c.lane]);
    for (int g = 0; g < kGroupsPerRow; ++g)
      across[g] = hn::Mul(
          dfdx, hn::Add(Column(), hn::Set(d, static_cast<float>(c.dx) + static_cast<float>(g * kLanes))));
    const hn::CappedTag<float, kBlockSize> dr;
    const int step = static_cast<int>(hn::MaxLanes(dr));
    const auto f0 = hn::Set(dr, s.f0_f[plane][c.lane]), dfdy = hn::Set(dr, s.dfdy_f[plane][c.lane]);
    for (int n = 0; n < kBlockSize; n += step) {
      const auto dy = hn::Add(hn::Set(dr, static_cast<float>(c.dy)),
                              hn::Add(hn::Iota(dr, 0), hn::Set(dr, static_cast<float>(n))));
      hn::Store(hn::Add(f0, hn::Mul(dfdy, dy)), dr, row + n);
    }
  }
  HWY_INLINE VF At(int i) const {
    return hn::Add(FillRows(row + i / kBlockSize), across[i % kBlockSize / kLanes % kGroupsPerRow]);
  }

  // The column of each lane's pixel in its row.
  static HWY_INLINE VF Column() {
    const VF lane = hn::Iota(DF(), 0);
    if constexpr (kRowsPerGroup == 1) return lane;
    const VF width = hn::Set(DF(), static_cast<float>(kBlockSize));
    return hn::Sub(lane, hn::IfThenElseZero(hn::Ge(lane, width), width));
  }
};

struct BlockPlaneDouble {
  static constexpr int kParts = kRowsPerGroup == 1 ? kDoubleParts : kDoubleParts / kRowsPerGroup;  // of a row
  VD across[kGroupsPerRow];
  double f0, dfdy, dy;
  HWY_INLINE BlockPlaneDouble(const BlockContext& c, int plane) {
    const SetupBatch& s = *c.setup;
    const DD d;
    f0 = s.f0[plane][c.lane];
    dfdy = s.dfdy[plane][c.lane];
    dy = c.dy;
    const auto dfdx = hn::Set(d, s.dfdx[plane][c.lane]);
    for (int g = 0; g < kGroupsPerRow; ++g)
      for (int p = 0; p < kParts; ++p)
        across[g].part[p] =
            hn::Mul(dfdx, hn::Add(hn::Iota(d, 0), hn::Set(d, c.dx + (g * kLanes + p * kDoubleLanes))));
  }
  HWY_INLINE VD At(int i) const {
    VD v;
    for (int p = 0; p < kDoubleParts; ++p) {
      const double row = f0 + dfdy * (dy + (i / kBlockSize + p / kParts));
      v.part[p] = hn::Add(hn::Set(DD(), row),
                          across[kGroupsPerRow == 1 ? 0 : i % kBlockSize / kLanes].part[p % kParts]);
    }
    return v;
  }
};

// Where a stage finds what one before it left for pixel `i`, which counts from the first of the block or of the tile.
HWY_INLINE const float* SlotAt(const BlockContext& c, Slot slot, int i) {
  return c.slot[slot] + i % (kRowBlocks * kBlockPixels);
}

// For stages with nothing to work out once a block.
struct NothingOnce {
  HWY_INLINE explicit NothingOnce(const BlockContext&) {}
};

// --- Where a stage's lanes come from. Both give the same bits for the same pixel.

// Rows of one block, one primitive: planes are evaluated here, memory is contiguous.
struct BlockLanes {
  static HWY_INLINE uint64_t Live(const BlockContext& c) { return c.live; }
  // Of pixel `i`: its row and its column, counted from the context's place; and how many there are.
  static constexpr int kSide = kBlockSize;
  static HWY_INLINE int Row(int i) { return i / kBlockSize; }
  static HWY_INLINE int Column(int i) { return i % kBlockSize; }
  static HWY_INLINE int FirstRow(const BlockContext&) { return 0; }  // of the row of blocks at hand
  using Plane = BlockPlane;
  using PlaneOfAlpha = Plane;
  using PlaneDouble = BlockPlaneDouble;
  struct FlatColor {
    VF color[4];
    HWY_INLINE explicit FlatColor(const BlockContext& c) {
      for (int k = 0; k < 4; ++k) color[k] = hn::Set(DF(), c.setup->flat[k][c.lane]);
    }
    HWY_INLINE VF At(int channel, int) const { return color[channel]; }
  };
  static HWY_INLINE void StoreRgba8(const BlockContext& c, int i, VI packed, MF live) {
    int32_t* memory = reinterpret_cast<int32_t*>(c.color) + i;
    const DI d;
    hn::Store(hn::IfThenElse(hn::RebindMask(d, live), packed, hn::Load(d, memory)), d, memory);
  }
};

// The same where all of the block is live.
struct FullLanes : BlockLanes {
  static HWY_INLINE void StoreRgba8(const BlockContext& c, int i, VI packed, MF) {
    hn::Store(packed, DI(), reinterpret_cast<int32_t*>(c.color) + i);
  }
};

template <class L>
inline constexpr bool IsBlock = false;
template <>
inline constexpr bool IsBlock<BlockLanes> = true;
template <class L>
inline constexpr bool IsFull = false;
template <>
inline constexpr bool IsFull<FullLanes> = true;

// Depths that the fragments of an image bring along.
struct GivenDepth {
  const int32_t* values;
  HWY_INLINE GivenDepth(const BlockContext& c, int)
      : values(reinterpret_cast<const int32_t*>(c.given_depth)) {}
  HWY_INLINE VD At(int i) const {
    VD v;
    for (int p = 0; p < kDoubleParts; ++p) {
      const hn::Rebind<int32_t, DD> ints;
      v.part[p] = hn::PromoteTo(DD(), hn::LoadU(ints, values + i + p * kDoubleLanes));
    }
    return v;
  }
};

// A block whose fragments bring their own depth; of planes in double, only the depth test's is asked for.
struct GivenDepthLanes : BlockLanes {
  using PlaneDouble = GivenDepth;
};

// Values that were evaluated when a fragment came in.
struct PackedPlane {
  const float* values;
  HWY_INLINE PackedPlane(const BlockContext& c, int plane) : values(c.queue->plane[plane]) {}
  HWY_INLINE VF At(int i) const { return hn::Load(DF(), values + i); }
};

// Fragments of many small triangles, packed after their depth test; plane values were evaluated when they
// came in. Stored in the order of the triangles, so where two fragments share a pixel the later one stays.
struct PackedLanes {
  using Plane = PackedPlane;
  using PlaneOfAlpha = Plane;
  using PlaneDouble = BlockPlaneDouble;  // never used: what needs doubles is not packed
  struct FlatColor {
    const BlockContext& c;
    HWY_INLINE explicit FlatColor(const BlockContext& context) : c(context) {}
    HWY_INLINE VF At(int channel, int i) const { return PackedPlane(c, c.params->color_plane + channel).At(i); }
  };
  static HWY_INLINE void StoreRgba8(const BlockContext& c, int i, VI packed, MF) {
    alignas(64) int32_t pixels[kMaxLanes];
    hn::Store(packed, DI(), pixels);
    const int32_t* offset = c.queue->offset + i;
    const int left = c.queue->count - i;
    if (HWY_LIKELY(left >= kLanes)) {
      for (int j = 0; j < kLanes; ++j) c.color[offset[j]] = static_cast<uint32_t>(pixels[j]);
      return;
    }
    for (int j = 0; j < kLanes; ++j)
      if (j < left) c.color[offset[j]] = static_cast<uint32_t>(pixels[j]);
  }
};
