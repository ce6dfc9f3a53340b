// The primary colour at each pixel: only as much interpolation as the vertices ask for.

struct ColorConstant {
  static constexpr bool kKills = false, kPacks = true;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, int, Lanes& v) {
    for (int k = 0; k < 4; ++k) v.slot[kR + k] = hn::Set(DF(), c.params->constant_color[k]);
  }
};

struct ColorFlat {
  static constexpr bool kKills = false, kPacks = true;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, int i, Lanes& v) {
    for (int k = 0; k < 4; ++k) v.slot[kR + k] = L::FlatColor(c, k, i);
  }
};

// kVariant: bits of Variant. Perspective-correct: colour/w over 1/w, one divide a pixel.
template <unsigned kVariant>
struct ColorSmooth {
  static constexpr bool kKills = false, kPacks = (kVariant & kDouble) == 0;
  static HWY_INLINE VF Clamp(VF x) {
    return hn::Min(hn::Max(x, hn::Zero(DF())), hn::Set(DF(), 255.0f));
  }
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, int i, Lanes& v) {
    const int first = c.params->color_plane;
    if constexpr (kVariant == kAffine) {
      for (int k = 0; k < 4; ++k) v.slot[kR + k] = Clamp(L::Plane(c, first + k, i));
    } else if constexpr (kVariant == 0) {
      const VF w = hn::Div(hn::Set(DF(), 1.0f), L::Plane(c, 1, i));
      for (int k = 0; k < 4; ++k) v.slot[kR + k] = Clamp(hn::Mul(L::Plane(c, first + k, i), w));
    } else {
      const VD inv_w = PlaneAtDouble(c, 1, i);
      for (int k = 0; k < 4; ++k) {
        VD value = PlaneAtDouble(c, first + k, i);
        if constexpr ((kVariant & kAffine) == 0)
          for (int p = 0; p < kDoubleParts; ++p) value.part[p] = hn::Div(value.part[p], inv_w.part[p]);
        v.slot[kR + k] = Clamp(DemoteGroup(DF(), value));
      }
    }
  }
};
