// The primary colour and texture coordinates at the exact level: planes and divides in double.

struct ColorConstantWide {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int, Lanes& v) {
    for (int k = 0; k < 4; ++k) PutWide(SetWide(c.params->exact.constant_color[k]), kR + k, v);
  }
};

struct ColorFlatWide {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int, Lanes& v) {
    for (int k = 0; k < 4; ++k) PutWide(SetWide(c.setup->exact_flat[k][c.lane]), kR + k, v);
  }
};

struct ColorSmoothWide {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  using Once = ColorSmooth<kDouble>::Planes<BlockPlaneDouble>;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>& once, int i, Lanes& v) {
    const bool affine = (c.setup->variant[c.lane] & kAffine) != 0;
    const VD divisor = affine ? SetWide(1) : once.inv_w.At(i);
    PutWide(ClampLevels(DivWide(once.r.At(i), divisor)), kR, v);
    PutWide(ClampLevels(DivWide(once.g.At(i), divisor)), kG, v);
    PutWide(ClampLevels(DivWide(once.b.At(i), divisor)), kB, v);
    PutWide(ClampLevels(DivWide(once.a.At(i), divisor)), kA, v);
  }
};

template <bool kProjective>
struct CoordWide {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  using Once = typename Coord<kDouble, kProjective>::template Planes<BlockPlaneDouble>;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>& once, int i, Lanes& v) {
    const bool affine = !kProjective && (c.setup->variant[c.lane] & kAffine) != 0;
    const VD divisor = affine ? SetWide(1) : once.divisor.At(i);
    PutWide(WithoutTurns(DivWide(once.s.At(i), divisor), c.params->sampler.wrap_s), kS, v);
    PutWide(WithoutTurns(DivWide(once.t.At(i), divisor), c.params->sampler.wrap_t), kT, v);
  }

 private:
  static HWY_INLINE VD WithoutTurns(const VD& v, Wrap wrap) {
    return wrap == Wrap::repeat ? SubWide(v, FloorWide(v)) : v;
  }
};
