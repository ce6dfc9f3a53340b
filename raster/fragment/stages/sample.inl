// Texture filters (spec 3.8.8, 3.8.9). Texels come out in 0..255.

// One axis of a lookup: texel coordinate u (spec: u = s * size), wrapped or clamped so that a footprint never
// leaves level plus skirt. `center` 0.5 for linear, 0 for nearest.
HWY_INLINE VF TexelCoord(VF s, VF size, Wrap wrap, float center) {
  const DF d;
  const VF half = hn::Set(d, 0.5f);
  if (wrap == Wrap::repeat) s = hn::Sub(s, hn::Floor(s));
  VF u = hn::Mul(s, size);
  if (wrap == Wrap::clamp) u = hn::Min(hn::Max(u, hn::Zero(d)), size);
  if (wrap == Wrap::clamp_to_edge) u = hn::Min(hn::Max(u, half), hn::Sub(size, half));
  return hn::Sub(u, hn::Set(d, center));
}

// The texel of a nearest lookup, its coordinate snapped to 1/1024 texel: s = k / N is often a rounding below texel k's
// edge. With REPEAT what snaps to the far edge is texel 0 again. In the level whatever s is, as below.
HWY_INLINE VI NearestTexel(VF s, float size, int size_i, Wrap wrap) {
  const DF d;
  const DI di;
  // Never negative, so truncation is floor.
  const VF scaled = hn::Mul(TexelCoord(s, hn::Set(d, size), wrap, 0.0f), hn::Set(d, 1024.0f));
  VI u = hn::ShiftRight<10>(TruncateInRange(hn::Add(scaled, hn::Set(d, 0.5f))));
  if (wrap == Wrap::repeat) u = hn::IfThenZeroElse(hn::Eq(u, hn::Set(di, size_i)), u);
  return hn::Min(hn::Max(u, hn::Zero(di)), hn::Set(di, size_i - 1));
}

// Index in [lowest, size - 1] whatever u is: out-of-range and NaN lanes are dead, but their loads must be safe.
HWY_INLINE VI HeldIndex(VI index, VI size, int lowest) {
  const DI d;
  return hn::Min(hn::Max(index, hn::Set(d, lowest)), hn::Sub(size, hn::Set(d, 1)));
}
HWY_INLINE VI TexelIndex(VF floor_u, VI size, int lowest) { return HeldIndex(TruncateInRange(floor_u), size, lowest); }

HWY_INLINE void UnpackTexels(VU texel, Lanes& v) {
  const DF d;
  const DI di;
  const DU du;
  const VU byte = hn::Set(du, 255u);
  v.slot[kTexR] = hn::ConvertTo(d, hn::BitCast(di, hn::And(texel, byte)));
  v.slot[kTexG] = hn::ConvertTo(d, hn::BitCast(di, hn::And(hn::ShiftRight<8>(texel), byte)));
  v.slot[kTexB] = hn::ConvertTo(d, hn::BitCast(di, hn::And(hn::ShiftRight<16>(texel), byte)));
  v.slot[kTexA] = hn::ConvertTo(d, hn::BitCast(di, hn::ShiftRight<24>(texel)));
}

// The lanes' offsets as scalars, by way of memory: taking them out of a vector would cost the units that filter.
struct LaneOffsets {
  alignas(64) int32_t own[kMaxLanes];
  const void* memory;
  HWY_INLINE explicit LaneOffsets(VI v) : memory(own) {
    hn::Store(v, DI(), own);
    __asm__ volatile("" : : "r"(own) : "memory");
  }
  // Of values that are there already, kLanes of them.
  HWY_INLINE explicit LaneOffsets(const void* values) : memory(values) {}
  HWY_INLINE int64_t operator[](int j) const {
    int32_t offset;
    __builtin_memcpy(&offset, static_cast<const char*>(memory) + 4 * j, 4);
    return offset;
  }
};

// Two neighbouring texels of one row for each lane: `first` the left ones, `second` the right ones. By 64-bit loads; on
// no x86 measured does the gather instruction win.
struct TexelPairs {
  VU first, second;
};
// Of two rows of texels.
struct Footprints {
  TexelPairs low, high;
};

// Where levels keep texels beside those above them, a footprint is one load: half as many, and fewer to put together. With
// vectors of 256 bits the shuffles cost more than the loads (tex_bilinear 1.06 times as long).
#if HWY_TARGET == HWY_AVX3
HWY_INLINE __m128 LoadStacked(const uint32_t* stacked, int64_t offset) {
  return _mm_loadu_ps(reinterpret_cast<const float*>(stacked + 2 * offset));
}
// Those of every fourth lane from `j` on. A masked broadcast leaves the units that shuffle alone.
HWY_INLINE VU LoadEveryFourth(const LaneOffsets& offsets, int j, const uint32_t* stacked) {
  const auto two = [&](int k) HWY_ATTR {
    const __m256 low = _mm256_castps128_ps256(LoadStacked(stacked, offsets[k]));
    return _mm256_castps_si256(_mm256_mask_broadcast_f32x4(low, 0xf0, LoadStacked(stacked, offsets[k + 4])));
  };
  return VU{_mm512_inserti64x4(_mm512_castsi256_si512(two(j)), two(j + 8), 1)};
}
template <class D>
HWY_INLINE VU LowerOfBoth(D d, VU a, VU b) {
  return hn::BitCast(DU(), hn::InterleaveLower(d, hn::BitCast(d, a), hn::BitCast(d, b)));
}
template <class D>
HWY_INLINE VU UpperOfBoth(D d, VU a, VU b) {
  return hn::BitCast(DU(), hn::InterleaveUpper(d, hn::BitCast(d, a), hn::BitCast(d, b)));
}
HWY_INLINE Footprints LoadFootprints(const LaneOffsets& offsets, const uint32_t* stacked) {
  const DU one;
  const hn::Repartition<uint64_t, DU> two;
  const VU a = LoadEveryFourth(offsets, 0, stacked), b = LoadEveryFourth(offsets, 1, stacked);
  const VU c = LoadEveryFourth(offsets, 2, stacked), e = LoadEveryFourth(offsets, 3, stacked);
  const VU left = LowerOfBoth(one, a, b), right = UpperOfBoth(one, a, b);
  const VU other_left = LowerOfBoth(one, c, e), other_right = UpperOfBoth(one, c, e);
  return {{LowerOfBoth(two, left, other_left), LowerOfBoth(two, right, other_right)},
          {UpperOfBoth(two, left, other_left), UpperOfBoth(two, right, other_right)}};
}
#endif

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_SSE4
HWY_INLINE __m128 LoadTwoPairs(const uint32_t* row, int64_t a, int64_t b) {
  const __m128i left = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(row + a));
  return _mm_loadh_pi(_mm_castsi128_ps(left), reinterpret_cast<const __m64*>(row + b));
}
#endif
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
struct FourPairs {
  __m256 low, high;
};
#endif
#if HWY_TARGET == HWY_AVX2
// Pairs of the lanes j, j + 1, j + 4 and j + 5. Both rows at once, so that an offset is in a register for both.
HWY_INLINE FourPairs LoadFourPairs(const LaneOffsets& offsets, int j, const uint32_t* low, const uint32_t* high) {
  const int64_t a = offsets[j], b = offsets[j + 1], c = offsets[j + 4], e = offsets[j + 5];
  return {_mm256_insertf128_ps(_mm256_castps128_ps256(LoadTwoPairs(low, a, b)), LoadTwoPairs(low, c, e), 1),
          _mm256_insertf128_ps(_mm256_castps128_ps256(LoadTwoPairs(high, a, b)), LoadTwoPairs(high, c, e), 1)};
}
#elif HWY_TARGET == HWY_AVX3
// The same by broadcasts into places: those leave the units that shuffle alone.
HWY_INLINE __m256 LoadPlaces(const uint32_t* row, int64_t a, int64_t b, int64_t c, int64_t e) {
  const auto at = [row](int64_t offset) HWY_ATTR {
    double pair;  // _mm_load_sd would want it aligned
    __builtin_memcpy(&pair, row + offset, sizeof pair);
    return _mm_set_sd(pair);
  };
  __m256d v = _mm256_castpd128_pd256(at(a));
  v = _mm256_mask_broadcastsd_pd(v, 2, at(b));
  v = _mm256_mask_broadcastsd_pd(v, 4, at(c));
  return _mm256_castpd_ps(_mm256_mask_broadcastsd_pd(v, 8, at(e)));
}
HWY_INLINE FourPairs LoadFourPairs(const LaneOffsets& offsets, int j, const uint32_t* low, const uint32_t* high) {
  const int64_t a = offsets[j], b = offsets[j + 1], c = offsets[j + 4], e = offsets[j + 5];
  return {LoadPlaces(low, a, b, c, e), LoadPlaces(high, a, b, c, e)};
}
#endif
// low, high: where the offsets count from in the two rows.
#if HWY_TARGET == HWY_AVX2
HWY_INLINE TexelPairs Unzip(__m256 even, __m256 odd) {
  return {VU{_mm256_castps_si256(_mm256_shuffle_ps(even, odd, 0x88))},
          VU{_mm256_castps_si256(_mm256_shuffle_ps(even, odd, 0xdd))}};
}
HWY_INLINE Footprints LoadFootprints(const LaneOffsets& offsets, const uint32_t* low, const uint32_t* high) {
  const FourPairs even = LoadFourPairs(offsets, 0, low, high), odd = LoadFourPairs(offsets, 2, low, high);
  return {Unzip(even.low, odd.low), Unzip(even.high, odd.high)};
}
#elif HWY_TARGET == HWY_AVX3
HWY_INLINE __m512 Join(__m256 a, __m256 b) {
  return _mm512_castpd_ps(_mm512_insertf64x4(_mm512_castps_pd(_mm512_castps256_ps512(a)), _mm256_castps_pd(b), 1));
}
HWY_INLINE TexelPairs Unzip(__m512 even, __m512 odd) {
  return {VU{_mm512_castps_si512(_mm512_shuffle_ps(even, odd, 0x88))},
          VU{_mm512_castps_si512(_mm512_shuffle_ps(even, odd, 0xdd))}};
}
HWY_INLINE Footprints LoadFootprints(const LaneOffsets& offsets, const uint32_t* low, const uint32_t* high) {
  const FourPairs a = LoadFourPairs(offsets, 0, low, high), b = LoadFourPairs(offsets, 8, low, high);
  const FourPairs c = LoadFourPairs(offsets, 2, low, high), e = LoadFourPairs(offsets, 10, low, high);
  return {Unzip(Join(a.low, b.low), Join(c.low, e.low)), Unzip(Join(a.high, b.high), Join(c.high, e.high))};
}
#elif HWY_TARGET == HWY_SSE4
HWY_INLINE TexelPairs LoadPairs(const LaneOffsets& offsets, const uint32_t* row) {
  const __m128 even = LoadTwoPairs(row, offsets[0], offsets[1]);
  const __m128 odd = LoadTwoPairs(row, offsets[2], offsets[3]);
  return {VU{_mm_castps_si128(_mm_shuffle_ps(even, odd, 0x88))}, VU{_mm_castps_si128(_mm_shuffle_ps(even, odd, 0xdd))}};
}
HWY_INLINE Footprints LoadFootprints(const LaneOffsets& offsets, const uint32_t* low, const uint32_t* high) {
  return {LoadPairs(offsets, low), LoadPairs(offsets, high)};
}
#else
HWY_INLINE TexelPairs LoadPairs(const LaneOffsets& offsets, const uint32_t* row) {
  alignas(64) uint32_t first[kMaxLanes], second[kMaxLanes];
  for (int j = 0; j < kLanes; ++j) {
    first[j] = row[offsets[j]];
    second[j] = row[offsets[j] + 1];
  }
  return {hn::Load(DU(), first), hn::Load(DU(), second)};
}
HWY_INLINE Footprints LoadFootprints(const LaneOffsets& offsets, const uint32_t* low, const uint32_t* high) {
  return {LoadPairs(offsets, low), LoadPairs(offsets, high)};
}
#endif

// The upper half of each in the lower one's place; what lies above it is for masks to take away. With AVX-512 turning
// takes the units that multiply, shifting those that add.
HWY_INLINE VU UpperFirst(VU texel) {
#if HWY_TARGET == HWY_AVX3
  return hn::RotateRight<16>(texel);
#else
  return hn::ShiftRight<16>(texel);
#endif
}

// A byte of each texel as a float, without a conversion: floats from 2^23 to 2^24 are whole numbers with the byte in
// their last bits, and those from 2^15 on have whole numbers' bits eight places further up. So a shift serves two
// channels; what the byte is lifted by differs.
constexpr float lift_of(int channel) { return channel % 2 == 0 ? 8388608.0f : 32768.0f; }
template <int kChannel>
HWY_INLINE VF Lifted(VU texel) {
  const DU d;
  if constexpr (kChannel >= 2) texel = UpperFirst(texel);
  const VU byte = hn::Set(d, kChannel % 2 == 0 ? 0xffu : 0xff00u);
  const VU lift = hn::BitCast(d, hn::Set(DF(), lift_of(kChannel)));
#if HWY_TARGET == HWY_AVX3
  // (texel & byte) | lift, in the texel's register: Highway's OrAnd takes a copy of the constant.
  return hn::BitCast(DF(), VU{_mm512_ternarylogic_epi32(texel.raw, byte.raw, lift.raw, 0xea)});
#else
  return hn::BitCast(DF(), hn::OrAnd(lift, texel, byte));
#endif
}

// One or two channels of bilinear lookups, in float. Columns first, then rows. What is lifted needs no lowering where only
// a difference is wanted, which is exact. All of it step by step rather than channel by channel: the processor
// looks only so far ahead for what need not wait.
template <int kChannel, int kCount>
HWY_INLINE void FilterChannels(const Footprints& texels, VF wu, VF wv, VF* out) {
  // Left and right of the first channel, left and right of the second.
  constexpr int kSides = 2 * kCount, kNext = kChannel + kCount - 1;
  VF low[4] = {Lifted<kChannel>(texels.low.first), Lifted<kChannel>(texels.low.second),
               Lifted<kNext>(texels.low.first), Lifted<kNext>(texels.low.second)};
  VF rise[4] = {Lifted<kChannel>(texels.high.first), Lifted<kChannel>(texels.high.second),
                Lifted<kNext>(texels.high.first), Lifted<kNext>(texels.high.second)};
  for (int k = 0; k < kSides; ++k) rise[k] = hn::Sub(rise[k], low[k]);
  for (int k = 0; k < kSides; ++k) rise[k] = hn::Mul(rise[k], wv);
  for (int k = 0; k < kSides; ++k) low[k] = hn::Sub(low[k], hn::Set(DF(), lift_of(kChannel + k / 2)));
  for (int k = 0; k < kSides; ++k) low[k] = hn::Add(low[k], rise[k]);
  for (int k = 0; k < kCount; ++k) rise[k] = hn::Sub(low[2 * k + 1], low[2 * k]);
  for (int k = 0; k < kCount; ++k) rise[k] = hn::Mul(rise[k], wu);
  for (int k = 0; k < kCount; ++k) out[k] = hn::Add(low[2 * k], rise[k]);
}

// A lookup's arithmetic and the next one's loads take turns, since the processor looks ahead for little more than
// one lookup. Only where registers hold what two have under way.
inline constexpr bool kFetchesAhead = HWY_TARGET == HWY_AVX3;
struct NothingMeanwhile {
  HWY_INLINE void operator()() const {}
};

// Bilinear lookups for all lanes, in float. `opaque`: every alpha is 255, and interpolating 255 gives 255.
// `fetch_next` loads texels for the lookup that comes next.
template <class FetchNext>
HWY_INLINE void Bilinear(const Footprints& texels, VF wu, VF wv, bool opaque, Lanes& v, FetchNext fetch_next) {
  FilterChannels<0, 2>(texels, wu, wv, &v.slot[kTexR]);
  if constexpr (kFetchesAhead) fetch_next();
  if (opaque) {
    FilterChannels<2, 1>(texels, wu, wv, &v.slot[kTexB]);
    v.slot[kTexA] = hn::Set(DF(), 255.0f);
  } else {
    FilterChannels<2, 2>(texels, wu, wv, &v.slot[kTexB]);
  }
  if constexpr (!kFetchesAhead) fetch_next();
}

HWY_INLINE VI TexelOffset(const LevelRef& level, VI x, VI y) {
  const DI di;
  const VI one = hn::Set(di, 1);
  return hn::Add(hn::Mul(hn::Add(y, one), hn::Set(di, level.pitch)), hn::Add(x, one));
}

HWY_INLINE VI NearestOffset(const LevelRef& level, const Sampler& sampler, VF s, VF t) {
  return TexelOffset(level, NearestTexel(s, level.width, level.width_i, sampler.wrap_s),
                     NearestTexel(t, level.height, level.height_i, sampler.wrap_t));
}

// By way of registers: a vector read where single texels were just written would wait for them.
HWY_INLINE VU LoadTexels(const LaneOffsets& offsets, const uint32_t* texels) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_SSE4
  auto four = [&](int j) HWY_ATTR {
    __m128i v = _mm_cvtsi32_si128(static_cast<int>(texels[offsets[j]]));
    v = _mm_insert_epi32(v, static_cast<int>(texels[offsets[j + 1]]), 1);
    v = _mm_insert_epi32(v, static_cast<int>(texels[offsets[j + 2]]), 2);
    return _mm_insert_epi32(v, static_cast<int>(texels[offsets[j + 3]]), 3);
  };
#if HWY_TARGET == HWY_SSE4
  return VU{four(0)};
#else
  auto eight = [&](int j) HWY_ATTR { return _mm256_inserti128_si256(_mm256_castsi128_si256(four(j)), four(j + 4), 1); };
#if HWY_TARGET == HWY_AVX2
  return VU{eight(0)};
#else
  return VU{_mm512_inserti64x4(_mm512_castsi256_si512(eight(0)), eight(8), 1)};
#endif
#endif
#else
  alignas(64) uint32_t loaded[kMaxLanes];
  for (int j = 0; j < kLanes; ++j) loaded[j] = texels[offsets[j]];
  return hn::Load(DU(), loaded);
#endif
}

// Where a nearest lookup on level 0 reads. A stage of its own for the reason Footprint is one.
struct FootprintNearest {
  static constexpr bool kKills = false, kPacks = true, kInTiles = true;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int, Lanes& v) {
    const VI offset = NearestOffset(c.params->levels[0], c.params->sampler, v.slot[kS], v.slot[kT]);
    v.slot[kOffset] = hn::BitCast(DF(), offset);
  }
};

// The same for REPEAT both ways on sizes that are powers of two: what snaps to the far edge, and what is no number, falls
// under the mask.
struct FootprintNearestRepeat {
  static constexpr bool kKills = false, kPacks = true, kInTiles = true;
  template <class L>
  struct Once {
    VF scale_s, scale_t;  // to 1/1024 texels
    VI mask_s, mask_t, pitch, first;
    HWY_INLINE explicit Once(const BlockContext& c) {
      const LevelRef& level = c.params->levels[0];
      scale_s = hn::Set(DF(), level.width * 1024.0f);
      scale_t = hn::Set(DF(), level.height * 1024.0f);
      mask_s = hn::Set(DI(), level.width_i - 1);
      mask_t = hn::Set(DI(), level.height_i - 1);
      pitch = hn::Set(DI(), level.pitch);
      first = hn::Set(DI(), level.pitch + 1);
    }
  };
  template <class L>
  static HWY_INLINE void Run(const BlockContext&, const Once<L>& once, int, Lanes& v) {
    const VF s = hn::Sub(v.slot[kS], hn::Floor(v.slot[kS])), t = hn::Sub(v.slot[kT], hn::Floor(v.slot[kT]));
    const VI x = Texel(s, once.scale_s, once.mask_s), y = Texel(t, once.scale_t, once.mask_t);
    v.slot[kOffset] = hn::BitCast(DF(), hn::Add(hn::Mul(y, once.pitch), hn::Add(x, once.first)));
  }

 private:
  static HWY_INLINE VI Texel(VF s, VF scale, VI mask) {
    const VF scaled = hn::Add(hn::Mul(s, scale), hn::Set(DF(), 0.5f));
    return hn::And(hn::ShiftRight<10>(TruncateInRange(scaled)), mask);
  }
};

struct SampleNearest {
  static constexpr bool kKills = false, kPacks = true, kInTiles = true, kTakesFromMemory = true;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int i, Lanes& v) {
    TakeTexels(FetchTexels(c, i), v);
  }
  static HWY_INLINE VU FetchTexels(const BlockContext& c, int i) {
    return LoadTexels(LaneOffsets(SlotAt(c, kOffset, i)), c.params->levels[0].texels);
  }
  static HWY_INLINE void TakeTexels(VU texels, Lanes& v) { UnpackTexels(texels, v); }
};

// Where a bilinear lookup reads: the offset of the lower left texel, and the weights of the right and the upper ones.
struct Place {
  VI offset;
  VF wu, wv;
};
HWY_INLINE Place FindPlace(const LevelRef& level, Wrap wrap_s, Wrap wrap_t, VF s, VF t) {
  const DF d;
  const DI di;
  const VF u = TexelCoord(s, hn::Set(d, level.width), wrap_s, 0.5f);
  const VF v = TexelCoord(t, hn::Set(d, level.height), wrap_t, 0.5f);
  const VF u0 = hn::Floor(u), v0 = hn::Floor(v);
  const VI x = TexelIndex(u0, hn::Set(di, level.width_i), -1);
  const VI y = TexelIndex(v0, hn::Set(di, level.height_i), -1);
  return {TexelOffset(level, x, y), hn::Sub(u, u0), hn::Sub(v, v0)};
}
// A coordinate under REPEAT: in [0, 1] for whatever number; what is none becomes 1, since dead lanes are looked up.
HWY_INLINE VF InOneTurn(VF v) {
  const VU turn = hn::BitCast(DU(), hn::Sub(v, hn::Floor(v)));  // never negative: has the order of its bits
  return hn::BitCast(DF(), hn::Min(turn, hn::BitCast(DU(), hn::Set(DF(), 1.0f))));
}

// The same for REPEAT both ways, and coordinates in one turn: in the level without being held there.
struct RepeatedLevel {
  VF width, height;
  VI pitch, first;
  HWY_INLINE explicit RepeatedLevel(const LevelRef& level)
      : width(hn::Set(DF(), level.width)),
        height(hn::Set(DF(), level.height)),
        pitch(hn::Set(DI(), level.pitch)),
        first(hn::Set(DI(), level.pitch + 1)) {}
  HWY_INLINE Place Find(VF s, VF t) const {
    const VF half = hn::Set(DF(), 0.5f);
    const VF x = hn::Sub(hn::Mul(s, width), half), y = hn::Sub(hn::Mul(t, height), half);
    const VF x0 = hn::Floor(x), y0 = hn::Floor(y);
    const VI row = hn::Mul(TruncateInRange(y0), pitch);
    return {hn::Add(row, hn::Add(TruncateInRange(x0), first)), hn::Sub(x, x0), hn::Sub(y, y0)};
  }
};

template <bool kStacked>
HWY_INLINE Footprints FetchFrom(const LevelRef& level, const LaneOffsets& offsets) {
#if HWY_TARGET == HWY_AVX3
  if constexpr (kStacked) return LoadFootprints(offsets, level.stacked);
#endif
  return LoadFootprints(offsets, level.texels, level.texels + level.pitch);
}
HWY_INLINE bool IsStacked(const LevelRef& level) {
  return HWY_TARGET == HWY_AVX3 && HWY_LIKELY(level.stacked != nullptr);
}
HWY_INLINE Footprints Fetch(const LevelRef& level, const LaneOffsets& offsets) {
  return IsStacked(level) ? FetchFrom<true>(level, offsets) : FetchFrom<false>(level, offsets);
}

// Where a bilinear lookup on level 0 reads: slots s, t become the weights, and the offset of the lower left texel joins
// them. A stage of its own, since a lookup's loads can only overlap with the next row's if little lies before them.
struct Footprint {
  static constexpr bool kKills = false, kPacks = true, kInTiles = true;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int, Lanes& v) {
    const Sampler& sampler = c.params->sampler;
    const Place place = FindPlace(c.params->levels[0], sampler.wrap_s, sampler.wrap_t, v.slot[kS], v.slot[kT]);
    v.slot[kS] = place.wu;
    v.slot[kT] = place.wv;
    v.slot[kOffset] = hn::BitCast(DF(), place.offset);
  }
};

// The same for REPEAT both ways.
struct FootprintRepeat {
  static constexpr bool kKills = false, kPacks = true, kInTiles = true;
  template <class L>
  struct Once {
    RepeatedLevel level;
    HWY_INLINE explicit Once(const BlockContext& c) : level(c.params->levels[0]) {}
  };
  template <class L>
  static HWY_INLINE void Run(const BlockContext&, const Once<L>& once, int, Lanes& v) {
    const Place place = once.level.Find(InOneTurn(v.slot[kS]), InOneTurn(v.slot[kT]));
    v.slot[kS] = place.wu;
    v.slot[kT] = place.wv;
    v.slot[kOffset] = hn::BitCast(DF(), place.offset);
  }
};

// kOpaque: every texel is.
template <bool kOpaque>
struct SampleLinear {
  static constexpr bool kKills = false, kPacks = true, kInTiles = true, kTakesFromMemory = true;
  static constexpr bool kRunsBlocks = kFetchesAhead;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int i, Lanes& v) {
    const Footprints texels = Fetch(c.params->levels[0], LaneOffsets(SlotAt(c, kOffset, i)));
    Bilinear(texels, v.slot[kS], v.slot[kT], kOpaque, v, NothingMeanwhile());
  }
  // A block that is live all over: while a group's texels are filtered, the next one's are fetched.
  template <class Load, class Store>
  static HWY_INLINE bool RunBlock(const BlockContext& c, const NothingOnce&, int first, Load load, Store store) {
    if (IsStacked(c.params->levels[0])) FilterBlock<true>(c, first, load, store);
    else FilterBlock<false>(c, first, load, store);
    return true;
  }

 private:
  template <bool kStacked, class Load, class Store>
  static HWY_INLINE void FilterBlock(const BlockContext& c, int first, Load load, Store store) {
    Footprints texels = FetchAt<kStacked>(c, first);
    const int last = first + kBlockPixels - kLanes;
    for (int i = first; i <= last; i += kLanes) {
      Lanes v;
      load(i, v);
      Footprints next;
      Bilinear(texels, v.slot[kS], v.slot[kT], kOpaque, v,
               [&]() HWY_ATTR { next = FetchAt<kStacked>(c, i < last ? i + kLanes : last); });  // a branch would cost more
      texels = next;
      store(v, i);
    }
  }
  template <bool kStacked>
  static HWY_INLINE Footprints FetchAt(const BlockContext& c, int i) {
    return FetchFrom<kStacked>(c.params->levels[0], LaneOffsets(SlotAt(c, kOffset, i)));
  }
};
