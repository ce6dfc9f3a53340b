// To memory (spec 4.2): round to nearest, and only the channels the colour mask lets through.

template <bool kMasked>
struct WriteRgba8 {
  static constexpr bool kKills = false;
  static HWY_INLINE void Run(const BlockContext& c, int i, Lanes& v) {
    const DI d;
    int32_t* memory = reinterpret_cast<int32_t*>(c.color) + i;
    VI packed = hn::Or(hn::Or(RoundToByte(v.slot[kR]), hn::ShiftLeft<8>(RoundToByte(v.slot[kG]))),
                       hn::Or(hn::ShiftLeft<16>(RoundToByte(v.slot[kB])), hn::ShiftLeft<24>(RoundToByte(v.slot[kA]))));
    if constexpr (kMasked) {
      const VI mask = hn::Set(d, static_cast<int32_t>(c.params->color_mask));
      packed = hn::Or(hn::And(mask, packed), hn::AndNot(mask, hn::Load(d, memory)));
    }
    hn::Store(hn::IfThenElse(hn::RebindMask(d, v.live), packed, hn::Load(d, memory)), d, memory);
  }
};

struct WriteRgba32f {
  static constexpr bool kKills = false;
  static HWY_INLINE void Run(const BlockContext& c, int i, Lanes& v) {
    const DF d;
    for (int k = 0; k < 4; ++k) {
      if (((c.params->color_mask >> (8 * k)) & 255u) == 0) continue;
      float* memory = c.color_planes + k * kBlockPixels + i;
      const VF value = hn::Div(v.slot[kR + k], hn::Set(d, 255.0f));
      hn::Store(hn::IfThenElse(v.live, value, hn::Load(d, memory)), d, memory);
    }
  }
};
