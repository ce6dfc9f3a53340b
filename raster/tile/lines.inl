// Lines of one pixel's width that are set up (line_setup.inl). Where a kernel takes a line's packet to
// memory, it does; else its fragments, a vector of columns at a time, wait with those of small triangles.
// Compiled once per ISA level.

// A pixel a lane.
using DLf = hn::CappedTag<float, 16>;
using DLi = hn::RebindToSigned<DLf>;
inline constexpr int kPixelLanes = static_cast<int>(hn::MaxLanes(DLi()));

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
HWY_NOINLINE void TestAndPackPiece(TileContext& t, const LinePiece<DLf>& piece, int count, unsigned variant) {
  const DIq d;
  alignas(64) int32_t px[kPixelLanes], py[kPixelLanes];
  hn::Store(hn::And(piece.x, hn::Set(DLi(), kTileSize - 1)), DLi(), px);
  hn::Store(hn::And(piece.y, hn::Set(DLi(), kTileSize - 1)), DLi(), py);
  const int last = count - 1;
  uint32_t* depth = PreparePacking(t, variant, count, RectBlocks(px[0], py[0], px[last], py[last]));
  for (int i = 0; i < count; i += kQueueLanes) {
    const auto taken = hn::Lt(hn::Iota(d, 0), hn::Set(d, count - i));
    const auto x = hn::IfThenElse(taken, hn::Load(d, px + i), hn::Set(d, px[i]));
    const auto y = hn::IfThenElse(taken, hn::Load(d, py + i), hn::Set(d, py[i]));
    t.packer.AppendGroup(t.setup, 0, x, y, count - i, *t.program, t.plane_count, depth);
  }
}

// Lets what waits be shaded as soon as that fills whole vectors; the rest stays.
HWY_NOINLINE void ShadeWholeQueue(TileContext& t) {
  const DLf f;
  const DLi d;
  PixelQueue& queue = t.packer.queue;
  const int rest = queue.count - PixelQueue::kCapacity;
  queue.count = PixelQueue::kCapacity;
  ShadePacked(t);
  queue.count = rest;
  for (int i = 0; i < rest; i += kPixelLanes) {
    for (int p = 1; p < t.plane_count; ++p)
      hn::Store(hn::Load(f, queue.plane[p] + PixelQueue::kCapacity + i), f, queue.plane[p] + i);
    hn::Store(hn::Load(d, queue.offset + PixelQueue::kCapacity + i), d, queue.offset + i);
  }
}

// Puts a line's fragments into the queue, behind the first `count` of it.
HWY_INLINE void QueuePiece(const LinePacket& line, const LinePiece<DLf>& piece, int plane_count,
                           const uint32_t* color, int count, PixelQueue& queue) {
  const DLf f;
  const auto dx = piece.FromAnchorX(line), dy = piece.FromAnchorY(line);
  const int first = LinePacket::first_plane(line.variant());
  const auto store = [&](int p) HWY_ATTR {
    const float* plane = line.planes() + 3 * (p - first);
    const auto row = hn::Add(hn::Set(f, plane[0]), hn::Mul(hn::Set(f, plane[1]), dy));
    hn::StoreU(hn::Add(row, hn::Mul(hn::Set(f, plane[2]), dx)), f, queue.plane[p] + count);
  };
  if (HWY_LIKELY(first == 2 && plane_count == 6)) {  // a colour: without a loop
    for (int p = 2; p < 6; ++p) store(p);
  } else {
    for (int p = first; p < plane_count; ++p) store(p);
  }
  hn::StoreU(piece.Offset(), DLi(), queue.offset + count);
  AskForPixels<kPixelLanes>(color, queue.offset + count);
}

// The planes of a line as lane 0 of a batch has them.
void UnpackPlanes(const LinePacket& line, const float* planes, int plane_count, int tile_x, int tile_y,
                  SetupBatch& s) {
  double depth[3];
  memcpy(depth, &line + 1, sizeof depth);
  s.f0[0][0] = depth[0], s.dfdy[0][0] = depth[1], s.dfdx[0][0] = depth[2];
  s.anchor_x[0] = static_cast<double>(line.anchor_x) + tile_x,
  s.anchor_y[0] = static_cast<double>(line.anchor_y) + tile_y;
  for (int p = LinePacket::first_plane(line.variant()); p < plane_count; ++p, planes += 3)
    s.f0_f[p][0] = planes[0], s.dfdy_f[p][0] = planes[1], s.dfdx_f[p][0] = planes[2];
}

// Lines of a program that has a kernel for them.
void DrawLines(TileContext& t, const std::byte* from, const std::byte* end) {
  FlushPacked(t);
  BlockContext& c = t.block;
  c.color = t.framebuffer->color_tile<uint32_t>(t.tile, t.program->plane);
  c.line_fragments = 0;
  c.lines_end = end;
  for (c.lines = from; c.lines < end;) t.program->lines[LineAt(c.lines).variant()](c);
  t.statistics->fragments += c.line_fragments;
}

// Lines of others, without a depth test.
void StreamLines(TileContext& t, const std::byte* from, const std::byte* end) {
  PixelQueue& queue = t.packer.queue;
  const uint32_t* color = t.framebuffer->color_tile<uint32_t>(t.tile, t.program->plane);
  const int plane_count = t.plane_count;
  int count = queue.count;  // in a register: stores of planes might be to the queue's
  uint64_t fragments = 0;
  for (; from < end; from += LineAt(from).bytes()) {
    const LinePacket& line = LineAt(from);
    const unsigned variant = line.variant();
    if (HWY_UNLIKELY(t.packer.variant != variant)) {
      queue.count = count;
      FlushPacked(t);
      count = 0;
      t.packer.variant = variant;
    }
    const int columns = line.count();
    fragments += static_cast<uint64_t>(columns);
    for (int column = 0; column < columns; column += kPixelLanes) {
      QueuePiece(line, LinePiece<DLf>(line, column), plane_count, color, count, queue);
      count += columns - column < kPixelLanes ? columns - column : kPixelLanes;
      if (count < PixelQueue::kCapacity) continue;
      queue.count = count;
      ShadeWholeQueue(t);
      count = queue.count;
    }
  }
  queue.count = count;
  t.statistics->fragments += fragments;
}

// With one.
void TestLines(TileContext& t, const std::byte* from, const std::byte* end) {
  for (; from < end; from += LineAt(from).bytes()) {
    const LinePacket& line = LineAt(from);
    UnpackPlanes(line, reinterpret_cast<const float*>(&line + 1) + 6, t.plane_count, t.x, t.y, t.setup);
    for (int column = 0; column < line.count(); column += kPixelLanes) {
      const int left = line.count() - column, count = left < kPixelLanes ? left : kPixelLanes;
      TestAndPackPiece(t, LinePiece<DLf>(line, column), count, line.variant());
    }
  }
}

// Blocks of the tile that lines may have fragments in.
uint64_t LineBlocks(const std::byte* from, const std::byte* end) {
  uint64_t blocks = 0;
  for (; from < end; from += LineAt(from).bytes()) {
    const LinePacket& line = LineAt(from);
    const int last = line.count() - 1;
    const int u0 = line.first % kTileSize, v0 = line.row(0) % kTileSize;
    const int u1 = u0 + last, v1 = line.row(last) % kTileSize;
    blocks |= line.steep() ? RectBlocks(v0, u0, v1, u1) : RectBlocks(u0, v0, u1, v1);
  }
  return blocks;
}

inline constexpr int kManyLines = 12;

// Packets from `from` on, up to `end`.
void RunLinePackets(TileContext& t, const std::byte* from, const std::byte* end) {
  if (from == end) return;
  if (t.program->reads_depth) return TestLines(t, from, end);
  if (t.state->color[t.program->plane].is_clear != 0) {
    // Many lines reach most of a tile, and to see where they lie would take longer than to store the rest.
    const bool many = end - from >= kManyLines * static_cast<ptrdiff_t>(LineAt(from).bytes());
    PrepareWindow(t, many ? ~uint64_t{0} : LineBlocks(from, end));
  }
  if (t.program->lines[0] != nullptr && t.block.meter == nullptr) return DrawLines(t, from, end);
  StreamLines(t, from, end);
  t.packer.blocks = ~uint64_t{0};  // at the end, since whatever shades the queue on the way clears it
}

HWY_INLINE bool IsLineRun(const Segment& segment, uint32_t id) {
  return segment.primitives.data()[id].kind == PrimitiveKind::line_run;
}

void RunLines(TileContext& t, const Segment& segment, uint32_t id) {
  const PacketRun& run = segment.packets.runs.data()[segment.primitives.data()[id].v[0]];
  RunLinePackets(t, run.packets, run.packets + run.bytes);
}

// Whether the batch is of lines that may be packets.
HWY_INLINE bool ArePlainLines(const TileContext& t, const Segment& segment, const DrawRecord& draw,
                              const uint32_t* ids, int count) {
  const PrimitiveRef* refs = segment.primitives.data();
  if (refs[ids[0]].kind != PrimitiveKind::line || t.notes != nullptr || !lines_wait(draw)) return false;
  for (int lane = 0; lane < count; ++lane)
    if (refs[ids[lane]].kind != PrimitiveKind::line || refs[ids[lane]].cut) return false;
  return true;
}

HWY_INLINE std::byte* WritePartOfTile(const LineGroup& group, int lane, int x, int y, std::byte* to) {
  for (const LineGroup::Part& part : group.parts)
    if (part.count[lane] > 0 && part.x[lane] == x && part.y[lane] == y) return group.write(lane, part, to);
  return to;
}

// Lines that were not set up for all their tiles: edges of polygons, and those of small draws. Draws the
// batch, up to the first line whose planes have to be double; returns where it stopped. The last vertex of
// each gives its flat colour.
int RunPlainLines(TileContext& t, const DrawRecord& draw, const BatchRefs& refs, int count) {
  LineGroup group;
  MakeLines(draw, LineRecords{{refs.at}}, count, group);
  alignas(64) std::byte packets[kSetupLanes * kMostLineBytes];
  std::byte* end = packets;
  int lane = 0;
  const Rect window{t.x + t.limit.x0, t.y + t.limit.y0, t.x + t.limit.x1, t.y + t.limit.y1};
  for (; lane < count && !group.needs_double(lane); ++lane) {
    if (!group.is_drawn(lane)) continue;
    if (group.whole[lane] != 0) end = group.write_within(lane, window, end);
    else end = WritePartOfTile(group, lane, t.x / kTileSize, t.y / kTileSize, end);
  }
  RunLinePackets(t, packets, end);
  return lane;
}

// Which pixels those are, for the tests.
void ListLine(const LineEnds& ends, int tile_x, int tile_y, const Rect& bounds, PixelList& out) {
  out.count = 0;
  const Rect cut = intersect(bounds, {tile_x, tile_y, tile_x + kTileSize, tile_y + kTileSize});
  if (cut.empty()) return;
  const DDi d;
  const LineColumns columns(
      LineEndVectors{{hn::Set(d, ends.x0), hn::Set(d, ends.x1)}, {hn::Set(d, ends.y0), hn::Set(d, ends.y1)}});
  const int count = hn::GetLane(columns.count), first = hn::GetLane(columns.first);
  const bool steep = hn::GetLane(columns.steep) != 0;
  LinePacket line{hn::GetLane(columns.place), hn::GetLane(columns.step), 0, 0, first,
                  static_cast<uint32_t>(count) | (steep ? LinePacket::kSteep : 0)};
  if (count < 1 || !line.cut_to({cut, steep})) return;
  for (int column = 0; column < line.count(); column += kPixelLanes) {
    const LinePiece<DLf> piece(line, column);
    alignas(64) int32_t px[kPixelLanes], py[kPixelLanes];
    hn::Store(piece.x, DLi(), px);
    hn::Store(piece.y, DLi(), py);
    for (int j = 0; j < kPixelLanes && column + j < line.count(); ++j, ++out.count) {
      out.x[out.count] = static_cast<uint8_t>(px[j] - tile_x);
      out.y[out.count] = static_cast<uint8_t>(py[j] - tile_y);
    }
  }
}
