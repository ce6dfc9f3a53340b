// What happens to a colour at the exact level: in double, rounded once, on its way to memory.

HWY_INLINE VD ScaledWide(const VD& a, const VD& b) { return DivWide(MulWide(a, b), SetWide(255)); }
HWY_INLINE VD MixWide(const VD& a, const VD& b, const VD& weight) {
  return AddWide(a, ScaledWide(SubWide(b, a), weight));
}

// Texture environment (spec 3.8.13, tables 3.22 and 3.23).
struct EnvWide {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int, Lanes& v) {
    const ExactParams& p = c.params->exact;
    VD f[4], t[4];
    for (int k = 0; k < 4; ++k) {
      f[k] = GetWide(v, kR + k, true);
      t[k] = GetWide(v, kTexR + k, HasWideTexel(c));
    }
    for (int k = 0; k < 3 && p.env_rgb; ++k) {
      switch (p.env) {
        case EnvMode::modulate: f[k] = ScaledWide(f[k], t[k]); break;
        case EnvMode::replace: f[k] = t[k]; break;
        case EnvMode::decal: f[k] = p.env_alpha ? MixWide(f[k], t[k], t[3]) : t[k]; break;
        case EnvMode::blend: f[k] = MixWide(f[k], SetWide(p.env_color[k]), t[k]); break;
      }
    }
    if (p.env_alpha && p.env != EnvMode::decal) {
      if (p.env == EnvMode::replace) f[3] = t[3];
      else f[3] = p.env_mixes_alpha ? MixWide(f[3], SetWide(p.env_color[3]), t[3]) : ScaledWide(f[3], t[3]);
    }
    for (int k = 0; k < 4; ++k) PutWide(f[k], kR + k, v);
  }
};

// Fog (spec 3.10), its factor as accurate as the fog axis says.
struct FogWide {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  using Once = Fog<kDouble>::Planes<BlockPlaneDouble>;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>& once, int i, Lanes& v) {
    const ExactParams& p = c.params->exact;
    const bool affine = (c.setup->variant[c.lane] & kAffine) != 0;
    VD distance = once.distance.At(i);
    if (!affine) distance = DivWide(distance, once.inv_w.At(i));
    const VD depth = MulWide(SubWide(distance, SetWide(p.fog_origin)), SetWide(p.fog_slope));
    const VD f = Factor(c, depth), rest = SubWide(SetWide(1), f);
    for (int k = 0; k < 3; ++k) {
      const VD color = GetWide(v, kR + k, IsWide(c));
      PutWide(AddWide(MulWide(f, color), MulWide(rest, SetWide(p.fog_color[k]))), kR + k, v);
    }
    PutWide(GetWide(v, kA, IsWide(c)), kA, v);
  }

 private:
  static HWY_INLINE VD Factor(const BlockContext& c, const VD& depth) {
    const FogCurve curve = c.params->fog.curve;
    if (curve != FogCurve::linear && c.params->accuracy.fog != Level::exact)
      return PromoteGroup(FogFactor(curve, DemoteGroup(DF(), depth)));
    alignas(64) double x[kMaxLanes];
    StoreWide(depth, x);
    for (int j = 0; j < kLanes; ++j) {
      const double held = x[j] > 0 ? x[j] : 0;
      if (curve == FogCurve::linear) x[j] = held < 1 ? held : 1;
      else x[j] = ExactExpMinus(curve == FogCurve::exp ? held : held * held);
    }
    return LoadWide(x);
  }
};

struct CoverageWide {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int i, Lanes& v) {
    PutWide(MulWide(GetWide(v, kA, true), PromoteGroup(hn::Load(DF(), c.coverage + i))), kA, v);
  }
};

struct AlphaTestWide {
  static constexpr bool kKills = true, kPacks = false;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int, Lanes& v) {
    // The sign of the difference is what counts; it survives as a float.
    const VD above = SubWide(GetWide(v, kA, true), SetWide(c.params->exact.alpha_reference));
    v.live = hn::And(v.live, Passes(c.params->alpha_func, DemoteGroup(DF(), above), hn::Zero(DF())));
  }
};

// Blending (spec 4.1.7). Where bytes are kept, the colour becomes bytes first (2.14.9), as at every level.
template <bool kFloatTarget>
struct BlendWide {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int i, Lanes& v) {
    const DD d;
    VD s[4], dst[4], result[4];
    Lanes old;
    if constexpr (!kFloatTarget) UnpackTexels(hn::Load(DU(), c.color + i), old);
    for (int k = 0; k < 4; ++k) {
      s[k] = GetWide(v, kR + k, true);
      for (int p = 0; p < kDoubleParts && !kFloatTarget; ++p)
        s[k].part[p] = hn::Floor(hn::Add(s[k].part[p], hn::Set(d, 0.5)));
      dst[k] = kFloatTarget
                   ? MulWide(PromoteGroup(hn::Load(DF(), c.color_planes + k * kBlockPixels + i)), SetWide(255))
                   : PromoteGroup(old.slot[kTexR + k]);
    }
    const auto one = hn::Set(d, 255.0);
    for (int p = 0; p < kDoubleParts; ++p) {
      const hn::Vec<DD> from[4] = {s[0].part[p], s[1].part[p], s[2].part[p], s[3].part[p]};
      const hn::Vec<DD> to[4] = {dst[0].part[p], dst[1].part[p], dst[2].part[p], dst[3].part[p]};
      for (int k = 0; k < 4; ++k) {
        const auto fs = BlendWeight(d, c.params->blend_src, from, to, k, one);
        const auto fd = BlendWeight(d, c.params->blend_dst, from, to, k, one);
        result[k].part[p] = hn::Div(hn::Add(hn::Mul(from[k], fs), hn::Mul(to[k], fd)), one);
      }
    }
    for (int k = 0; k < 4; ++k) PutWide(ClampLevels(result[k]), kR + k, v);
  }
};

struct WriteRgba8Wide {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int i, Lanes& v) {
    const DI d;
    VI byte[4];
    for (int k = 0; k < 4; ++k) byte[k] = DemoteGroup(d, AddWide(GetWide(v, kR + k, true), SetWide(0.5)));
    const VI color = hn::Or(hn::Or(byte[0], hn::ShiftLeft<8>(byte[1])),
                            hn::Or(hn::ShiftLeft<16>(byte[2]), hn::ShiftLeft<24>(byte[3])));
    const VI old = hn::Load(d, reinterpret_cast<const int32_t*>(c.color) + i);
    const VI mask = hn::Set(d, static_cast<int32_t>(c.params->color_mask));
    L::StoreRgba8(c, i, hn::Or(hn::And(mask, color), hn::AndNot(mask, old)), v.live);
  }
};

struct WriteRgba32fWide {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int i, Lanes& v) {
    const DF d;
    for (int k = 0; k < 4; ++k) {
      if (((c.params->color_mask >> (8 * k)) & 255u) == 0) continue;
      float* memory = c.color_planes + k * kBlockPixels + i;
      const VF value = DemoteGroup(d, DivWide(GetWide(v, kR + k, true), SetWide(255)));
      hn::Store(hn::IfThenElse(v.live, value, hn::Load(d, memory)), d, memory);
    }
  }
};
