// Blocks that a triangle covers all over, many in one call. Compiled once per ISA level.

// A block in a call of its own costs less than what a whole tile's planes do, where there are but a few.
constexpr int kFewBlocks = 4;

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
void RunRows(BlockContext& c, uint64_t blocks, const TileCode& code) {
  constexpr uint64_t kRow = (uint64_t{1} << kRowBlocks) - 1;
  for (int first = 0; first < kTileBlocks; first += kRowBlocks) {
    c.blocks = blocks & kRow << first;
    for (uint64_t& live : c.row_live) live = ~uint64_t{0};
    for (int i = 0; i < code.row_count && c.blocks != 0; ++i) code.row[static_cast<size_t>(i)](c);
  }
}

// The kernel that takes many, on blocks whose depth is settled, or not asked for.
void RunTileKernel(TileContext& t, int lane, uint64_t blocks, const TileCode& code) {
  const SetupBatch& s = t.setup;
  BlockContext& c = t.block;
  const int plane = t.program->plane;
  c.dx = s.anchor_x[lane];
  c.dy = s.anchor_y[lane];
  c.lane = lane;
  CountFragments(t, lane, blocks);
  if (code.fills) return FillBlocks(t, blocks, EvenPixel(t, lane, code.block));
  ColorMarks& marks = t.state->color[plane];
  if (code.overwrites) marks.is_clear &= ~blocks;
  else if ((marks.is_clear & blocks) != 0) t.framebuffer->settle_color(t.tile, blocks, plane);
  c.color = t.framebuffer->color_tile<uint32_t>(t.tile, plane);
  if (t.program->reads_depth) c.depth = t.framebuffer->depth_tile(t.tile);
  c.blocks = blocks;
  if (code.tile != nullptr) code.tile(c);
  else RunRows(c, blocks, code);
}

// Where being nearer decides nothing.
void RunTestedBlocks(TileContext& t, int lane, uint64_t blocks, const BlockProgram& stages) {
  const SetupBatch& s = t.setup;
  if (t.program->rejects_deeper) blocks &= ~BlockDepths(s, lane, blocks).Hidden(*t.state);
  if (blocks == 0) return;
  if ((t.state->depth_marks() & blocks) != 0) t.framebuffer->settle_depth(t.tile, blocks);
  RunTileKernel(t, lane, blocks, stages.whole);
  for (; blocks != 0; blocks &= blocks - 1) {
    const int block = __builtin_ctzll(blocks);
    t.block.dx = s.anchor_x[lane] + block % 8 * kBlockSize;
    t.block.dy = s.anchor_y[lane] + block / 8 * kBlockSize;
    UpdateDepthBounds(t, lane, block, true);
  }
}

void RunWholeBlocks(TileContext& t, int lane, uint64_t blocks, const BlockProgram& stages) {
  const SetupBatch& s = t.setup;
  const PipelineProgram& program = *t.program;
  if (!stages.whole.fills && __builtin_popcountll(blocks) < kFewBlocks) {
    for (; blocks != 0; blocks &= blocks - 1) RunBlock(t, lane, __builtin_ctzll(blocks), ~uint64_t{0});
    return;
  }
  t.planes.has_single = t.planes.has_double = 0;
  t.planes.begin = __builtin_ctzll(blocks) / 8 * kBlockSize;
  t.planes.end = (63 - __builtin_clzll(blocks)) / 8 * kBlockSize + kBlockSize;
  if (!program.reads_depth) return RunTileKernel(t, lane, blocks, stages.whole);
  if (!program.accepts_nearer) return RunTestedBlocks(t, lane, blocks, stages);
  const BlockDepths depths(s, lane, blocks);
  const CoarseDepth coarse = depths.Compare(*t.state, program.depth.func == CompareFunc::less_equal);
  blocks &= ~coarse.hidden;
  const uint64_t nearer = stages.nearer.exists() ? blocks & coarse.nearer : 0, tested = blocks & ~nearer;
  if (tested != 0 && stages.whole.exists()) {
    if ((t.state->depth_marks() & tested) != 0) t.framebuffer->settle_depth(t.tile, tested);
    RunTileKernel(t, lane, tested, stages.whole);
  } else {
    for (uint64_t todo = tested; todo != 0; todo &= todo - 1) RunBlock(t, lane, __builtin_ctzll(todo), ~uint64_t{0});
  }
  if (nearer != 0) {
    RunTileKernel(t, lane, nearer, stages.nearer);
    if (program.writes_depth) TakeDepth(t, lane, nearer);
  }
  if (!program.writes_depth) return;
  depths.Update(tested, nearer, *t.state);
  t.knows_deepest = false;
}
