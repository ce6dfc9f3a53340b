// Texture environment (spec 3.8.13, tables 3.22 and 3.23). Colours are 0..255, so products carry 1/255.

HWY_INLINE VF Scaled(VF a, VF b) { return hn::Mul(hn::Mul(a, b), hn::Set(DF(), 1.0f / 255.0f)); }
HWY_INLINE VF Mix(VF a, VF b, VF weight) { return hn::Add(a, Scaled(hn::Sub(b, a), weight)); }

// kRgb, kAlpha: whether the texture's base format has them.
template <EnvMode kMode, bool kRgb, bool kAlpha>
struct Env {
  static constexpr bool kKills = false, kPacks = true, kInTiles = true;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int, Lanes& v) {
    for (int k = 0; k < 3; ++k) {
      VF& f = v.slot[kR + k];
      const VF t = v.slot[kTexR + k];
      if constexpr (kMode == EnvMode::decal) {
        f = kAlpha ? Mix(f, t, v.slot[kTexA]) : t;
      } else if constexpr (kRgb) {
        if constexpr (kMode == EnvMode::modulate) f = Scaled(f, t);
        if constexpr (kMode == EnvMode::replace) f = t;
        if constexpr (kMode == EnvMode::blend) f = Mix(f, hn::Set(DF(), c.params->env_color[k]), t);
      }
    }
    if constexpr (kAlpha && kMode == EnvMode::replace) v.slot[kA] = v.slot[kTexA];
    if constexpr (kAlpha && (kMode == EnvMode::modulate || kMode == EnvMode::blend))
      v.slot[kA] = Scaled(v.slot[kA], v.slot[kTexA]);
  }
};

// GL_BLEND with an intensity texture mixes alpha too.
struct EnvBlendIntensity {
  static constexpr bool kKills = false, kPacks = true, kInTiles = true;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int, Lanes& v) {
    for (int k = 0; k < 4; ++k)
      v.slot[kR + k] = Mix(v.slot[kR + k], hn::Set(DF(), c.params->env_color[k]), v.slot[kTexR + k]);
  }
};

// GL_MODULATE of shares (ColorShares).
template <bool kAlpha>
struct ModulateShares {
  static constexpr bool kKills = false, kPacks = true, kInTiles = true;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext&, const Once<L>&, int, Lanes& v) {
    for (int k = 0; k < 3; ++k) v.slot[kR + k] = hn::Mul(v.slot[kR + k], v.slot[kTexR + k]);
    v.slot[kA] = hn::Mul(v.slot[kA], kAlpha ? v.slot[kTexA] : hn::Set(DF(), 255.0f));
  }
};
