// What primitives cover of a tile, in one call: groups of lanes that are not empty, one after another. A
// value is (f0 + dfdy * dy) + dfdx * dx as in lanes.inl, with the same bits. Pixels count from the tile's
// first, block by block.

// Whether a list may hold groups of several primitives of a batch (raster/tile/group_batch.inl). Then what a
// plane needs is loaded for each group, which costs nothing where an instruction takes it as its operand;
// else once for all.
#if HWY_TARGET == HWY_AVX3
inline constexpr bool kGroupsOfMany = true;

// 0, 1, 2 ...
struct TileSteps {
  alignas(64) double wide[kTileSize];
};
inline constexpr TileSteps kTileSteps = [] {
  TileSteps steps{};
  for (int i = 0; i < kTileSize; ++i) steps.wide[i] = i;
  return steps;
}();

// Where in the tables (raster/tile/group_walk.inl fills them) a group's columns and rows are: one instruction
// each, which closes up bits of the group. Bits that are 0 go along for the columns of a block, for the rows of a
// pair, and since a lane has twice as many values as the tile is wide.
struct GroupPlace {
  static constexpr unsigned kLaneBits = 7u << TileGroup::kLaneShift | 1u << (TileGroup::kLaneShift - 1);
  static constexpr unsigned kColumnBits = 7 << 5 | 7, kRowBits = 7 << 8 | 7 << 2;
  static_assert(kBlockSize == 8 && kTileSize == 64 && kLanes == 16 && TileGroup::kIndexShift == 3);
  // 64 bits wide, or else a copy of each makes them so.
  size_t column, row;
  HWY_INLINE explicit GroupPlace(TileGroup group)
      : column(_pext_u64(group.bits, kColumnBits | kLaneBits)),
        row(_pext_u64(group.bits, kRowBits | kLaneBits)) {}
};

// A plane of all the batch's primitives. Planes beside it are so and so far from there.
struct GroupPlaneTable {
  const float (*f0)[kSetupLanes], (*dfdx)[kSetupLanes], (*dfdy)[kSetupLanes];
  HWY_INLINE GroupPlaneTable(const SetupBatch& s, int plane)
      : f0(s.f0_f + plane), dfdx(s.dfdx_f + plane), dfdy(s.dfdy_f + plane) {}
  HWY_INLINE GroupPlaneTable operator+(int planes) const {
    GroupPlaneTable other(*this);
    other.f0 += planes, other.dfdx += planes, other.dfdy += planes;
    return other;
  }
};

struct GroupPlane {
  const BlockContext& c;
  GroupPlaneTable table;
  const GroupTables& tables;
  HWY_INLINE GroupPlane(const BlockContext& context, int plane)
      : GroupPlane(context, plane, GroupPlaneTable(*context.setup, plane)) {}
  HWY_INLINE GroupPlane(const BlockContext& context, int, const GroupPlaneTable& at)
      : c(context), table(at), tables(*context.group_tables) {}
  HWY_INLINE VF At(int) const {
    const auto lane = static_cast<size_t>(c.group.lane());
    const GroupPlace place(c.group);
    const __m256d columns = _mm256_castps_pd(_mm256_load_ps(tables.dx + place.column));
    const __m512 dx = _mm512_castpd_ps(_mm512_broadcast_f64x4(columns));
    const __m512 dy = _mm512_add_ps(_mm512_load_ps(kTwoRows<float>.row),
                                    _mm512_set1_ps(tables.dy[place.row]));
    const __m512 up = _mm512_mul_ps(dy, _mm512_set1_ps((*table.dfdy)[lane]));
    const __m512 across = _mm512_mul_ps(dx, _mm512_set1_ps((*table.dfdx)[lane]));
    return VF{_mm512_add_ps(_mm512_add_ps(up, _mm512_set1_ps((*table.f0)[lane])), across)};
  }
};

struct GroupPlaneDouble {
  const BlockContext& c;
  int plane;
  const GroupTables& tables;
  HWY_INLINE GroupPlaneDouble(const BlockContext& context, int which)
      : c(context), plane(which), tables(*context.group_tables) {}
  HWY_INLINE VD At(int i) const {
    if (plane == 0) return Depth();
    const SetupBatch& s = *c.setup;
    const int lane = c.group.lane();
    const __m512d dx =
        _mm512_add_pd(_mm512_load_pd(kTileSteps.wide + ColumnInTile(i)), _mm512_set1_pd(s.anchor_x[lane]));
    const __m512d across = _mm512_mul_pd(dx, _mm512_set1_pd(s.dfdx[plane][lane]));
    const __m128d dy = _mm_add_pd(_mm_load_pd(kTileSteps.wide + RowInTile(i)), _mm_set1_pd(s.anchor_y[lane]));
    const __m128d rows =
        _mm_add_pd(_mm_mul_pd(dy, _mm_set1_pd(s.dfdy[plane][lane])), _mm_set1_pd(s.f0[plane][lane]));
    VD v;
    v.part[0] = hn::Vec<DD>{_mm512_add_pd(_mm512_broadcastsd_pd(rows), across)};
    v.part[1] = hn::Vec<DD>{_mm512_add_pd(_mm512_broadcastsd_pd(_mm_unpackhi_pd(rows, rows)), across)};
    return v;
  }

 private:
  HWY_INLINE VD Depth() const {
    const GroupPlace place(c.group);
    const __m512d across = _mm512_load_pd(tables.across + place.column);
    const double* row = tables.row + place.row;
    VD v;
    for (int p = 0; p < 2; ++p) v.part[p] = hn::Vec<DD>{_mm512_add_pd(_mm512_set1_pd(row[p]), across)};
    return v;
  }
};

struct GroupLevelPlane {
  const BlockContext& c;
  const float (*f0)[kSetupLanes];
  HWY_INLINE GroupLevelPlane(const BlockContext& context, int, const GroupPlaneTable& at)
      : c(context), f0(at.f0) {}
  HWY_INLINE VF At(int) const { return hn::Set(DF(), (*f0)[c.group.lane()]); }
};

struct GroupFlatColor {
  const BlockContext& c;
  HWY_INLINE explicit GroupFlatColor(const BlockContext& context) : c(context) {}
  HWY_INLINE VF At(int channel, int) const { return hn::Set(DF(), c.setup->flat[channel][c.group.lane()]); }
};
#else
inline constexpr bool kGroupsOfMany = false;

struct GroupPlane {
  VF f0, dfdx, dfdy;
  float x, y;  // of the tile's first pixel from the anchor
  HWY_INLINE GroupPlane(const BlockContext& c, int plane)
      : f0(hn::Set(DF(), c.setup->f0_f[plane][c.lane])),
        dfdx(hn::Set(DF(), c.setup->dfdx_f[plane][c.lane])),
        dfdy(hn::Set(DF(), c.setup->dfdy_f[plane][c.lane])),
        x(c.setup->anchor_x_f[c.lane]),
        y(c.setup->anchor_y_f[c.lane]) {}
  HWY_INLINE VF At(int i) const {
    const DF d;
    const VF dx = hn::Add(hn::Load(d, kTwoRows<float>.column), hn::Set(d, x + static_cast<float>(ColumnInTile(i))));
    const VF dy = hn::Add(hn::Load(d, kTwoRows<float>.row), hn::Set(d, y + static_cast<float>(RowInTile(i))));
    return hn::Add(hn::Add(f0, hn::Mul(dfdy, dy)), hn::Mul(dfdx, dx));
  }
};

struct GroupPlaneDouble {
  static constexpr int kParts = BlockPlaneDouble::kParts;  // of a row
  double f0, dfdy, x, y;
  hn::Vec<DD> dfdx;
  HWY_INLINE GroupPlaneDouble(const BlockContext& c, int plane)
      : f0(c.setup->f0[plane][c.lane]),
        dfdy(c.setup->dfdy[plane][c.lane]),
        x(c.setup->anchor_x[c.lane]),
        y(c.setup->anchor_y[c.lane]),
        dfdx(hn::Set(DD(), c.setup->dfdx[plane][c.lane])) {}
  HWY_INLINE VD At(int i) const {
    const DD d;
    hn::Vec<DD> across[kParts];
    for (int p = 0; p < kParts; ++p) {
      const double first = x + (ColumnInTile(i) + p * kDoubleLanes);
      across[p] = hn::Mul(dfdx, hn::Add(hn::Iota(d, 0), hn::Set(d, first)));
    }
    VD v;
    for (int p = 0; p < kDoubleParts; ++p) {
      const double row = f0 + dfdy * (y + (RowInTile(i) + p / kParts));
      v.part[p] = hn::Add(hn::Set(d, row), across[p % kParts]);
    }
    return v;
  }
};

using GroupLevelPlane = LevelPlane;
using GroupFlatColor = BlockLanes::FlatColor;
#endif

// kLevelAlpha: the plane of alpha has no slope.
template <bool kLevelAlpha>
struct GroupLanes : BlockLanes {
  using Plane = GroupPlane;
  using PlaneOfAlpha = std::conditional_t<kLevelAlpha, GroupLevelPlane, GroupPlane>;
  using PlaneDouble = GroupPlaneDouble;
  using FlatColor = GroupFlatColor;
};
