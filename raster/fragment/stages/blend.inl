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

HWY_INLINE WidePixel BlendWeights(BlendFactor factor, const WidePixel& s, const WidePixel& dst) {
  const VU most = hn::Set(DU(), 0x00ff00ffu);
  const auto rest = [&](const WidePixel& p) HWY_ATTR { return WidePixel{hn::Xor(p.rb, most), hn::Xor(p.ga, most)}; };
  const auto alpha = [](const WidePixel& p) HWY_ATTR {
    const VU twice = UpperTwice(p.ga);
    return WidePixel{twice, twice};
  };
  switch (factor) {
    case BlendFactor::zero: return {hn::Zero(DU()), hn::Zero(DU())};
    case BlendFactor::one: return {most, most};
    case BlendFactor::src_color: return s;
    case BlendFactor::one_minus_src_color: return rest(s);
    case BlendFactor::dst_color: return dst;
    case BlendFactor::one_minus_dst_color: return rest(dst);
    case BlendFactor::src_alpha: return alpha(s);
    case BlendFactor::one_minus_src_alpha: return rest(alpha(s));
    case BlendFactor::dst_alpha: return alpha(dst);
    case BlendFactor::one_minus_dst_alpha: return rest(alpha(dst));
    case BlendFactor::src_alpha_saturate: {
      const VU least = Min16(alpha(s).rb, rest(alpha(dst)).rb);
      return {least, hn::Or(hn::And(least, hn::Set(DU(), 0xffffu)), hn::Set(DU(), 0x00ff0000u))};
    }
  }
  return {most, most};
}

// kOver: by the source's alpha, as most blending is; else as the draw says.
template <bool kOver>
struct BlendRgba8 {
  static constexpr bool kKills = false, kPacks = false, kInTiles = true;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int i, Lanes& v) {
    const DU d;
    const WidePixel s = Widen(hn::BitCast(d, v.slot[kPixel])), dst = Widen(hn::Load(d, c.color + i));
    const WidePixel fs = BlendWeights(kOver ? BlendFactor::src_alpha : c.params->blend_src, s, dst);
    const WidePixel fd = BlendWeights(kOver ? BlendFactor::one_minus_src_alpha : c.params->blend_dst, s, dst);
    const WidePixel sum{Blended(s.rb, fs.rb, dst.rb, fd.rb), Blended(s.ga, fs.ga, dst.ga, fd.ga)};
    v.slot[kPixel] = hn::BitCast(DF(), Narrow(sum));
  }

 private:
  static HWY_INLINE VU Blended(VU s, VU fs, VU dst, VU fd) {
    const VU from_s = Mul16(s, fs), from_d = Mul16(dst, fd);
    if constexpr (kOver) return Divided255(hn::Add(from_s, from_d));
    const VU most = hn::Set(DU(), 255u * 255u * 0x10001u);
    return Divided255(Min16(SaturatedAdd16(from_s, from_d), most));
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
