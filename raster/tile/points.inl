// Points of one pixel, without any set-up: they wait with the fragments of small triangles. Compiled once per
// ISA level.

inline constexpr size_t kPointsAhead = 8;  // their vertices are asked for while others are drawn

// False: not such a point.
bool RunWaitingPoint(TileContext& t, const Segment& segment, const DrawRecord& draw, uint32_t id) {
  const PrimitiveRef& ref = segment.primitives.data()[id];
  if (ref.kind != PrimitiveKind::point || ref.cut) return false;
  const VertexLayout& layout = draw.vertices.layout;
  const VertexHead* head = Head(draw.vertices, layout.stride(), ref.v[0]);
  const int x = (head->x >> kSubpixelBits) - t.x, y = (head->y >> kSubpixelBits) - t.y;
  float color[4];
  if (layout.color >= 0) {
    const bool to_bytes = draw.program->params.rounds_to_bytes;
    const int place = ref.back_facing && layout.back_color >= 0 ? layout.back_color : layout.color;
    const float* from =
        Attributes(t.flat_color ? Head(draw.vertices, layout.stride(), ref.v[ref.provoking]) : head) + place;
    for (int k = 0; k < 4; ++k)
      color[k] = t.flat_color ? color_level(from[k], to_bytes)
                              : static_cast<float>(static_cast<double>(from[k]) * 255.0);
  }
  uint32_t* depth = PreparePacking(t, kAffine, 1, uint64_t{1} << (y / kBlockSize * 8 + x / kBlockSize));
  const auto z = static_cast<int32_t>(head->z * kDepthScale + 0.5);
  t.packer.AppendPoint(z, layout.color >= 0 ? color : nullptr, tile_offset(x, y), *t.program, depth);
  return true;
}

template <class Packet>
HWY_INLINE uint64_t PointBlocks(const Packet* points, uint32_t count) {
  uint64_t blocks = 0;
  for (uint32_t i = 0; i < count; ++i) blocks |= uint64_t{1} << (points[i].offset / kBlockPixels);
  return blocks;
}

// A point of a run, as RunWaitingPoint does it. The product by 255 is rounded once, as it is there, since in
// double it would be exact.
HWY_INLINE void RunPacket(TileContext& t, const PointPacket& point, bool colored) {
  float color[4];
  for (int k = 0; colored && k < 4; ++k) color[k] = point.color[k] * 255.0f;
  uint32_t* depth = PreparePacking(t, kAffine, 1, uint64_t{1} << (point.offset / kBlockPixels));
  t.packer.AppendPoint(point.depth, colored ? color : nullptr, point.offset, *t.program, depth);
}

#if HWY_TARGET != HWY_SCALAR

inline constexpr int kPointGroup = 4;

// Colours of four points, as 0..255, to the queue's columns.
HWY_INLINE void QueueColors(const PointPacket* points, int column, PixelQueue& queue) {
  const hn::CappedTag<float, kPointGroup> d;
  const auto scale = hn::Set(d, 255.0f);
  const auto a = hn::Mul(hn::LoadU(d, points[0].color), scale),
             b = hn::Mul(hn::LoadU(d, points[1].color), scale);
  const auto c = hn::Mul(hn::LoadU(d, points[2].color), scale),
             e = hn::Mul(hn::LoadU(d, points[3].color), scale);
  const auto low_ab = hn::InterleaveLower(d, a, b), low_ce = hn::InterleaveLower(d, c, e);
  const auto high_ab = hn::InterleaveUpper(d, a, b), high_ce = hn::InterleaveUpper(d, c, e);
  hn::StoreU(hn::ConcatLowerLower(d, low_ce, low_ab), d, queue.plane[column] + queue.count);
  hn::StoreU(hn::ConcatUpperUpper(d, low_ce, low_ab), d, queue.plane[column + 1] + queue.count);
  hn::StoreU(hn::ConcatLowerLower(d, high_ce, high_ab), d, queue.plane[column + 2] + queue.count);
  hn::StoreU(hn::ConcatUpperUpper(d, high_ce, high_ab), d, queue.plane[column + 3] + queue.count);
}

// Four points, of which `count` are drawn; the others are overwritten by the next.
HWY_INLINE uint64_t QueuePoints(TileContext& t, const PointPacket* points, int count, bool colored) {
  PixelQueue& queue = t.packer.queue;
  const uint32_t* color = t.framebuffer->color_tile<uint32_t>(t.tile, t.program->plane);
  uint64_t blocks = 0;
  for (int j = 0; j < kPointGroup; ++j) {
    const int32_t at = points[j].offset;
    queue.offset[queue.count + j] = at;
    blocks |= uint64_t{1} << (at / kBlockPixels);
    __builtin_prefetch(color + at, 1);
  }
  if (colored) QueueColors(points, t.program->params.color_plane, queue);
  queue.count += count;
  return blocks;
}

// Points four at a time, where no depth test has to look at them one by one.
void StreamPoints(TileContext& t, const PointPacket* points, uint32_t count, bool colored) {
  Packer& packer = t.packer;
  PixelQueue& queue = packer.queue;
  t.statistics->fragments += count;
  for (uint32_t done = 0; done < count;) {
    if (packer.variant != kAffine || queue.count + kPointGroup > PixelQueue::kCapacity) FlushPacked(t);
    packer.variant = kAffine;
    const uint32_t room =
        static_cast<uint32_t>(PixelQueue::kCapacity - queue.count) / kPointGroup * kPointGroup;
    const uint32_t end = done + room < count ? done + room : count;
    uint64_t blocks = 0;
    for (; done + kPointGroup <= end; done += kPointGroup)
      blocks |= QueuePoints(t, points + done, kPointGroup, colored);
    if (done < end) {  // the last ones
      PointPacket tail[kPointGroup];
      for (uint32_t j = 0; j < kPointGroup; ++j) tail[j] = points[done + j < end ? done + j : done];
      blocks |= QueuePoints(t, tail, static_cast<int>(end - done), colored);
      done = end;
    }
    PrepareWindow(t, blocks);
    packer.blocks |= blocks;
  }
}

#endif

void RunColoredPoints(TileContext& t, const PointPacket* points, uint32_t count, bool colored) {
#if HWY_TARGET != HWY_SCALAR
  if (!t.program->reads_depth) return StreamPoints(t, points, count, colored);
#endif
  for (uint32_t i = 0; i < count; ++i) RunPacket(t, points[i], colored);
}

// How many points ahead of the one at hand its pixel's memory is asked for.
inline constexpr uint32_t kPixelsAhead = 32;

// Points that are pixels.
void StorePixels(TileContext& t, const PixelPoint* points, uint32_t count) {
  if (t.state->color[t.program->plane].is_clear != 0) PrepareWindow(t, PointBlocks(points, count));
  auto* color = t.framebuffer->color_tile<uint32_t>(t.tile, t.program->plane);
  for (uint32_t i = 0; i < count && i < kPixelsAhead; ++i) __builtin_prefetch(color + points[i].offset, 1);
  uint32_t i = 0;
  for (; i + kPixelsAhead < count; ++i) {
    __builtin_prefetch(color + points[i + kPixelsAhead].offset, 1);
    color[points[i].offset] = points[i].pixel;
  }
  for (; i < count; ++i) color[points[i].offset] = points[i].pixel;
}

// With a depth test, whose outcome nobody could guess: all is stored, though it be what was there.
void TestPixels(TileContext& t, const TestedPixelPoint* points, uint32_t count) {
  PrepareWindow(t, PointBlocks(points, count));
  auto* color = t.framebuffer->color_tile<uint32_t>(t.tile, t.program->plane);
  uint32_t* depth = t.framebuffer->depth_tile(t.tile);
  const DepthState& test = t.program->depth;
  const auto ask = [&](uint32_t i) HWY_ATTR {
    __builtin_prefetch(color + points[i].offset, 1), __builtin_prefetch(depth + points[i].offset, 1);
  };
  for (uint32_t i = 0; i < count && i < kPixelsAhead; ++i) ask(i);
  for (uint32_t i = 0; i < count; ++i) {
    if (i + kPixelsAhead < count) ask(i + kPixelsAhead);
    const TestedPixelPoint& point = points[i];
    const uint32_t old = depth[point.offset];
    const bool pass = PassesDepthAt(test.func, point.depth, static_cast<int32_t>(old));
    depth[point.offset] = pass && test.write ? static_cast<uint32_t>(point.depth) : old;
    color[point.offset] = pass ? point.pixel : color[point.offset];
  }
}

// Those of a draw, from ids[at] on, up to the primitive `end`. Gives where it stopped.
size_t RunPoints(TileContext& t, const Segment& segment, const DrawRecord& draw, const uint32_t* ids, size_t at,
                 size_t total, uint32_t end) {
  const PointKind kind = point_kind(*draw.program);
  const PrimitiveRef* refs = segment.primitives.data();
  const PacketRun* runs = segment.packets.runs.data();
  const size_t bytes = point_bytes(kind);
  if (kind != PointKind::colored) FlushPacked(t);
  for (; at < total && ids[at] < end; ++at) {
    const PacketRun& run = runs[refs[ids[at]].v[0]];
    const auto count = static_cast<uint32_t>(run.bytes / bytes);
    if (kind == PointKind::colored) {
      RunColoredPoints(t, reinterpret_cast<const PointPacket*>(run.packets), count, draw.vertices.layout.color >= 0);
      continue;
    }
    t.statistics->fragments += count;
    if (kind == PointKind::pixel) StorePixels(t, reinterpret_cast<const PixelPoint*>(run.packets), count);
    else TestPixels(t, reinterpret_cast<const TestedPixelPoint*>(run.packets), count);
  }
  return at;
}
