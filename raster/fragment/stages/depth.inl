// Depth test and write (spec 4.1.6). Depth is a 24-bit integer, interpolated in double: right to the last bit.

HWY_INLINE VI DepthAt(const BlockContext& c, int i) {
  const VD z = PlaneAtDouble(c, 0, i);  // units of 2^-24, one half added: truncation rounds to nearest
  const DI d;
  return hn::Min(hn::Max(DemoteGroup(d, z), hn::Zero(d)), hn::Set(d, static_cast<int32_t>(kDepthMax)));
}

template <CompareFunc F, bool kWrite>
struct DepthTest {
  static constexpr bool kKills = true, kPacks = false;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, int i, Lanes& v) {
    const DI d;
    int32_t* memory = reinterpret_cast<int32_t*>(c.depth) + i;
    const VI z = DepthAt(c, i);
    const VI old = hn::Load(d, memory);
    v.live = hn::And(v.live, hn::RebindMask(DF(), Compare<F>(z, old)));
    if constexpr (kWrite) hn::Store(hn::IfThenElse(hn::RebindMask(d, v.live), z, old), d, memory);
  }
};
