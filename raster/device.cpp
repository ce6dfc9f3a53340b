#include "raster/api/device.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <thread>
#include <vector>

#include "raster/arena.h"
#include "raster/fragment/program.h"
#include "raster/primitive/assembly.h"
#include "raster/primitive/pixel_rect.h"
#include "raster/primitive/shape_assembly.h"
#include "raster/primitive/window_box.h"
#include "raster/surface/accumulate.h"
#include "raster/statistics.h"
#include "raster/surface/clear.h"
#include "raster/surface/resolve.h"
#include "raster/thread_pool.h"
#include "raster/tile/tile_worker.h"
#include "raster/vertex/shade_point.h"
#include "raster/vertex/vertex_stage.h"

namespace halfspace::raster {
namespace {

// Work kept back before it is executed, so that memory stays bounded whatever a frame draws.
constexpr size_t kMaxPendingBytes = size_t{1} << 18;  // shaded vertices
constexpr size_t kMaxPendingPrimitives = size_t{1} << 13;
constexpr size_t kMaxPendingTextureBytes = size_t{128} << 20;  // of several textures; a single one may be larger
constexpr uint32_t kPartPrimitives = 4096;   // a larger draw is taken in parts
// With several threads all of these are larger: every execution is a meeting of all threads.
constexpr uint32_t kThreadedScale = 8;
constexpr uint32_t kParallelPrimitives = 2048;  // a part of fewer is not split over threads
constexpr uint32_t kVerticesPerTask = 2048;

int thread_count(const DeviceOptions& options) {
  if (options.threads > 0) return std::min(options.threads, 256);
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const char* wish = std::getenv("HALFSPACE_THREADS");
  if (wish == nullptr || *wish == '\0') return cores;
  char* end = nullptr;
  const long n = std::strtol(wish, &end, 10);
  if (*end == '\0' && n >= 1 && n <= 256) return static_cast<int>(n);
  std::fprintf(stderr, "halfspace: HALFSPACE_THREADS=%s is not a number from 1 to 256; using %d\n", wish, cores);
  return cores;
}

bool fuses(const DeviceOptions& options) {
  const char* wish = std::getenv("HALFSPACE_FUSE");
  return options.fuse && (wish == nullptr || std::strcmp(wish, "0") != 0);
}

bool wants_statistics() {
  const char* wish = std::getenv("HALFSPACE_STATS");
  return wish != nullptr && *wish != '\0' && std::strcmp(wish, "0") != 0;
}

bool same_layout(const VertexLayout& a, const VertexLayout& b) {
  return a.attribute_count == b.attribute_count && a.color == b.color && a.tex_coord == b.tex_coord &&
         a.projective == b.projective && a.fog == b.fog && a.back_color == b.back_color && a.coverage == b.coverage &&
         a.constant_color == b.constant_color && a.given_color == b.given_color && a.given_depth == b.given_depth;
}

Rect draw_window(const DrawState& state, const Framebuffer::Impl& fb) {
  const Rect whole{0, 0, fb.width, fb.height};
  return state.raster.scissor_test ? intersect(whole, state.raster.scissor) : whole;
}

Rect draw_bounds(const DrawState& state, const Framebuffer::Impl& fb) {
  const Viewport& v = state.viewport;
  return intersect(draw_window(state, fb), {v.x, v.y, v.x + v.width, v.y + v.height});
}

}  // namespace

struct Device::Impl {
  using Clock = std::chrono::steady_clock;
  explicit Impl(const DeviceOptions& options)
      : pool(thread_count(options)),
        prints(wants_statistics()),
        meters(options.meter || prints),
        fuse(fuses(options) && !meters) {}

  ThreadPool pool;
  const bool prints, meters;  // statistics of stages
  const bool fuse;
  StageMeter meter;             // since creation
  DeviceStatistics statistics_at_picture;  // what had been counted when the last picture was shown
  Framebuffer::Impl* target = nullptr;
  DeviceStatistics statistics;

  // The pass so far. Segments, and what they hold, are reused from pass to pass.
  std::vector<std::unique_ptr<Segment>> segments;
  std::vector<Segment*> pending;
  uint8_t pending_targets = 0;  // colour planes drawn to since the pass began or was last executed
  bool pending_stencil = false;  // and whether the stencil plane may have been written
  bool last_is_open = false;  // the last pending segment takes further small draws
  std::deque<DrawRecord> draws;
  std::deque<PixelImage> images;
  std::deque<PipelineProgram> programs;
  std::shared_ptr<const DrawState> program_state;
  VertexLayout program_layout;
  // Textures that pending draws hold on to, by level 0; the program that replaced or deleted one cannot free it.
  std::vector<const TextureLevel*> textures;
  size_t texture_bytes = 0;
  Arena arena;
  std::vector<uint16_t> outcodes;
  std::vector<ClipVertex> clip;
  std::vector<uint32_t> part_indices;
  std::vector<double> clip_distances;  // of the draw at hand, from the user clip planes
  std::vector<uint8_t> clip_codes;
  uint32_t stipple = 0;  // where the stipple of the last line strip stands

  Segment& new_segment();
  Segment& open_segment();
  const PipelineProgram& program_for(const std::shared_ptr<const DrawState>& state, const VertexLayout& layout);
  void note_texture(const TextureView& view);
  void shade(const DrawPacket& packet, ShadedVertices& vertices);
  uint32_t scale() const { return pool.size() > 1 ? kThreadedScale : 1; }
  void count_vertices(const DrawState& state, uint32_t count, Clock::duration time);
  void report_stages(const LinearImage* image);
  void find_clip_distances(const VertexBatch& batch, DrawRecord& record);
  void assemble_draw(DrawRecord& record, const DrawPacket& packet, uint32_t primitives);
  void need_planes(const DrawState& state, const PipelineProgram& program);
  void draw(const DrawPacket& packet);
  void draw_in_parts(const DrawPacket& packet, const VertexLayout& layout, const ShapePlan& shape);
  void draw_part(const DrawPacket& packet, const VertexLayout& layout, const ShapePlan& shape);
  void execute_if_full();
  void draw_pixels(const PixelPacket& packet);
  bool prepare_pixels(const PixelPacket& packet, const PipelineProgram& program);
  void execute(const LinearImage* image, ColorPlane plane = kBackPlane);
  void discard();
  bool covers_pending(const ClearCommand& command) const;
};

Segment& Device::Impl::new_segment() {
  if (pending.size() == segments.size()) segments.push_back(std::make_unique<Segment>());
  Segment& segment = *segments[pending.size()];
  segment.reset(target->tiles_x, target->tiles_y);
  pending.push_back(&segment);
  last_is_open = false;
  return segment;
}

Segment& Device::Impl::open_segment() {
  if (!pending.empty() && last_is_open) return *pending.back();
  Segment& segment = new_segment();
  last_is_open = true;
  return segment;
}

void Device::Impl::note_texture(const TextureView& view) {
  const TextureLevel* base = view.levels[0].get();
  if (std::find(textures.begin(), textures.end(), base) != textures.end()) return;
  textures.push_back(base);
  texture_bytes += view.bytes();
}

const PipelineProgram& Device::Impl::program_for(const std::shared_ptr<const DrawState>& state,
                                                 const VertexLayout& layout) {
  if (programs.empty() || program_state != state || !same_layout(program_layout, layout)) {
    programs.push_back(build_program(*state, layout, target->format, fuse));
    program_state = state;
    program_layout = layout;
    if (state->texture.view != nullptr) note_texture(*state->texture.view);
  }
  return programs.back();
}

void Device::Impl::shade(const DrawPacket& packet, ShadedVertices& vertices) {
  const VertexBatch& batch = packet.batch;
  vertices.count = batch.count;
  vertices.records = arena.allocate(batch.count * vertices.layout.stride());
  vertices.outcodes.swap(outcodes);
  vertices.clip.swap(clip);
  if (vertices.outcodes.size() < batch.count) {
    vertices.outcodes.resize(batch.count);
    vertices.clip.resize(batch.count);
  }
  const uint32_t tasks = (batch.count + kVerticesPerTask - 1) / kVerticesPerTask;
  const auto start = meters ? Clock::now() : Clock::time_point();
  pool.run(tasks, [&](uint32_t task, int) {
    const uint32_t first = task * kVerticesPerTask;
    shade_vertices(*packet.state, batch, packet.materials, first, std::min(kVerticesPerTask, batch.count - first),
                   vertices);
  });
  if (meters) count_vertices(*packet.state, batch.count, Clock::now() - start);
}

void Device::Impl::count_vertices(const DrawState& state, uint32_t count, Clock::duration time) {
  statistics.vertex_nanoseconds += static_cast<uint64_t>(time / std::chrono::nanoseconds(1));
  if (state.lighting.enabled) statistics.lit_vertices += count;
  if (state.tex_gen.any()) statistics.generated_vertices += count;
}

// Brings statistics.stages up to date and, where that was asked for, prints what a shown picture took.
void Device::Impl::report_stages(const LinearImage* image) {
  statistics.stages.clear();
  for (int id = 0; !stage_name(id).empty(); ++id) {
    const auto at = static_cast<size_t>(id);
    if (meter.fragments[at] != 0) statistics.stages.push_back({stage_name(id), meter.fragments[at], meter.nanoseconds[at]});
  }
  if (!prints || image == nullptr || statistics.draws == statistics_at_picture.draws) return;
  print_statistics(statistics_at_picture, statistics);
  statistics_at_picture = statistics;
}

void Device::Impl::find_clip_distances(const VertexBatch& batch, DrawRecord& record) {
  if (record.state->clip_planes.enabled == 0) return;
  clip_distances.resize(size_t{batch.count} * kMaxClipPlanes);
  clip_codes.resize(batch.count);
  raster::clip_distances(*record.state, batch, clip_distances.data(), clip_codes.data());
  record.clip_distances = clip_distances.data();
  record.clip_codes = clip_codes.data();
}

void Device::Impl::assemble_draw(DrawRecord& record, const DrawPacket& packet, uint32_t primitives) {
  // The stipple of a line starts where the one before it ended.
  if (pool.size() == 1 || primitives < kParallelPrimitives || record.shape.stippled_lines) {
    Segment& segment = open_segment();
    assemble(record, packet.primitive, packet.indices, packet.index_count, 0, primitives, segment);
    stipple = segment.stipple_end;
    return;
  }
  const auto parts = static_cast<uint32_t>(pool.size());
  const size_t first_segment = pending.size();
  for (uint32_t i = 0; i < parts; ++i) new_segment();
  const uint32_t each = (primitives + parts - 1) / parts;
  pool.run(parts, [&](uint32_t part, int) {
    const uint32_t first = std::min(part * each, primitives);
    assemble(record, packet.primitive, packet.indices, packet.index_count, first,
             std::min(each, primitives - first), *pending[first_segment + part]);
  });
}

// Asks the framebuffer for the planes that a draw works on.
void Device::Impl::need_planes(const DrawState& state, const PipelineProgram& program) {
  if (program.writes_color) {
    target->need_color(state.color_targets);
    pending_targets |= state.color_targets;
  }
  if (program.reads_depth) target->need_depth();
  if (program.reads_stencil) {
    target->need_stencil();
    pending_stencil = true;
  }
}

void Device::Impl::draw(const DrawPacket& packet) {
  if (target == nullptr || packet.batch.count == 0 || primitive_count(packet.primitive, packet.index_count) == 0) return;
  const DrawState& state = *packet.state;
  // Once for the whole draw: how it is cut into parts must not show.
  VertexLayout layout = choose_layout(state, packet.batch);
  const ShapePlan shape = plan_shapes(state, packet.primitive);
  layout.coverage = shape.coverage;
  const PipelineProgram& program = program_for(packet.state, layout);
  ++statistics.draws;
  statistics.vertices += packet.batch.count;
  const Rect reach = shape.general ? draw_window(state, *target) : draw_bounds(state, *target);
  if (program.draws_nothing || reach.empty()) return;
  need_planes(state, program);
  draw_in_parts(packet, layout, shape);
}

// Large draws of separate primitives go in parts, each with the vertices it names, so that what is pending stays small.
void Device::Impl::draw_in_parts(const DrawPacket& packet, const VertexLayout& layout, const ShapePlan& shape) {
  const uint32_t each = separate_vertices(packet.primitive);
  const uint32_t step = each * kPartPrimitives * scale();
  if (each == 0 || packet.index_count <= step) return draw_part(packet, layout, shape);
  for (uint32_t first = 0; first < packet.index_count; first += step) {
    DrawPacket part = packet;
    part.index_count = std::min(step, packet.index_count - first);
    uint32_t lowest = first, highest = first + part.index_count - 1;
    if (packet.indices != nullptr) {
      const uint32_t* indices = packet.indices + first;
      lowest = highest = indices[0];
      for (uint32_t i = 0; i < part.index_count; ++i) {  // not minmax_element: this is done in vectors
        lowest = std::min(lowest, indices[i]);
        highest = std::max(highest, indices[i]);
      }
      part_indices.resize(part.index_count);
      for (uint32_t i = 0; i < part.index_count; ++i) part_indices[i] = indices[i] - lowest;
      part.indices = part_indices.data();
    }
    part.batch = part_of(packet.batch, lowest, highest - lowest + 1);
    draw_part(part, layout, shape);
  }
}

void Device::Impl::draw_part(const DrawPacket& packet, const VertexLayout& layout, const ShapePlan& shape) {
  DrawRecord& record = draws.emplace_back();
  record.state = packet.state;
  record.bounds = draw_bounds(*packet.state, *target);
  record.window = draw_window(*packet.state, *target);
  record.program = &program_for(packet.state, layout);  // executing a full pass drops it
  record.shape = shape;
  record.edge_flags = packet.batch.edge_flag;
  record.stipple_start = packet.continues ? stipple : 0;
  record.vertices.layout = layout;
  shade(packet, record.vertices);
  find_clip_distances(packet.batch, record);
  assemble_draw(record, packet, primitive_count(packet.primitive, packet.index_count));
  // Clip coordinates and outcodes have done their work; the next draw takes their memory.
  record.vertices.outcodes.swap(outcodes);
  record.vertices.clip.swap(clip);
  record.clip_distances = nullptr, record.clip_codes = record.edge_flags = nullptr;
  execute_if_full();
}

void Device::Impl::execute_if_full() {
  size_t pending_primitives = 0;
  for (const Segment* segment : pending) pending_primitives += segment->primitives.size();
  const bool many_texels = textures.size() > 1 && texture_bytes > kMaxPendingTextureBytes;
  if (arena.bytes_in_use() > kMaxPendingBytes * scale() || many_texels || pending_primitives > kMaxPendingPrimitives * scale())
    execute(nullptr);
}

// Asks the framebuffer for what the packet draws on; false if it draws nothing.
bool Device::Impl::prepare_pixels(const PixelPacket& packet, const PipelineProgram& program) {
  if (packet.kind == PixelKind::stencil) {
    if (packet.stencil_mask == 0) return false;
    target->need_stencil();
    pending_stencil = true;
    return true;
  }
  if (program.draws_nothing) return false;
  need_planes(*packet.state, program);
  return true;
}

// A small image waits with the draws around it; a large one is drawn at once, and need not be copied.
void Device::Impl::draw_pixels(const PixelPacket& packet) {
  if (target == nullptr) return;
  const VertexLayout layout = pixel_layout(packet);
  const PipelineProgram& program = program_for(packet.state, layout);
  if (!prepare_pixels(packet, program)) return;
  const Rect limit = draw_window(*packet.state, *target);
  const bool keep = is_small(packet);
  PixelImage& image = images.emplace_back();
  if (!lay_out_pixels(packet, layout, limit, keep, arena, image)) return;
  ++statistics.draws;
  DrawRecord& record = draws.emplace_back();
  record.state = packet.state;
  record.bounds = image.bounds;
  record.program = &program;
  record.vertices.layout = layout;
  record.image = &image;
  Segment& segment = open_segment();
  segment.draws.push_back({static_cast<uint32_t>(segment.primitives.size()), &record});
  bin_box(segment, tile_box(image.bounds), static_cast<uint32_t>(segment.primitives.size()));
  segment.primitives.push_back({});
  if (keep) execute_if_full();
  else execute(nullptr);
}

void Device::Impl::discard() {
  for (const Segment* segment : pending) {
    statistics.triangles += segment->triangles_in;
    statistics.culled += segment->culled;
    statistics.clipped += segment->clipped;
  }
  pending.clear();
  pending_targets = 0;
  pending_stencil = false;
  last_is_open = false;
  draws.clear();
  images.clear();
  programs.clear();
  program_state.reset();
  textures.clear();
  texture_bytes = 0;
  arena.reset();
}

// True if nothing of the pending work would be seen after the clear.
bool Device::Impl::covers_pending(const ClearCommand& command) const {
  return command.color && command.depth && (pending_targets & ~command.color_targets) == 0 &&
         (command.stencil || !pending_stencil) && clears_everything(*target, command);
}

void Device::Impl::execute(const LinearImage* image, ColorPlane plane) {
  if (target == nullptr) return;
  std::vector<uint32_t> tiles;
  if (image != nullptr) {
    tiles.resize(target->tiles.size());
    for (uint32_t i = 0; i < tiles.size(); ++i) tiles[i] = i;
  } else {
    for (const Segment* segment : pending) tiles.insert(tiles.end(), segment->touched.begin(), segment->touched.end());
    std::sort(tiles.begin(), tiles.end());
    tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
  }
  if (!pending.empty()) ++statistics.passes;
  std::vector<TileStatistics> counts(static_cast<size_t>(pool.size()));
  std::vector<StageMeter> worker_meters(meters ? counts.size() : 0);
  pool.run(static_cast<uint32_t>(tiles.size()), [&](uint32_t i, int worker) {
    TileStatistics local;
    if (meters) local.meter = &worker_meters[static_cast<size_t>(worker)];
    if (!pending.empty()) run_tile(pending, *target, tiles[i], local);
    if (image != nullptr) resolve_tile(*target, tiles[i], plane_index(plane), *image);
    counts[static_cast<size_t>(worker)].fragments += local.fragments;
    counts[static_cast<size_t>(worker)].double_fragments += local.double_fragments;
  });
  for (const TileStatistics& count : counts) {
    statistics.fragments += count.fragments;
    statistics.double_fragments += count.double_fragments;
  }
  for (const StageMeter& counted : worker_meters) meter.add(counted);
  discard();
  if (meters) report_stages(image);
}

Device::Device(const DeviceOptions& options) : impl_(std::make_unique<Impl>(options)) {}
Device::~Device() = default;

void Device::begin_pass(Framebuffer* target) {
  Framebuffer::Impl* next = target != nullptr ? &target->impl() : nullptr;
  if (next == impl_->target) return;
  impl_->execute(nullptr);
  impl_->target = next;
}

void Device::clear(const ClearCommand& command) {
  if (impl_->target == nullptr) return;
  if (impl_->covers_pending(command)) impl_->discard();
  else impl_->execute(nullptr);
  raster::clear(*impl_->target, command);
}

void Device::draw(const DrawPacket& packet) { impl_->draw(packet); }
void Device::draw_pixels(const PixelPacket& packet) { impl_->draw_pixels(packet); }
ShadedPoint Device::shade_point(const DrawState& state, const VertexBatch& batch) {
  return raster::shade_point(state, batch);
}
void Device::finish(const LinearImage* image, ColorPlane plane) { impl_->execute(image, plane); }
const DeviceStatistics& Device::statistics() const { return impl_->statistics; }

namespace {

// Calls read(x0, x1, y, out) for each row of `rect` that the framebuffer has.
template <class T, class Read>
void read_rows(const Framebuffer::Impl& fb, const Rect& rect, size_t channels, T* out, Read read) {
  const Rect inside = intersect(rect, {0, 0, fb.width, fb.height});
  if (inside.empty()) return;
  const auto width = static_cast<size_t>(rect.x1 - rect.x0);
  for (int y = inside.y0; y < inside.y1; ++y) {
    const size_t at = static_cast<size_t>(y - rect.y0) * width + static_cast<size_t>(inside.x0 - rect.x0);
    read(inside.x0, inside.x1, y, out + at * channels);
  }
}

}  // namespace

void Device::read_color(const Rect& rect, uint8_t* out, ColorPlane plane) {
  if (impl_->target == nullptr) return;
  finish();
  const Framebuffer::Impl& fb = *impl_->target;
  std::vector<uint32_t> row(static_cast<size_t>(fb.width));
  read_rows(fb, rect, 4, out, [&](int x0, int x1, int y, uint8_t* to) {
    read_row_rgba8(fb, plane_index(plane), x0, x1, y, row.data());
    std::memcpy(to, row.data(), static_cast<size_t>(x1 - x0) * 4);
  });
}

void Device::read_color_float(const Rect& rect, float* out, ColorPlane plane) {
  if (impl_->target == nullptr) return;
  finish();
  const Framebuffer::Impl& fb = *impl_->target;
  read_rows(fb, rect, 4, out, [&](int x0, int x1, int y, float* to) {
    read_row_float(fb, plane_index(plane), x0, x1, y, to);
  });
}

void Device::read_depth(const Rect& rect, uint32_t* out) {
  if (impl_->target == nullptr) return;
  finish();
  const Framebuffer::Impl& fb = *impl_->target;
  read_rows(fb, rect, 1, out, [&](int x0, int x1, int y, uint32_t* to) { read_row_depth(fb, x0, x1, y, to); });
}

void Device::read_stencil(const Rect& rect, uint8_t* out) {
  if (impl_->target == nullptr) return;
  finish();
  const Framebuffer::Impl& fb = *impl_->target;
  read_rows(fb, rect, 1, out, [&](int x0, int x1, int y, uint8_t* to) { read_row_stencil(fb, x0, x1, y, to); });
}

void Device::accumulate(const AccumCommand& command) {
  if (impl_->target == nullptr) return;
  finish();
  const Accumulation accumulation(*impl_->target, command);
  impl_->pool.run(static_cast<uint32_t>(impl_->target->tiles.size()),
                  [&](uint32_t tile, int) { accumulation.run(tile); });
}

void Device::copy_plane(ColorPlane from, ColorPlane to, const Rect& rect) {
  if (impl_->target == nullptr) return;
  finish();
  Framebuffer::Impl& fb = *impl_->target;
  fb.need_color(kBackPlane | kFrontPlane);
  impl_->pool.run(static_cast<uint32_t>(fb.tiles.size()), [&](uint32_t tile, int) {
    copy_plane_tile(fb, tile, plane_index(from), plane_index(to), rect);
  });
}

}  // namespace halfspace::raster
