// Whole blocks of a tile in one call: what is the same for all rows of a tile, or for all its columns, is
// worked out once. Compiled once per ISA level.
//
// Here a group's pixel `i` counts from the tile's first, block by block; the context's memory and anchor are
// the tile's.

inline constexpr int kBlocksPerRow = kTileSize / kBlockSize;

// The tile's pixel row of pixel `i`, and which of the vectors across the tile its group takes.
HWY_INLINE int TileRow(int i) {
  return i / (kTileSize * kBlockSize) * kBlockSize + i % kBlockPixels / kBlockSize;
}
HWY_INLINE int TileColumn(int i) {
  return i / kBlockPixels % kBlocksPerRow * kGroupsPerRow + i % kBlockSize / kLanes % kGroupsPerRow;
}

// Rows from the first block's to the last one's: the others are not asked for.
struct TileRows {
  int begin, end;
  HWY_INLINE explicit TileRows(const BlockContext& c)
      : begin(__builtin_ctzll(c.blocks) / kBlocksPerRow * kBlockSize),
        end((63 - __builtin_clzll(c.blocks)) / kBlocksPerRow * kBlockSize + kBlockSize) {}
};

#if HWY_TARGET == HWY_AVX3
// As FillRows does, but not through a pointer: g++ would then reload what is the same for all blocks after
// every store.
HWY_INLINE VF TwoRows(float first, float second) {
  const hn::Half<DF> half;
  return hn::Combine(DF(), hn::Set(half, second), hn::Set(half, first));
}
#endif

// The values of BlockPlane: the same operations on the same numbers.
struct TilePlane {
  VF across[kBlocksPerRow * kGroupsPerRow];  // dfdx * dx
  alignas(64) float row[kTileSize];          // f0 + dfdy * dy
#if HWY_TARGET == HWY_AVX3
  VF rows[kTileSize / kRowsPerGroup];
#endif
  HWY_INLINE TilePlane(const BlockContext& c, int plane) {
    const SetupBatch& s = *c.setup;
    const DF d;
    const TileRows needed(c);
    const VF dfdx = hn::Set(d, s.dfdx_f[plane][c.lane]);
    const VF column = BlockPlane::Column();
    constexpr int kStep = kLanes < kBlockSize ? kLanes : kBlockSize;
    for (int g = 0; g < kBlocksPerRow * kGroupsPerRow; ++g)
      across[g] = hn::Mul(
          dfdx, hn::Add(column, hn::Set(d, static_cast<float>(c.dx) + static_cast<float>(g * kStep))));
    const hn::CappedTag<float, kBlockSize> dr;
    const int step = static_cast<int>(hn::MaxLanes(dr));
    const auto f0 = hn::Set(dr, s.f0_f[plane][c.lane]), dfdy = hn::Set(dr, s.dfdy_f[plane][c.lane]);
    const auto first = hn::Iota(dr, 0);
    for (int n = needed.begin; n < needed.end; n += step) {
      const auto dy =
          hn::Add(hn::Set(dr, static_cast<float>(c.dy)), hn::Add(first, hn::Set(dr, static_cast<float>(n))));
      hn::Store(hn::Add(f0, hn::Mul(dfdy, dy)), dr, row + n);
    }
#if HWY_TARGET == HWY_AVX3
    for (int n = needed.begin; n < needed.end; n += kRowsPerGroup)
      rows[n / kRowsPerGroup] = TwoRows(row[n], row[n + 1]);
#endif
  }
  HWY_INLINE VF At(int i) const {
#if HWY_TARGET == HWY_AVX3
    return hn::Add(rows[TileRow(i) / kRowsPerGroup], across[TileColumn(i)]);
#else
    return hn::Add(hn::Set(DF(), row[TileRow(i)]), across[TileColumn(i)]);
#endif
  }
};

// The same for a plane without slope.
struct LevelPlane {
  VF value;
  HWY_INLINE LevelPlane(const BlockContext& c, int plane)
      : value(hn::Set(DF(), c.setup->f0_f[plane][c.lane])) {}
  HWY_INLINE VF At(int) const { return value; }
};

// The values of BlockPlaneDouble.
struct TilePlaneDouble {
  static constexpr int kParts = BlockPlaneDouble::kParts;
  hn::Vec<DD> across[kTileSize / kDoubleLanes];
  double row[kTileSize];
  HWY_INLINE TilePlaneDouble(const BlockContext& c, int plane) {
    const SetupBatch& s = *c.setup;
    const DD d;
    const TileRows needed(c);
    const double f0 = s.f0[plane][c.lane], dfdy = s.dfdy[plane][c.lane];
    const auto dfdx = hn::Set(d, s.dfdx[plane][c.lane]);
    for (int g = 0; g < kTileSize / kDoubleLanes; ++g)
      across[g] = hn::Mul(dfdx, hn::Add(hn::Iota(d, 0), hn::Set(d, c.dx + g * kDoubleLanes)));
    for (int n = needed.begin; n < needed.end; ++n) row[n] = f0 + dfdy * (c.dy + n);
  }
  HWY_INLINE VD At(int i) const {
    VD v;
    for (int p = 0; p < kDoubleParts; ++p)
      v.part[p] =
          hn::Add(hn::Set(DD(), row[TileRow(i) + p / kParts]), across[TileColumn(i) * kParts + p % kParts]);
    return v;
  }
};

// kLevelAlpha: the plane of alpha has no slope.
template <bool kLevelAlpha>
struct TileLanes : BlockLanes {
  using Plane = TilePlane;
  using PlaneOfAlpha = std::conditional_t<kLevelAlpha, LevelPlane, TilePlane>;
  using PlaneDouble = TilePlaneDouble;
};
// The same where all pixels stay live.
template <bool kLevelAlpha>
struct FullTileLanes : TileLanes<kLevelAlpha> {
  static HWY_INLINE void StoreRgba8(const BlockContext& c, int i, VI packed, MF live) {
    FullLanes::StoreRgba8(c, i, packed, live);
  }
};
