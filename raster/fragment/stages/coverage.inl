// How much of the pixel a smooth point, line or polygon covers multiplies alpha (spec 3.13, RGBA mode).

struct Coverage {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int i, Lanes& v) {
    v.slot[kA] = hn::Mul(v.slot[kA], hn::Load(DF(), c.coverage + i));
  }
};
