// What is known of depth without looking at pixels: the planes' least and greatest depth in a block or a tile, and the
// bounds that a tile keeps of its blocks. Whole blocks are rejected, or accepted, by them. Compiled once per ISA level.

// The plane's least (sign = -1) or greatest (sign = 1) depth over the pixel centres of a box that begins (dx, dy) from
// the anchor and reaches (across, up) pixels further: that of the pixel in one of its corners, to the last bit.
HWY_INLINE double BoxDepth(const SetupBatch& s, int lane, double dx, double dy, int across, int up, int sign) {
  const double gx = s.dfdx[0][lane], gy = s.dfdy[0][lane];
  const double far_x = (gx > 0) == (sign > 0) ? dx + across : dx;
  const double far_y = (gy > 0) == (sign > 0) ? dy + up : dy;
  return s.f0[0][lane] + gy * far_y + gx * far_x;
}

// Coarse z, rounded away from the decision: true only if no pixel of the box can be as near as `deepest`.
HWY_INLINE bool IsBehind(double least, uint32_t deepest) {
  if (least > kDepthScale) least = kDepthScale;  // an offset may take it beyond; fragments are held to the range
  return least - 1.0 > static_cast<double>(deepest) + 1.0;
}

// The deepest any pixel of the tile lies, as far as its blocks know.
HWY_INLINE uint32_t DeepestOfTile(TileContext& t) {
  if (!t.knows_deepest) {
    const hn::CappedTag<uint32_t, 16> d;
    auto deepest = hn::Zero(d);
    for (size_t i = 0; i < kTileBlocks; i += hn::Lanes(d)) deepest = hn::Max(deepest, hn::LoadU(d, t.state->depth_max + i));
    t.deepest = hn::GetLane(hn::MaxOfLanes(d, deepest));
    t.knows_deepest = true;
  }
  return t.deepest;
}

HWY_INLINE bool TileHides(TileContext& t, int lane) {
  if (!t.program->rejects_deeper) return false;
  const SetupBatch& s = t.setup;
  const uint32_t deepest = DeepestOfTile(t);
  if (deepest == kDepthMax) return false;
  const int x = s.min_x[lane], y = s.min_y[lane];
  return IsBehind(BoxDepth(s, lane, s.anchor_x[lane] + x, s.anchor_y[lane] + y, s.max_x[lane] - x, s.max_y[lane] - y, -1),
                  deepest);
}

HWY_INLINE bool BlockIsHidden(const TileContext& t, int lane, int block) {
  const double least = BoxDepth(t.setup, lane, t.block.dx, t.block.dy, kBlockSize - 1, kBlockSize - 1, -1);
  return IsBehind(least, t.state->depth_max[block]);
}

// After fragments at pixels of a block, or at all of them (`full`).
HWY_INLINE void UpdateDepthBounds(TileContext& t, int lane, int block, bool full) {
  if (!t.program->writes_depth) return;
  t.state->depth_min_holds &= ~(uint64_t{1} << block);
  if (t.program->depth_may_grow) {
    t.state->depth_max[block] = kDepthMax;
    t.knows_deepest = false;
  } else if (full && t.program->depth_pass_lowers) {
    const double greatest = BoxDepth(t.setup, lane, t.block.dx, t.block.dy, kBlockSize - 1, kBlockSize - 1, 1) + 1.0;
    if (greatest >= 0 && greatest < static_cast<double>(t.state->depth_max[block])) {
      t.state->depth_max[block] = static_cast<uint32_t>(greatest);
      t.knows_deepest = false;
    }
  }
}

// --- All blocks of a tile at once, for a triangle that covers many. LESS and LEQUAL only.

template <class D>
HWY_INLINE uint64_t BitsOfMask(D d, hn::Mask<D> mask) {
#if HWY_TARGET == HWY_SCALAR
  return hn::AllFalse(d, mask) ? 0u : 1u;
#else
  uint8_t bits[8] = {};
  hn::StoreMaskBits(d, mask, bits);
  return bits[0] & ((uint64_t{1} << kDoubleLanes) - 1);
#endif
}
template <class D>
HWY_INLINE hn::Mask<D> MaskOfBits(D d, uint64_t bits) {
#if HWY_TARGET == HWY_SCALAR
  return hn::Ne(hn::Set(d, static_cast<int32_t>(bits & 1)), hn::Zero(d));
#else
  const auto low = static_cast<uint8_t>(bits & ((uint64_t{1} << kDoubleLanes) - 1));
  return hn::LoadMaskBits(d, &low);
#endif
}

// What of a triangle's blocks needs no test of each pixel.
struct CoarseDepth {
  uint64_t hidden = 0;  // no fragment passes
  uint64_t nearer = 0;  // every fragment passes
};

class BlockDepths {
 public:
  HWY_INLINE BlockDepths(const SetupBatch& s, int lane, uint64_t blocks)
      : gx_(s.dfdx[0][lane]), gy_(s.dfdy[0][lane]), f0_(s.f0[0][lane]), dy_(s.anchor_y[lane]) {
    const DD d;
    const double dx = s.anchor_x[lane];
    for (int i = 0; i < 8; i += kDoubleLanes) {
      const VD column = hn::Add(hn::Mul(hn::Iota(d, 0), hn::Set(d, kBlockSize)), hn::Set(d, dx + i * kBlockSize));
      const VD end = hn::Add(column, hn::Set(d, kBlockSize - 1));
      hn::Store(hn::Mul(hn::Set(d, gx_), gx_ > 0 ? column : end), d, least_x_ + i);
      hn::Store(hn::Mul(hn::Set(d, gx_), gx_ > 0 ? end : column), d, greatest_x_ + i);
    }
    first_ = __builtin_ctzll(blocks) / 8;
    last_ = (63 - __builtin_clzll(blocks)) / 8;
  }

  HWY_INLINE CoarseDepth Compare(const TileState& state, bool or_equal) const {
    const DD d;
    CoarseDepth coarse;
    const VD one = hn::Set(d, 1.0), slack = hn::Set(d, or_equal ? 1.0 : 0.0);
    for (int row = first_; row <= last_; ++row) {
      for (int i = 0; i < 8; i += kDoubleLanes) {
        const int block = row * 8 + i;
        const VD nearest = hn::PromoteTo(d, Load(state.depth_min + block));
        coarse.hidden |= HiddenBlocks(row, i, state);
        // A fragment before the near plane is held to 0, so it lies before a depth of at least 1 only.
        const VD before = hn::IfThenElse(hn::Ge(nearest, one), hn::Add(nearest, slack), hn::Set(d, -1e300));
        coarse.nearer |= BitsOfMask(d, hn::Lt(Greatest(row, i), before)) << block;
      }
    }
    coarse.nearer &= state.depth_min_holds;
    return coarse;
  }

  // What Compare finds hidden, and nothing else.
  HWY_INLINE uint64_t Hidden(const TileState& state) const {
    uint64_t hidden = 0;
    for (int row = first_; row <= last_; ++row)
      for (int i = 0; i < 8; i += kDoubleLanes) hidden |= HiddenBlocks(row, i, state);
    return hidden;
  }

  // After pixels of `tested` were tested and written, all those of `whole` among them, and all of `nearer` written.
  HWY_INLINE void Update(uint64_t tested, uint64_t whole, uint64_t nearer, TileState& state) const {
    const DDi d;
    for (int row = first_; row <= last_; ++row) {
      for (int i = 0; i < 8; i += kDoubleLanes) {
        const int block = row * 8 + i;
        const VD far = Greatest(row, i);
        const auto least = Held(Least(row, i));
        // What is no number bounds nothing.
        const auto greatest = Held(hn::IfThenElse(hn::Eq(far, far), far, hn::Set(DD(), kDepthScale)));
        const auto low = Load(state.depth_min + block), high = Load(state.depth_max + block);
        const auto is_nearer = MaskOfBits(d, nearer >> block), is_tested = MaskOfBits(d, tested >> block),
                   is_whole = MaskOfBits(d, whole >> block);
        const auto new_low = hn::IfThenElse(is_tested, hn::Min(low, least), low);
        const auto new_high = hn::IfThenElse(is_whole, hn::Min(high, greatest), high);
        Store(hn::IfThenElse(is_nearer, least, new_low), state.depth_min + block);
        Store(hn::IfThenElse(is_nearer, greatest, new_high), state.depth_max + block);
      }
    }
    state.depth_min_holds |= nearer;
  }

 private:
  // Of the blocks from the `i`-th of a row on, as many as a vector holds: those that IsBehind is true of.
  HWY_INLINE uint64_t HiddenBlocks(int row, int i, const TileState& state) const {
    const DD d;
    const int block = row * 8 + i;
    const VD scale = hn::Set(d, kDepthScale), one = hn::Set(d, 1.0);
    const VD deepest = hn::PromoteTo(d, Load(state.depth_max + block));
    const VD least = hn::Sub(hn::Min(Least(row, i), scale), one);
    return BitsOfMask(d, hn::Gt(least, hn::Add(deepest, one))) << block;
  }

  HWY_INLINE VD Least(int row, int i) const {
    const double y = dy_ + row * kBlockSize;
    return hn::Add(hn::Set(DD(), f0_ + gy_ * (gy_ > 0 ? y : y + (kBlockSize - 1))), hn::Load(DD(), least_x_ + i));
  }
  HWY_INLINE VD Greatest(int row, int i) const {
    const double y = dy_ + row * kBlockSize;
    return hn::Add(hn::Set(DD(), f0_ + gy_ * (gy_ > 0 ? y + (kBlockSize - 1) : y)), hn::Load(DD(), greatest_x_ + i));
  }

  // As fragments' depth is: whole, and in the range.
  static HWY_INLINE hn::Vec<DDi> Held(VD depth) {
    const DD d;
    const VD most = hn::Set(d, static_cast<double>(kDepthMax));
    return hn::DemoteTo(DDi(), hn::Min(hn::Max(depth, hn::Zero(d)), most));
  }
  static HWY_INLINE hn::Vec<DDi> Load(const uint32_t* from) {
    return hn::LoadU(DDi(), reinterpret_cast<const int32_t*>(from));
  }
  static HWY_INLINE void Store(hn::Vec<DDi> v, uint32_t* to) { hn::StoreU(v, DDi(), reinterpret_cast<int32_t*>(to)); }

  double gx_, gy_, f0_, dy_;
  int first_, last_;  // rows of blocks
  alignas(64) double least_x_[8], greatest_x_[8];
};
