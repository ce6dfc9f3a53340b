// Texture coordinates s, t at each pixel (spec 3.8, figure 3.10: s/q, t/q when q varies).

template <unsigned kVariant, bool kProjective>
struct Coord {
  static constexpr bool kKills = false, kPacks = (kVariant & kDouble) == 0, kInTiles = true;
  static constexpr bool kDivides = (kVariant & kAffine) == 0 || kProjective;

  template <class Plane>
  struct Planes {
    Plane divisor, s, t;
    HWY_INLINE explicit Planes(const BlockContext& c)
        : divisor(c, kProjective ? c.params->tex_plane + 2 : 1),
          s(c, c.params->tex_plane),
          t(PlaneAfter<Plane>(c, s, c.params->tex_plane, 1)) {}
  };
  template <class L>
  using Once = Planes<std::conditional_t<kPacks, typename L::Plane, typename L::PlaneDouble>>;

  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>& once, int i, Lanes& v) {
    if constexpr ((kVariant & kPreciseDivide) != 0) {
      const VD divisor = PromoteGroup(once.divisor.At(i));
      v.slot[kS] = InDouble(PromoteGroup(once.s.At(i)), divisor, c.params->sampler.wrap_s);
      v.slot[kT] = InDouble(PromoteGroup(once.t.At(i)), divisor, c.params->sampler.wrap_t);
    } else if constexpr (!kPacks) {
      const VD divisor = once.divisor.At(i);
      v.slot[kS] = InDouble(once.s.At(i), divisor, c.params->sampler.wrap_s);
      v.slot[kT] = InDouble(once.t.At(i), divisor, c.params->sampler.wrap_t);
    } else if constexpr (kDivides) {
      const VF w = hn::Div(hn::Set(DF(), 1.0f), once.divisor.At(i));
      v.slot[kS] = hn::Mul(once.s.At(i), w);
      v.slot[kT] = hn::Mul(once.t.At(i), w);
      v.slot[kW] = w;
    } else {
      v.slot[kS] = once.s.At(i);
      v.slot[kT] = once.t.At(i);
    }
  }

 private:
  // With REPEAT whole turns are taken off before anything becomes float.
  static HWY_INLINE VF InDouble(VD value, const VD& divisor, Wrap wrap) {
    if constexpr (kDivides)
      for (int p = 0; p < kDoubleParts; ++p) value.part[p] = hn::Div(value.part[p], divisor.part[p]);
    if (wrap == Wrap::repeat)
      for (int p = 0; p < kDoubleParts; ++p) value.part[p] = hn::Sub(value.part[p], hn::Floor(value.part[p]));
    return DemoteGroup(DF(), value);
  }
};
