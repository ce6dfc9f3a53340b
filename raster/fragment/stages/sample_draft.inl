// Draft: the filter llvmpipe has by default. Coordinates rounded to 1/256 texel, 8-bit weights, x before y, each
// step rounded: a + ((f * (b - a) + 128) >> 8).

// Texel coordinate minus one half, in 1/256.
HWY_INLINE VI FixedCoord(VF s, VF size, Wrap wrap) {
  const VF u = TexelCoord(s, size, wrap, 0.0f);
  return hn::Sub(hn::NearestInt(hn::Mul(u, hn::Set(DF(), 256.0f))), hn::Set(DI(), 128));
}

// A weight in 1/256, as MixBytes takes it: times 128, in both halves of a lane.
HWY_INLINE VF DraftWeight(VI coord) {
#if HWY_TARGET == HWY_AVX3
  // By the units that multiply: shifts take those that add, which have more to do. With a mask, or else g++ makes shifts
  // of it.
  const __m512i weight = _mm512_and_epi32(coord.raw, _mm512_set1_epi32(255));
  return hn::BitCast(DF(), VI{_mm512_maskz_mullo_epi32(0xffff, weight, _mm512_set1_epi32(1 << 7 | 1 << 23))});
#else
  const VI weight = hn::And(hn::ShiftLeft<7>(coord), hn::Set(DI(), 255 << 7));
  return hn::BitCast(DF(), hn::Or(weight, hn::ShiftLeft<16>(weight)));
#endif
}

// As FindPlace; the weights are those of DraftWeight.
HWY_INLINE Place FindPlaceDraft(const LevelRef& level, Wrap wrap_s, Wrap wrap_t, VF s, VF t) {
  const DF d;
  const DI di;
  const VI x = FixedCoord(s, hn::Set(d, level.width), wrap_s), y = FixedCoord(t, hn::Set(d, level.height), wrap_t);
  const VI i = HeldIndex(hn::ShiftRight<8>(x), hn::Set(di, level.width_i), -1);
  const VI j = HeldIndex(hn::ShiftRight<8>(y), hn::Set(di, level.height_i), -1);
  return {TexelOffset(level, i, j), DraftWeight(x), DraftWeight(y)};
}

// The step on two channels a lane, bytes 0 and 2. A product that MulFixedPoint15 rounds is (x * y + 2^14) >> 15; with
// the weight times 128 that is the step's.
HWY_INLINE VU MixBytes(VU a, VU b, VU weight) {
#if HWY_TARGET == HWY_SCALAR
  const auto from = static_cast<int32_t>(hn::GetLane(a)), to = static_cast<int32_t>(hn::GetLane(b));
  const auto f = static_cast<int32_t>(hn::GetLane(weight) >> 7 & 255u);
  const auto mix = [f](int32_t x, int32_t y) { return x + ((f * (y - x) + 128) >> 8); };
  return hn::Set(DU(), static_cast<uint32_t>(mix(from & 255, to & 255) | mix(from >> 16, to >> 16) << 16));
#else
  const hn::Repartition<int16_t, DU> d;
  const auto x = hn::BitCast(d, a), y = hn::BitCast(d, b);
  return hn::BitCast(DU(), hn::Add(x, hn::MulFixedPoint15(hn::Sub(y, x), hn::BitCast(d, weight))));
#endif
}

// Of lanes that hold two bytes each, the upper one.
HWY_INLINE VU UpperHalf(VU pair) {
#if HWY_TARGET == HWY_AVX3
  return VU{_mm512_madd_epi16(pair.raw, _mm512_set1_epi32(1 << 16))};  // as above
#else
  return hn::ShiftRight<16>(pair);
#endif
}

HWY_INLINE void BilinearDraft(const Footprints& texels, VF wu, VF wv, Lanes& v) {
  const DF d;
  const DI di;
  const DU du;
  const VU x = hn::BitCast(du, wu), y = hn::BitCast(du, wv);
  const auto mix = [](const WidePixel& a, const WidePixel& b, VU weight) HWY_ATTR {
    return WidePixel{MixBytes(a.rb, b.rb, weight), MixBytes(a.ga, b.ga, weight)};
  };
  const WidePixel low = mix(Widen(texels.low.first), Widen(texels.low.second), x);
  const WidePixel high = mix(Widen(texels.high.first), Widen(texels.high.second), x);
  const WidePixel sum = mix(low, high, y);
  const VU byte = hn::Set(du, 255u);
  v.slot[kTexR] = hn::ConvertTo(d, hn::BitCast(di, hn::And(sum.rb, byte)));
  v.slot[kTexG] = hn::ConvertTo(d, hn::BitCast(di, hn::And(sum.ga, byte)));
  v.slot[kTexB] = hn::ConvertTo(d, hn::BitCast(di, UpperHalf(sum.rb)));
  v.slot[kTexA] = hn::ConvertTo(d, hn::BitCast(di, UpperHalf(sum.ga)));
}

struct FootprintDraft {
  static constexpr bool kKills = false, kPacks = true, kInTiles = true;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int, Lanes& v) {
    const Sampler& sampler = c.params->sampler;
    const Place place =
        FindPlaceDraft(c.params->levels[0], sampler.wrap_s, sampler.wrap_t, v.slot[kS], v.slot[kT]);
    v.slot[kS] = place.wu;
    v.slot[kT] = place.wv;
    v.slot[kOffset] = hn::BitCast(DF(), place.offset);
  }
};

// The same for REPEAT both ways on sizes that are powers of two: whole turns fall under the mask, and so does what is no
// number.
struct FootprintDraftRepeat {
  static constexpr bool kKills = false, kPacks = true, kInTiles = true;
  template <class L>
  struct Once {
    VF width, height;  // in 1/256 texels
    VI mask_s, mask_t, pitch, first;
    HWY_INLINE explicit Once(const BlockContext& c) {
      const LevelRef& level = c.params->levels[0];
      width = hn::Set(DF(), level.width * 256.0f);
      height = hn::Set(DF(), level.height * 256.0f);
      mask_s = hn::Set(DI(), level.width_i * 256 - 1);
      mask_t = hn::Set(DI(), level.height_i * 256 - 1);
      pitch = hn::Set(DI(), level.pitch);
      first = hn::Set(DI(), level.pitch + 1);
    }
  };
  template <class L>
  static HWY_INLINE void Run(const BlockContext&, const Once<L>& once, int, Lanes& v) {
    const VI x = Coord(v.slot[kS], once.width, once.mask_s), y = Coord(v.slot[kT], once.height, once.mask_t);
    v.slot[kS] = DraftWeight(x);
    v.slot[kT] = DraftWeight(y);
    const VI row = hn::Mul(hn::ShiftRight<8>(y), once.pitch);
    v.slot[kOffset] = hn::BitCast(DF(), hn::Add(row, hn::Add(hn::ShiftRight<8>(x), once.first)));
  }

 private:
  static HWY_INLINE VI Coord(VF s, VF size, VI mask) {
    return hn::And(hn::Sub(NearestInRange(hn::Mul(s, size)), hn::Set(DI(), 128)), mask);
  }
};

struct SampleLinearDraft {
  static constexpr bool kKills = false, kPacks = true, kInTiles = true, kTakesFromMemory = true;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int i, Lanes& v) {
    TakeTexels(FetchTexels(c, i), v);
  }
  static HWY_INLINE Footprints FetchTexels(const BlockContext& c, int i) {
    return Fetch(c.params->levels[0], LaneOffsets(SlotAt(c, kOffset, i)));
  }
  static HWY_INLINE void TakeTexels(const Footprints& texels, Lanes& v) {
    BilinearDraft(texels, v.slot[kS], v.slot[kT], v);
  }
};
