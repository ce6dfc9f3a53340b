// What a primitive covers of a tile, in one call: groups of lanes that are not empty, one after another. What
// a plane needs is loaded once a primitive; a value is (f0 + dfdy * dy) + dfdx * dx as in lanes.inl, with the
// same bits. Pixels count from the tile's first, block by block.

alignas(64) inline constexpr float kColumnOfLane[16] = {0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7};
alignas(64) inline constexpr float kRowOfLane[16] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1};

struct GroupPlane {
  VF f0, dfdx, dfdy;
  float x, y;  // of the tile's first pixel from the anchor
  HWY_INLINE GroupPlane(const BlockContext& c, int plane)
      : f0(hn::Set(DF(), c.setup->f0_f[plane][c.lane])),
        dfdx(hn::Set(DF(), c.setup->dfdx_f[plane][c.lane])),
        dfdy(hn::Set(DF(), c.setup->dfdy_f[plane][c.lane])),
        x(static_cast<float>(c.setup->anchor_x[c.lane])),
        y(static_cast<float>(c.setup->anchor_y[c.lane])) {}
  HWY_INLINE VF At(int i) const {
    const DF d;
    const VF dx = hn::Add(hn::Load(d, kColumnOfLane), hn::Set(d, x + static_cast<float>(ColumnInTile(i))));
    const VF dy = hn::Add(hn::Load(d, kRowOfLane), hn::Set(d, y + static_cast<float>(RowInTile(i))));
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

// kLevelAlpha: the plane of alpha has no slope.
template <bool kLevelAlpha>
struct GroupLanes : BlockLanes {
  using Plane = GroupPlane;
  using PlaneOfAlpha = std::conditional_t<kLevelAlpha, LevelPlane, GroupPlane>;
  using PlaneDouble = GroupPlaneDouble;
};
