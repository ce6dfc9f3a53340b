// Lines of one pixel's width: which pixels they make fragments at, a vector of columns at a time, exactly as
// raster/tile/cover_line.cpp has it pixel by pixel. Compiled once per ISA level.

// A line on a tile, in 1/256 px from the tile's corner. u is along its longer axis, v along the other. The
// diamond-exit rule (spec 3.4.1) as bounds on sums and differences of coordinates: the diamond |x - cx| + |y
// - cy| < 1/2 is a square on the axes x + y and x - y, where the moved ends make one side of each bound
// belong to it.
struct LineWalk {
  static constexpr int kHalf = kSubpixelScale / 2;
  int32_t x0, y0, sum, difference;  // dx + dy, dx - dy
  bool steep;
  int first, last;      // columns of pixels
  double start, step;   // v at the middle of column `first`, and from column to column, times pitch
  double pitch;         // a pixel
  double between_down;  // 1: where the line runs exactly between two pixels, the one below has the fragment

  HWY_INLINE LineWalk(const LineEnds& e, int tile_x, int tile_y, const Rect& limit) {
    x0 = e.x0 - tile_x * kSubpixelScale, y0 = e.y0 - tile_y * kSubpixelScale;
    const int32_t dx = e.x1 - e.x0, dy = e.y1 - e.y0;
    const int32_t width = dx < 0 ? -dx : dx, height = dy < 0 ? -dy : dy;
    sum = dx + dy, difference = dx - dy;
    steep = height > width;
    const int32_t u0 = steep ? y0 : x0, v0 = steep ? x0 : y0, du = steep ? dy : dx, dv = steep ? dx : dy;
    const int32_t length = steep ? height : width, rise = du < 0 ? -dv : dv;
    const int32_t low = du < 0 ? u0 + du : u0, high = du < 0 ? u0 : u0 + du;
    const int from = steep ? limit.y0 : limit.x0, to = (steep ? limit.y1 : limit.x1) - 1;
    first = ColumnBelow(low), last = ColumnBelow(high);
    first = first > from ? first : from;
    last = last < to ? last : to;
    const int64_t along = int64_t{first} * kSubpixelScale + kHalf - u0;
    start = static_cast<double>(int64_t{v0} * length + rise * along);
    step = static_cast<double>(int64_t{rise} * kSubpixelScale);
    pitch = static_cast<double>(int64_t{length} * kSubpixelScale);
    // Both diamonds touch the line with a corner; the moved line passes through one of them.
    between_down = steep || (dx > 0 ? dy <= 0 : dy >= 0) ? 1 : 0;
  }

  // The rows of columns [column, column + kQueueLanes). Every number is an integer below 2^53. A quotient
  // that is none is further from the next integer than it is rounded by: rows are below 2^18, pitch below
  // 2^33.
  HWY_INLINE hn::Vec<DIq> Rows(int column) const {
    const DD d;
    QueuedDoubles rows;
    for (int p = 0; p < kQueueParts; ++p) {
      const VD index =
          hn::Add(hn::Iota(d, 0), hn::Set(d, static_cast<double>(column - first + p * kDoubleLanes)));
      const VD place = hn::Add(hn::Set(d, start), hn::Mul(hn::Set(d, step), index));
      const VD row = hn::Floor(hn::Div(place, hn::Set(d, pitch)));
      const auto between = hn::Eq(hn::Mul(row, hn::Set(d, pitch)), place);
      rows.part[p] = hn::Sub(row, hn::IfThenElseZero(between, hn::Set(d, between_down)));
    }
    return DemoteQueued(DIq(), rows);
  }

  // Whether the segment reaches into the pixels' diamonds, and leaves them.
  HWY_INLINE hn::Mask<DIq> MakesFragments(hn::Vec<DIq> x, hn::Vec<DIq> y) const {
    const DIq d;
    const auto to_x = hn::Sub(hn::Set(d, x0 - kHalf), hn::ShiftLeft<kSubpixelBits>(x));
    const auto to_y = hn::Sub(hn::Set(d, y0 - kHalf), hn::ShiftLeft<kSubpixelBits>(y));
    const auto a = hn::Add(to_x, to_y), b = hn::Sub(to_x, to_y);
    const auto reaches = hn::And(Within(a, sum < 0 ? sum : 0, sum > 0 ? sum : 0),
                                 Within(b, difference < 0 ? difference : 0, difference > 0 ? difference : 0));
    const auto ends = hn::And(Within(a, sum, sum), Within(b, difference, difference));
    return hn::AndNot(ends, reaches);
  }

 private:
  static HWY_INLINE int ColumnBelow(int32_t u) { return ((u + kSubpixelScale - 1) >> kSubpixelBits) - 1; }
  static HWY_INLINE hn::Mask<DIq> Within(hn::Vec<DIq> v, int32_t least, int32_t most) {
    const DIq d;
    return hn::And(hn::Gt(v, hn::Set(d, -kHalf - most)), hn::Lt(v, hn::Set(d, kHalf + 1 - least)));
  }
};

// Neighbouring fragments of a line, at most a vector of them.
struct alignas(64) LinePiece {
  int32_t x[8], y[8];  // behind the last: what a register held
  int lane, count;
};

// The pieces of a batch's lines on the tile, in their order. They are all found before the first is drawn:
// how many fragments there are decides where the queue is full, and the processor must not wait with its
// guess for the division.
struct LinePieces {
  static constexpr int kMost = kSetupLanes * (kTileSize / kQueueLanes);
  LinePiece piece[kMost];
  int count = 0;

  // `limit`: the pixels that may be drawn, relative to the tile.
  HWY_INLINE void Add(const LineEnds& ends, int lane, int tile_x, int tile_y, const Rect& limit) {
    const DIq d;
    const LineWalk walk(ends, tile_x, tile_y, limit);
    const auto steep = hn::MaskFromVec(hn::Set(d, walk.steep ? -1 : 0));
    const auto low = hn::Set(d, walk.steep ? limit.x0 : limit.y0);
    const auto high = hn::Set(d, walk.steep ? limit.x1 : limit.y1);
    for (int column = walk.first; column <= walk.last; column += kQueueLanes) {
      const auto u = hn::Add(hn::Iota(d, 0), hn::Set(d, column)), v = walk.Rows(column);
      const auto x = hn::IfThenElse(steep, v, u), y = hn::IfThenElse(steep, u, v);
      const auto inside =
          hn::And(hn::Lt(u, hn::Set(d, walk.last + 1)), hn::AndNot(hn::Lt(v, low), hn::Lt(v, high)));
      const auto live = hn::And(inside, walk.MakesFragments(x, y));
      LinePiece& to = piece[count];
      const Squeeze squeeze(live);
      hn::Store(squeeze(x), d, to.x);
      hn::Store(squeeze(y), d, to.y);
      to.lane = lane;
      to.count = static_cast<int>(hn::CountTrue(d, live));
      count += to.count > 0 ? 1 : 0;
    }
  }
};

void PackPiece(TileContext& t, const LinePiece& piece) {
  const DIq d;
  const SetupBatch& s = t.setup;
  const int last = piece.count - 1;
  // With the first and the last of them all their blocks are found.
  uint32_t* depth = PreparePacking(t, s.variant[piece.lane], piece.count,
                                   WindowBlocks(piece.x[0], piece.y[0], piece.x[last], piece.y[last]));
  const auto taken = hn::Lt(hn::Iota(d, 0), hn::Set(d, piece.count));
  const auto x = hn::IfThenElse(taken, hn::Load(d, piece.x), hn::Set(d, piece.x[0]));
  const auto y = hn::IfThenElse(taken, hn::Load(d, piece.y), hn::Set(d, piece.y[0]));
  const int before = t.packer.queue.count;
  const uint32_t* color = t.framebuffer->color_tile<uint32_t>(t.tile, t.program->plane);
  for (int i = 0; i < piece.count; i += 2)
    __builtin_prefetch(color + Packer::TileOffset(piece.x[i], piece.y[i]), 1);
  t.packer.AppendGroup(s, piece.lane, x, y, piece.count, *t.program, t.plane_count, depth);
  if (t.flat_color) t.packer.SetFlatColor(s, piece.lane, t.program->params.color_plane, before);
}

HWY_INLINE bool PacksLine(const TileContext& t, const PrimitiveRef& ref, int lane) {
  return ref.kind == PrimitiveKind::line && !ref.cut && Packs(t, lane);
}

// How many of the batch's primitives, from the first on, are lines that it drew.
int PackLines(TileContext& t, const Segment& segment, const DrawRecord& draw, const uint32_t* ids,
              int count) {
  const PrimitiveRef* refs = segment.primitives.data();
  if (!draw.shape.plain_lines() || !PacksLine(t, refs[ids[0]], 0)) return 0;
  const size_t stride = draw.vertices.layout.stride();
  LinePieces pieces;
  int lane = 0;
  for (; lane < count && PacksLine(t, refs[ids[lane]], lane); ++lane) {
    const VertexHead *a = Head(draw.vertices, stride, refs[ids[lane]].v[0]),
                     *b = Head(draw.vertices, stride, refs[ids[lane]].v[1]);
    pieces.Add({a->x, a->y, b->x, b->y}, lane, t.x, t.y, t.limit);
  }
  for (int i = 0; i < pieces.count; ++i) PackPiece(t, pieces.piece[i]);
  return lane;
}

// What PackLines finds, for the tests.
void ListLine(const LineEnds& ends, int tile_x, int tile_y, const Rect& bounds, PixelList& out) {
  out.count = 0;
  const Rect cut = intersect(bounds, {tile_x, tile_y, tile_x + kTileSize, tile_y + kTileSize});
  if (cut.empty()) return;
  LinePieces pieces;
  pieces.Add(ends, 0, tile_x, tile_y, {cut.x0 - tile_x, cut.y0 - tile_y, cut.x1 - tile_x, cut.y1 - tile_y});
  for (int i = 0; i < pieces.count; ++i) {
    for (int j = 0; j < pieces.piece[i].count; ++j, ++out.count) {
      out.x[out.count] = static_cast<uint8_t>(pieces.piece[i].x[j]);
      out.y[out.count] = static_cast<uint8_t>(pieces.piece[i].y[j]);
    }
  }
}
