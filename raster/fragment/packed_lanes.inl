// Kernels on fragments that waited in a queue (PixelQueue): all of it in one call, so that what a kernel works out ahead
// serves it all. Included by kernels.cpp, whose stages and slots these are.

// Texels of a level that the caches next to a core hold anyway.
inline constexpr int64_t kCachedTexels = 1 << 16;

// Asks for the texels of the first `count` offsets' bilinear lookups: of every fourth, since fragments side by side share
// lines of the cache. They are of triangles that may lie anywhere, and the next kernel comes to them when all of the queue
// has been asked for.
HWY_INLINE void AskForTexels(const BlockContext& c, int count) {
  const LevelRef& level = c.params->levels[0];
  if (HWY_LIKELY(int64_t{level.width_i} * level.height_i <= kCachedTexels)) return;
  const LaneOffsets offsets(c.slot[kOffset]);
  for (int i = 0; i < count; i += 4) {
    const uint32_t* texel = level.texels + offsets[i];
    __builtin_prefetch(texel);
    __builtin_prefetch(texel + level.pitch);
  }
}

// Stages that kill have no part in it. In the last group lanes beyond the queue's end are worked on, too, but not stored.
template <StageId... ids>
void RunPacked(BlockContext& c) {
  static_assert(MemoryIsFilled<ids...>() && !(BodyOf<ids>::Type::kKills || ...));
  static_assert(PixelQueue::kCapacity <= kRowBlocks * kBlockPixels);  // slots
  using L = PackedLanes;
  const OnceAll<L, ids...> once(c);
  const int count = c.queue->count;
  int done = 0;
  if constexpr (sizeof...(ids) == 1 && (RunsBlocks<typename BodyOf<ids>::Type> && ...)) {
    while (done + kBlockPixels <= count && (RunWholeBlock<L, ids>(c, once, done) && ...)) done += kBlockPixels;
  }
  for (int i = done; i < count; i += kLanes) {
    Lanes v;
    v.live = MaskFromBits(kGroupBits);
    LoadSlots<TakenSlots<ids...>()>(c, i, v);
    (Step<L, L, ids>(c, once, i, v) && ...);
    StoreSlots<LeftSlots<ids...>()>(v, i, c);
  }
  if constexpr ((LeftSlots<ids...>() & kPlace) != 0) AskForTexels(c, count);
}
