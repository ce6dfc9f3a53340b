// Shading what was deferred (deferred_pixels.inl). Compiled once per ISA level.

// A block in a call of its own costs less than what a whole tile's planes do, where there are but a few.
constexpr int kFewBlocks = 4;

// The kernels after the depth test, on what is left of a deferred triangle.
void ShadeTriangle(TileContext& t, int index, uint64_t blocks) {
  const DeferredPixels::Triangle& triangle = t.deferred.triangles[index];
  BlockContext& c = t.block;
  c.setup = &t.deferred.setup[index / kSetupLanes];
  c.params = &triangle.program->params;
  c.lane = index % kSetupLanes;
  const double x = c.setup->anchor_x[c.lane], y = c.setup->anchor_y[c.lane];
  uint64_t masks[kTileBlocks];
  uint64_t left = 0;
  for (uint64_t todo = blocks; todo != 0; todo &= todo - 1) {
    const int block = __builtin_ctzll(todo);
    masks[block] = t.deferred.Left(block, index);
    t.deferred.shaded += static_cast<uint64_t>(__builtin_popcountll(masks[block]));
    if (masks[block] != 0) left |= uint64_t{1} << block;
  }
  if (left == 0) return;
  uint32_t* color = t.framebuffer->color_tile<uint32_t>(t.tile, triangle.program->plane);
  if (__builtin_popcountll(left) < kFewBlocks) {
    for (; left != 0; left &= left - 1) {
      const int block = __builtin_ctzll(left);
      c.dx = x + block % 8 * kBlockSize;
      c.dy = y + block / 8 * kBlockSize;
      c.color = color + block * kBlockPixels;
      c.live = masks[block];
      triangle.stages->run_deferred(c);
    }
    return;
  }
  c.dx = x;
  c.dy = y;
  c.color = color;
  c.planes->has_single = c.planes->has_double = 0;
  c.planes->has_lod_columns = false;
  c.planes->begin = __builtin_ctzll(left) / 8 * kBlockSize;
  c.planes->end = (63 - __builtin_clzll(left)) / 8 * kBlockSize + kBlockSize;
  const TileCode& code = triangle.stages->nearer;
  for (int first = 0; first < kTileBlocks; first += kRowBlocks) {
    c.blocks = left & ((uint64_t{1} << kRowBlocks) - 1) << first;
    if (c.blocks == 0) continue;
    for (int k = 0; k < kRowBlocks; ++k) c.row_live[k] = (c.blocks >> (first + k) & 1) != 0 ? masks[first + k] : 0;
    for (int i = 0; i < code.row_count && c.blocks != 0; ++i) code.row[static_cast<size_t>(i)](c);
  }
}

HWY_NOINLINE void ShadeAllDeferred(TileContext& t, uint64_t blocks) {
  DeferredPixels& deferred = t.deferred;
  BlockContext& c = t.block;
  const int begin = c.planes->begin, end = c.planes->end;
  for (int i = 0; i < deferred.count; ++i) {
    const uint64_t own = deferred.triangles[i].blocks & blocks;
    if (own != 0) ShadeTriangle(t, i, own);
  }
  deferred.blocks &= ~blocks;
  if (deferred.blocks == 0) deferred.count = 0;
  // As they were, but for planes that were worked out.
  c.planes->begin = begin, c.planes->end = end;
  c.planes->has_single = c.planes->has_double = 0;
  c.planes->has_lod_columns = false;
  c.setup = &t.setup;
  if (t.program != nullptr) c.params = &t.program->params;
}

// Shades what waits in these blocks. Of the context, what is the primitive's or the block's is to be set afterwards.
HWY_INLINE void ShadeDeferred(TileContext& t, uint64_t blocks) {
  if ((t.deferred.blocks & blocks) != 0) ShadeAllDeferred(t, t.deferred.blocks & blocks);
}

// A block of the triangle at hand: its depth now, its colour later.
HWY_INLINE void DeferBlock(TileContext& t, const BlockProgram& stages, int block) {
  stages.run_depth(t.block);
  t.block.row_live[block % kRowBlocks] = t.block.live;
  if (t.block.live != 0) t.deferred.Take(uint64_t{1} << block, t.block.row_live);
}

// While there is one, the triangle's colours are deferred if its program can do so.
class Deferral {
 public:
  HWY_INLINE Deferral(TileContext& t, int lane, const BlockProgram& stages) : t_(t), lane_(lane) {
    DeferredPixels& deferred = t.deferred;
    if (!stages.defers) return;
    deferred.asked = true;
    if (deferred.pauses) return;
    if (deferred.count == DeferredPixels::kTriangles) ShadeDeferred(t, deferred.blocks);
    if (deferred.blocks == 0) deferred.count = 0;
    deferred.triangles[deferred.count] = {t.program, &stages, 0};
    deferred.taker = &stages;
  }
  HWY_INLINE ~Deferral() {
    DeferredPixels& deferred = t_.deferred;
    if (deferred.taker == nullptr) return;
    deferred.taker = nullptr;
    if (deferred.triangles[deferred.count].blocks == 0) return;
    deferred.KeepPlanes(t_.setup, lane_, t_.plane_count);
    ++deferred.count;
  }
  Deferral(const Deferral&) = delete;
  Deferral& operator=(const Deferral&) = delete;

 private:
  TileContext& t_;
  int lane_;
};
