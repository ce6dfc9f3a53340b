// Blending (spec 4.1.7). On 8-bit surfaces the colour is first rounded to 8 bits; then s * fs + d * fd is exact in
// integers and rounded once.

// Factor for channel k in 0..one; the four channels of s and d are given in the same scale.
template <class V, class D>
HWY_INLINE V BlendWeight(D d, BlendFactor factor, const V* s, const V* dst, int k, V one) {
  switch (factor) {
    case BlendFactor::zero: return hn::Zero(d);
    case BlendFactor::one: return one;
    case BlendFactor::src_color: return s[k];
    case BlendFactor::one_minus_src_color: return hn::Sub(one, s[k]);
    case BlendFactor::dst_color: return dst[k];
    case BlendFactor::one_minus_dst_color: return hn::Sub(one, dst[k]);
    case BlendFactor::src_alpha: return s[3];
    case BlendFactor::one_minus_src_alpha: return hn::Sub(one, s[3]);
    case BlendFactor::dst_alpha: return dst[3];
    case BlendFactor::one_minus_dst_alpha: return hn::Sub(one, dst[3]);
    case BlendFactor::src_alpha_saturate: return k == 3 ? one : hn::Min(s[3], hn::Sub(one, dst[3]));
  }
  return one;
}

HWY_INLINE VI RoundToByte(VF v) { return TruncateInRange(hn::Add(v, hn::Set(DF(), 0.5f))); }

struct BlendRgba8 {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int i, Lanes& v) {
    const DI d;
    const VI old = hn::BitCast(d, hn::Load(DU(), c.color + i));
    const VI byte = hn::Set(d, 255);
    const VI dst[4] = {hn::And(old, byte), hn::And(hn::ShiftRight<8>(old), byte),
                       hn::And(hn::ShiftRight<16>(old), byte), hn::And(hn::ShiftRight<24>(old), byte)};
    VI s[4];
    for (int k = 0; k < 4; ++k) s[k] = RoundToByte(v.slot[kR + k]);
    for (int k = 0; k < 4; ++k) {
      const VI fs = BlendWeight(d, c.params->blend_src, s, dst, k, byte);
      const VI fd = BlendWeight(d, c.params->blend_dst, s, dst, k, byte);
      const VI sum = hn::Min(hn::Add(hn::Mul(s[k], fs), hn::Mul(dst[k], fd)), hn::Set(d, 255 * 255));
      const VI x = hn::Add(sum, hn::Set(d, 128));
      v.slot[kR + k] = hn::ConvertTo(DF(), hn::ShiftRight<8>(hn::Add(x, hn::ShiftRight<8>(x))));
    }
  }
};

struct BlendRgba32f {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int i, Lanes& v) {
    const DF d;
    const VF one = hn::Set(d, 255.0f);
    VF s[4], dst[4];
    for (int k = 0; k < 4; ++k) {
      s[k] = v.slot[kR + k];
      dst[k] = hn::Mul(hn::Load(d, c.color_planes + k * kBlockPixels + i), one);
    }
    for (int k = 0; k < 4; ++k) {
      const VF fs = BlendWeight(d, c.params->blend_src, s, dst, k, one);
      const VF fd = BlendWeight(d, c.params->blend_dst, s, dst, k, one);
      const VF sum = hn::Div(hn::Add(hn::Mul(s[k], fs), hn::Mul(dst[k], fd)), one);
      v.slot[kR + k] = hn::Min(hn::Max(sum, hn::Zero(d)), one);
    }
  }
};
