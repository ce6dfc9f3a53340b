#include "raster/batch.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "raster/cache_distance.h"
#include "raster/surface/clear.h"
#include "raster/tile/tile_worker.h"

namespace halfspace::raster {
namespace {

constexpr size_t kMaxBytes = size_t{1} << 18;  // shaded vertices
constexpr size_t kMaxPrimitives = size_t{1} << 13;
constexpr size_t kMaxPacketBytes = size_t{3} << 17;  // of points and lines, which wait in bins as packets
// Limits are so many times as large where what is pending lies scattered: less than kDensePrimitives of it in each of its
// tiles. To visit a tile again costs more then than vertices that have left the cache: 1.2 times as fast with triangles
// of 100 pixels, 1.1 with 65. Lines and points have too few pixels for that. Nothing is gained while primitives go on to
// other tiles, as a mesh's do row by row: the batch ends when it has half as many tiles again as at the limits.
constexpr uint32_t kScatteredScale = 8;
constexpr size_t kDensePrimitives = 256;
// A small draw brings some six hundred bytes: more draws than these are not in the cache any more when their
// tiles are drawn. Measured best of 128 to 1024; with three kilobytes, before they shared states, 256 were.
constexpr size_t kMaxDraws = 512;
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
  if (workers == 1) return 0;  // without the divisions, which a frame of little else feels
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

const DrawProgram& Batch::program_for(const std::shared_ptr<const DrawState>& state,
                                      const VertexLayout& layout, ColorFormat format, bool fuse) {
  const TextureView* view = state->texture.view.get();
  const size_t first = views_.size() < kProgramsLookedAt ? 0 : views_.size() - kProgramsLookedAt;
  for (size_t i = views_.size(); i-- > first;) {
    if (views_[i] != view) continue;
    const DrawProgram& entry = programs_[i];
    const bool same_state = entry.state == state || have_same_program(*entry.state, *state);
    if (same_state && entry.format == format && same_layout(entry.layout, layout)) return entry;
  }
  DrawProgram& entry = programs_.emplace_back();
  build_program(*state, layout, format, fuse, codes_, entry.program);
  entry.state = state;
  entry.layout = layout;
  entry.format = format;
  entry.number = static_cast<uint32_t>(views_.size());
  views_.push_back(view);
  if (view != nullptr) note_texture(*view);
  return entry;
}

bool Batch::is_covered_by(const ClearCommand& command, const Framebuffer::Impl& target) const {
  return command.color && command.depth && (targets_ & ~command.color_targets) == 0 &&
         (command.stencil || !stencil_) && clears_everything(target, command);
}

bool Batch::is_full(uint32_t scale, uint32_t packet_scale) {
  size_t primitives = waiting.primitives(), packet_bytes = 0, touched = 0, widest = 0;
  for (const Segment* segment : pending_) {
    primitives += segment->primitives.size();
    packet_bytes += segment->packet_bytes;
    touched += segment->touched.size();
    widest = std::max(widest, segment->touched.size());
  }
  const auto exceeds = [&](uint32_t times) {
    return arena.bytes_in_use() + waiting.bytes_in_use() > kMaxBytes * times ||
           primitives > kMaxPrimitives * times;
  };
  if (packet_bytes > kMaxPacketBytes * packet_scale) return true;
  const bool many_texels = textures_.size() > 1 && texture_bytes_ > kMaxTextureBytes;
  if (many_texels || draws.size() + waiting.size() >= kMaxDraws || exceeds(std::max(scale, kScatteredScale)))
    return true;
  if (!waiting.empty()) return exceeds(1);  // another thread may begin with them
  if (!exceeds(scale)) return false;
  if (tiles_at_limit_ == 0) tiles_at_limit_ = widest;
  const bool spreads = widest > tiles_at_limit_ + tiles_at_limit_ / 2;
  return primitives >= kDensePrimitives * touched || spreads || !ends_with_triangle();
}

bool Batch::ends_with_triangle() const {
  if (pending_.empty() || pending_.back()->primitives.empty()) return false;
  return pending_.back()->primitives.back().kind == PrimitiveKind::triangle;
}

void Batch::deal_tiles(const Framebuffer::Impl& target, bool all, int workers) {
  // Tiles with something to draw as bits: they come out in order and each once.
  marks_.assign((target.tiles.size() + 63) / 64, all ? ~uint64_t{0} : 0);
  if (all && target.tiles.size() % 64 != 0) marks_.back() >>= 64 - target.tiles.size() % 64;
  if (!all) {
    for (const Segment* segment : pending_)
      for (const uint32_t tile : segment->touched) marks_[tile / 64] |= uint64_t{1} << tile % 64;
  }
  const auto for_each = [this](auto&& visit) {
    for (size_t word = 0; word < marks_.size(); ++word)
      for (uint64_t left = marks_[word]; left != 0; left &= left - 1)
        visit(static_cast<uint32_t>(64 * word + static_cast<size_t>(std::countr_zero(left))));
  };
  const auto count = static_cast<uint32_t>(workers);
  ends.assign(count, 0);
  for_each([&](uint32_t tile) { ++ends[owner(tile, target.tiles_x, count)]; });
  uint32_t begin = 0;
  for (uint32_t& end : ends) begin += std::exchange(end, begin);
  tiles.resize(begin);
  for_each([&](uint32_t tile) { tiles[ends[owner(tile, target.tiles_x, count)]++] = tile; });
}

uint32_t Batch::tile_after(uint32_t i) const {
  return std::find(ends.begin(), ends.end(), i + 1) == ends.end() ? tiles[i + 1] : kNoTile;
}

void Batch::count_into(DeviceStatistics& statistics) const {
  for (const Segment* segment : pending_) {
    statistics.triangles += segment->triangles_in;
    statistics.culled += segment->culled;
    statistics.clipped += segment->clipped;
  }
}

void Batch::leave_caches() const {
  const auto leave = [](const auto& list) {
    raster::leave_caches(list.data(), list.size() * sizeof *list.data());
  };
  arena.for_each_used(raster::leave_caches);
  waiting.for_each_used(raster::leave_caches);
  for (const Segment* segment : pending_) {
    leave(segment->primitives);
    leave(segment->cut_triangles);
    leave(segment->plane_sources);
    for (const uint32_t tile : segment->touched) leave(segment->bins[tile]);
    leave(segment->packets.runs);
    segment->packets.memory().for_each_used(raster::leave_caches);
  }
}

void Batch::discard() {
  pending_.clear();
  targets_ = 0;
  stencil_ = false;
  last_is_open_ = false;
  tiles_at_limit_ = 0;
  draws.clear();
  waiting.clear();
  images.clear();
  programs_.clear();
  views_.clear();
  textures_.clear();
  texture_bytes_ = 0;
  arena.reset();
}

}  // namespace halfspace::raster
