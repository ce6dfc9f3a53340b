// Asks for the memory of the tile that comes next, a little at a time while this one is drawn: tiles of a picture come from
// beyond a core's own caches.
class TileAhead {
 public:
  HWY_INLINE void Expect(std::span<Segment* const> segments, Framebuffer::Impl& framebuffer, uint32_t next) {
    line_ = kLines;
    if (next == kNoTile || framebuffer.format != ColorFormat::rgba8) return;
    size_t primitives = 0;
    for (size_t i = 0; i < segments.size(); ++i) primitives += segments.data()[i]->bins.data()[next].size();
    if (primitives < kSome) return;
    few_ = primitives < kMany;
    framebuffer_ = &framebuffer;
    next_ = next;
    line_ = 0;
    const size_t each = kLines * kSetupLanes / primitives;
    some_ = few_ ? 16 : each >= 32 ? 32 : (each >= 12 ? 16 : 8);
  }

  // To be called where primitives touch this tile's memory here and there, as those will that of the next; `large`: as
  // few of them will, too.
  HWY_INLINE void AskForSome(int plane, bool depth, bool large = false) {
    if (line_ >= kLines || (few_ && !large)) return;
    const char* colors = framebuffer_->color_tile<char>(next_, plane) + line_ * 64;
    for (int i = 0; i < some_; ++i) __builtin_prefetch(colors + i * 64, 1, 2);
    if (depth) {
      const char* depths = reinterpret_cast<const char*>(framebuffer_->depth_tile(next_)) + line_ * 64;
      for (int i = 0; i < some_; ++i) __builtin_prefetch(depths + i * 64, 1, 2);
    }
    line_ += some_;
  }

 private:
  static constexpr int kLines = kTilePixels * 4 / 64;  // of a plane
  static constexpr size_t kMany = 24;  // primitives; fewer small ones leave most of a tile alone
  static constexpr size_t kSome = 2;   // one that is large covers blocks all over, and nothing waits for memory
  Framebuffer::Impl* framebuffer_;
  uint32_t next_;
  bool few_;
  int line_;
  int some_;  // lines at a time: as few as it takes, for many would wait for each other. A part of kLines
};
