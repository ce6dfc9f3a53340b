// Fog (spec 3.10): f C + (1 - f) Cf, where f follows from the fragment's distance from the eye.

// e^-x for x >= 0, to within 2e-7; exactly 1 at 0. 2^-t = 2^-whole * 2^-rest, the latter a polynomial on [0, 1).
HWY_INLINE VF ExpMinus(VF x) {
  const DF d;
  const DI di;
  VF t = hn::Mul(x, hn::Set(d, 1.44269504f));
  t = hn::IfThenElse(hn::Lt(t, hn::Set(d, 126.0f)), t, hn::Set(d, 126.0f));  // NaN too: as good as nothing left
  const VF whole = hn::Floor(t), rest = hn::Sub(t, whole);
  constexpr float kTerms[] = {-0.693146945f, 0.24021469f, -0.0554085595f, 0.00934423101f, -0.00100363051f};
  VF sum = hn::Set(d, kTerms[4]);
  for (int k = 3; k >= 0; --k) sum = hn::Add(hn::Mul(sum, rest), hn::Set(d, kTerms[k]));
  const VF fraction = hn::Add(hn::Mul(sum, rest), hn::Set(d, 1.0f));
  const VI exponent = hn::Sub(hn::Set(di, 127), TruncateInRange(whole));
  return hn::Mul(fraction, hn::BitCast(d, hn::ShiftLeft<23>(exponent)));
}

// kVariant: bits of Variant.
template <unsigned kVariant>
struct Fog {
  static constexpr bool kKills = false, kPacks = (kVariant & kDouble) == 0;
  static constexpr bool kDivides = (kVariant & kAffine) == 0;

  template <class Plane>
  struct Planes {
    Plane inv_w, distance;
    HWY_INLINE explicit Planes(const BlockContext& c) : inv_w(c, 1), distance(c, c.params->fog.plane) {}
  };
  template <class L>
  using Once = Planes<std::conditional_t<kPacks, typename L::Plane, typename L::PlaneDouble>>;

  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>& once, int i, Lanes& v) {
    const DF d;
    const FogParams& fog = c.params->fog;
    const VF f = Factor(fog.mode, Depth(fog, once, i));
    const VF rest = hn::Sub(hn::Set(d, 1.0f), f);
    for (int k = 0; k < 3; ++k) {
      VF& color = v.slot[kR + k];
      color = hn::Add(hn::Mul(f, color), hn::Mul(rest, hn::Set(d, fog.color[k])));
    }
  }

 private:
  // (distance - origin) * slope.
  template <class Planes>
  static HWY_INLINE VF Depth(const FogParams& fog, const Planes& once, int i) {
    if constexpr (kPacks) {
      const DF d;
      VF distance = once.distance.At(i);
      if constexpr (kDivides) distance = hn::Mul(distance, hn::Div(hn::Set(d, 1.0f), once.inv_w.At(i)));
      return hn::Mul(hn::Sub(distance, hn::Set(d, fog.origin)), hn::Set(d, fog.slope));
    } else {
      const DD d;
      VD distance = once.distance.At(i);
      const VD inv_w = once.inv_w.At(i);
      for (int p = 0; p < kDoubleParts; ++p) {
        if constexpr (kDivides) distance.part[p] = hn::Div(distance.part[p], inv_w.part[p]);
        distance.part[p] = hn::Mul(hn::Sub(distance.part[p], hn::Set(d, static_cast<double>(fog.origin))),
                                   hn::Set(d, static_cast<double>(fog.slope)));
      }
      return DemoteGroup(DF(), distance);
    }
  }

  static HWY_INLINE VF Factor(FogMode mode, VF depth) {
    const DF d;
    const VF x = hn::IfThenElseZero(hn::Gt(depth, hn::Zero(d)), depth);
    switch (mode) {
      case FogMode::exp: return ExpMinus(x);
      case FogMode::exp2: return ExpMinus(hn::Mul(x, x));
      case FogMode::linear: break;
    }
    return hn::IfThenElse(hn::Lt(x, hn::Set(d, 1.0f)), x, hn::Set(d, 1.0f));
  }
};
