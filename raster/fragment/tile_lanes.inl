// Whole blocks of a tile in one call: what is the same for all rows of a tile, or for all its columns, is
// worked out once. Compiled once per ISA level.
//
// Here a group's pixel `i` counts from the tile's first, block by block; the context's memory and anchor are
// the tile's.

inline constexpr int kBlocksPerRow = kTileSize / kBlockSize;

// Row and column in the tile of pixel `i`, and which of the vectors across the tile its group takes.
HWY_INLINE int RowInTile(int i) {
  return i / (kTileSize * kBlockSize) * kBlockSize + i % kBlockPixels / kBlockSize;
}
HWY_INLINE int ColumnInTile(int i) { return i / kBlockPixels % kBlocksPerRow * kBlockSize + i % kBlockSize; }
HWY_INLINE int VectorAcrossTile(int i) {
  return i / kBlockPixels % kBlocksPerRow * kGroupsPerRow + i % kBlockSize / kLanes % kGroupsPerRow;
}

// The values of BlockPlane: the same operations on the same numbers. Each plane is worked out once a
// triangle, and out of line: every kernel has several.
HWY_NOINLINE void FillTilePlane(const BlockContext& c, int plane) {
  TilePlanes& tables = *c.planes;
  TilePlanes::Single& table = tables.single[plane];
  tables.has_single |= 1u << plane;
  const SetupBatch& s = *c.setup;
  const DF d;
  const VF dfdx = hn::Set(d, s.dfdx_f[plane][c.lane]);
  const VF column = BlockPlane::Column();
  constexpr int kStep = kLanes < kBlockSize ? kLanes : kBlockSize;
  for (int g = 0; g < kBlocksPerRow * kGroupsPerRow; ++g) {
    const VF dx = hn::Add(column, hn::Set(d, static_cast<float>(c.dx) + static_cast<float>(g * kStep)));
    hn::Store(hn::Mul(dfdx, dx), d, table.across + g * kLanes);
  }
  const hn::CappedTag<float, kBlockSize> dr;
  const int step = static_cast<int>(hn::MaxLanes(dr));
  const auto f0 = hn::Set(dr, s.f0_f[plane][c.lane]), dfdy = hn::Set(dr, s.dfdy_f[plane][c.lane]);
  const auto first = hn::Iota(dr, 0);
  for (int n = tables.begin; n < tables.end; n += step) {
    const auto dy =
        hn::Add(hn::Set(dr, static_cast<float>(c.dy)), hn::Add(first, hn::Set(dr, static_cast<float>(n))));
    hn::Store(hn::Add(f0, hn::Mul(dfdy, dy)), dr, table.row + n);
  }
  if constexpr (kRowsPerGroup > 1)
    for (int n = tables.begin; n < tables.end; n += kRowsPerGroup)
      hn::Store(FillRows(table.row + n), d, table.rows + n * kBlockSize);
}

struct TilePlane {
  const TilePlanes::Single* table;
  HWY_INLINE TilePlane(const BlockContext& c, int plane) : TilePlane(c, plane, c.planes->single + plane) {}
  // By the table of a plane before: so that the compiler knows how far apart they lie.
  HWY_INLINE TilePlane(const BlockContext& c, int plane, const TilePlanes::Single* at) : table(at) {
    if ((c.planes->has_single >> plane & 1) == 0) FillTilePlane(c, plane);
  }
  HWY_INLINE VF At(int i) const {
    const DF d;
    const VF across = hn::Load(d, table->across + VectorAcrossTile(i) * kLanes);
    if constexpr (kRowsPerGroup > 1)
      return hn::Add(hn::Load(d, table->rows + RowInTile(i) * kBlockSize), across);
    else
      return hn::Add(hn::Set(d, table->row[RowInTile(i)]), across);
  }
};

// Plane `first` + `step`, beside `before`, which is the first: by its table, if planes have one.
template <class Plane, class Before>
HWY_INLINE Plane PlaneAfter(const BlockContext& c, const Before& before, int first, int step) {
  if constexpr (requires { Plane(c, first + step, before.table + step); })
    return Plane(c, first + step, before.table + step);
  else
    return Plane(c, first + step);
}

// The same for a plane without slope.
struct LevelPlane {
  VF value;
  HWY_INLINE LevelPlane(const BlockContext& c, int plane)
      : value(hn::Set(DF(), c.setup->f0_f[plane][c.lane])) {}
  HWY_INLINE VF At(int) const { return value; }
};

// The values of BlockPlaneDouble.
HWY_NOINLINE void FillTilePlaneDouble(const BlockContext& c, int plane) {
  TilePlanes& tables = *c.planes;
  TilePlanes::Double& table = tables.wide[plane];
  tables.has_double |= 1u << plane;
  const SetupBatch& s = *c.setup;
  const DD d;
  const double f0 = s.f0[plane][c.lane], dfdy = s.dfdy[plane][c.lane];
  const auto dfdx = hn::Set(d, s.dfdx[plane][c.lane]);
  for (int x = 0; x < kTileSize; x += kDoubleLanes)
    hn::Store(hn::Mul(dfdx, hn::Add(hn::Iota(d, 0), hn::Set(d, c.dx + x))), d, table.across + x);
  for (int n = tables.begin; n < tables.end; ++n) table.row[n] = f0 + dfdy * (c.dy + n);
}

struct TilePlaneDouble {
  static constexpr int kParts = BlockPlaneDouble::kParts;
  const TilePlanes::Double* table;
  HWY_INLINE TilePlaneDouble(const BlockContext& c, int plane) : table(&c.planes->wide[plane]) {
    if ((c.planes->has_double >> plane & 1) == 0) FillTilePlaneDouble(c, plane);
  }
  HWY_INLINE VD At(int i) const {
    const DD d;
    VD v;
    for (int p = 0; p < kDoubleParts; ++p) {
      const double* across = table->across + (VectorAcrossTile(i) * kParts + p % kParts) * kDoubleLanes;
      v.part[p] = hn::Add(hn::Set(d, table->row[RowInTile(i) + p / kParts]), hn::Load(d, across));
    }
    return v;
  }
};

// kLevelAlpha: the plane of alpha has no slope.
template <bool kLevelAlpha>
struct TileLanes : BlockLanes {
  static constexpr int kSide = kTileSize;
  static HWY_INLINE int Row(int i) { return RowInTile(i); }
  static HWY_INLINE int Column(int i) { return ColumnInTile(i); }
  static HWY_INLINE int FirstRow(const BlockContext& c) {
    return c.blocks != 0 ? __builtin_ctzll(c.blocks) / kBlocksPerRow * kBlockSize : 0;
  }
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
