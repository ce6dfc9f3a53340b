// Walking a triangle over the blocks of a tile: half-space tests, exact in int32. Compiled once per ISA level.

struct TriangleWalk {
  int32_t edge[3], step_x[3], step_y[3];
  int32_t lowest[3], highest[3];  // how much an edge value can fall or rise inside a block

  HWY_INLINE TriangleWalk(const SetupBatch& s, int lane) {
    for (int k = 0; k < 3; ++k) {
      edge[k] = s.edge[k][lane];
      step_x[k] = s.step_x[k][lane];
      step_y[k] = s.step_y[k][lane];
      const int32_t rise_x = step_x[k] > 0 ? step_x[k] : 0, rise_y = step_y[k] > 0 ? step_y[k] : 0;
      highest[k] = (kBlockSize - 1) * (rise_x + rise_y);
      lowest[k] = (kBlockSize - 1) * (step_x[k] - rise_x + step_y[k] - rise_y);
    }
  }

  // Pixels inside, of the block whose lowest-left pixel is (x, y) of the tile; rows outside [min_y, max_y] hold none.
  HWY_INLINE uint64_t Coverage(int x, int y, int min_y, int max_y) const {
    int32_t e[3];
    int32_t outside = 0, crossed = 0;
    for (int k = 0; k < 3; ++k) {
      e[k] = edge[k] + step_x[k] * x + step_y[k] * y;
      outside |= e[k] + highest[k];
      crossed |= e[k] + lowest[k];
    }
    if (outside < 0) return 0;
    if (crossed >= 0) return ~uint64_t{0};
    const int first = min_y > y ? min_y - y : 0;
    const int last = max_y < y + kBlockSize - 1 ? max_y - y : kBlockSize - 1;
    return Rows(e, first, last);
  }

  // Pixels inside, of the window of `width` x `height` (at most 8 each) pixels whose first one is (x, y) of the tile:
  // bit 8 * row + column.
  HWY_INLINE uint64_t Window(int x, int y, int width, int height) const {
    int32_t e[3];
    for (int k = 0; k < 3; ++k) e[k] = edge[k] + step_x[k] * x + step_y[k] * y;
    uint64_t mask = Rows(e, 0, 3);
    if (height > 4) mask |= Rows(e, 4, 7);
    mask &= 0x0101010101010101u * ((1u << width) - 1);
    return height < 8 ? mask & ((uint64_t{1} << (8 * height)) - 1) : mask;
  }

 private:
  // A vector takes a part of a row, a row, or two rows.
  HWY_INLINE uint64_t Rows(const int32_t e[3], int first, int last) const {
    using D = hn::CappedTag<int32_t, 16>;
    const D d;
    constexpr int kWidth = static_cast<int>(hn::MaxLanes(D()));
    constexpr int kRowsAtOnce = kWidth > kBlockSize ? kWidth / kBlockSize : 1;
    uint64_t mask = 0;
    for (int column = 0; column < kBlockSize; column += kWidth) {
      const auto lane = hn::Iota(d, 0);
      const auto x = hn::Add(hn::And(lane, hn::Set(d, kBlockSize - 1)), hn::Set(d, column));
      const auto y = hn::Add(hn::ShiftRight<3>(lane), hn::Set(d, first));
      hn::Vec<D> v[3], step[3];
      for (int k = 0; k < 3; ++k) {
        const auto across = hn::Mul(x, hn::Set(d, step_x[k])), up = hn::Mul(y, hn::Set(d, step_y[k]));
        v[k] = hn::Add(hn::Set(d, e[k]), hn::Add(across, up));
        step[k] = hn::Set(d, kRowsAtOnce * step_y[k]);
      }
      for (int row = first; row <= last; row += kRowsAtOnce) {
        mask |= InsideBits(d, hn::Or(hn::Or(v[0], v[1]), v[2])) << (row * kBlockSize + column);
        for (int k = 0; k < 3; ++k) v[k] = hn::Add(v[k], step[k]);
      }
    }
    return mask;
  }

  // One bit a lane: set where the value is not negative.
  template <class D>
  static HWY_INLINE uint64_t InsideBits(D d, hn::Vec<D> value) {
#if HWY_TARGET == HWY_SCALAR
    (void)d;
    return hn::GetLane(value) < 0 ? 0u : 1u;
#else
    uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Lt(value, hn::Zero(d)), bits);
    const auto outside = static_cast<uint64_t>(bits[0] | bits[1] << 8);
    return ~outside & ((uint64_t{1} << hn::MaxLanes(d)) - 1);
#endif
  }
};
