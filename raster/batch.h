// Draws that were taken up and binned, on their way to the tiles.
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "raster/api/device.h"
#include "raster/arena.h"
#include "raster/fragment/program.h"
#include "raster/primitive/pixel_rect.h"
#include "raster/primitive/segment.h"
#include "raster/recycled.h"
#include "raster/waiting_draws.h"

namespace halfspace::raster {

// A program and what it was made for.
struct DrawProgram {
  std::shared_ptr<const DrawState> state;  // of the first draw that took it
  VertexLayout layout;
  ColorFormat format{};
  uint32_t number = 0;  // among those of the batch
  PipelineProgram program;

  // What a draw with a state of its own goes by once its vertices are shaded. Where the two differ in their
  // matrices only it is this one: nobody keeps the other, and so one after the other can be made in one
  // place, which stays in the cache.
  const std::shared_ptr<const DrawState>& state_after_vertices(
      const std::shared_ptr<const DrawState>& own) const {
    return own->rest_version != 0 && own->rest_version == state->rest_version ? state : own;
  }
};

// With several threads a device has two: the tiles of one are drawn while the next is filled. What a batch
// holds is kept for the draws to come.
class Batch {
 public:
  // An empty segment at the end; one that takes further small draws; all of them, in order.
  Segment& new_segment(const Framebuffer::Impl& target);
  Segment& open_segment(const Framebuffer::Impl& target);
  const std::vector<Segment*>& segments() const { return pending_; }
  // What draws of this state and layout go through; draws that differ in their vertices only share it.
  const DrawProgram& program_for(const std::shared_ptr<const DrawState>& state, const VertexLayout& layout,
                                 ColorFormat format, bool fuse);
  // Notes what a draw put into this batch may change.
  void add_targets(uint8_t color_targets, bool stencil) {
    targets_ |= color_targets;
    stencil_ |= stencil;
  }
  // True if nothing of it would be seen after the clear.
  bool is_covered_by(const ClearCommand& command, const Framebuffer::Impl& target) const;
  bool empty() const { return pending_.empty() && waiting.empty(); }
  // Before another draw goes to the segments, and before tiles are dealt.
  void take_up_waiting(const Framebuffer::Impl& target) {
    if (!waiting.empty()) waiting.take_up(target, open_segment(target), arena);
  }
  // Enough to be executed: memory stays bounded whatever a frame draws. `scale`: of the limits, but
  // `packet_scale` of that of points and lines.
  bool is_full(uint32_t scale, uint32_t packet_scale);
  // Tiles with something to draw, or all of them, as tasks for `workers`: ends[w] ends the stretch of worker
  // w, which is dealt the same tiles each time.
  void deal_tiles(const Framebuffer::Impl& target, bool all, int workers);
  // The tile of task i + 1, if the same worker is dealt that, else kNoTile.
  uint32_t tile_after(uint32_t i) const;
  void count_into(DeviceStatistics& statistics) const;
  // For who fills it anew, when other threads have read it (CacheDistance).
  void leave_caches() const;
  void discard();

  Recycled<DrawRecord> draws;
  std::deque<PixelImage> images;
  WaitingDraws waiting;
  Arena arena;
  std::vector<uint32_t> tiles, ends;

 private:
  void note_texture(const TextureView& view);
  bool ends_with_triangle() const;

  std::vector<std::unique_ptr<Segment>> all_segments_;
  std::vector<Segment*> pending_;
  bool last_is_open_ = false;
  size_t tiles_at_limit_ = 0;  // of the segment with most tiles, when the limits were passed
  std::vector<uint64_t> marks_;  // of tiles, while they are dealt
  uint8_t targets_ = 0;          // colour planes drawn to
  bool stencil_ = false;         // whether the stencil plane may be written
  Recycled<DrawProgram> programs_;
  std::vector<const TextureView*> views_;  // of the programs, in their order: most look-ups end here
  CodeCache codes_;
  // Textures that draws hold on to, by level 0; the program that replaced or deleted one cannot free it.
  std::vector<const TextureLevel*> textures_;
  size_t texture_bytes_ = 0;
};

}  // namespace halfspace::raster
