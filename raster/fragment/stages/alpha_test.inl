// Alpha test (spec 4.1.4).

template <class V>
HWY_INLINE auto Passes(CompareFunc func, V a, V b) {
  switch (func) {
    case CompareFunc::never: return Compare<CompareFunc::never>(a, b);
    case CompareFunc::less: return Compare<CompareFunc::less>(a, b);
    case CompareFunc::equal: return Compare<CompareFunc::equal>(a, b);
    case CompareFunc::less_equal: return Compare<CompareFunc::less_equal>(a, b);
    case CompareFunc::greater: return Compare<CompareFunc::greater>(a, b);
    case CompareFunc::not_equal: return Compare<CompareFunc::not_equal>(a, b);
    case CompareFunc::greater_equal: return Compare<CompareFunc::greater_equal>(a, b);
    case CompareFunc::always: break;
  }
  return Compare<CompareFunc::always>(a, b);
}

struct AlphaTest {
  static constexpr bool kKills = true, kPacks = false, kInTiles = true;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int, Lanes& v) {
    const VF reference = hn::Set(DF(), c.params->alpha_reference);
    v.live = hn::And(v.live, Passes(c.params->alpha_func, v.slot[kA], reference));
  }
};
