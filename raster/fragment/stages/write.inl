// To memory (spec 4.2): round to nearest, and only the channels the colour mask lets through.

template <bool kMasked>
struct WriteRgba8 {
  static constexpr bool kKills = false, kPacks = !kMasked;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int i, Lanes& v) {
    VI packed = hn::Or(hn::Or(RoundToByte(v.slot[kR]), hn::ShiftLeft<8>(RoundToByte(v.slot[kG]))),
                       hn::Or(hn::ShiftLeft<16>(RoundToByte(v.slot[kB])), hn::ShiftLeft<24>(RoundToByte(v.slot[kA]))));
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
