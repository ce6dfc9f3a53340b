// The level-of-detail parameter lambda (spec 3.8.8): rho from the planes' exact derivatives, the longer gradient.

// log2 of positive finite floats, |error| < 1e-4. The exponent is taken from the bits, the mantissa in [0.75, 1.5)
// goes through the series of log2((1 + r) / (1 - r)).
HWY_INLINE VF Log2(VF x) {
  const DF d;
  const DI di;
  const VI bits = hn::BitCast(di, x);
  const VI shifted = hn::Sub(bits, hn::Set(di, 0x3f400000));  // 0.75f
  const VI exponent = hn::ShiftRight<23>(shifted);
  const VF m = hn::BitCast(d, hn::Sub(bits, hn::ShiftLeft<23>(exponent)));
  const VF r = hn::Div(hn::Sub(m, hn::Set(d, 1.0f)), hn::Add(m, hn::Set(d, 1.0f)));
  const VF r2 = hn::Mul(r, r);
  // 2/ln2 * (1 + r^2/3 + r^4/5 + r^6/7)
  VF p = hn::Set(d, 0.41219858f);
  p = hn::Add(hn::Mul(p, r2), hn::Set(d, 0.57707802f));
  p = hn::Add(hn::Mul(p, r2), hn::Set(d, 0.96179669f));
  p = hn::Add(hn::Mul(p, r2), hn::Set(d, 2.88539008f));
  return hn::Add(hn::ConvertTo(d, exponent), hn::Mul(p, r));
}

template <bool kProjective>
struct Lambda {
  static constexpr bool kKills = false, kPacks = false;
  // d(S/Q)/dx = (dS/dx - s * dQ/dx) / Q, in texels of level 0; in double since the difference may cancel.
  template <class L>
  struct Once {
    BlockPlaneDouble divisor, s, t;
    HWY_INLINE explicit Once(const BlockContext& c)
        : divisor(c, kProjective ? c.params->tex_plane + 2 : 1),
          s(c, c.params->tex_plane),
          t(c, c.params->tex_plane + 1) {}
  };
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>& once, int i, Lanes& v) {
    const DF d;
    const SetupBatch& setup = *c.setup;
    const int k = c.lane;
    const int first = c.params->tex_plane;
    const int divisor = kProjective ? first + 2 : 1;
    const bool affine = !kProjective && (setup.variant[k] & kAffine) != 0;
    const VD q = once.divisor.At(i);
    VD x2, y2;  // squared lengths of the gradients along x and y
    for (int p = 0; p < kDoubleParts; ++p) x2.part[p] = y2.part[p] = hn::Zero(DD());
    for (int axis = 0; axis < 2; ++axis) {
      const VD numerator = axis == 0 ? once.s.At(i) : once.t.At(i);
      const auto size = hn::Set(DD(), c.params->lod_scale[axis]);
      for (int p = 0; p < kDoubleParts; ++p) {
        auto gx = hn::Set(DD(), setup.dfdx[first + axis][k]);
        auto gy = hn::Set(DD(), setup.dfdy[first + axis][k]);
        if (!affine) {
          const auto s = hn::Div(numerator.part[p], q.part[p]);
          gx = hn::Div(hn::Sub(gx, hn::Mul(s, hn::Set(DD(), setup.dfdx[divisor][k]))), q.part[p]);
          gy = hn::Div(hn::Sub(gy, hn::Mul(s, hn::Set(DD(), setup.dfdy[divisor][k]))), q.part[p]);
        }
        gx = hn::Mul(gx, size);
        gy = hn::Mul(gy, size);
        x2.part[p] = hn::Add(x2.part[p], hn::Mul(gx, gx));
        y2.part[p] = hn::Add(y2.part[p], hn::Mul(gy, gy));
      }
    }
    for (int p = 0; p < kDoubleParts; ++p) x2.part[p] = hn::Max(x2.part[p], y2.part[p]);
    const VF rho2 = hn::Min(hn::Max(DemoteGroup(d, x2), hn::Set(d, 1e-30f)), hn::Set(d, 1e30f));
    v.slot[kLambda] = hn::Mul(hn::Set(d, 0.5f), Log2(rho2));
  }
};
