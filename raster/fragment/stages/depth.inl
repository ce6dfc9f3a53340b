// Depth test and write (spec 4.1.6). Depth is a 24-bit integer, interpolated in double: right to the last bit.

template <CompareFunc F, bool kWrite>
struct DepthTest {
  static constexpr bool kKills = true, kPacks = false, kTakesDepth = true, kInTiles = true;
  template <class L>
  struct Once {
    typename L::PlaneDouble depth;  // units of 2^-24, one half added: truncation rounds to nearest
    HWY_INLINE explicit Once(const BlockContext& c) : depth(c, 0) {}
  };
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>& once, int i, Lanes& v) {
    const DI d;
    int32_t* memory = reinterpret_cast<int32_t*>(c.depth) + i;
    const VI z = hn::Min(hn::Max(TruncateGroupInRange(once.depth.At(i)), hn::Zero(d)),
                         hn::Set(d, static_cast<int32_t>(kDepthMax)));
    const VI old = hn::Load(d, memory);
    v.live = hn::And(v.live, hn::RebindMask(DF(), Compare<F>(z, old)));
    if constexpr (kWrite) hn::Store(hn::IfThenElse(hn::RebindMask(d, v.live), z, old), d, memory);
  }
};
