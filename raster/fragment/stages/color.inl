// The primary colour at each pixel: only as much interpolation as the vertices ask for.

struct ColorConstant {
  static constexpr bool kKills = false, kPacks = true, kInTiles = true;
  // Out here the compiler takes what is worked out from it, too, out of the loop.
  struct Channels {
    VF color[4];
    HWY_INLINE explicit Channels(const BlockContext& c) {
      for (int k = 0; k < 4; ++k) color[k] = hn::Set(DF(), c.params->constant_color[k]);
    }
  };
  template <class L>
  using Once = Channels;
  template <class L>
  static HWY_INLINE void Run(const BlockContext&, const Once<L>& once, int, Lanes& v) {
    for (int k = 0; k < 4; ++k) v.slot[kR + k] = once.color[k];
  }
};

struct ColorFlat {
  static constexpr bool kKills = false, kPacks = true, kInTiles = true;
  template <class L>
  using Once = typename L::FlatColor;
  template <class L>
  static HWY_INLINE void Run(const BlockContext&, const Once<L>& once, int i, Lanes& v) {
    for (int k = 0; k < 4; ++k) v.slot[kR + k] = once.At(k, i);
  }
};

// Beside the bits of Variant, as a template's argument: planes in float, but the divide in double.
inline constexpr unsigned kPreciseDivide = 4;

// To what range a colour is held. What is modulated by texels and then rounded need not be held from below: a product with
// less than 0 rounds to 0, as one with 0 does.
enum class Held { both_ways, from_above, not_at_all };

// kVariant: bits of Variant. Perspective-correct: colour/w over 1/w, one divide a pixel; kAtW: none, w is there already.
template <unsigned kVariant, bool kAtW = false, Held kHeld = Held::both_ways>
struct ColorSmooth {
  static constexpr bool kKills = false, kPacks = (kVariant & kDouble) == 0;
  static constexpr bool kDivides = (kVariant & kAffine) == 0;
  static constexpr bool kInTiles = true, kTakesAlpha = !kDivides;

  struct NoPlane {
    HWY_INLINE NoPlane(const BlockContext&, int) {}
  };
  template <class Plane, class PlaneOfAlpha = Plane>
  struct Planes {
    std::conditional_t<kDivides, Plane, NoPlane> inv_w;
    Plane r, g, b;
    PlaneOfAlpha a;
    HWY_INLINE explicit Planes(const BlockContext& c)
        : inv_w(c, 1),
          r(c, c.params->color_plane),
          g(PlaneAfter<Plane>(c, r, c.params->color_plane, 1)),
          b(PlaneAfter<Plane>(c, r, c.params->color_plane, 2)),
          a(PlaneAfter<PlaneOfAlpha>(c, r, c.params->color_plane, 3)) {}
  };
  template <class L>
  using Once = Planes<std::conditional_t<kPacks, typename L::Plane, typename L::PlaneDouble>,
                      std::conditional_t<kPacks, typename L::PlaneOfAlpha, typename L::PlaneDouble>>;

  template <class L>
  static HWY_INLINE void Run(const BlockContext&, const Once<L>& once, int i, Lanes& v) {
    if constexpr ((kVariant & kPreciseDivide) != 0) {
      const VD inv_w = PromoteGroup(once.inv_w.At(i));
      v.slot[kR] = InDouble(PromoteGroup(once.r.At(i)), inv_w);
      v.slot[kG] = InDouble(PromoteGroup(once.g.At(i)), inv_w);
      v.slot[kB] = InDouble(PromoteGroup(once.b.At(i)), inv_w);
      v.slot[kA] = InDouble(PromoteGroup(once.a.At(i)), inv_w);
    } else if constexpr (kPacks) {
      VF w = hn::Zero(DF());
      if constexpr (kAtW) w = v.slot[kW];
      else if constexpr (kDivides) w = hn::Div(hn::Set(DF(), 1.0f), once.inv_w.At(i));
      v.slot[kR] = InFloat(once.r.At(i), w);
      v.slot[kG] = InFloat(once.g.At(i), w);
      v.slot[kB] = InFloat(once.b.At(i), w);
      v.slot[kA] = InFloat(once.a.At(i), w);
    } else {
      VD inv_w;
      if constexpr (kDivides) inv_w = once.inv_w.At(i);
      v.slot[kR] = InDouble(once.r.At(i), inv_w);
      v.slot[kG] = InDouble(once.g.At(i), inv_w);
      v.slot[kB] = InDouble(once.b.At(i), inv_w);
      v.slot[kA] = InDouble(once.a.At(i), inv_w);
    }
  }

 private:
  static HWY_INLINE VF Clamp(VF x) {
    if constexpr (kHeld == Held::both_ways) x = NotNegative(x);
    if constexpr (kHeld != Held::not_at_all) x = HeldBelow(x, hn::Set(DF(), 255.0f));
    return x;
  }
  static HWY_INLINE VF InFloat(VF value, VF w) { return Clamp(kDivides ? hn::Mul(value, w) : value); }
  static HWY_INLINE VF InDouble(VD value, const VD& inv_w) {
    if constexpr (kDivides)
      for (int p = 0; p < kDoubleParts; ++p) value.part[p] = hn::Div(value.part[p], inv_w.part[p]);
    return Clamp(DemoteGroup(DF(), value));
  }
};

// The draft level, before texels that modulate: as shares of white, so that no product with a texel needs a factor. Held
// from above, as Held::from_above is.
struct ColorShares {
  static constexpr bool kKills = false, kPacks = true, kInTiles = true;
  template <class L>
  using Once = typename ColorSmooth<0, true>::template Once<L>;
  template <class L>
  static HWY_INLINE void Run(const BlockContext&, const Once<L>& once, int i, Lanes& v) {
    const VF w = hn::Mul(v.slot[kW], hn::Set(DF(), 1.0f / 255.0f));
    v.slot[kR] = Share(once.r.At(i), w);
    v.slot[kG] = Share(once.g.At(i), w);
    v.slot[kB] = Share(once.b.At(i), w);
    v.slot[kA] = Share(once.a.At(i), w);
  }

 private:
  static HWY_INLINE VF Share(VF value, VF w) { return HeldBelow(hn::Mul(value, w), hn::Set(DF(), 1.0f)); }
};
