// What a larger triangle need not do block by block: be stored where it is one pixel value all over, and where it is
// nearer than all there is.

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
HWY_INLINE uint32_t EvenPixel(TileContext& t, int lane, BlockFunction kernel) {
  BlockContext& c = t.block;
  alignas(64) uint32_t pixels[kBlockPixels];
  c.color = pixels;
  c.lane = lane;
  c.live = ~uint64_t{0};
  kernel(c);
  return pixels[0];
}

void FillBlocks(TileContext& t, uint64_t blocks, uint32_t pixel) {
  const int plane = t.program->plane;
  t.state->color[plane].is_clear &= ~blocks;
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
