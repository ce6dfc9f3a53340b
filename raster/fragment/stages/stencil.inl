// Stencil test (spec 4.1.5). What becomes of the stencil value hangs on the depth test too, so where there is one it is
// made here.

HWY_INLINE VI Changed(StencilOp op, VI old, const StencilState& s) {
  const DI d;
  switch (op) {
    case StencilOp::keep: return old;
    case StencilOp::zero: return hn::Zero(d);
    case StencilOp::replace: return hn::Set(d, static_cast<int32_t>(s.reference));
    case StencilOp::increment: return hn::Min(hn::Add(old, hn::Set(d, 1)), hn::Set(d, 255));
    case StencilOp::decrement: return hn::Max(hn::Sub(old, hn::Set(d, 1)), hn::Zero(d));
    case StencilOp::invert: break;
  }
  return hn::Xor(old, hn::Set(d, 255));
}

template <class L, bool kDepth>
struct StencilOnce {
  typename L::PlaneDouble depth;  // as in DepthTest
  HWY_INLINE explicit StencilOnce(const BlockContext& c) : depth(c, 0) {}
};
template <class L>
struct StencilOnce<L, false> : NothingOnce {
  HWY_INLINE explicit StencilOnce(const BlockContext& c) : NothingOnce(c) {}
};

template <bool kDepth>
struct StencilTest {
  static constexpr bool kKills = true, kPacks = false, kTakesDepth = true;
  template <class L>
  using Once = StencilOnce<L, kDepth>;

  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>& once, int i, Lanes& v) {
    const DI d;
    const hn::Rebind<uint8_t, DI> bytes;
    const StencilState& s = c.params->stencil;
    const VI old = hn::PromoteTo(d, hn::LoadU(bytes, c.stencil + i));
    const VI mask = hn::Set(d, static_cast<int32_t>(s.compare_mask));
    const VI reference = hn::Set(d, static_cast<int32_t>(s.reference & s.compare_mask));
    const auto live = hn::RebindMask(d, v.live);
    auto pass = hn::And(live, Passes(s.func, reference, hn::And(old, mask)));
    VI value = hn::IfThenElse(hn::AndNot(pass, live), Changed(s.fail, old, s), old);
    if constexpr (kDepth) {
      const auto seen = hn::And(pass, TestDepth(c, once, i, pass));
      value = hn::IfThenElse(hn::AndNot(seen, pass), Changed(s.depth_fail, old, s), value);
      pass = seen;
    }
    value = hn::IfThenElse(pass, Changed(s.depth_pass, old, s), value);
    const VI written = hn::Set(d, static_cast<int32_t>(s.write_mask));
    value = hn::Or(hn::And(value, written), hn::AndNot(written, old));
    hn::StoreU(hn::DemoteTo(bytes, value), bytes, c.stencil + i);
    v.live = hn::RebindMask(DF(), pass);
  }

 private:
  template <class Once>
  static HWY_INLINE hn::Mask<DI> TestDepth(const BlockContext& c, const Once& once, int i, hn::Mask<DI> live) {
    const DI d;
    const DepthState& test = c.params->depth;
    int32_t* memory = reinterpret_cast<int32_t*>(c.depth) + i;
    const VI z = hn::Min(hn::Max(DemoteGroup(d, once.depth.At(i)), hn::Zero(d)),
                         hn::Set(d, static_cast<int32_t>(kDepthMax)));
    const VI old = hn::Load(d, memory);
    const auto pass = Passes(test.func, z, old);
    if (test.write) hn::Store(hn::IfThenElse(hn::And(live, pass), z, old), d, memory);
    return pass;
  }
};
