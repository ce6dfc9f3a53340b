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

#if HWY_MAX_BYTES >= 32 && HWY_TARGET != HWY_SCALAR
// Two neighbouring texels, eight channels.
HWY_INLINE hn::Vec<hn::FixedTag<float, 8>> TexelPair(const uint32_t* texel) {
  const hn::FixedTag<uint8_t, 8> bytes;
  const hn::FixedTag<int32_t, 8> ints;
  const hn::FixedTag<float, 8> floats;
  return hn::ConvertTo(floats, hn::PromoteTo(ints, hn::LoadU(bytes, reinterpret_cast<const uint8_t*>(texel))));
}
#endif

// One bilinear lookup; texel pairs come by 64-bit loads. Rows first, then columns, both in float.
HWY_INLINE void Bilinear(const uint32_t* texel, int pitch, float wu, float wv, float* rgba) {
#if HWY_TARGET == HWY_SCALAR
  for (int k = 0; k < 4; ++k) {
    auto channel = [k](uint32_t t) { return static_cast<float>((t >> (8 * k)) & 255u); };
    const float a = channel(texel[0]), b = channel(texel[1]);
    const float left = a + (channel(texel[pitch]) - a) * wv;
    const float right = b + (channel(texel[pitch + 1]) - b) * wv;
    rgba[k] = left + (right - left) * wu;
  }
#else
  const hn::FixedTag<float, 4> d4;
#if HWY_MAX_BYTES >= 32
  const hn::FixedTag<float, 8> d8;
  const auto low = TexelPair(texel), high = TexelPair(texel + pitch);
  const auto pair = hn::Add(low, hn::Mul(hn::Sub(high, low), hn::Set(d8, wv)));
  const auto left = hn::LowerHalf(d4, pair), right = hn::UpperHalf(d4, pair);
#else
  const hn::FixedTag<uint8_t, 4> u4;
  const hn::FixedTag<int32_t, 4> i4;
  auto load = [&](const uint32_t* t) {
    return hn::ConvertTo(d4, hn::PromoteTo(i4, hn::LoadU(u4, reinterpret_cast<const uint8_t*>(t))));
  };
  const auto wv4 = hn::Set(d4, wv);
  const auto a = load(texel), b = load(texel + 1);
  const auto left = hn::Add(a, hn::Mul(hn::Sub(load(texel + pitch), a), wv4));
  const auto right = hn::Add(b, hn::Mul(hn::Sub(load(texel + pitch + 1), b), wv4));
#endif
  hn::Store(hn::Add(left, hn::Mul(hn::Sub(right, left), hn::Set(d4, wu))), d4, rgba);
#endif
}

// All lanes of a group, two at a time: what is stored as 32 bytes is loaded as 32 bytes.
HWY_INLINE void BilinearGroup(const LevelRef& level, const int32_t* offsets, const float* wu, const float* wv,
                              float* rgba) {
#if HWY_MAX_BYTES >= 32 && HWY_TARGET != HWY_SCALAR
  const hn::FixedTag<float, 8> d8;
  const hn::FixedTag<float, 4> d4;
  for (int j = 0; j < kLanes; j += 2) {
    const uint32_t *a = level.texels + offsets[j], *b = level.texels + offsets[j + 1];
    const auto a_low = TexelPair(a), b_low = TexelPair(b);
    const auto a_pair =
        hn::Add(a_low, hn::Mul(hn::Sub(TexelPair(a + level.pitch), a_low), hn::Set(d8, wv[j])));
    const auto b_pair =
        hn::Add(b_low, hn::Mul(hn::Sub(TexelPair(b + level.pitch), b_low), hn::Set(d8, wv[j + 1])));
    const auto left = hn::ConcatLowerLower(d8, b_pair, a_pair), right = hn::ConcatUpperUpper(d8, b_pair, a_pair);
    const auto weight = hn::Combine(d8, hn::Set(d4, wu[j + 1]), hn::Set(d4, wu[j]));
    hn::Store(hn::Add(left, hn::Mul(hn::Sub(right, left), weight)), d8, rgba + 4 * j);
  }
#else
  for (int j = 0; j < kLanes; ++j) Bilinear(level.texels + offsets[j], level.pitch, wu[j], wv[j], rgba + 4 * j);
#endif
}

struct SampleNearest {
  static constexpr bool kKills = false, kPacks = true;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, int, Lanes& v) {
    const DF d;
    const DI di;
    const LevelRef& level = c.params->levels[0];
    const Sampler& sampler = c.params->sampler;
    const VF u = hn::Floor(TexelCoord(v.slot[kS], hn::Set(d, level.width), sampler.wrap_s, 0.0f));
    const VF t = hn::Floor(TexelCoord(v.slot[kT], hn::Set(d, level.height), sampler.wrap_t, 0.0f));
    const VI x = TexelIndex(u, hn::Set(di, level.width_i), 0);
    const VI y = TexelIndex(t, hn::Set(di, level.height_i), 0);
    const VI offset =
        hn::Add(hn::Mul(hn::Add(y, hn::Set(di, 1)), hn::Set(di, level.pitch)), hn::Add(x, hn::Set(di, 1)));
    alignas(64) int32_t offsets[8];
    alignas(64) uint32_t texels[8];
    hn::Store(offset, di, offsets);
    for (int j = 0; j < kLanes; ++j) texels[j] = level.texels[offsets[j]];
    UnpackTexels(hn::Load(DU(), texels), v);
  }
};

template <bool kRepeat>
struct SampleLinear {
  static constexpr bool kKills = false, kPacks = true;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, int, Lanes& v) {
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
    alignas(64) int32_t offsets[8];
    alignas(64) float wu[8], wv[8], rgba[32];
    hn::Store(hn::Add(hn::Mul(hn::Add(y, one), hn::Set(di, level.pitch)), hn::Add(x, one)), di, offsets);
    hn::Store(hn::Sub(u, u0), d, wu);
    hn::Store(hn::Sub(t, t0), d, wv);
    if (hn::AllTrue(d, v.live)) {
      BilinearGroup(level, offsets, wu, wv, rgba);
    } else {
      for (int j = 0; j < 4 * kLanes; j += kLanes) hn::Store(hn::Zero(d), d, rgba + j);
      for (unsigned todo = MaskBits(v.live); todo != 0; todo &= todo - 1) {
        const int j = __builtin_ctz(todo);
        Bilinear(level.texels + offsets[j], level.pitch, wu[j], wv[j], rgba + 4 * j);
      }
    }
    hn::LoadInterleaved4(d, rgba, v.slot[kTexR], v.slot[kTexG], v.slot[kTexB], v.slot[kTexA]);
  }
};

// Draft: the filter llvmpipe has by default. Coordinates rounded to 1/256 texel, 8-bit weights, x before y, each
// step rounded: a + ((f * (b - a) + 128) >> 8).
struct SampleLinearDraft {
  static constexpr bool kKills = false, kPacks = true;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, int, Lanes& v) {
    const DF d;
    const DI di;
    const LevelRef& level = c.params->levels[0];
    const VI x = Fixed(v.slot[kS], level.width, c.params->sampler.wrap_s);
    const VI y = Fixed(v.slot[kT], level.height, c.params->sampler.wrap_t);
    alignas(64) int32_t xs[8], ys[8];
    alignas(64) uint32_t texels[8] = {};
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
