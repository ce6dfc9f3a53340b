#include "raster/batch.h"

#include <algorithm>

#include "raster/surface/clear.h"

namespace halfspace::raster {
namespace {

constexpr size_t kMaxBytes = size_t{1} << 18;  // shaded vertices
constexpr size_t kMaxPrimitives = size_t{1} << 13;
// A draw brings some five kilobytes, of its state for the most part: more draws than these are not in the
// cache any more when their tiles are drawn. Measured best of 32 to 512, and 1.3 times as fast as thousands.
constexpr size_t kMaxDraws = 128;
constexpr size_t kProgramsLookedAt = 32;  // the last ones; to make one is as fast as to look at some more
constexpr size_t kMaxTextureBytes = size_t{128} << 20;  // of several textures; a single one may be larger

bool same_layout(const VertexLayout& a, const VertexLayout& b) {
  return a.attribute_count == b.attribute_count && a.color == b.color && a.tex_coord == b.tex_coord &&
         a.projective == b.projective && a.fog == b.fog && a.back_color == b.back_color &&
         a.coverage == b.coverage && a.constant_color == b.constant_color && a.given_color == b.given_color &&
         a.given_depth == b.given_depth;
}

// Neighbours along both axes belong to different workers, so that a drawing in one corner is everybody's; a
// tile is always the same worker's, in whose cache it may still be.
uint32_t owner(uint32_t tile, int tiles_x, uint32_t workers) {
  const auto row = static_cast<uint32_t>(tiles_x);
  return (tile % row + tile / row) % workers;
}

}  // namespace

Segment& Batch::new_segment(const Framebuffer::Impl& target) {
  if (pending_.size() == all_segments_.size()) all_segments_.push_back(std::make_unique<Segment>());
  Segment& segment = *all_segments_[pending_.size()];
  segment.reset(target.tiles_x, target.tiles_y);
  pending_.push_back(&segment);
  last_is_open_ = false;
  return segment;
}

Segment& Batch::open_segment(const Framebuffer::Impl& target) {
  if (!pending_.empty() && last_is_open_) return *pending_.back();
  Segment& segment = new_segment(target);
  last_is_open_ = true;
  return segment;
}

void Batch::note_texture(const TextureView& view) {
  const TextureLevel* base = view.levels[0].get();
  if (std::find(textures_.begin(), textures_.end(), base) != textures_.end()) return;
  textures_.push_back(base);
  texture_bytes_ += view.bytes();
}

const PipelineProgram& Batch::program_for(const std::shared_ptr<const DrawState>& state,
                                          const VertexLayout& layout, ColorFormat format, bool fuse) {
  const TextureView* view = state->texture.view.get();
  const size_t first = views_.size() < kProgramsLookedAt ? 0 : views_.size() - kProgramsLookedAt;
  for (size_t i = views_.size(); i-- > first;) {
    if (views_[i] != view) continue;
    const Entry& entry = programs_[i];
    const bool same_state = entry.state == state || have_same_program(*entry.state, *state);
    if (same_state && entry.format == format && same_layout(entry.layout, layout)) return entry.program;
  }
  Entry& entry = programs_.emplace_back();
  build_program(*state, layout, format, fuse, codes_, entry.program);
  entry.state = state;
  entry.layout = layout;
  entry.format = format;
  views_.push_back(view);
  if (view != nullptr) note_texture(*view);
  return entry.program;
}

bool Batch::is_covered_by(const ClearCommand& command, const Framebuffer::Impl& target) const {
  return command.color && command.depth && (targets_ & ~command.color_targets) == 0 &&
         (command.stencil || !stencil_) && clears_everything(target, command);
}

bool Batch::is_full(uint32_t scale) const {
  size_t primitives = 0;
  for (const Segment* segment : pending_) primitives += segment->primitives.size();
  const bool many_texels = textures_.size() > 1 && texture_bytes_ > kMaxTextureBytes;
  return arena.bytes_in_use() > kMaxBytes * scale || many_texels || primitives > kMaxPrimitives * scale ||
         draws.size() >= kMaxDraws;
}

void Batch::deal_tiles(const Framebuffer::Impl& target, bool all, int workers) {
  tiles.clear();
  if (all) {
    tiles.resize(target.tiles.size());
    for (uint32_t i = 0; i < tiles.size(); ++i) tiles[i] = i;
  } else {
    for (const Segment* segment : pending_)
      tiles.insert(tiles.end(), segment->touched.begin(), segment->touched.end());
  }
  const auto count = static_cast<uint32_t>(workers);
  const auto key = [&](uint32_t tile) { return uint64_t{owner(tile, target.tiles_x, count)} << 32 | tile; };
  if (!all || count > 1)
    std::sort(tiles.begin(), tiles.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
  tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
  ends.assign(count, 0);
  for (const uint32_t tile : tiles) ++ends[owner(tile, target.tiles_x, count)];
  for (uint32_t worker = 1; worker < count; ++worker) ends[worker] += ends[worker - 1];
}

void Batch::count_into(DeviceStatistics& statistics) const {
  for (const Segment* segment : pending_) {
    statistics.triangles += segment->triangles_in;
    statistics.culled += segment->culled;
    statistics.clipped += segment->clipped;
  }
}

void Batch::discard() {
  pending_.clear();
  targets_ = 0;
  stencil_ = false;
  last_is_open_ = false;
  draws.clear();
  images.clear();
  programs_.clear();
  views_.clear();
  textures_.clear();
  texture_bytes_ = 0;
  arena.reset();
}

}  // namespace halfspace::raster
