// Points of one pixel from client memory to their tiles' packets at once: no record of a vertex is made.
// Positions, depths and colours are what the vertex stage would have stored. Compiled once an ISA level.

struct alignas(64) PointGroup {
  float position[4][kGroup];
  int32_t tile[kGroup];  // less than 0: not seen
  int32_t offset[kGroup], depth[kGroup];
};

HWY_INLINE hn::Vec<hn::Rebind<int32_t, Doubles>> lanes_of(Mask mask) {
  const hn::Rebind<uint32_t, Doubles> half;
  const auto words = hn::BitCast(Words(), hn::VecFromMask(Doubles(), mask));
  return hn::BitCast(hn::Rebind<int32_t, Doubles>(), hn::TruncateTo(half, words));
}

HWY_INLINE void place_lanes(const ShadeJob& job, const PointJob& points, PointGroup& g, uint32_t i) {
  const Doubles d;
  const hn::Rebind<int32_t, Doubles> di;
  const ClipVec c = clip_position(job, g.position, i);
  Mask seen = surely_inside(c);
  if (HWY_UNLIKELY(!job.window.inside_guard || !hn::AllTrue(d, seen)))
    seen = hn::RebindMask(d, hn::Eq(hn::BitCast(Words(), outcodes(c, job.window)), hn::Zero(Words())));
  const DividedVec place(c, seen);
  const auto x =
      hn::ShiftRight<kSubpixelBits>(to_fixed(place.x, seen, job.window.scale_x, job.window.offset_x).value);
  const auto y =
      hn::ShiftRight<kSubpixelBits>(to_fixed(place.y, seen, job.window.scale_y, job.window.offset_y).value);
  const auto beyond = hn::Or(
      hn::Or(hn::Lt(x, hn::Set(di, points.bounds.x0)), hn::Lt(y, hn::Set(di, points.bounds.y0))),
      hn::Not(hn::And(hn::Lt(x, hn::Set(di, points.bounds.x1)), hn::Lt(y, hn::Set(di, points.bounds.y1)))));
  const auto tile = hn::Add(hn::Mul(hn::ShiftRight<6>(y), hn::Set(di, points.tiles_x)), hn::ShiftRight<6>(x));
  const auto hidden = hn::Or(hn::Not(lanes_of(seen)), hn::VecFromMask(di, beyond));
  hn::Store(hn::Or(tile, hidden), di, g.tile + i);
  // As tile_offset() has it.
  const auto bits = [&](hn::Vec<hn::Rebind<int32_t, Doubles>> v, int which)
                        HWY_ATTR { return hn::And(v, hn::Set(di, which)); };
  const auto block = hn::Add(hn::ShiftLeft<6>(bits(y, 56)), hn::ShiftLeft<3>(bits(x, 56)));
  hn::Store(hn::Add(block, hn::Add(hn::ShiftLeft<3>(bits(y, 7)), bits(x, 7))), di, g.offset + i);
  if (points.depth_steps == 0) return;
  const Vec steps =
      hn::Mul(hn::IfThenElseZero(seen, window_depth(place.z, job.window)), hn::Set(d, points.depth_steps));
  hn::Store(hn::DemoteTo(di, hn::Add(steps, hn::Set(d, 0.5))), di, g.depth + i);
}

HWY_INLINE PointPacket* next_packet(const PointJob& points, int32_t tile) {
  PacketBin& bin = points.bins[tile];
  if (HWY_UNLIKELY(bin.next == bin.limit)) points.open_run(points.owner, uint32_t(tile));
  auto* packet = reinterpret_cast<PointPacket*>(bin.next);
  bin.next += sizeof *packet;
  __builtin_prefetch(bin.next + 64, 1);  // many other tiles' come between
  return packet;
}

HWY_INLINE void bin_points(const ShadeJob& job, const PointJob& points, const PointGroup& g, uint32_t first,
                           uint32_t count) {
  const ColorReader colors(job, first, count);
  for (uint32_t i = 0; i < count; ++i) {
    if (g.tile[i] < 0) continue;
    PointPacket* packet = next_packet(points, g.tile[i]);
    packet->offset = g.offset[i];
    packet->depth = g.depth[i];
    if (job.color_offset >= 0) colors.Copy(i, packet->color);
  }
}

void place_points(const ShadeJob& job, const PointJob& points, uint32_t first, uint32_t count) {
  PointGroup group;
  memset(group.depth, 0, sizeof group.depth);
  while (count > 0) {
    const uint32_t n = count < kGroup ? count : kGroup;
    load_columns(job.position, first, n, 4, kDefaults, group.position);
    for (uint32_t i = 0; i < n; i += uint32_t(hn::Lanes(Doubles()))) place_lanes(job, points, group, i);
    bin_points(job, points, group, first, n);
    first += n;
    count -= n;
  }
}
