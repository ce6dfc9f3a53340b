// Points of one pixel from client memory to their tiles' packets at once: no record of a vertex is made.
// Positions, depths and colours are what the vertex stage would have stored. Compiled once an ISA level.

struct alignas(64) PointGroup {
  float position[4][kGroup];
  int32_t tile[kGroup];  // less than 0: not seen
  int32_t offset[kGroup], depth[kGroup];
  uint32_t pixel[kGroup];
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

template <class Packet>
HWY_INLINE Packet* next_packet(const PointJob& points, int32_t tile) {
  PacketBin& bin = points.bins[tile];
  if (HWY_UNLIKELY(bin.next == bin.limit)) points.open_run(points.owner, uint32_t(tile));
  auto* packet = reinterpret_cast<Packet*>(bin.next);
  bin.next += sizeof *packet;
  __builtin_prefetch(bin.next + 64, 1);  // many other tiles' come between
  return packet;
}

// Vertices' own colours as fragments' stages round them to pixels: times 255 and to the nearest byte.
HWY_INLINE void round_pixels(const ShadeJob& job, uint32_t first, uint32_t count, uint32_t* pixel) {
  if (job.color.bytes) {  // which come out as they went in
    const unsigned char* from = job.color.data + size_t{first} * job.color.stride;
    for (uint32_t i = 0; i < count; ++i, from += job.color.stride) memcpy(pixel + i, from, sizeof *pixel);
    return;
  }
  const ColorReader colors(job, first, count);
#if HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  const __m128 one = _mm_set1_ps(1.0f), scale = _mm_set1_ps(255.0f), half = _mm_set1_ps(0.5f);
  const auto channels = [&](uint32_t i) HWY_ATTR {
    // Not a number stays so, and is converted to the least integer; packing then takes all below 0 to 0.
    const __m128 v = _mm_min_ps(one, colors.quads.get(i < count ? i : 0).raw);
    return _mm_cvttps_epi32(_mm_add_ps(_mm_mul_ps(v, scale), half));
  };
  for (uint32_t i = 0; i < count; i += 4) {
    const __m128i low = _mm_packs_epi32(channels(i), channels(i + 1));
    const __m128i high = _mm_packs_epi32(channels(i + 2), channels(i + 3));
    _mm_store_si128(reinterpret_cast<__m128i*>(pixel + i), _mm_packus_epi16(low, high));
  }
#else
  for (uint32_t i = 0; i < count; ++i) {
    float rgba[4];
    colors.Copy(i, rgba);
    pixel[i] = 0;
    for (int k = 0; k < 4; ++k) pixel[i] |= uint32_t(rgba[k] * 255.0f + 0.5f) << (8 * k);
  }
#endif
}

HWY_INLINE void bin_points(const ShadeJob& job, const PointJob& points, const PointGroup& g, uint32_t first,
                           uint32_t count) {
  const ColorReader colors(job, first, count);
  for (uint32_t i = 0; i < count; ++i) {
    if (g.tile[i] < 0) continue;
    auto* packet = next_packet<PointPacket>(points, g.tile[i]);
    packet->offset = g.offset[i];
    packet->depth = g.depth[i];
    if (job.color_offset >= 0) colors.Copy(i, packet->color);
  }
}

template <bool kTested>
HWY_INLINE void bin_pixels(const PointJob& points, const PointGroup& g, uint32_t count) {
  using Packet = std::conditional_t<kTested, TestedPixelPoint, PixelPoint>;
  for (uint32_t i = 0; i < count; ++i) {
    if (g.tile[i] < 0) continue;
    auto* packet = next_packet<Packet>(points, g.tile[i]);
    packet->offset = g.offset[i];
    packet->pixel = g.pixel[i];
    if constexpr (kTested) packet->depth = g.depth[i];
  }
}

void place_points(const ShadeJob& job, const PointJob& points, uint32_t first, uint32_t count) {
  PointGroup group;
  memset(group.depth, 0, sizeof group.depth);
  for (uint32_t& pixel : group.pixel) pixel = points.constant_pixel;
  while (count > 0) {
    const uint32_t n = count < kGroup ? count : kGroup;
    load_columns(job.position, first, n, 4, kDefaults, group.position);
    for (uint32_t i = 0; i < n; i += uint32_t(hn::Lanes(Doubles()))) place_lanes(job, points, group, i);
    if (points.kind != PointKind::colored && job.color_offset >= 0) round_pixels(job, first, n, group.pixel);
    if (points.kind == PointKind::colored) bin_points(job, points, group, first, n);
    else if (points.kind == PointKind::pixel) bin_pixels<false>(points, group, n);
    else bin_pixels<true>(points, group, n);
    first += n;
    count -= n;
  }
}
