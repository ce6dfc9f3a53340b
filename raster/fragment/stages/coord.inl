// Texture coordinates s, t at each pixel (spec 3.8, figure 3.10: s/q, t/q when q varies).

template <unsigned kVariant, bool kProjective>
struct Coord {
  static constexpr bool kKills = false, kPacks = (kVariant & kDouble) == 0;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, int i, Lanes& v) {
    const int first = c.params->tex_plane;
    const int divisor = kProjective ? first + 2 : 1;
    if constexpr (kVariant == kAffine && !kProjective) {
      v.slot[kS] = L::Plane(c, first, i);
      v.slot[kT] = L::Plane(c, first + 1, i);
    } else if constexpr ((kVariant & kDouble) == 0) {
      const VF w = hn::Div(hn::Set(DF(), 1.0f), L::Plane(c, divisor, i));
      v.slot[kS] = hn::Mul(L::Plane(c, first, i), w);
      v.slot[kT] = hn::Mul(L::Plane(c, first + 1, i), w);
    } else {
      v.slot[kS] = DoubleAt(c, first, divisor, c.params->sampler.wrap_s, i);
      v.slot[kT] = DoubleAt(c, first + 1, divisor, c.params->sampler.wrap_t, i);
    }
  }

 private:
  // With REPEAT whole turns are taken off before anything becomes float.
  static HWY_INLINE VF DoubleAt(const BlockContext& c, int plane, int divisor, Wrap wrap, int i) {
    VD value = PlaneAtDouble(c, plane, i);
    if constexpr ((kVariant & kAffine) == 0 || kProjective) {
      const VD w = PlaneAtDouble(c, divisor, i);
      for (int p = 0; p < kDoubleParts; ++p) value.part[p] = hn::Div(value.part[p], w.part[p]);
    }
    if (wrap == Wrap::repeat)
      for (int p = 0; p < kDoubleParts; ++p) value.part[p] = hn::Sub(value.part[p], hn::Floor(value.part[p]));
    return DemoteGroup(DF(), value);
  }
};
