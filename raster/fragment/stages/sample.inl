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

// The coordinate of a nearest lookup, snapped to 1/1024 texel: s = k / N is often a rounding below texel k's edge. With
// REPEAT what snaps to the far edge is texel 0 again.
HWY_INLINE VF NearestTexel(VF s, VF size, Wrap wrap) {
  const DF d;
  const VF scaled = hn::Mul(TexelCoord(s, size, wrap, 0.0f), hn::Set(d, 1024.0f));
  const VF u = hn::Floor(hn::Mul(hn::Floor(hn::Add(scaled, hn::Set(d, 0.5f))), hn::Set(d, 1.0f / 1024.0f)));
  return wrap == Wrap::repeat ? hn::IfThenZeroElse(hn::Ge(u, size), u) : u;
}

// Index in [lowest, size - 1] whatever u is: out-of-range and NaN lanes are dead, but their loads must be safe.
HWY_INLINE VI TexelIndex(VF floor_u, VI size, int lowest) {
  const DI d;
  return hn::Min(hn::Max(TruncateInRange(floor_u), hn::Set(d, lowest)), hn::Sub(size, hn::Set(d, 1)));
}

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

// Two neighbouring texels of one row for each lane: `first` the left ones, `second` the right ones. By 64-bit loads; on
// no x86 measured does the gather instruction win.
struct TexelPairs {
  VU first, second;
};

// texel(j): address of lane j's left texel.
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
HWY_INLINE __m128i LoadTwoPairs(const uint32_t* a, const uint32_t* b) {
  const __m128i low = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(a));
  return _mm_castps_si128(_mm_loadh_pi(_mm_castsi128_ps(low), reinterpret_cast<const __m64*>(b)));
}
// Pairs of the lanes j, j + 1, j + 4 and j + 5.
template <class Address>
HWY_INLINE __m256i LoadFourPairs(Address texel, int j) {
  return _mm256_inserti128_si256(_mm256_castsi128_si256(LoadTwoPairs(texel(j), texel(j + 1))),
                                 LoadTwoPairs(texel(j + 4), texel(j + 5)), 1);
}
#if HWY_TARGET == HWY_AVX2
template <class Address>
HWY_INLINE TexelPairs LoadPairs(Address texel) {
  const __m256 even = _mm256_castsi256_ps(LoadFourPairs(texel, 0)), odd = _mm256_castsi256_ps(LoadFourPairs(texel, 2));
  return {VU{_mm256_castps_si256(_mm256_shuffle_ps(even, odd, 0x88))},
          VU{_mm256_castps_si256(_mm256_shuffle_ps(even, odd, 0xdd))}};
}
#else
template <class Address>
HWY_INLINE __m512 LoadEightPairs(Address texel, int j) {
  return _mm512_castsi512_ps(
      _mm512_inserti64x4(_mm512_castsi256_si512(LoadFourPairs(texel, j)), LoadFourPairs(texel, j + 8), 1));
}
template <class Address>
HWY_INLINE TexelPairs LoadPairs(Address texel) {
  const __m512 even = LoadEightPairs(texel, 0), odd = LoadEightPairs(texel, 2);
  return {VU{_mm512_castps_si512(_mm512_shuffle_ps(even, odd, 0x88))},
          VU{_mm512_castps_si512(_mm512_shuffle_ps(even, odd, 0xdd))}};
}
#endif
#elif HWY_TARGET == HWY_SSE4
HWY_INLINE __m128 LoadTwoPairs(const uint32_t* a, const uint32_t* b) {
  const __m128i low = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(a));
  return _mm_loadh_pi(_mm_castsi128_ps(low), reinterpret_cast<const __m64*>(b));
}
template <class Address>
HWY_INLINE TexelPairs LoadPairs(Address texel) {
  const __m128 even = LoadTwoPairs(texel(0), texel(1)), odd = LoadTwoPairs(texel(2), texel(3));
  return {VU{_mm_castps_si128(_mm_shuffle_ps(even, odd, 0x88))}, VU{_mm_castps_si128(_mm_shuffle_ps(even, odd, 0xdd))}};
}
#else
template <class Address>
HWY_INLINE TexelPairs LoadPairs(Address texel) {
  alignas(64) uint32_t first[kMaxLanes], second[kMaxLanes];
  for (int j = 0; j < kLanes; ++j) {
    first[j] = texel(j)[0];
    second[j] = texel(j)[1];
  }
  return {hn::Load(DU(), first), hn::Load(DU(), second)};
}
#endif

template <int kChannel>
HWY_INLINE VF Channel(VU texel) {
  const DU d;
  const VU byte = hn::Set(d, 255u);
  const VU shifted = hn::ShiftRight<8 * kChannel>(texel);
  return hn::ConvertTo(DF(), hn::BitCast(DI(), kChannel == 3 ? shifted : hn::And(shifted, byte)));
}

template <int kChannel>
HWY_INLINE VF FilterChannel(const TexelPairs& low, const TexelPairs& high, VF wu, VF wv) {
  const VF a = Channel<kChannel>(low.first), b = Channel<kChannel>(low.second);
  const VF left = hn::Add(a, hn::Mul(hn::Sub(Channel<kChannel>(high.first), a), wv));
  const VF right = hn::Add(b, hn::Mul(hn::Sub(Channel<kChannel>(high.second), b), wv));
  return hn::Add(left, hn::Mul(hn::Sub(right, left), wu));
}

// Bilinear lookups for all lanes, in float: rows first, then columns. low(j), high(j): addresses of lane j's left texels
// in the lower and the upper row. `opaque`: every alpha is 255, and interpolating 255 gives 255.
template <class Low, class High>
HWY_INLINE void Bilinear(Low low, High high, VF wu, VF wv, bool opaque, Lanes& v) {
  const TexelPairs bottom = LoadPairs(low), top = LoadPairs(high);
  v.slot[kTexR] = FilterChannel<0>(bottom, top, wu, wv);
  v.slot[kTexG] = FilterChannel<1>(bottom, top, wu, wv);
  v.slot[kTexB] = FilterChannel<2>(bottom, top, wu, wv);
  v.slot[kTexA] = opaque ? hn::Set(DF(), 255.0f) : FilterChannel<3>(bottom, top, wu, wv);
}

// The lanes' offsets as scalars, by way of memory: taking them out of a vector would cost the units that filter.
struct LaneOffsets {
  alignas(64) int32_t at[kMaxLanes];
  HWY_INLINE explicit LaneOffsets(VI v) {
    hn::Store(v, DI(), at);
    __asm__ volatile("" : : "r"(at) : "memory");
  }
};

struct SampleNearest {
  static constexpr bool kKills = false, kPacks = true;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int, Lanes& v) {
    const DF d;
    const DI di;
    const LevelRef& level = c.params->levels[0];
    const Sampler& sampler = c.params->sampler;
    const VF u = NearestTexel(v.slot[kS], hn::Set(d, level.width), sampler.wrap_s);
    const VF t = NearestTexel(v.slot[kT], hn::Set(d, level.height), sampler.wrap_t);
    const VI x = TexelIndex(u, hn::Set(di, level.width_i), 0);
    const VI y = TexelIndex(t, hn::Set(di, level.height_i), 0);
    const VI offset =
        hn::Add(hn::Mul(hn::Add(y, hn::Set(di, 1)), hn::Set(di, level.pitch)), hn::Add(x, hn::Set(di, 1)));
    const LaneOffsets offsets(offset);
    alignas(64) uint32_t texels[kMaxLanes];
    for (int j = 0; j < kLanes; ++j) texels[j] = level.texels[offsets.at[j]];
    UnpackTexels(hn::Load(DU(), texels), v);
  }
};

// Where a bilinear lookup on level 0 reads: slots s, t become the weights, and the offset of the lower left texel joins
// them. A stage of its own, since a lookup's loads can only overlap with the next row's if little lies before them.
template <bool kRepeat>
struct Footprint {
  static constexpr bool kKills = false, kPacks = true;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int, Lanes& v) {
    const DF d;
    const DI di;
    const LevelRef& level = c.params->levels[0];
    const Wrap wrap_s = kRepeat ? Wrap::repeat : c.params->sampler.wrap_s;
    const Wrap wrap_t = kRepeat ? Wrap::repeat : c.params->sampler.wrap_t;
    const VF u = TexelCoord(v.slot[kS], hn::Set(d, level.width), wrap_s, 0.5f);
    const VF t = TexelCoord(v.slot[kT], hn::Set(d, level.height), wrap_t, 0.5f);
    const VF u0 = hn::Floor(u), t0 = hn::Floor(t);
    const VI x = TexelIndex(u0, hn::Set(di, level.width_i), -1);
    const VI y = TexelIndex(t0, hn::Set(di, level.height_i), -1);
    const VI one = hn::Set(di, 1);
    const VI offset = hn::Add(hn::Mul(hn::Add(y, one), hn::Set(di, level.pitch)), hn::Add(x, one));
    v.slot[kS] = hn::Sub(u, u0);
    v.slot[kT] = hn::Sub(t, t0);
    v.slot[kOffset] = hn::BitCast(d, offset);
  }
};

struct SampleLinear {
  static constexpr bool kKills = false, kPacks = true;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int, Lanes& v) {
    const LevelRef& level = c.params->levels[0];
    const LaneOffsets offsets(hn::BitCast(DI(), v.slot[kOffset]));
    const uint32_t *lower = level.texels, *upper = lower + level.pitch;
    Bilinear([&](int j) HWY_ATTR { return lower + offsets.at[j]; }, [&](int j) HWY_ATTR { return upper + offsets.at[j]; },
             v.slot[kS], v.slot[kT], level.opaque, v);
  }
};

// Draft: the filter llvmpipe has by default. Coordinates rounded to 1/256 texel, 8-bit weights, x before y, each
// step rounded: a + ((f * (b - a) + 128) >> 8).
struct SampleLinearDraft {
  static constexpr bool kKills = false, kPacks = true;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int, Lanes& v) {
    const DF d;
    const DI di;
    const LevelRef& level = c.params->levels[0];
    const VI x = Fixed(v.slot[kS], level.width, c.params->sampler.wrap_s);
    const VI y = Fixed(v.slot[kT], level.height, c.params->sampler.wrap_t);
    alignas(64) int32_t xs[kMaxLanes], ys[kMaxLanes];
    alignas(64) uint32_t texels[kMaxLanes] = {};
    hn::Store(x, di, xs);
    hn::Store(y, di, ys);
    for (unsigned todo = MaskBits(v.live); todo != 0; todo &= todo - 1) {
      const int j = __builtin_ctz(todo);
      texels[j] = Lookup(level, xs[j], ys[j]);
    }
    UnpackTexels(hn::Load(DU(), texels), v);
    (void)d;
  }

 private:
  // Texel coordinate minus one half, in 1/256.
  static HWY_INLINE VI Fixed(VF s, float size, Wrap wrap) {
    const DF d;
    const VF u = TexelCoord(s, hn::Set(d, size), wrap, 0.0f);
    return hn::Sub(hn::NearestInt(hn::Mul(u, hn::Set(d, 256.0f))), hn::Set(DI(), 128));
  }
  static HWY_INLINE int Clamp(int v, int lowest, int highest) {
    return v < lowest ? lowest : (v > highest ? highest : v);
  }
  static HWY_INLINE uint32_t Lookup(const LevelRef& level, int x, int y) {
    const int i = Clamp(x >> 8, -1, level.width_i - 1), j = Clamp(y >> 8, -1, level.height_i - 1);
    const int fx = x & 255, fy = y & 255;
    const uint32_t* t = level.texels + (j + 1) * level.pitch + (i + 1);
    uint32_t out = 0;
    for (int k = 0; k < 32; k += 8) {
      auto channel = [k](uint32_t texel) { return static_cast<int>((texel >> k) & 255u); };
      auto lerp = [](int a, int b, int f) { return a + ((f * (b - a) + 128) >> 8); };
      const int low = lerp(channel(t[0]), channel(t[1]), fx);
      const int high = lerp(channel(t[level.pitch]), channel(t[level.pitch + 1]), fx);
      out |= static_cast<uint32_t>(lerp(low, high, fy)) << k;
    }
    return out;
  }
};
