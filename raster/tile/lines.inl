// Lines of one pixel's width: which pixels they make fragments at, a vector of columns at a time, exactly as
// raster/tile/cover_line.cpp has it pixel by pixel. Compiled once per ISA level.

using LineInts = hn::Vec<DDi>;  // a line a lane

// A pixel a lane.
using DLf = hn::CappedTag<float, 16>;
using DLi = hn::RebindToSigned<DLf>;
using PixelInts = hn::Vec<DLi>;
inline constexpr int kPixelLanes = static_cast<int>(hn::MaxLanes(DLi()));
inline constexpr int kPixelParts = kPixelLanes / kDoubleLanes;

// A batch's lines as SetUp has them, but for what only triangles need: no order to be found, no edges, no
// box. The third corner, at right angles (FindCorners), is made in registers.
struct LineSetup {
  alignas(64) int32_t x[2][kSetupLanes], y[2][kSetupLanes];  // the ends in the order they were given

  HWY_INLINE void Copy(const VertexHead* from, const VertexHead* to, const QuadPlan& quads, int lane,
                       SetupInput& in) {
    x[0][lane] = from->x, y[0][lane] = from->y;
    x[1][lane] = to->x, y[1][lane] = to->y;
    // The lower end first, as Below() has it; chosen without a branch, which would be wrong every other time.
    const int64_t swap = Place(*to) < Place(*from) ? 1 : 0;
    const ptrdiff_t apart =
        (reinterpret_cast<const std::byte*>(to) - reinterpret_cast<const std::byte*>(from)) * swap;
    const auto* low = reinterpret_cast<const VertexHead*>(reinterpret_cast<const std::byte*>(from) + apart);
    const auto* high = reinterpret_cast<const VertexHead*>(reinterpret_cast<const std::byte*>(to) - apart);
    memcpy(&in.head[0][lane], low, sizeof *low);
    memcpy(&in.head[1][lane], high, sizeof *high);
    CopyQuads(low, quads, 0, lane, in);
    CopyQuads(high, quads, 1, lane, in);
  }

  static HWY_INLINE void Spread(const QuadPlan& quads, int attributes, int i, SetupInput& in, CornerVectors& v) {
    const DD d;
    const DDi di;
    const DDf df;
    LineInts x[3], y[3];
    hn::Vec<DDf> rest_x[3], rest_y[3];
    for (int k = 0; k < 2; ++k) {
      VD place, z, inv_w, rest;
      hn::LoadInterleaved4(d, reinterpret_cast<const double*>(in.head[k] + i), place, z, inv_w, rest);
      x[k] = LowHalf(di, place), y[k] = HighHalf(di, place);
      rest_x[k] = LowHalf(df, rest), rest_y[k] = HighHalf(df, rest);
      v.z[k] = z, v.inv_w[k] = inv_w;
    }
    v.z[2] = v.z[0], v.inv_w[2] = v.inv_w[0];
    x[2] = hn::Sub(x[0], hn::Sub(y[1], y[0])), y[2] = hn::Add(y[0], hn::Sub(x[1], x[0]));
    rest_x[2] = hn::Sub(rest_x[0], hn::Sub(rest_y[1], rest_y[0]));
    rest_y[2] = hn::Add(rest_y[0], hn::Sub(rest_x[1], rest_x[0]));
    for (int k = 0; k < 3; ++k) {
      v.place_x[k] = x[k], v.place_y[k] = y[k];
      v.x[k] = hn::PromoteTo(d, x[k]), v.y[k] = hn::PromoteTo(d, y[k]);
      v.rest_x[k] = hn::PromoteTo(d, rest_x[k]), v.rest_y[k] = hn::PromoteTo(d, rest_y[k]);
    }
    for (int q = 0; q < quads.count; ++q) {
      hn::Vec<DDf> quad[2][4];
      for (int k = 0; k < 2; ++k)
        hn::LoadInterleaved4(df, in.quad[k][q][i], quad[k][0], quad[k][1], quad[k][2], quad[k][3]);
      for (int f = 0; f < 4; ++f) {
        const int a = quads.Start(q) + f;
        if (a < 4 * q || a >= attributes) continue;
        for (int k = 0; k < 3; ++k) hn::Store(quad[k % 2][f], df, in.attribute[a][k] + i);
      }
    }
  }

 private:
  static HWY_INLINE int64_t Place(const VertexHead& v) { return (int64_t{v.y} << 32) + v.x; }
};

// A batch's lines on a tile, in 1/256 px from the tile's corner. u is along the longer axis, v along the
// other. The diamond-exit rule (spec 3.4.1) as bounds on sums and differences of coordinates: the diamond |x
// - cx| + |y - cy| < 1/2 is a square on the axes x + y and x - y, where the moved ends make one side of each
// bound belong to it.
struct LineWalk {
  static constexpr int kHalf = kSubpixelScale / 2;
  alignas(64) int32_t x0[kSetupLanes], y0[kSetupLanes];
  alignas(64) int32_t sum[kSetupLanes], difference[kSetupLanes];  // dx + dy, dx - dy
  alignas(64) int32_t steep[kSetupLanes];                         // -1 or 0
  alignas(64) int32_t first[kSetupLanes], last[kSetupLanes];      // columns of pixels
  // v at the middle of column `first`, and from column to column, times pitch; a pixel is a pitch.
  alignas(64) double start[kSetupLanes], step[kSetupLanes], pitch[kSetupLanes];
  // 1: where the line runs exactly between two pixels, the one below has the fragment. Both diamonds touch
  // the line with a corner, and the moved line passes through one of them.
  alignas(64) double between_down[kSetupLanes];

  HWY_INLINE void Find(const LineSetup& lines, int i, int tile_x, int tile_y, const Rect& limit) {
    const DD d;
    const DDi di;
    const LineInts zero = hn::Zero(di);
    const LineInts ax = hn::Sub(hn::Load(di, lines.x[0] + i), hn::Set(di, tile_x * kSubpixelScale));
    const LineInts ay = hn::Sub(hn::Load(di, lines.y[0] + i), hn::Set(di, tile_y * kSubpixelScale));
    const LineInts dx = hn::Sub(hn::Load(di, lines.x[1] + i), hn::Load(di, lines.x[0] + i));
    const LineInts dy = hn::Sub(hn::Load(di, lines.y[1] + i), hn::Load(di, lines.y[0] + i));
    const LineInts width = hn::Max(dx, hn::Neg(dx)), height = hn::Max(dy, hn::Neg(dy));
    const auto is_steep = hn::Gt(height, width);
    const LineInts u0 = hn::IfThenElse(is_steep, ay, ax), v0 = hn::IfThenElse(is_steep, ax, ay);
    const LineInts du = hn::IfThenElse(is_steep, dy, dx), dv = hn::IfThenElse(is_steep, dx, dy);
    const LineInts length = hn::Max(width, height);
    const LineInts rise = hn::IfThenElse(hn::Lt(du, zero), hn::Neg(dv), dv);
    const LineInts from = hn::IfThenElse(is_steep, hn::Set(di, limit.y0), hn::Set(di, limit.x0));
    const LineInts to = hn::IfThenElse(is_steep, hn::Set(di, limit.y1 - 1), hn::Set(di, limit.x1 - 1));
    const LineInts begin = hn::Max(ColumnBelow(hn::Min(u0, hn::Add(u0, du))), from);
    const LineInts along = hn::Sub(hn::Add(hn::ShiftLeft<kSubpixelBits>(begin), hn::Set(di, kHalf)), u0);
    hn::Store(ax, di, x0 + i);
    hn::Store(ay, di, y0 + i);
    hn::Store(hn::Add(dx, dy), di, sum + i);
    hn::Store(hn::Sub(dx, dy), di, difference + i);
    hn::Store(hn::VecFromMask(di, is_steep), di, steep + i);
    hn::Store(begin, di, first + i);
    hn::Store(hn::Min(ColumnBelow(hn::Max(u0, hn::Add(u0, du))), to), di, last + i);
    // Integers below 2^50.
    const VD long_side = hn::PromoteTo(d, length), climb = hn::PromoteTo(d, rise);
    const VD pixel = hn::Set(d, static_cast<double>(kSubpixelScale));
    hn::Store(hn::Add(hn::Mul(hn::PromoteTo(d, v0), long_side), hn::Mul(climb, hn::PromoteTo(d, along))), d,
              start + i);
    hn::Store(hn::Mul(climb, pixel), d, step + i);
    hn::Store(hn::Mul(long_side, pixel), d, pitch + i);
    // Steep, or level, or falling to the right.
    const LineInts falls =
        hn::Or(hn::VecFromMask(di, is_steep),
               hn::Or(hn::VecFromMask(di, hn::Eq(dy, zero)), hn::BroadcastSignBit(hn::Xor(dx, dy))));
    hn::Store(hn::Neg(hn::PromoteTo(d, falls)), d, between_down + i);
  }

  // The rows of columns [column, column + kPixelLanes). A quotient that is no integer is further from the
  // next than it is rounded by: rows are below 2^18, pitch below 2^33.
  HWY_INLINE PixelInts Rows(int lane, int column) const {
    const DD d;
    const VD height = hn::Set(d, pitch[lane]);
    LineInts rows[kPixelParts];
    for (int p = 0; p < kPixelParts; ++p) {
      const VD index =
          hn::Add(hn::Iota(d, 0), hn::Set(d, static_cast<double>(column - first[lane] + p * kDoubleLanes)));
      const VD place = hn::Add(hn::Set(d, start[lane]), hn::Mul(hn::Set(d, step[lane]), index));
      const VD row = hn::Floor(hn::Div(place, height));
      const auto between = hn::Eq(hn::Mul(row, height), place);
      rows[p] =
          hn::DemoteTo(DDi(), hn::Sub(row, hn::IfThenElseZero(between, hn::Set(d, between_down[lane]))));
    }
#if HWY_TARGET == HWY_SCALAR
    return rows[0];
#else
    return hn::Combine(DLi(), rows[1], rows[0]);
#endif
  }

  // Whether the segment reaches into the pixels' diamonds, and leaves them.
  HWY_INLINE hn::Mask<DLi> MakesFragments(int lane, PixelInts x, PixelInts y) const {
    const DLi d;
    const auto to_x = hn::Sub(hn::Set(d, x0[lane] - kHalf), hn::ShiftLeft<kSubpixelBits>(x));
    const auto to_y = hn::Sub(hn::Set(d, y0[lane] - kHalf), hn::ShiftLeft<kSubpixelBits>(y));
    const auto a = hn::Add(to_x, to_y), b = hn::Sub(to_x, to_y);
    const int32_t s = sum[lane], t = difference[lane];
    const auto reaches =
        hn::And(Within(a, s < 0 ? s : 0, s > 0 ? s : 0), Within(b, t < 0 ? t : 0, t > 0 ? t : 0));
    const auto ends = hn::And(Within(a, s, s), Within(b, t, t));
    return hn::AndNot(ends, reaches);
  }

 private:
  static HWY_INLINE LineInts ColumnBelow(LineInts u) {
    const DDi d;
    return hn::Sub(hn::ShiftRight<kSubpixelBits>(hn::Add(u, hn::Set(d, kSubpixelScale - 1))), hn::Set(d, 1));
  }
  static HWY_INLINE hn::Mask<DLi> Within(PixelInts v, int32_t least, int32_t most) {
    const DLi d;
    return hn::And(hn::Gt(v, hn::Set(d, -kHalf - most)), hn::Lt(v, hn::Set(d, kHalf + 1 - least)));
  }
};

// Neighbouring fragments of a line, at most a vector of them.
struct alignas(64) LinePiece {
  static constexpr int kMost = 16;
  int32_t x[kMost], y[kMost];  // behind the last: what a register held
  int lane, count;
};

// The pieces of a batch's lines on the tile, in their order. They are all found before the first is drawn:
// how many fragments there are decides where the queue is full, and the processor must not wait with its
// guess for the division.
struct LinePieces {
  static constexpr int kMost = kSetupLanes * (kTileSize / kPixelLanes);
  LinePiece piece[kMost];
  int count = 0;

  // `limit`: the pixels that may be drawn, relative to the tile.
  HWY_INLINE void Find(const LineSetup& lines, int line_count, int tile_x, int tile_y, const Rect& limit) {
    LineWalk walk;
    for (int i = 0; i < line_count; i += kDoubleLanes) walk.Find(lines, i, tile_x, tile_y, limit);
    for (int lane = 0; lane < line_count; ++lane) Add(walk, lane, limit);
  }

 private:
  static HWY_INLINE PixelInts ToTheFront(PixelInts v, hn::Mask<DLi> live) {
#if HWY_TARGET == HWY_AVX2
    return Squeeze(live)(v);
#else
    return hn::Compress(v, live);
#endif
  }

  HWY_INLINE void Add(const LineWalk& walk, int lane, const Rect& limit) {
    const DLi d;
    const bool is_steep = walk.steep[lane] != 0;
    const auto steep = hn::MaskFromVec(hn::Set(d, walk.steep[lane]));
    const auto low = hn::Set(d, is_steep ? limit.x0 : limit.y0),
               high = hn::Set(d, is_steep ? limit.x1 : limit.y1);
    const auto end = hn::Set(d, walk.last[lane] + 1);
    for (int column = walk.first[lane]; column <= walk.last[lane]; column += kPixelLanes) {
      const auto u = hn::Add(hn::Iota(d, 0), hn::Set(d, column)), v = walk.Rows(lane, column);
      const auto x = hn::IfThenElse(steep, v, u), y = hn::IfThenElse(steep, u, v);
      const auto inside = hn::And(hn::Lt(u, end), hn::AndNot(hn::Lt(v, low), hn::Lt(v, high)));
      const auto live = hn::And(inside, walk.MakesFragments(lane, x, y));
      LinePiece& to = piece[count];
      hn::Store(ToTheFront(x, live), d, to.x);
      hn::Store(ToTheFront(y, live), d, to.y);
      to.lane = lane;
      to.count = static_cast<int>(hn::CountTrue(d, live));
      count += to.count > 0 ? 1 : 0;
    }
  }
};

// Blocks of the rectangle with these pixels at opposite corners: among them those of a line from one to the
// other.
HWY_INLINE uint64_t RectBlocks(int x0, int y0, int x1, int y1) {
  const int left = (x0 < x1 ? x0 : x1) / kBlockSize, right = (x0 < x1 ? x1 : x0) / kBlockSize;
  const int low = (y0 < y1 ? y0 : y1) / kBlockSize, high = (y0 < y1 ? y1 : y0) / kBlockSize;
  const uint64_t columns = (uint64_t{2} << right) - (uint64_t{1} << left);
  const uint64_t rows = (uint64_t{0x0101010101010101} >> (8 * (7 - high + low))) << (8 * low);
  return columns * rows;
}

// With a depth test, a vector of the queue's length at a time; its lanes beyond the last stand for the first.
HWY_NOINLINE void TestAndPackPiece(TileContext& t, const LinePiece& piece, uint32_t* depth) {
  const DIq d;
  for (int i = 0; i < piece.count; i += kQueueLanes) {
    const auto taken = hn::Lt(hn::Iota(d, 0), hn::Set(d, piece.count - i));
    const auto x = hn::IfThenElse(taken, hn::Load(d, piece.x + i), hn::Set(d, piece.x[i]));
    const auto y = hn::IfThenElse(taken, hn::Load(d, piece.y + i), hn::Set(d, piece.y[i]));
    t.packer.AppendGroup(t.setup, piece.lane, x, y, piece.count - i, *t.program, t.plane_count, depth);
  }
}

void PackPiece(TileContext& t, const LinePiece& piece) {
  const SetupBatch& s = t.setup;
  PixelQueue& queue = t.packer.queue;
  const int lane = piece.lane, last = piece.count - 1;
  const unsigned variant = s.variant[lane];
  uint32_t* depth = PreparePacking(t, variant, piece.count,
                                   RectBlocks(piece.x[0], piece.y[0], piece.x[last], piece.y[last]));
  const int before = queue.count;
  if (depth != nullptr) {
    TestAndPackPiece(t, piece, depth);
  } else {
    const DLi d;
    const DLf f;
    const auto x = hn::Load(d, piece.x), y = hn::Load(d, piece.y);
    const auto dx = hn::Add(hn::ConvertTo(f, x), hn::Set(f, static_cast<float>(s.anchor_x[lane])));
    const auto dy = hn::Add(hn::ConvertTo(f, y), hn::Set(f, static_cast<float>(s.anchor_y[lane])));
    for (int p = (variant & kAffine) != 0 ? 2 : 1; p < t.plane_count; ++p) {
      const auto row = hn::Add(hn::Set(f, s.f0_f[p][lane]), hn::Mul(hn::Set(f, s.dfdy_f[p][lane]), dy));
      hn::StoreU(hn::Add(row, hn::Mul(hn::Set(f, s.dfdx_f[p][lane]), dx)), f, queue.plane[p] + before);
    }
    const auto high = hn::Set(d, 56), low = hn::Set(d, 7);
    const auto block = hn::Add(hn::ShiftLeft<6>(hn::And(y, high)), hn::ShiftLeft<3>(hn::And(x, high)));
    const auto offset = hn::Add(block, hn::Add(hn::ShiftLeft<3>(hn::And(y, low)), hn::And(x, low)));
    hn::StoreU(offset, d, queue.offset + before);
    queue.count = before + piece.count;
    // Every other pixel is in the cache line of its neighbour.
    const uint32_t* color = t.framebuffer->color_tile<uint32_t>(t.tile, t.program->plane);
    for (int i = 0; i < kPixelLanes; i += 2) __builtin_prefetch(color + queue.offset[before + i], 1);
  }
  if (t.flat_color) t.packer.SetFlatColor(s, lane, t.program->params.color_plane, before);
}

// Whether the batch is of lines that go one after the other through the queue of waiting fragments.
HWY_INLINE bool ArePlainLines(const TileContext& t, const Segment& segment, const DrawRecord& draw,
                              const uint32_t* ids, int count) {
  const PrimitiveRef* refs = segment.primitives.data();
  if (refs[ids[0]].kind != PrimitiveKind::line) return false;
  const VertexLayout& layout = draw.vertices.layout;
  if (!draw.shape.plain_lines() || !t.program->packs || t.notes != nullptr || layout.back_color >= 0 ||
      layout.low >= 0)
    return false;
  for (int lane = 0; lane < count; ++lane)
    if (refs[ids[lane]].kind != PrimitiveKind::line || refs[ids[lane]].cut) return false;
  return true;
}

// Draws the batch, up to the first line whose planes have to be double; returns where it stopped.
int RunPlainLines(TileContext& t, const Segment& segment, const DrawRecord& draw, const uint32_t* ids,
                  int count) {
  const DD d;
  const VertexLayout& layout = draw.vertices.layout;
  const FragmentParams& params = t.program->params;
  const QuadPlan quads(layout.attribute_count);
  LineSetup lines;
  for (int lane = 0; lane < count; ++lane) {
    const PrimitiveRef& ref = segment.primitives.data()[ids[lane]];
    lines.Copy(Head(draw.vertices, layout.stride(), ref.v[0]), Head(draw.vertices, layout.stride(), ref.v[1]),
               quads, lane, t.input);
  }
  for (int lane = count; lane < kSetupLanes; ++lane)  // for what computes with whole vectors
    for (int k = 0; k < 2; ++k) lines.x[k][lane] = lines.x[k][0], lines.y[k][lane] = lines.y[k][0];
  const int32_t center_x = t.x * kSubpixelScale + kSubpixelScale / 2;
  const int32_t center_y = t.y * kSubpixelScale + kSubpixelScale / 2;
  const VD cx = hn::Set(d, static_cast<double>(center_x)), cy = hn::Set(d, static_cast<double>(center_y));
  for (int i = 0; i < count; i += kDoubleLanes) {
    CornerVectors v;
    LineSetup::Spread(quads, layout.attribute_count, i, t.input, v);
    if (HWY_UNLIKELY(params.one_lambda)) StorePlaces(v, i, t.input);
    SetAnchor(v, i, cx, cy, t.setup);
    SetPlanes(t.input, layout, params, v, i, t.setup);
  }
  if (t.flat_color || params.one_lambda)
    FinishLanes(segment, draw, ids, count, center_x, center_y, t.input, t.setup);
  int packed = 0;
  while (packed < count && Packs(t, packed)) ++packed;
  LinePieces pieces;
  pieces.Find(lines, packed, t.x, t.y, t.limit);
  for (int i = 0; i < pieces.count; ++i) PackPiece(t, pieces.piece[i]);
  return packed;
}

// Which pixels those are, for the tests.
void ListLine(const LineEnds& ends, int tile_x, int tile_y, const Rect& bounds, PixelList& out) {
  out.count = 0;
  const Rect cut = intersect(bounds, {tile_x, tile_y, tile_x + kTileSize, tile_y + kTileSize});
  if (cut.empty()) return;
  LineSetup lines;
  for (int lane = 0; lane < kSetupLanes; ++lane) {
    lines.x[0][lane] = ends.x0, lines.y[0][lane] = ends.y0;
    lines.x[1][lane] = ends.x1, lines.y[1][lane] = ends.y1;
  }
  LinePieces pieces;
  pieces.Find(lines, 1, tile_x, tile_y, {cut.x0 - tile_x, cut.y0 - tile_y, cut.x1 - tile_x, cut.y1 - tile_y});
  for (int i = 0; i < pieces.count; ++i) {
    for (int j = 0; j < pieces.piece[i].count; ++j, ++out.count) {
      out.x[out.count] = static_cast<uint8_t>(pieces.piece[i].x[j]);
      out.y[out.count] = static_cast<uint8_t>(pieces.piece[i].y[j]);
    }
  }
}
