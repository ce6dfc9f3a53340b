// Rectangles of fragments that come from an image. Colours go to the slots in which the stages after the primary
// colour look for it; everything else about a fragment is the same for all of them.

HWY_INLINE void SetImagePlanes(const PixelImage& image, int plane_count, SetupBatch& s) {
  for (int p = 0; p < plane_count; ++p) {
    s.f0[p][0] = image.planes[p];
    s.f0_f[p][0] = static_cast<float>(image.planes[p]);
    s.dfdx[p][0] = s.dfdy[p][0] = 0;
    s.dfdx_f[p][0] = s.dfdy_f[p][0] = 0;
  }
  s.anchor_x[0] = s.anchor_y[0] = 0;
  s.variant[0] = kAffine;
}

// The pixels of one block that the image has fragments for, and its elements there.
struct ImageBlock {
  const PixelImage& image;
  int x0, y0, x1, y1;       // in the block
  const int32_t* column;    // of pixel 0 of the block's rows; valid from x0 on
  const int32_t* row;

  // visit(i, column, row): pixel i of the block.
  template <class Visit>
  HWY_INLINE void ForEach(Visit visit) const {
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x)
        visit(y * kBlockSize + x, static_cast<size_t>(column[x]), static_cast<size_t>(row[y]));
  }
};

HWY_INLINE uint64_t BitmapMask(const ImageBlock& b) {
  uint64_t mask = 0;
  b.ForEach([&](int i, size_t column, size_t row) {
    const unsigned byte = b.image.bits[row * b.image.row_bytes + column / 8];
    mask |= uint64_t{byte >> (7 - column % 8) & 1u} << i;
  });
  return mask;
}

HWY_INLINE void TakeColors(const ImageBlock& b, const FragmentParams& params, BlockContext& c) {
  const bool wide = params.accuracy.interpolation == Level::exact;
  b.ForEach([&](int i, size_t column, size_t row) {
    const float* color = b.image.color + (row * b.image.row_elements + column) * 4;
    for (int k = 0; k < 4; ++k) {
      const double exact = static_cast<double>(color[k]) * 255.0;
      const float level = wide ? static_cast<float>(exact) : color_level(color[k], params.rounds_to_bytes);
      c.slot[kR + k][i] = level;
      if (wide) c.slot[kLowR + k][i] = static_cast<float>(exact - static_cast<double>(level));
    }
  });
}

// Spec 3.6.4: stencil indices go to the framebuffer under the mask, past all of the fragment stages but the scissor.
HWY_INLINE void WriteStencil(const ImageBlock& b, uint8_t* pixels) {
  const unsigned mask = b.image.stencil_mask;
  b.ForEach([&](int i, size_t column, size_t row) {
    const unsigned value = b.image.stencil[row * b.image.row_elements + column];
    pixels[i] = static_cast<uint8_t>((pixels[i] & ~mask) | (value & mask));
  });
}

HWY_INLINE void RunImageBlock(TileContext& t, const ImageBlock& b, int block) {
  uint64_t mask = LimitMask(t.limit, block);
  switch (b.image.kind) {
    case PixelKind::bitmap:
      mask = BitmapMask(b);
      break;
    case PixelKind::color:
      TakeColors(b, t.program->params, t.block);
      break;
    case PixelKind::depth: {
      uint32_t* depth = t.given_depth;
      b.ForEach([&](int i, size_t column, size_t row) { depth[i] = b.image.depth[row * b.image.row_elements + column]; });
      t.block.given_depth = depth;
      break;
    }
    case PixelKind::stencil: {
      const uint64_t bit = uint64_t{1} << block;
      if ((t.state->stencil_is_clear & bit) != 0) t.framebuffer->settle_stencil(t.tile, bit);
      return WriteStencil(b, t.framebuffer->stencil_tile(t.tile) + block * kBlockPixels);
    }
  }
  if (mask != 0) RunBlock(t, 0, block, mask);
}

void RunImage(TileContext& t, const PixelImage& image) {
  FlushPacked(t);
  SetImagePlanes(image, t.plane_count, t.setup);
  const Rect& limit = t.limit;  // the image's bounds in this tile
  for (int y = limit.y0 & ~(kBlockSize - 1); y < limit.y1; y += kBlockSize) {
    for (int x = limit.x0 & ~(kBlockSize - 1); x < limit.x1; x += kBlockSize) {
      const ImageBlock b{image,
                         limit.x0 > x ? limit.x0 - x : 0,
                         limit.y0 > y ? limit.y0 - y : 0,
                         limit.x1 < x + kBlockSize ? limit.x1 - x : kBlockSize,
                         limit.y1 < y + kBlockSize ? limit.y1 - y : kBlockSize,
                         image.column + (t.x + x - image.bounds.x0),
                         image.row + (t.y + y - image.bounds.y0)};
      RunImageBlock(t, b, y / kBlockSize * 8 + x / kBlockSize);
    }
  }
}
