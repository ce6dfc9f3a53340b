// Logical operation (spec 4.1.9), bit by bit on the colours as the buffer holds them; wide buffers as 16-bit integers.

HWY_INLINE VI Combined(LogicOp op, VI s, VI d) {
  const VI ones = hn::Set(DI(), -1);
  switch (op) {
    case LogicOp::clear: return hn::Zero(DI());
    case LogicOp::and_: return hn::And(s, d);
    case LogicOp::and_reverse: return hn::AndNot(d, s);
    case LogicOp::copy: return s;
    case LogicOp::and_inverted: return hn::AndNot(s, d);
    case LogicOp::noop: return d;
    case LogicOp::xor_: return hn::Xor(s, d);
    case LogicOp::or_: return hn::Or(s, d);
    case LogicOp::nor: return hn::Xor(hn::Or(s, d), ones);
    case LogicOp::equiv: return hn::Xor(hn::Xor(s, d), ones);
    case LogicOp::invert: return hn::Xor(d, ones);
    case LogicOp::or_reverse: return hn::Or(s, hn::Xor(d, ones));
    case LogicOp::copy_inverted: return hn::Xor(s, ones);
    case LogicOp::or_inverted: return hn::Or(hn::Xor(s, ones), d);
    case LogicOp::nand: return hn::Xor(hn::And(s, d), ones);
    case LogicOp::set: break;
  }
  return ones;
}

struct LogicOpRgba8 {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int i, Lanes& v) {
    const DI di;
    const VI old = hn::Load(di, reinterpret_cast<const int32_t*>(c.color) + i);
    v.slot[kPixel] = hn::BitCast(DF(), Combined(c.params->logic_op, hn::BitCast(di, v.slot[kPixel]), old));
  }
};

struct LogicOpRgba32f {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int i, Lanes& v) {
    const DF d;
    const VI most = hn::Set(DI(), 65535);
    for (int k = 0; k < 4; ++k) {
      const VI s = RoundToByte(hn::Mul(v.slot[kR + k], hn::Set(d, 257.0f)));
      const VI dst = RoundToByte(hn::Mul(hn::Load(d, c.color_planes + k * kBlockPixels + i), hn::Set(d, 65535.0f)));
      const VI result = hn::And(Combined(c.params->logic_op, s, dst), most);
      v.slot[kR + k] = hn::Div(hn::ConvertTo(d, result), hn::Set(d, 257.0f));
    }
  }
};
