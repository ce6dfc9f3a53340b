// Walking a triangle over the blocks of a tile: half-space tests, exact in int32. Compiled once per ISA level.

// One bit a lane: set where the value is negative.
template <class D>
HWY_INLINE unsigned NegativeLanes(D d, hn::Vec<D> v) {
#if HWY_TARGET == HWY_SCALAR
  (void)d;
  return hn::GetLane(v) < 0 ? 1u : 0u;
#elif HWY_TARGET == HWY_AVX3
  (void)d;
  if constexpr (sizeof v == 64)
    return _cvtmask16_u32(_mm512_movepi32_mask(v.raw));
  else
    return _cvtmask8_u32(_mm256_movepi32_mask(v.raw));
#elif HWY_TARGET == HWY_AVX2
  (void)d;
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(v.raw)));
#elif HWY_TARGET == HWY_SSE4
  (void)d;
  return static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(v.raw)));
#else
  uint8_t bits[8] = {};
  hn::StoreMaskBits(d, hn::Lt(v, hn::Zero(d)), bits);
  return bits[0];
#endif
}

struct TriangleWalk {
  using D = hn::CappedTag<int32_t, kBlockSize>;
  static constexpr int kWidth = static_cast<int>(hn::MaxLanes(D()));  // a row, or a part of one

  int32_t edge[3], step_x[3], step_y[3];
  int32_t lowest[3], highest[3];  // how much an edge value can fall or rise inside a block
  hn::Vec<D> pattern[3];          // edge values of a vector's pixels, less that of its first

  HWY_INLINE TriangleWalk(const SetupBatch& s, int lane) {
    for (int k = 0; k < 3; ++k) {
      edge[k] = s.edge[k][lane];
      step_x[k] = s.step_x[k][lane];
      step_y[k] = s.step_y[k][lane];
      const int32_t rise_x = step_x[k] > 0 ? step_x[k] : 0, rise_y = step_y[k] > 0 ? step_y[k] : 0;
      highest[k] = (kBlockSize - 1) * (rise_x + rise_y);
      lowest[k] = (kBlockSize - 1) * (step_x[k] - rise_x + step_y[k] - rise_y);
      const D d;
      pattern[k] = hn::Mul(hn::Iota(d, 0), hn::Set(d, step_x[k]));
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

  HWY_INLINE bool CoversTile() const {
    int32_t least = 0;
    for (int k = 0; k < 3; ++k) least |= edge[k] + lowest[k] / (kBlockSize - 1) * (kTileSize - 1);
    return least >= 0;
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
  HWY_INLINE uint64_t Rows(const int32_t e[3], int first, int last) const {
    const D d;
    uint64_t mask = 0;
    for (int column = 0; column < kBlockSize; column += kWidth) {
      hn::Vec<D> v[3], step[3];
      for (int k = 0; k < 3; ++k) {
        v[k] = hn::Add(pattern[k], hn::Set(d, e[k] + first * step_y[k] + column * step_x[k]));
        step[k] = hn::Set(d, step_y[k]);
      }
      for (int row = first; row <= last; ++row) {
        const uint64_t inside = ~NegativeLanes(d, hn::Or3(v[0], v[1], v[2])) & ((1u << kWidth) - 1);
        mask |= inside << (row * kBlockSize + column);
        for (int k = 0; k < 3; ++k) v[k] = hn::Add(v[k], step[k]);
      }
    }
    return mask;
  }
};
