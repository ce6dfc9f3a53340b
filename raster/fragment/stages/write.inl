// To memory (spec 4.2), and only the channels the colour mask lets through. Bytes are rounded to nearest (spec 2.14.9).

// kToEven: where two are as near, the even one, as llvmpipe does; else the upper one.
template <bool kToEven>
struct RoundRgba8 {
  static constexpr bool kKills = false, kPacks = true, kInTiles = true;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext&, const Once<L>&, int, Lanes& v) {
    const auto byte = [&v](int k) HWY_ATTR { return kToEven ? NearestInRange(v.slot[k]) : RoundToByte(v.slot[k]); };
    v.slot[kPixel] = hn::BitCast(DF(), PackPixel(byte(kR), byte(kG), byte(kB), byte(kA)));
  }
};

template <bool kMasked>
struct WriteRgba8 {
  static constexpr bool kKills = false, kPacks = !kMasked, kStoresPixels = true, kInTiles = true;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int i, Lanes& v) {
    VI packed = hn::BitCast(DI(), v.slot[kPixel]);
    if constexpr (kMasked) {
      const DI d;
      const VI old = hn::Load(d, reinterpret_cast<const int32_t*>(c.color) + i);
      const VI mask = hn::Set(d, static_cast<int32_t>(c.params->color_mask));
      packed = hn::Or(hn::And(mask, packed), hn::AndNot(mask, old));
    }
    L::StoreRgba8(c, i, packed, v.live);
  }
};

struct WriteRgba32f {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int i, Lanes& v) {
    const DF d;
    for (int k = 0; k < 4; ++k) {
      if (((c.params->color_mask >> (8 * k)) & 255u) == 0) continue;
      float* memory = c.color_planes + k * kBlockPixels + i;
      const VF value = hn::Div(v.slot[kR + k], hn::Set(d, 255.0f));
      hn::Store(hn::IfThenElse(v.live, value, hn::Load(d, memory)), d, memory);
    }
  }
};
