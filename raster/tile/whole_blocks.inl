// Blocks that a triangle covers, many in one call: those it covers all over, and, where a row's kernels take them, those
// it covers in part. Compiled once per ISA level.

struct CoveredBlocks {
  uint64_t whole;
  uint64_t parts = 0;
  const uint64_t* masks = nullptr;  // pixels of each of the tile's blocks, where there are parts
  HWY_INLINE uint64_t All() const { return whole | parts; }
  HWY_INLINE uint64_t Of(int block) const { return masks != nullptr ? masks[block] : ~uint64_t{0}; }
  HWY_INLINE CoveredBlocks But(uint64_t blocks) const { return {whole & ~blocks, parts & ~blocks, masks}; }
};

// The depth of blocks that were drawn just now is the triangle's. The tile keeps one such plane; where other blocks still
// hold another, this one's are written.
void TakeDepth(TileContext& t, int lane, uint64_t blocks) {
  const SetupBatch& s = t.setup;
  TileState& state = *t.state;
  state.depth_is_clear &= ~blocks;
  state.depth_on_plane &= ~blocks;
  if (state.depth_on_plane == 0) {
    state.depth_plane = {s.f0[0][lane], s.dfdx[0][lane], s.dfdy[0][lane], s.anchor_x[lane], s.anchor_y[lane]};
    state.depth_on_plane = blocks;
    return;
  }
  t.block.blocks = blocks;
  t.block.depth = t.framebuffer->depth_tile(t.tile);
  t.program->stores_depth(t.block);
}

// A row of the tile's blocks after the other.
void RunRows(TileContext& t, const CoveredBlocks& blocks, const TileCode& code) {
  BlockContext& c = t.block;
  constexpr uint64_t kRow = (uint64_t{1} << kRowBlocks) - 1;
  for (int first = 0; first < kTileBlocks; first += kRowBlocks) {
    c.blocks = blocks.All() & kRow << first;
    if (c.blocks == 0) continue;
    if (blocks.parts != 0) t.ahead.AskForSome(t.program->plane, t.program->reads_depth, true);
    for (int k = 0; k < kRowBlocks; ++k) c.row_live[k] = blocks.Of(first + k);
    for (int i = 0; i < code.row_count && c.blocks != 0; ++i) code.row[static_cast<size_t>(i)](c);
  }
}

// The same, of all but the depth test, later.
void DeferRows(TileContext& t, const CoveredBlocks& blocks, const BlockProgram& stages, bool tests_depth) {
  BlockContext& c = t.block;
  constexpr uint64_t kRow = (uint64_t{1} << kRowBlocks) - 1;
  for (int first = 0; first < kTileBlocks; first += kRowBlocks) {
    c.blocks = blocks.All() & kRow << first;
    if (c.blocks == 0) continue;
    if (blocks.parts != 0) t.ahead.AskForSome(t.program->plane, t.program->reads_depth, true);
    for (int k = 0; k < kRowBlocks; ++k) c.row_live[k] = blocks.Of(first + k);
    if (tests_depth) stages.whole.row[0](c);
    t.deferred.Take(c.blocks, c.row_live);
  }
}

HWY_INLINE void CountFragments(TileContext& t, int lane, const CoveredBlocks& blocks) {
  int count = __builtin_popcountll(blocks.whole) * kBlockPixels;
  for (uint64_t todo = blocks.parts; todo != 0; todo &= todo - 1)
    count += __builtin_popcountll(blocks.masks[__builtin_ctzll(todo)]);
  AddFragments(t, lane, static_cast<uint64_t>(count));
}

// The kernel that takes many, on blocks whose depth is settled, or not asked for.
void RunTileKernel(TileContext& t, int lane, const CoveredBlocks& blocks, const TileCode& code) {
  const SetupBatch& s = t.setup;
  BlockContext& c = t.block;
  const int plane = t.program->plane;
  const BlockProgram* taker = t.deferred.taker;
  if (taker == nullptr && (t.deferred.blocks & blocks.All()) != 0) {
    if (code.overwrites || code.fills) t.deferred.Drop(blocks.whole);
    ShadeDeferred(t, blocks.All());
  }
  c.dx = s.anchor_x[lane];
  c.dy = s.anchor_y[lane];
  c.lane = lane;
  CountFragments(t, lane, blocks);
  if (code.fills) return FillBlocks(t, blocks.whole, EvenPixel(t, lane, code.block));
  ColorMarks& marks = t.state->color[plane];
  if (code.overwrites) marks.is_clear &= ~blocks.whole;
  if ((marks.is_clear & blocks.All()) != 0) t.framebuffer->settle_color(t.tile, blocks.All(), plane);
  c.color = t.framebuffer->color_tile<uint32_t>(t.tile, plane);
  if (t.program->reads_depth) c.depth = t.framebuffer->depth_tile(t.tile);
  c.blocks = blocks.All();
  if (taker != nullptr) DeferRows(t, blocks, *taker, &code == &taker->whole);
  else if (code.tile != nullptr) code.tile(c);
  else RunRows(t, blocks, code);
}

// Where being nearer decides nothing.
void RunTestedBlocks(TileContext& t, int lane, CoveredBlocks blocks, const BlockProgram& stages) {
  const SetupBatch& s = t.setup;
  if (t.program->rejects_deeper) blocks = blocks.But(BlockDepths(s, lane, blocks.All()).Hidden(*t.state));
  if (blocks.All() == 0) return;
  if ((t.state->depth_marks() & blocks.All()) != 0) t.framebuffer->settle_depth(t.tile, blocks.All());
  RunTileKernel(t, lane, blocks, stages.whole);
  for (uint64_t todo = blocks.All(); todo != 0; todo &= todo - 1) {
    const int block = __builtin_ctzll(todo);
    t.block.dx = s.anchor_x[lane] + block % 8 * kBlockSize;
    t.block.dy = s.anchor_y[lane] + block / 8 * kBlockSize;
    UpdateDepthBounds(t, lane, block, (blocks.whole >> block & 1) != 0);
  }
}

void RunEach(TileContext& t, int lane, const CoveredBlocks& blocks) {
  for (uint64_t todo = blocks.All(); todo != 0; todo &= todo - 1)
    RunBlock(t, lane, __builtin_ctzll(todo), blocks.Of(__builtin_ctzll(todo)));
}

void RunCoveredBlocks(TileContext& t, int lane, CoveredBlocks blocks, const BlockProgram& stages) {
  const SetupBatch& s = t.setup;
  const PipelineProgram& program = *t.program;
  if (!stages.whole.fills && __builtin_popcountll(blocks.All()) < kFewBlocks) return RunEach(t, lane, blocks);
  t.planes.has_single = t.planes.has_double = 0;
  t.planes.has_lod_columns = false;
  t.planes.begin = __builtin_ctzll(blocks.All()) / 8 * kBlockSize;
  t.planes.end = (63 - __builtin_clzll(blocks.All())) / 8 * kBlockSize + kBlockSize;
  if (!program.reads_depth) return RunTileKernel(t, lane, blocks, stages.whole);
  if (!program.accepts_nearer) return RunTestedBlocks(t, lane, blocks, stages);
  const BlockDepths depths(s, lane, blocks.All());
  const CoarseDepth coarse = depths.Compare(*t.state, program.depth.func == CompareFunc::less_equal);
  blocks = blocks.But(coarse.hidden);
  const uint64_t nearer = stages.nearer.exists() ? blocks.whole & coarse.nearer : 0;
  const CoveredBlocks tested = blocks.But(nearer);
  if (tested.All() != 0 && stages.whole.exists()) {
    if ((t.state->depth_marks() & tested.All()) != 0) t.framebuffer->settle_depth(t.tile, tested.All());
    RunTileKernel(t, lane, tested, stages.whole);
  } else {
    RunEach(t, lane, tested);
  }
  if (nearer != 0) {
    RunTileKernel(t, lane, {nearer}, stages.nearer);
    if (program.writes_depth) TakeDepth(t, lane, nearer);
  }
  if (!program.writes_depth) return;
  depths.Update(tested.All(), tested.whole, nearer, *t.state);
  t.knows_deepest = false;
}
