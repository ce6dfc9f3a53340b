// Triangles whose program takes many blocks in one call: which blocks of the tile, and which pixels of each.
// Exact in int32, as triangle.inl is. Compiled once per ISA level.

struct GroupWalk {
  using DP = hn::CappedTag<int32_t, 16>;          // pixels: two rows of a block, one, or a part of one
  using DB = hn::CappedTag<int32_t, kBlockSize>;  // blocks: a row of the tile's, or a part of one
  static constexpr int kPixels = static_cast<int>(hn::MaxLanes(DP())),
                       kBlocks = static_cast<int>(hn::MaxLanes(DB()));

  int32_t edge[3], step_x[3], step_y[3];

  HWY_INLINE GroupWalk(const SetupBatch& s, int lane) {
    for (int k = 0; k < 3; ++k)
      edge[k] = s.edge[k][lane], step_x[k] = s.step_x[k][lane], step_y[k] = s.step_y[k][lane];
  }

  // Pixels inside, of the 8x8 whose lowest-left one is (x, y) of the tile.
  HWY_INLINE uint64_t Pixels(int x, int y) const {
    const DP d;
    constexpr int kColumns = kPixels < kBlockSize ? kPixels : kBlockSize, kRows = kPixels / kColumns;
    uint64_t outside = 0;
    for (int column = 0; column < kBlockSize; column += kColumns) {
      hn::Vec<DP> e[3], step[3];
      for (int k = 0; k < 3; ++k) {
        const auto across = hn::Mul(hn::Load(d, kTwoRows<int32_t>.column), hn::Set(d, step_x[k]));
        e[k] = hn::Add(across, hn::Set(d, edge[k] + step_x[k] * (x + column) + step_y[k] * y));
        step[k] = hn::Set(d, step_y[k] * kRows);
        if constexpr (kRows > 1)
          e[k] = hn::Add(e[k], hn::Mul(hn::Load(d, kTwoRows<int32_t>.row), hn::Set(d, step_y[k])));
      }
      for (int row = 0; row < kBlockSize; row += kRows) {
        outside |= uint64_t{NegativeLanes(d, hn::Or3(e[0], e[1], e[2]))} << (row * kBlockSize + column);
        for (int k = 0; k < 3; ++k) e[k] = hn::Add(e[k], step[k]);
      }
    }
    return ~outside;
  }

  // Of the tile's blocks in the box of pixels from (x0, y0) to (x1, y1): those the triangle may touch, and
  // those it covers.
  HWY_INLINE void Blocks(int x0, int y0, int x1, int y1, uint64_t& touched, uint64_t& covered) const {
    const DB d;
    touched = covered = 0;
    const unsigned columns = (2u << (x1 / kBlockSize)) - (1u << (x0 / kBlockSize));
    for (int column = 0; column < kBlockSize; column += kBlocks) {
      hn::Vec<DB> most[3], least[3];  // of the edge's values in each block
      for (int k = 0; k < 3; ++k) {
        const int32_t rise_x = step_x[k] > 0 ? step_x[k] : 0, rise_y = step_y[k] > 0 ? step_y[k] : 0;
        const int32_t highest = (kBlockSize - 1) * (rise_x + rise_y);
        const int32_t lowest = (kBlockSize - 1) * (step_x[k] - rise_x + step_y[k] - rise_y);
        const auto at = hn::Add(hn::Mul(hn::Load(d, kTwoRows<int32_t>.column), hn::Set(d, step_x[k] * kBlockSize)),
                                hn::Set(d, edge[k] + step_x[k] * kBlockSize * column));
        most[k] = hn::Add(at, hn::Set(d, highest));
        least[k] = hn::Add(at, hn::Set(d, lowest));
      }
      for (int row = y0 / kBlockSize; row <= y1 / kBlockSize; ++row) {
        hn::Vec<DB> high[3], low[3];
        for (int k = 0; k < 3; ++k) {
          const auto up = hn::Set(d, step_y[k] * kBlockSize * row);
          high[k] = hn::Add(most[k], up), low[k] = hn::Add(least[k], up);
        }
        const unsigned outside = NegativeLanes(d, hn::Or3(high[0], high[1], high[2]));
        const unsigned crossed = NegativeLanes(d, hn::Or3(low[0], low[1], low[2]));
        const unsigned inside = ~outside & (columns >> column) & ((1u << kBlocks) - 1);
        touched |= uint64_t{inside} << (row * kBlockSize + column);
        covered |= uint64_t{inside & ~crossed} << (row * kBlockSize + column);
      }
    }
  }
};

// The triangle lies all over these blocks and lowers their depths.
HWY_INLINE void LowerDepthMax(TileContext& t, int lane, uint64_t blocks) {
  const double gx = t.setup.dfdx[0][lane], gy = t.setup.dfdy[0][lane];
  const double x = t.setup.anchor_x[lane] + (gx > 0 ? kBlockSize - 1 : 0);
  const double y = t.setup.anchor_y[lane] + (gy > 0 ? kBlockSize - 1 : 0), f0 = t.setup.f0[0][lane] + 1.0;
  for (; blocks != 0; blocks &= blocks - 1) {
    const int block = __builtin_ctzll(blocks);
    const double greatest = f0 + gy * (y + block / 8 * kBlockSize) + gx * (x + block % 8 * kBlockSize);
    if (greatest < 0 || greatest >= static_cast<double>(t.state->depth_max[block])) continue;
    t.state->depth_max[block] = static_cast<uint32_t>(greatest);
    t.knows_deepest = false;
  }
}

// As many lanes as the kernels of fragments have.
inline constexpr int kGroupLanes = static_cast<int>(hn::MaxLanes(hn::CappedTag<float, 16>()));
inline constexpr int kTileGroups = kTileSize * kTileSize / kGroupLanes;

// What a primitive covers of a tile, block by block.
struct GroupList {
  TileGroup* groups;
  int lane;  // the primitive's
  int count = 0;
  uint64_t fragments = 0;
  HWY_INLINE GroupList(TileGroup* memory, int primitive) : groups(memory), lane(primitive) {}
  // Without a branch: what is empty is written over by the next one.
  HWY_INLINE void Add(int block, uint64_t mask) {
    for (int i = 0; i < kBlockPixels; i += kGroupLanes) {
      const auto live = static_cast<unsigned>(mask >> i & ((uint64_t{1} << kGroupLanes) - 1));
      const int index = (block * kBlockPixels + i) / kGroupLanes;
      const int place = index << TileGroup::kIndexShift | lane << TileGroup::kLaneShift;
      groups[count] = TileGroup{static_cast<uint32_t>(place)}.with(live);
      count += static_cast<int>(groups[count].count());
    }
    fragments += static_cast<uint64_t>(__builtin_popcountll(mask));
  }
#if HWY_TARGET == HWY_AVX3
  // Of each lane a group: its place in the lower half, its pixels in the upper one. Without `live` pixels it is none.
  HWY_INLINE void AddSome(__m512i live, __m512i places) {
    const __mmask16 any = _mm512_test_epi32_mask(live, live);
    _mm512_storeu_si512(groups + count, _mm512_maskz_compress_epi32(any, _mm512_or_si512(live, places)));
    count += __builtin_popcount(any);
  }
#endif
};

#if HWY_TARGET == HWY_AVX3
HWY_INLINE __m512d EightFrom(double k) {
  return _mm512_setr_pd(k, k + 1, k + 2, k + 3, k + 4, k + 5, k + 6, k + 7);
}

HWY_INLINE __m512 SixteenFrom(float k) {
  return _mm512_setr_ps(k, k + 1, k + 2, k + 3, k + 4, k + 5, k + 6, k + 7, k + 8, k + 9, k + 10, k + 11, k + 12,
                        k + 13, k + 14, k + 15);
}

// What groups of the primitive are interpolated from: for a window's columns from x of the tile on, x at a block,
// and for its rows from y on. dx, dy: where that is from the anchor; sums of these are exact.
HWY_INLINE void FillColumnPlaces(int lane, int x, double dx, GroupTables& out) {
  const __m512 first = _mm512_set1_ps(static_cast<float>(dx));
  for (int k = 0; k < GroupTables::kColumns; k += 16)
    _mm512_storeu_ps(out.dx + GroupTables::at(lane, x + k), _mm512_add_ps(SixteenFrom(static_cast<float>(k)), first));
}
HWY_INLINE void FillRowPlaces(int lane, int y, double dy, GroupTables& out) {
  static_assert(GroupTables::kRows == 16);
  _mm512_storeu_ps(out.dy + GroupTables::at(lane, y), _mm512_add_ps(SixteenFrom(0), _mm512_set1_ps(static_cast<float>(dy))));
}
HWY_INLINE void FillColumnDepths(const SetupBatch& s, int lane, int x, double dx, GroupTables& out) {
  const __m512d first = _mm512_set1_pd(dx), slope = _mm512_set1_pd(s.dfdx[0][lane]);
  for (int k = 0; k < GroupTables::kColumns; k += 8)
    _mm512_store_pd(out.across + GroupTables::at(lane, x + k), _mm512_mul_pd(_mm512_add_pd(EightFrom(k), first), slope));
}
HWY_INLINE void FillRowDepths(const SetupBatch& s, int lane, int y, double dy, GroupTables& out) {
  const __m512d first = _mm512_set1_pd(dy);
  for (int k = 0; k < GroupTables::kRows; k += 8) {
    const __m512d up = _mm512_mul_pd(_mm512_add_pd(EightFrom(k), first), _mm512_set1_pd(s.dfdy[0][lane]));
    _mm512_storeu_pd(out.row + GroupTables::at(lane, y + k), _mm512_add_pd(up, _mm512_set1_pd(s.f0[0][lane])));
  }
}
#endif

// Runs the program on a list in these blocks, of primitives that `lanes` are the bits of and that take the same path.
HWY_INLINE void RunGroups(TileContext& t, unsigned lanes, const GroupList& list, uint64_t blocks,
                          const BlockProgram& stages) {
  const int lane = __builtin_ctz(lanes);
  if ((t.packer.blocks & blocks) != 0) FlushPacked(t);
  PrepareWindow(t, blocks);
  AddFragments(t, lane, list.fragments);
  BlockContext& c = t.block;
  c.lane = lane;
  c.groups = list.groups;
  c.group_count = list.count;
  c.group_lanes = lanes;
  if (t.program->reads_depth) c.depth = t.framebuffer->depth_tile(t.tile);
  c.color = t.framebuffer->color_tile<uint32_t>(t.tile, t.program->plane);
  if (stages.groups_depth != nullptr) stages.groups_depth(c);
  if ((t.deferred.blocks & blocks) != 0) t.deferred.DropGroups(c.groups, c.group_count);
  stages.groups(c);
}

// With as many blocks that are covered all over, what the planes of a tile cost is made up for.
inline constexpr int kManyBlocks = 16;

#if HWY_TARGET == HWY_AVX3
// Pixels of a triangle in all blocks of a tile's row at once: each row of pixels is a span, from the
// rightmost of the edges it enters by to the leftmost of those it leaves by. Where an edge is crossed is
// floor(e / step), in double: the quotient is off by less than 2^-44 where it lies in the tile, and further
// than 2^-31 from the integers it is none of.
class SpanWalk {
 public:
  HWY_INLINE explicit SpanWalk(const GroupWalk& walk) : walk_(walk) {
    const __m512d rows = _mm512_setr_pd(0, 1, 2, 3, 4, 5, 6, 7);
    for (int k = 0; k < 3; ++k) {
      const int32_t step = walk.step_x[k];
      // An edge without a step is entered by everywhere, or nowhere.
      const double turn = step != 0 ? -1.0 / static_cast<double>(step) : -0x1p20;
      enters_[k] = static_cast<__mmask8>(step >= 0 ? 0xff : 0);
      turn_[k] = _mm512_set1_pd(turn);
      bias_[k] = _mm512_set1_pd(step >= 0 ? 1 - 0x1p-32 : 0x1p-40);
      rise_[k] = _mm512_mul_pd(rows, _mm512_set1_pd(static_cast<double>(walk.step_y[k])));
    }
  }

  // Of the blocks in row `row`: their pixels inside.
  HWY_INLINE __m512i Row(int row) const {
    const __m512d zero = _mm512_setzero_pd(), none = _mm512_set1_pd(-1), last = _mm512_set1_pd(kTileSize - 1),
                  end = _mm512_set1_pd(kTileSize);
    __m512d from = zero, to = last;
    for (int k = 0; k < 3; ++k) {
      const double base =
          static_cast<double>(walk_.edge[k]) + static_cast<double>(walk_.step_y[k]) * (kBlockSize * row);
      const __m512d e = _mm512_add_pd(rise_[k], _mm512_set1_pd(base));
      const __m512d at = _mm512_floor_pd(_mm512_add_pd(_mm512_mul_pd(e, turn_[k]), bias_[k]));
      from = _mm512_mask_max_pd(from, enters_[k], from, at);
      to = _mm512_mask_min_pd(to, static_cast<__mmask8>(~enters_[k]), to, at);
    }
    // Shifts by 64 leave nothing.
    const __m512i left = Whole(_mm512_min_pd(from, end)),
                  right = Whole(_mm512_sub_pd(last, _mm512_max_pd(to, none)));
    const __m512i ones = _mm512_set1_epi64(-1);
    return Turn(_mm512_and_si512(_mm512_sllv_epi64(ones, left), _mm512_srlv_epi64(ones, right)));
  }

 private:
  static HWY_INLINE __m512i Whole(__m512d small) { return _mm512_cvttpd_epi64(small); }

  // From rows of eight blocks' bytes each to blocks of eight rows' bytes.
  static HWY_INLINE __m512i Turn(__m512i rows) {
    const __m128i pairs = _mm_setr_epi8(0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15);
    const __m512i blocks = _mm512_set_epi16(31, 23, 15, 7, 30, 22, 14, 6, 29, 21, 13, 5, 28, 20, 12, 4,  //
                                            27, 19, 11, 3, 26, 18, 10, 2, 25, 17, 9, 1, 24, 16, 8, 0);
    return _mm512_permutexvar_epi16(blocks, _mm512_shuffle_epi8(rows, _mm512_broadcast_i32x4(pairs)));
  }

  const GroupWalk& walk_;
  __mmask8 enters_[3];
  __m512d turn_[3], bias_[3], rise_[3];
};

// What a triangle covers of the tile's blocks.
struct BlockMasks {
  alignas(64) uint64_t masks[kTileBlocks];
  uint64_t touched = 0, covered = 0;

  HWY_INLINE BlockMasks(const GroupWalk& walk, const SetupBatch& s, int lane) {
    const SpanWalk spans(walk);
    for (int row = s.min_y[lane] / kBlockSize; row <= s.max_y[lane] / kBlockSize; ++row) {
      const __m512i blocks = spans.Row(row);
      _mm512_store_si512(masks + row * 8, blocks);
      touched |= uint64_t{_mm512_test_epi64_mask(blocks, blocks)} << (row * 8);
      covered |= uint64_t{_mm512_cmpeq_epi64_mask(blocks, _mm512_set1_epi64(-1))} << (row * 8);
    }
  }

  HWY_INLINE uint64_t Of(int block) const { return masks[block]; }
  // Blocks with at most so many pixels inside, and some.
  HWY_INLINE uint64_t AtMost(int pixels) const {
    const __m512i ones = _mm512_broadcast_i32x4(_mm_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4));
    const __m512i low = _mm512_set1_epi8(15);
    uint64_t few = 0;
    for (uint64_t rows = touched; rows != 0;) {
      const int row = __builtin_ctzll(rows) / 8;
      const __m512i blocks = _mm512_load_si512(masks + row * 8);
      const __m512i lower = _mm512_shuffle_epi8(ones, _mm512_and_si512(blocks, low));
      const __m512i upper = _mm512_shuffle_epi8(ones, _mm512_and_si512(_mm512_srli_epi64(blocks, 4), low));
      const __m512i count = _mm512_sad_epu8(_mm512_add_epi8(lower, upper), _mm512_setzero_si512());
      few |= uint64_t{_mm512_cmple_epu64_mask(count, _mm512_set1_epi64(pixels))} << (row * 8);
      rows &= ~uint64_t{0xff} << (row * 8);
    }
    return few & touched;
  }
  HWY_INLINE void AddTo(GroupList& list, uint64_t blocks) const {
    const int first = __builtin_ctzll(blocks) / 8, last = (63 - __builtin_clzll(blocks)) / 8;
    const __m512i index = _mm512_slli_epi32(
        _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15), TileGroup::kIndexShift);
    const int lane_bits = list.lane << TileGroup::kLaneShift;
    for (int row = first; row <= last; ++row) {
      const __m512i some =
          _mm512_maskz_loadu_epi64(static_cast<__mmask8>(blocks >> (row * 8)), masks + row * 8);
      alignas(64) uint64_t each[8];
      _mm512_store_si512(each, some);
      for (const uint64_t mask : each) list.fragments += static_cast<uint64_t>(__builtin_popcountll(mask));
      for (int half = 0; half < 2; ++half) {
        const __m256i words = half == 0 ? _mm512_castsi512_si256(some) : _mm512_extracti64x4_epi64(some, 1);
        const __m512i live = _mm512_slli_epi32(_mm512_cvtepu16_epi32(words), TileGroup::kLiveShift);
        const int first_index = (row * 32 + half * 16) << TileGroup::kIndexShift;
        list.AddSome(live, _mm512_add_epi32(index, _mm512_set1_epi32(lane_bits | first_index)));
      }
    }
  }
};
#else
struct BlockMasks {
  const GroupWalk& walk;
  uint64_t touched, covered;

  HWY_INLINE BlockMasks(const GroupWalk& triangle, const SetupBatch& s, int lane) : walk(triangle) {
    walk.Blocks(s.min_x[lane], s.min_y[lane], s.max_x[lane], s.max_y[lane], touched, covered);
  }
  HWY_INLINE uint64_t Of(int block) const {
    if ((covered >> block & 1) != 0) return ~uint64_t{0};
    return walk.Pixels(block % 8 * kBlockSize, block / 8 * kBlockSize);
  }
  HWY_INLINE void AddTo(GroupList& list, uint64_t blocks) const {
    for (; blocks != 0; blocks &= blocks - 1) list.Add(__builtin_ctzll(blocks), Of(__builtin_ctzll(blocks)));
  }
};
#endif

// A triangle larger than a window. `collects`: RunCoveredBlocks can take blocks.
void WalkGroups(TileContext& t, int lane, const BlockProgram& stages, bool collects) {
  const SetupBatch& s = t.setup;
  if (collects && !t.masks_blocks && TriangleWalk(s, lane).CoversTile())
    return TakeWholeBlocks(t, lane, ~uint64_t{0}, stages);
  const GroupWalk walk(s, lane);
  const BlockMasks masks(walk, s, lane);
  uint64_t touched = masks.touched;
  if (touched == 0) return;
  if (t.program->rejects_deeper) touched &= ~BlockDepths(s, lane, touched).Hidden(*t.state);
  uint64_t covered = t.masks_blocks ? 0 : masks.covered & touched;
  if (collects && covered != 0 && (stages.whole.fills || __builtin_popcountll(covered) >= kManyBlocks)) {
    TakeWholeBlocks(t, lane, covered, stages);
    touched &= ~covered;
    covered = 0;
  }
  if (touched == 0) return;
#if HWY_TARGET == HWY_AVX3
  for (int x = 0; x < kTileSize; x += GroupTables::kColumns) {
    FillColumnPlaces(lane, x, s.anchor_x[lane] + x, t.group_tables);
    FillColumnDepths(s, lane, x, s.anchor_x[lane] + x, t.group_tables);
  }
  for (int y = 0; y < kTileSize; y += GroupTables::kRows) {
    FillRowPlaces(lane, y, s.anchor_y[lane] + y, t.group_tables);
    FillRowDepths(s, lane, y, s.anchor_y[lane] + y, t.group_tables);
  }
#endif
  GroupList list(t.groups, lane);
  if (!t.masks_blocks) {
    masks.AddTo(list, touched);
  } else {
    for (uint64_t todo = touched; todo != 0; todo &= todo - 1) {
      const int block = __builtin_ctzll(todo);
      list.Add(block, masks.Of(block) & BlockMask(t, block));
    }
  }
  if (list.count == 0) return;
  RunGroups(t, 1u << lane, list, touched, stages);
  if (covered != 0 && t.program->depth_pass_lowers) LowerDepthMax(t, lane, covered);
}

// Tests and packs the pixels masks[block] of some blocks of the tile (pixel_batch.inl).
void PackBlocks(TileContext& t, int lane, const uint64_t* masks, uint64_t blocks);

// What a triangle covers: blocks that rows' kernels take, and `few`, of which little is covered and which are packed.
struct RowWalk {
  CoveredBlocks blocks{0, 0, nullptr};
  uint64_t few = 0;

  // memory: for the masks of all blocks, where there are others than those found.
  HWY_INLINE RowWalk(const TileContext& t, const BlockMasks& found, bool packs, uint64_t* memory) {
#if HWY_TARGET == HWY_AVX3
    if (HWY_LIKELY(!t.masks_blocks)) {
      few = packs ? found.AtMost(kPackAtMost) : 0;
      blocks = {found.covered, found.touched & ~found.covered & ~few, found.masks};
      return;
    }
#endif
    blocks.masks = memory;
    for (uint64_t todo = found.touched; todo != 0; todo &= todo - 1) {
      const int block = __builtin_ctzll(todo);
      const uint64_t mask = t.masks_blocks ? found.Of(block) & BlockMask(t, block) : found.Of(block);
      memory[block] = mask;
      const uint64_t bit = todo & -todo;
      if (mask == 0) continue;
      if (mask == ~uint64_t{0})
        blocks.whole |= bit;
      else if (packs && __builtin_popcountll(mask) <= kPackAtMost)
        few |= bit;
      else
        blocks.parts |= bit;
    }
  }
};

// A triangle whose program takes the blocks of a tile's row in turn.
void WalkRows(TileContext& t, int lane, const BlockProgram& stages, bool packs) {
  const SetupBatch& s = t.setup;
  const Deferral deferral(t, lane, stages);
  if (!t.masks_blocks && TriangleWalk(s, lane).CoversTile())
    return TakeWholeBlocks(t, lane, ~uint64_t{0}, stages);
  const GroupWalk walk(s, lane);
  const BlockMasks found(walk, s, lane);
  if (found.touched == 0) return;
  uint64_t memory[kTileBlocks];
  const RowWalk rows(t, found, packs, memory);
  // What waits for these blocks' pixels was drawn before and is stored before.
  if ((t.packer.blocks & rows.blocks.All()) != 0) FlushPacked(t);
  if (rows.blocks.All() != 0) RunCoveredBlocks(t, lane, rows.blocks, stages);
  if (rows.few == 0) return;
  t.ahead.AskForSome(t.program->plane, t.program->reads_depth, true);
  PackBlocks(t, lane, rows.blocks.masks, rows.few);
}
