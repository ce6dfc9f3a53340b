// What a larger triangle need not do block by block: be hidden, and be stored where it is one pixel value all over.

// The plane's least (sign = -1) or greatest (sign = 1) depth over the pixel centres of a box that begins (dx, dy) from
// the anchor and reaches (across, up) pixels further.
HWY_INLINE double BoxDepth(const SetupBatch& s, int lane, double dx, double dy, int across, int up, int sign) {
  const double gx = s.dfdx[0][lane], gy = s.dfdy[0][lane];
  const double far_x = (gx > 0) == (sign > 0) ? dx + across : dx;
  const double far_y = (gy > 0) == (sign > 0) ? dy + up : dy;
  return s.f0[0][lane] + gy * far_y + gx * far_x;
}

// Coarse z, rounded away from the decision: true only if no pixel of the box can be as near as `deepest`.
HWY_INLINE bool IsBehind(double least, uint32_t deepest) {
  if (least > kDepthScale) least = kDepthScale;  // an offset may take it beyond; fragments are held to the range
  return least - 1.0 > static_cast<double>(deepest) + 1.0;
}

// The deepest any pixel of the tile lies, as far as its blocks know.
HWY_INLINE uint32_t DeepestOfTile(TileContext& t) {
  if (!t.knows_deepest) {
    const hn::CappedTag<uint32_t, 16> d;
    auto deepest = hn::Zero(d);
    for (size_t i = 0; i < kTileBlocks; i += hn::Lanes(d)) deepest = hn::Max(deepest, hn::LoadU(d, t.state->depth_max + i));
    t.deepest = hn::GetLane(hn::MaxOfLanes(d, deepest));
    t.knows_deepest = true;
  }
  return t.deepest;
}

HWY_INLINE bool TileHides(TileContext& t, int lane) {
  if (!t.program->rejects_deeper) return false;
  const SetupBatch& s = t.setup;
  const uint32_t deepest = DeepestOfTile(t);
  if (deepest == kDepthMax) return false;
  const int x = s.min_x[lane], y = s.min_y[lane];
  return IsBehind(BoxDepth(s, lane, s.anchor_x[lane] + x, s.anchor_y[lane] + y, s.max_x[lane] - x, s.max_y[lane] - y, -1),
                  deepest);
}

// Of `blocks`, those that lie behind what is there.
uint64_t HiddenBlocks(const TileContext& t, int lane, uint64_t blocks) {
  const SetupBatch& s = t.setup;
  uint64_t hidden = 0;
  for (uint64_t todo = blocks; todo != 0; todo &= todo - 1) {
    const int block = __builtin_ctzll(todo);
    const double dx = s.anchor_x[lane] + block % 8 * kBlockSize, dy = s.anchor_y[lane] + block / 8 * kBlockSize;
    const double least = BoxDepth(s, lane, dx, dy, kBlockSize - 1, kBlockSize - 1, -1);
    if (IsBehind(least, t.state->depth_max[block])) hidden |= uint64_t{1} << block;
  }
  return hidden;
}

// Whether the triangle's interpolated colour is the same at all pixels. If so, it becomes its flat colour.
HWY_INLINE bool HasEvenColor(TileContext& t, int lane) {
  SetupBatch& s = t.setup;
  if (t.program->even.count == 0 || s.variant[lane] != kAffine) return false;
  const int plane = t.program->params.color_plane;
  for (int k = plane; k < plane + 4; ++k)
    if (s.dfdx[k][lane] != 0 || s.dfdy[k][lane] != 0) return false;
  for (int k = 0; k < 4; ++k) s.flat[k][lane] = s.f0_f[plane + k][lane];
  return true;
}

// The one pixel value of such a primitive: its program works it out, on a block of its own.
HWY_INLINE uint32_t EvenPixel(TileContext& t, int lane, const BlockProgram& program) {
  BlockContext& c = t.block;
  alignas(64) uint32_t pixels[kBlockPixels];
  c.color = pixels;
  c.lane = lane;
  c.live = ~uint64_t{0};
  program.run(c);
  return pixels[0];
}

void FillBlocks(TileContext& t, uint64_t blocks, uint32_t pixel) {
  const int plane = t.program->plane;
  t.state->color[plane].is_clear &= ~blocks;
  t.statistics->fragments += static_cast<uint64_t>(__builtin_popcountll(blocks)) * kBlockPixels;
  uint32_t* tile = t.framebuffer->color_tile<uint32_t>(t.tile, plane);
  const hn::CappedTag<uint32_t, 16> d;
  const auto value = hn::Set(d, pixel);
  while (blocks != 0) {
    const int first = __builtin_ctzll(blocks);
    const uint64_t rest = ~(blocks >> first);
    const int count = rest != 0 ? __builtin_ctzll(rest) : kTileBlocks;
    uint32_t* out = tile + first * kBlockPixels;
    uint32_t* const end = out + count * kBlockPixels;
    for (; out != end; out += 32)
      for (size_t i = 0; i < 32; i += hn::Lanes(d)) hn::Store(value, d, out + i);
    blocks &= count == kTileBlocks ? 0 : ~(((uint64_t{1} << count) - 1) << first);
  }
}
