#include "raster/api/device.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "raster/batch.h"
#include "raster/device_options.h"
#include "raster/draw_area.h"
#include "raster/primitive/assembly.h"
#include "raster/primitive/index_part.h"
#include "raster/primitive/packet_run.h"
#include "raster/primitive/pixel_rect.h"
#include "raster/primitive/shape_assembly.h"
#include "raster/primitive/window_box.h"
#include "raster/shares.h"
#include "raster/statistics.h"
#include "raster/surface/accumulate.h"
#include "raster/surface/clear.h"
#include "raster/surface/resolve.h"
#include "raster/thread_pool.h"
#include "raster/tile/tile_worker.h"
#include "raster/vertex/shade_point.h"
#include "raster/vertex/vertex_stage.h"
#include "raster/view.h"

namespace halfspace::raster {
namespace {

constexpr uint32_t kPartPrimitives = 4096;  // a larger draw is taken in parts
// Points that are packets at once: of fewer in a part, each tile would have a few in every part. Of more, the
// first ones would have left the cache.
constexpr size_t kPartBytes = size_t{1} << 19;
// With indices parts share vertices, and what two of them name is shaded twice: fewer parts, less of that.
constexpr uint32_t kIndexedScale = 4;
// With several threads draws are taken in larger parts, and more is kept back before it is executed: each
// part and each execution is a meeting of threads. Where few meet, what stays in their caches counts for
// more.
constexpr uint32_t kFewThreadsScale = 4, kManyThreadsScale = 8;
// Of points and lines: more of them than these leave the caches before their tiles come to them.
constexpr uint32_t kFewThreadsScaleOfPackets = 2;
constexpr int kFewThreads = 4;
constexpr uint32_t kParallelPrimitives = 2048;  // a part of fewer is not split over threads
constexpr uint32_t kVerticesPerTask = 2048;     // about
constexpr uint32_t kShadedAtOnce = 16;          // vertices: whole vectors at every level

}  // namespace

struct Device::Impl {
  using Clock = std::chrono::steady_clock;
  explicit Impl(const DeviceOptions& options)
      : pool(thread_count(options)),
        report(report_from_environment()),
        meters(options.meter || report != Report::nothing),
        fuse(fuses(options) && !meters) {
    const View view = view_from_environment();
    if (view != View::none) notes.emplace(view);
  }

  ThreadPool pool;
  const Report report;
  const bool meters;  // statistics of stages
  const bool fuse;
  StageMeter meter;                        // since creation
  DeviceStatistics statistics_at_picture;  // what had been counted when the last picture was shown
  std::optional<ViewNotes> notes;          // for a view in the picture's place
  Framebuffer::Impl* target = nullptr;
  DeviceStatistics statistics;

  // Draws are put into one batch. Meanwhile the tiles of the other, if that is not null, are drawn by the
  // pool.
  Batch batches[2];
  Batch* filling = &batches[0];
  Batch* rendering = nullptr;
  std::vector<TileStatistics> counts;  // of each worker, for the batch that is drawn
  std::vector<StageMeter> worker_meters;
  std::vector<uint16_t> outcodes;
  std::vector<double> clip_distances;  // of the draw at hand, from the user clip planes
  std::vector<uint8_t> clip_codes;
  uint32_t stipple = 0;  // where the stipple of the last line strip stands

  const DrawProgram& program_for(const std::shared_ptr<const DrawState>& state, const VertexLayout& layout) {
    return filling->program_for(state, layout, target->format, fuse);
  }
  void make_room(const DrawPacket& packet, ShadedVertices& vertices);
  void shade(const DrawPacket& packet, ShadedVertices& vertices);
  bool has_few_threads() const { return pool.size() <= kFewThreads; }
  uint32_t scale() const {
    if (pool.size() == 1) return 1;
    return has_few_threads() ? kFewThreadsScale : kManyThreadsScale;
  }
  uint32_t packet_scale() const {
    return has_few_threads() ? std::min(scale(), kFewThreadsScaleOfPackets) : scale();
  }
  bool takes_points(const DrawPlan& plan, const DrawPacket& packet) const;
  uint32_t part_primitives(const DrawPlan& plan, const DrawPacket& packet) const;
  // Whether a draw's vertices and primitives should be split over threads. Few threads had better stay with
  // the tiles that wait for them: what one of them shades has to come over to another's cache to be
  // assembled.
  bool splits() const { return !has_few_threads() || (pool.size() > 1 && !pool.is_busy()); }
  template <class Task>
  void run_split(uint32_t count, const Task& task);
  void count_vertices(const DrawState& state, uint32_t count, Clock::duration time);
  void report_stages(const LinearImage* image);
  void report_draw(const DeviceStatistics& before);
  void find_clip_distances(const DrawPacket& packet, DrawRecord& record);
  bool assemble_draw(DrawRecord& record, const DrawPacket& packet, uint32_t primitives);
  void need_planes(const DrawState& state, const PipelineProgram& program);
  void note_targets(const DrawState& state, const PipelineProgram& program);
  void draw(const DrawPacket& packet);
  void draw_in_parts(const DrawPacket& packet, const VertexLayout& layout, const ShapePlan& shape,
                     const DrawProgram& program);
  void draw_part(const DrawPacket& packet, const VertexLayout& layout, const ShapePlan& shape,
                 const DrawProgram& program, uint32_t first_vertex);
  bool waits(const DrawPacket& packet, const ShapePlan& shape, const DrawProgram& program) const;
  void execute_if_full();
  void draw_pixels(const PixelPacket& packet);
  bool prepare_pixels(const PixelPacket& packet, const PipelineProgram& program);
  void hand_over(const LinearImage* image, ColorPlane plane);
  void show_tile(uint32_t tile, bool by_rows, const LinearImage& image, ColorPlane plane) const;
  void settle();
  void execute(const LinearImage* image, ColorPlane plane = kBackPlane);
  void discard(Batch& batch);
};

// task(i) for every i in [0, count).
template <class Task>
void Device::Impl::run_split(uint32_t count, const Task& task) {
  if (splits()) return pool.run(count, [&](uint32_t i, int) { task(i); });
  for (uint32_t i = 0; i < count; ++i) task(i);
}

void Device::Impl::make_room(const DrawPacket& packet, ShadedVertices& vertices) {
  const VertexBatch& batch = packet.batch;
  vertices.count = batch.count;
  vertices.records = filling->arena.allocate(batch.count * vertices.layout.stride());
  vertices.outcodes.swap(outcodes);
  if (vertices.outcodes.size() < batch.count) vertices.outcodes.resize(batch.count);
  vertices.clip = {batch.position, *packet.state};
}

void Device::Impl::shade(const DrawPacket& packet, ShadedVertices& vertices) {
  const VertexBatch& batch = packet.batch;
  const Shares shares = even_shares(batch.count, (batch.count - 1) / kVerticesPerTask + 1, kShadedAtOnce);
  const auto start = meters ? Clock::now() : Clock::time_point();
  run_split(shares.count, [&](uint32_t i) {
    shade_vertices(*packet.state, batch, packet.materials, shares.first(i), shares.size(i), vertices);
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
    if (meter.fragments[at] != 0)
      statistics.stages.push_back({stage_name(id), meter.fragments[at], meter.nanoseconds[at]});
  }
  if (report == Report::nothing || image == nullptr || statistics.draws == statistics_at_picture.draws)
    return;
  print_statistics(statistics_at_picture, statistics,
                   static_cast<size_t>(target->width) * static_cast<size_t>(target->height));
  statistics_at_picture = statistics;
}

// Where each draw is reported: draws it at once, and prints what that took.
void Device::Impl::report_draw(const DeviceStatistics& before) {
  execute(nullptr);
  print_statistics(before, statistics, 0);
}

void Device::Impl::find_clip_distances(const DrawPacket& packet, DrawRecord& record) {
  if (packet.state->clip_planes.enabled == 0) return;
  const VertexBatch& batch = packet.batch;
  clip_distances.resize(size_t{batch.count} * kMaxClipPlanes);
  clip_codes.resize(batch.count);
  raster::clip_distances(*packet.state, batch, clip_distances.data(), clip_codes.data());
  record.clip_distances = clip_distances.data();
  record.clip_codes = clip_codes.data();
}

// Whether what was made of a draw whose lines are packets refers to its vertices.
bool Device::Impl::assemble_draw(DrawRecord& record, const DrawPacket& packet, uint32_t primitives) {
  // The stipple of a line starts where the one before it ended.
  // Points that become packets at once are seen by nobody else until their tiles are drawn, which takes less.
  const bool only_packets = record.runs_points && record.given_vertices != nullptr;
  const bool split = splits() || (pool.size() > 1 && only_packets);
  if (!split || primitives < kParallelPrimitives || record.shape.stippled_lines) {
    Segment& segment = filling->open_segment(*target);
    assemble(record, packet.primitive, packet.indices, packet.index_count, 0, primitives, segment);
    stipple = segment.stipple_end;
    return segment.refers_to_vertices;
  }
  const Shares parts = even_shares(primitives, static_cast<uint32_t>(pool.size()));
  const size_t first_segment = filling->segments().size();
  for (uint32_t i = 0; i < parts.count; ++i) filling->new_segment(*target);
  pool.run(parts.count, [&](uint32_t part, int) {
    assemble(record, packet.primitive, packet.indices, packet.index_count, parts.first(part),
             parts.size(part), *filling->segments()[first_segment + part]);
  });
  bool refers = false;
  for (uint32_t i = 0; i < parts.count; ++i)
    refers |= filling->segments()[first_segment + i]->refers_to_vertices;
  return refers;
}

// Asks the framebuffer for the planes that a draw works on. The tiles' workers must not see one come to be.
void Device::Impl::need_planes(const DrawState& state, const PipelineProgram& program) {
  const bool color = program.writes_color && !target->has_color(state.color_targets);
  const bool depth = program.reads_depth && !target->has_depth();
  const bool stencil = program.reads_stencil && !target->has_stencil();
  if (color || depth || stencil) settle();
  if (color) target->need_color(state.color_targets);
  if (depth) target->need_depth();
  if (stencil) target->need_stencil();
}

void Device::Impl::note_targets(const DrawState& state, const PipelineProgram& program) {
  filling->add_targets(program.writes_color ? state.color_targets : uint8_t{0}, program.reads_stencil);
}

void Device::Impl::draw(const DrawPacket& packet) {
  if (target == nullptr || packet.batch.count == 0 ||
      primitive_count(packet.primitive, packet.index_count) == 0)
    return;
  const DrawState& state = *packet.state;
  // Once for the whole draw: how it is cut into parts must not show.
  VertexLayout layout = choose_layout(state, packet.batch);
  const ShapePlan shape = plan_shapes(state, packet.primitive);
  layout.coverage = shape.coverage;
  const DrawProgram& found = program_for(packet.state, layout);
  const PipelineProgram& program = found.program;
  ++statistics.draws;
  statistics.vertices += packet.batch.count;
  const Rect reach = shape.general ? draw_window(state, *target) : draw_bounds(state, *target);
  if (program.draws_nothing || reach.empty()) return;
  need_planes(state, program);
  draw_in_parts(packet, layout, shape, found);
}

// Whether points go straight from the application's memory into packets.
bool Device::Impl::takes_points(const DrawPlan& plan, const DrawPacket& packet) const {
  return points_run_unshaded(plan, packet) && !notes && !meters;
}

uint32_t Device::Impl::part_primitives(const DrawPlan& plan, const DrawPacket& packet) const {
  if (takes_points(plan, packet))
    return static_cast<uint32_t>(kPartBytes / point_bytes(point_kind(plan.program))) * packet_scale();
  if (packet.primitive == Primitive::points || packet.primitive == Primitive::lines)
    return kPartPrimitives * packet_scale();
  return kPartPrimitives * (packet.indices != nullptr ? std::max(scale(), kIndexedScale) : scale());
}

// Large draws of separate primitives go in parts, each with the vertices it names, so that what is pending
// stays small.
void Device::Impl::draw_in_parts(const DrawPacket& packet, const VertexLayout& layout, const ShapePlan& shape,
                                 const DrawProgram& program) {
  const uint32_t each = separate_vertices(packet.primitive);
  const uint32_t step = each * part_primitives({*packet.state, layout, shape, program.program}, packet);
  if (each == 0 || packet.index_count <= step || packet.gathered)
    return draw_part(packet, layout, shape, program, 0);
  for (uint32_t first = 0; first < packet.index_count; first += step) {
    DrawPacket part = packet;
    part.index_count = std::min(step, packet.index_count - first);
    uint32_t lowest = first, highest = first + part.index_count - 1;
    if (packet.indices != nullptr) {
      const uint32_t* indices = packet.indices + first;
      static_assert(kPartPrimitives % kIndexStretch == 0);
      const IndexRange range =
          packet.index_ranges != nullptr
              ? joined_range(packet.index_ranges + first / kIndexStretch, index_stretches(part.index_count))
              : index_range(indices, part.index_count);
      lowest = range.lowest, highest = range.highest;
      part.indices = indices, part.index_ranges = nullptr;
    }
    part.batch = part_of(packet.batch, lowest, highest - lowest + 1);
    // Executing a full pass drops it.
    draw_part(part, layout, shape, first == 0 ? program : program_for(packet.state, layout), lowest);
  }
}

// first_vertex: of the whole draw's, which the indices name.
void Device::Impl::draw_part(const DrawPacket& packet, const VertexLayout& layout, const ShapePlan& shape,
                             const DrawProgram& found, uint32_t first_vertex) {
  const PipelineProgram& program = found.program;
  const uint32_t primitives = primitive_count(packet.primitive, packet.index_count);
  note_targets(*packet.state, program);
  if (waits(packet, shape, found)) {
    filling->waiting.add(packet, found, primitives);
    return execute_if_full();
  }
  filling->take_up_waiting(*target);
  DrawRecord& record = filling->draws.emplace_back();
  record.state = found.state_after_vertices(packet.state);
  record.bounds = draw_bounds(*packet.state, *target);
  record.window = draw_window(*packet.state, *target);
  record.program = &program;
  record.shape = shape;
  record.edge_flags = packet.batch.edge_flag;
  record.stipple_start = packet.continues ? stipple : 0;
  record.vertices.layout = layout;
  record.first_vertex = first_vertex;
  const DrawPlan plan{*packet.state, layout, record.shape, program};
  record.runs_points = points_run(plan, packet.primitive) && !notes;
  record.runs_lines = lines_run(record, packet.primitive, primitives) && !notes;
  if (takes_points(plan, packet)) {
    record.given_vertices = &packet.batch, record.state = packet.state;
  } else if (record.runs_lines && lines_run_unshaded(plan, packet) && !meters) {
    make_room(packet, record.vertices);
    record.given_vertices = &packet.batch, record.unshaded = &record.vertices, record.state = packet.state;
  } else {
    make_room(packet, record.vertices);
    shade(packet, record.vertices);
  }
  find_clip_distances(packet, record);
  const bool refers = assemble_draw(record, packet, primitives);
  // Packets bring along all that is needed.
  if ((record.runs_points && record.given_vertices == nullptr) || (record.runs_lines && !refers))
    filling->arena.take_back(size_t{packet.batch.count} * layout.stride());
  // Clip coordinates and outcodes have done their work; the next draw takes the memory of these.
  record.vertices.outcodes.swap(outcodes);
  record.vertices.clip = {};
  if (record.given_vertices != nullptr) record.state = found.state_after_vertices(packet.state);
  record.given_vertices = nullptr, record.unshaded = nullptr;
  record.clip_distances = nullptr, record.clip_codes = record.edge_flags = nullptr;
  execute_if_full();
}

// With one thread there is nobody to leave it to; with many each draw is split among them.
bool Device::Impl::waits(const DrawPacket& packet, const ShapePlan& shape, const DrawProgram& program) const {
  return pool.size() > 1 && !meters && !notes &&
         WaitingDraws::may_wait(packet, shape, program, has_few_threads());
}

void Device::Impl::execute_if_full() {
  if (filling->is_full(scale(), packet_scale())) hand_over(nullptr, kBackPlane);
}

// Asks the framebuffer for what the packet draws on; false if it draws nothing.
bool Device::Impl::prepare_pixels(const PixelPacket& packet, const PipelineProgram& program) {
  if (packet.kind == PixelKind::stencil) {
    if (packet.stencil_mask == 0) return false;
    if (!target->has_stencil()) settle();
    target->need_stencil();
    filling->add_targets(0, true);
    return true;
  }
  if (program.draws_nothing) return false;
  need_planes(*packet.state, program);
  note_targets(*packet.state, program);
  return true;
}

// A small image waits with the draws around it; a large one is drawn at once, and need not be copied.
void Device::Impl::draw_pixels(const PixelPacket& packet) {
  if (target == nullptr) return;
  const VertexLayout layout = pixel_layout(packet);
  const PipelineProgram& program = program_for(packet.state, layout).program;
  if (!prepare_pixels(packet, program)) return;
  const Rect limit = draw_window(*packet.state, *target);
  const bool keep = is_small(packet);
  filling->take_up_waiting(*target);
  PixelImage& image = filling->images.emplace_back();
  if (!lay_out_pixels(packet, layout, limit, keep, filling->arena, image)) return;
  ++statistics.draws;
  DrawRecord& record = filling->draws.emplace_back();
  record.state = packet.state;
  record.bounds = image.bounds;
  record.program = &program;
  record.vertices.layout = layout;
  record.image = &image;
  Segment& segment = filling->open_segment(*target);
  segment.draws.push_back({static_cast<uint32_t>(segment.primitives.size()), &record});
  bin_box(segment, tile_box(image.bounds), static_cast<uint32_t>(segment.primitives.size()));
  segment.primitives.push_back({});
  if (keep)
    execute_if_full();
  else
    execute(nullptr);
}

void Device::Impl::discard(Batch& batch) {
  batch.count_into(statistics);
  if (pool.is_far()) batch.leave_caches();
  batch.discard();
}

// Waits for the batch that is drawn, and takes leave of it.
void Device::Impl::settle() {
  if (rendering == nullptr) return;
  pool.wait();
  for (const TileStatistics& count : counts) {
    statistics.fragments += count.fragments;
    statistics.double_fragments += count.double_fragments;
  }
  for (const StageMeter& counted : worker_meters) meter.add(counted);
  discard(*std::exchange(rendering, nullptr));
}

// Shows a tile that is drawn; by rows: with the last of a row of tiles, the row.
void Device::Impl::show_tile(uint32_t tile, bool by_rows, const LinearImage& image, ColorPlane plane) const {
  const auto row = static_cast<uint32_t>(target->tiles_x);
  if (!by_rows)
    resolve_tiles(*target, tile, 1, plane_index(plane), image);
  else if ((tile + 1) % row == 0)
    resolve_tiles(*target, tile + 1 - row, row, plane_index(plane), image);
}

// Has the pool draw the batch that was filled, once it is done with the one before.
void Device::Impl::hand_over(const LinearImage* image, ColorPlane plane) {
  settle();
  Batch& batch = *filling;
  const bool draws = !batch.empty();
  if (draws) ++statistics.passes;
  counts.assign(static_cast<size_t>(pool.size()), {});
  worker_meters.assign(meters ? counts.size() : 0, {});
  if (notes) notes->attend(*target);
  if (notes && image != nullptr) target->need_color(static_cast<uint8_t>(plane));
  rendering = &batch;
  if (pool.size() > 1) filling = &batches[filling == &batches[0] ? 1 : 0];
  const LinearImage shown = image != nullptr ? *image : LinearImage();
  const bool shows = image != nullptr;
  // Memory takes whole rows faster than tiles; but a tile that was drawn is in its own worker's cache.
  const bool by_rows = pool.size() == 1 || !draws;
  const auto prepare = [this, &batch, shows] {
    batch.take_up_waiting(*target);
    batch.deal_tiles(*target, shows, pool.size());
    return std::span<const uint32_t>(batch.ends);
  };
  const auto task = [this, &batch, draws, shows, shown, by_rows, plane](uint32_t i, int worker) {
    const auto at = static_cast<size_t>(worker);
    TileStatistics local;
    if (meters) local.meter = &worker_meters[at];
    if (notes) local.notes = notes->tile(batch.tiles[i]);
    if (draws) run_tile(batch.segments(), *target, batch.tiles[i], batch.tile_after(i), local);
    if (shows && notes) notes->paint_tile(*target, batch.tiles[i], plane_index(plane));
    if (shows) show_tile(batch.tiles[i], by_rows, shown, plane);
    counts[at].fragments += local.fragments;
    counts[at].double_fragments += local.double_fragments;
  };
  if (batch.waiting.empty())
    pool.start(prepare(), task);
  else
    pool.start(prepare, task);
  if (pool.size() == 1) settle();
}

void Device::Impl::execute(const LinearImage* image, ColorPlane plane) {
  if (target == nullptr) return;
  filling->take_up_waiting(*target);  // while others still draw what came before
  if (image != nullptr || !filling->empty()) hand_over(image, plane);
  settle();
  if (image != nullptr) pool.note_picture();
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
  if (impl_->filling->is_covered_by(command, *impl_->target)) {
    impl_->filling->take_up_waiting(*impl_->target);  // which counts them
    impl_->discard(*impl_->filling);
  }
  impl_->execute(nullptr);
  // What was drawn before is not to be seen in a view either.
  if (impl_->notes && command.color && clears_everything(*impl_->target, command)) impl_->notes->forget();
  raster::clear(*impl_->target, command);
}

void Device::draw(const DrawPacket& packet) {
  if (impl_->report != Report::draws || impl_->target == nullptr) return impl_->draw(packet);
  const DeviceStatistics before = impl_->statistics;
  impl_->draw(packet);
  impl_->report_draw(before);
}
void Device::draw_pixels(const PixelPacket& packet) {
  if (impl_->report != Report::draws || impl_->target == nullptr) return impl_->draw_pixels(packet);
  const DeviceStatistics before = impl_->statistics;
  impl_->draw_pixels(packet);
  impl_->report_draw(before);
}
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
  if (impl_->target == nullptr || rect.empty()) return;
  finish();
  const Framebuffer::Impl& fb = *impl_->target;
  const int width = rect.x1 - rect.x0;
  LinearImage image;
  image.data = out;
  image.row_bytes = ptrdiff_t{width} * 4;
  image.width = width;
  image.height = rect.y1 - rect.y0;
  const Rect inside = intersect(rect, {0, 0, fb.width, fb.height});
  if (inside.empty()) return;
  const TileBox box = tile_box(inside);
  impl_->pool.run(static_cast<uint32_t>(box.y1 - box.y0 + 1), [&](uint32_t row, int) {
    const auto first = (static_cast<uint32_t>(box.y0) + row) * static_cast<uint32_t>(fb.tiles_x);
    resolve_tiles(fb, first + static_cast<uint32_t>(box.x0), static_cast<uint32_t>(box.x1 - box.x0 + 1),
                  plane_index(plane), image, rect.x0, rect.y0);
  });
}

void Device::read_color_float(const Rect& rect, float* out, ColorPlane plane) {
  if (impl_->target == nullptr) return;
  finish();
  const Framebuffer::Impl& fb = *impl_->target;
  read_rows(fb, rect, 4, out,
            [&](int x0, int x1, int y, float* to) { read_row_float(fb, plane_index(plane), x0, x1, y, to); });
}

void Device::read_depth(const Rect& rect, uint32_t* out) {
  if (impl_->target == nullptr) return;
  finish();
  const Framebuffer::Impl& fb = *impl_->target;
  read_rows(fb, rect, 1, out,
            [&](int x0, int x1, int y, uint32_t* to) { read_row_depth(fb, x0, x1, y, to); });
}

void Device::read_stencil(const Rect& rect, uint8_t* out) {
  if (impl_->target == nullptr) return;
  finish();
  const Framebuffer::Impl& fb = *impl_->target;
  read_rows(fb, rect, 1, out,
            [&](int x0, int x1, int y, uint8_t* to) { read_row_stencil(fb, x0, x1, y, to); });
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
