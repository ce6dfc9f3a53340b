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

// The draft level's: a cubic in place of the quintic, to within 7.4e-5.
HWY_INLINE VF ExpMinusDraft(VF x) {
  const DF d;
  const DI di;
  VF t = hn::Mul(x, hn::Set(d, 1.44269504f));
  t = hn::IfThenElse(hn::Lt(t, hn::Set(d, 126.0f)), t, hn::Set(d, 126.0f));
  const VI whole = TruncateInRange(t);
  const VF rest = hn::Sub(t, hn::ConvertTo(d, whole));
  VF sum = hn::Add(hn::Mul(rest, hn::Set(d, -0.0396224625f)), hn::Set(d, 0.231299865f));
  sum = hn::Add(hn::Mul(sum, rest), hn::Set(d, -0.6916774025f));
  const VF fraction = hn::Add(hn::Mul(sum, rest), hn::Set(d, 1.0f));
  // Into the exponent of a number in (1/2, 1] at once.
  return hn::BitCast(d, hn::Sub(hn::BitCast(di, fraction), hn::ShiftLeft<23>(whole)));
}

// The share of the fragment's own colour. depth: (distance - origin) * slope.
HWY_INLINE VF FogFactor(FogCurve curve, VF depth) {
  const DF d;
  const VF x = hn::IfThenElseZero(hn::Gt(depth, hn::Zero(d)), depth);
  switch (curve) {
    case FogCurve::exp: return ExpMinus(x);
    case FogCurve::exp2: return ExpMinus(hn::Mul(x, x));
    case FogCurve::linear: break;
    case FogCurve::exp_draft: return ExpMinusDraft(x);
    case FogCurve::exp2_draft: return ExpMinusDraft(hn::Mul(x, x));
  }
  return hn::IfThenElse(hn::Lt(x, hn::Set(d, 1.0f)), x, hn::Set(d, 1.0f));
}

HWY_INLINE void MixFog(const FogParams& fog, VF f, Lanes& v) {
  const DF d;
  const VF rest = hn::Sub(hn::Set(d, 1.0f), f);
  for (int k = 0; k < 3; ++k) {
    VF& color = v.slot[kR + k];
    color = hn::Add(hn::Mul(f, color), hn::Mul(rest, hn::Set(d, fog.color[k])));
  }
}

// kVariant: bits of Variant. kAtW: no divide, w is there already.
template <unsigned kVariant, bool kAtW = false>
struct Fog {
  static constexpr bool kKills = false, kPacks = (kVariant & kDouble) == 0, kInTiles = true;
  static constexpr bool kDivides = (kVariant & kAffine) == 0;

  struct NoPlane {
    HWY_INLINE NoPlane(const BlockContext&, int) {}
  };
  template <class Plane>
  struct Planes {
    std::conditional_t<kDivides && !kAtW, Plane, NoPlane> inv_w;
    Plane distance;
    HWY_INLINE explicit Planes(const BlockContext& c) : inv_w(c, 1), distance(c, c.params->fog.plane) {}
  };
  template <class L>
  using Once = Planes<std::conditional_t<kPacks, typename L::Plane, typename L::PlaneDouble>>;

  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>& once, int i, Lanes& v) {
    const FogParams& fog = c.params->fog;
    MixFog(fog, FogFactor(fog.curve, Depth(fog, once, i, v)), v);
  }

 private:
  // (distance - origin) * slope.
  template <class Planes>
  static HWY_INLINE VF Depth(const FogParams& fog, const Planes& once, int i, const Lanes& v) {
    if constexpr ((kVariant & kPreciseDivide) != 0) {
      return InDouble(fog, PromoteGroup(once.distance.At(i)), PromoteGroup(once.inv_w.At(i)));
    } else if constexpr (kPacks) {
      const DF d;
      VF distance = once.distance.At(i);
      if constexpr (kAtW) distance = hn::Mul(distance, v.slot[kW]);
      else if constexpr (kDivides) distance = hn::Mul(distance, hn::Div(hn::Set(d, 1.0f), once.inv_w.At(i)));
      return hn::Mul(hn::Sub(distance, hn::Set(d, fog.origin)), hn::Set(d, fog.slope));
    } else {
      VD inv_w;
      if constexpr (kDivides) inv_w = once.inv_w.At(i);
      return InDouble(fog, once.distance.At(i), inv_w);
    }
  }
  static HWY_INLINE VF InDouble(const FogParams& fog, VD distance, const VD& inv_w) {
    const DD d;
    for (int p = 0; p < kDoubleParts; ++p) {
      if constexpr (kDivides) distance.part[p] = hn::Div(distance.part[p], inv_w.part[p]);
      distance.part[p] = hn::Mul(hn::Sub(distance.part[p], hn::Set(d, static_cast<double>(fog.origin))),
                                 hn::Set(d, static_cast<double>(fog.slope)));
    }
    return DemoteGroup(DF(), distance);
  }
};
