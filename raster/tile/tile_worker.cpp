#include "raster/tile/tile_worker.h"

#include <string.h>

#include "raster/isa.h"
#include "raster/primitive/line_packet.h"
#include "raster/primitive/packet_run.h"
#include "raster/primitive/pixel_rect.h"
#include "raster/primitive/point_packet.h"
#include "raster/tile/cover_smooth.h"
#include "raster/tile/coverage.h"
#include "raster/tile/line_setup.h"
#include "raster/tile/settled_planes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/tile/tile_worker.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace halfspace::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#include "raster/exact_math.inl"
#include "raster/tile/setup_gather.inl"
#include "raster/tile/setup.inl"
#include "raster/tile/line_setup.inl"
#include "raster/tile/triangle.inl"
#include "raster/tile/packing.inl"

#include "raster/tile/tile_ahead.inl"
#include "raster/tile/deferred_pixels.inl"

// What a tile's visit knows of triangles behind others (hidden_triangles.inl).
struct HiddenTriangles {
  static constexpr int kAtOnce = 32;   // triangles, before depths are looked up again (no difference with 16)
  bool pauses = false, knows = false;  // whether nobody looks in this visit; whether somebody has looked
  int since = 0;                       // triangles drawn after that
  uint64_t drawn_on = 0;               // blocks that were drawn on after that
  uint64_t asked = 0, found = 0;       // triangles
};

// What is the same for all primitives of a tile, and the scratch they share.
struct TileContext {
  Framebuffer::Impl* framebuffer;
  TileState* state;
  uint32_t tile;
  int x, y;  // lowest pixel
  const PipelineProgram* program = nullptr;
  Rect limit;          // the draw's bounds relative to the tile, within it
  bool masks_blocks;   // the limit is not the whole tile, or polygons are stippled
  bool stippled;
  uint64_t stipple[16];  // pixels of the blocks (y % 4) * 4 + x % 4
  int plane_count;
  bool flat_color;
  bool even = false;  // the primitive at hand takes the program's variant for one colour all over
  HiddenTriangles hidden;
  bool knows_deepest = false;
  uint32_t deepest = 0;  // of the blocks' depth_max, where that is known
  PixelNote* notes;      // of the tile's pixels, where a view asks for them; then nothing waits to be packed
  bool projective;
  bool packs_points;  // points of one pixel wait with the others, without any set-up
  TileStatistics* statistics;
  TileAhead ahead;
  BlockContext block;
  TilePlanes planes;
  SetupBatch setup;
  SetupInput input;
  bool input_is_clear;
  Packer packer;
  DeferredPixels deferred;
  alignas(64) uint32_t given_depth[kBlockPixels];  // of one block of an image
  ListedPixels listed;
  GroupTables group_tables;
  LinePixels line_pixels;
  TileGroup groups[kTilePixels / kBlockSize + 16];  // what a triangle covers, and room for a vector more
};

#include "raster/tile/coarse_depth.inl"
#include "raster/tile/fill.inl"
#include "raster/tile/hidden_triangles.inl"

HWY_INLINE void AddFragments(TileContext& t, int lane, uint64_t fragments) {
  t.statistics->fragments += fragments;
  if ((t.setup.variant[lane] & kDouble) != 0) t.statistics->double_fragments += fragments;
}

#include "raster/tile/deferred.inl"

HWY_INLINE void SelectColor(TileContext& t, int block, int plane) {
  const uint64_t bit = uint64_t{1} << block;
  if ((t.state->color[plane].is_clear & bit) != 0) t.framebuffer->settle_color(t.tile, bit, plane);
  std::byte* pixels = t.framebuffer->color_tile<std::byte>(t.tile, plane) +
                      static_cast<size_t>(block) * kBlockPixels * t.framebuffer->color_pixel_bytes();
  t.block.color = reinterpret_cast<uint32_t*>(pixels);
  t.block.color_planes = reinterpret_cast<float*>(pixels);
}

// What touches colour memory runs once a plane, each time on the colours that the stages before it have left.
HWY_NOINLINE void RunOnBothPlanes(TileContext& t, const BlockProgram& program, int block) {
  BlockContext& c = t.block;
  program.run_head(c);
  if (c.live == 0) return;
  alignas(64) float color[4][kBlockPixels];
  for (int k = 0; k < 4; ++k) memcpy(color[k], c.slot[kR + k], sizeof color[k]);
  program.run_tail(c);
  for (int k = 0; k < 4; ++k) memcpy(c.slot[kR + k], color[k], sizeof color[k]);
  SelectColor(t, block, 1 - t.program->plane);
  program.run_tail(c);
}

HWY_NOINLINE void NoteBlock(TileContext& t, int lane, int block, uint64_t mask) {
  const bool packs = t.program->packs && (t.setup.variant[lane] & kDouble) == 0 && __builtin_popcountll(mask) <= kPackAtMost;
  const FragmentPath path = packs ? FragmentPath::packed : mask == ~uint64_t{0} ? FragmentPath::whole : FragmentPath::part;
  note_fragments(t.notes, t.setup, lane, t.program->params, t.projective, block % 8 * kBlockSize, block / 8 * kBlockSize,
                 mask, path);
}

void RunBlock(TileContext& t, int lane, int block, uint64_t mask) {
  BlockContext& c = t.block;
  const SetupBatch& s = t.setup;
  const PipelineProgram& program = *t.program;
  const bool defers = t.deferred.taker != nullptr;
  if (!defers) ShadeDeferred(t, uint64_t{1} << block);
  c.dx = s.anchor_x[lane] + (block % 8) * kBlockSize;
  c.dy = s.anchor_y[lane] + (block / 8) * kBlockSize;
  if (program.rejects_deeper && BlockIsHidden(t, lane, block)) return;
  if (program.reads_depth) {
    const uint64_t bit = uint64_t{1} << block;
    if ((t.state->depth_marks() & bit) != 0) t.framebuffer->settle_depth(t.tile, bit);
    c.depth = t.framebuffer->depth_tile(t.tile) + block * kBlockPixels;
  }
  if (program.reads_stencil) {
    const uint64_t bit = uint64_t{1} << block;
    if ((t.state->stencil_is_clear & bit) != 0) t.framebuffer->settle_stencil(t.tile, bit);
    c.stencil = t.framebuffer->stencil_tile(t.tile) + block * kBlockPixels;
  }
  if (program.writes_color) SelectColor(t, block, program.plane);
  if (HWY_UNLIKELY(t.notes != nullptr)) NoteBlock(t, lane, block, mask);
  c.lane = lane;
  c.live = mask;
  AddFragments(t, lane, static_cast<uint64_t>(__builtin_popcountll(mask)));
  const BlockProgram& stages = t.even ? program.even : program.variants[s.variant[lane]];
  if (program.both_planes) RunOnBothPlanes(t, stages, block);
  else if (defers) DeferBlock(t, stages, block);
  else stages.run(c);
  UpdateDepthBounds(t, lane, block, mask == ~uint64_t{0});
}

// Pixels of a block that lie in `limit` (relative to the tile).
HWY_INLINE uint64_t LimitMask(const Rect& limit, int block) {
  const int x = (block % 8) * kBlockSize, y = (block / 8) * kBlockSize;
  uint64_t mask = 0;
  for (int row = 0; row < kBlockSize; ++row) {
    if (y + row < limit.y0 || y + row >= limit.y1) continue;
    for (int column = 0; column < kBlockSize; ++column)
      if (x + column >= limit.x0 && x + column < limit.x1) mask |= uint64_t{1} << (row * kBlockSize + column);
  }
  return mask;
}

HWY_INLINE uint64_t BlockMask(const TileContext& t, int block) {
  const uint64_t mask = LimitMask(t.limit, block);
  return t.stippled ? mask & t.stipple[block / 8 % 4 * 4 + block % 4] : mask;
}

// Shades what waits. Anything that draws otherwise does this first, so that order is kept.
void ShadePacked(TileContext& t) {
  PixelQueue& queue = t.packer.queue;
  BlockContext& c = t.block;
  if ((t.deferred.blocks & t.packer.blocks) != 0) t.deferred.DropListed(queue.offset, queue.count);
  c.queue = &queue;
  c.color = t.framebuffer->color_tile<uint32_t>(t.tile, t.program->plane);
  t.program->packed[t.packer.variant].run_packed(c);
}

void FlushPacked(TileContext& t) {
  if (t.packer.queue.count == 0) return;
  ShadePacked(t);
  t.packer.queue.count = 0;
  t.packer.blocks = 0;
}

// Blocks the pixels from (x0, y0) to (x1, y1) lie in; they span at most two each way.
HWY_INLINE uint64_t WindowBlocks(int x0, int y0, int x1, int y1) {
  const uint64_t columns = uint64_t{1} << (x0 / kBlockSize) | uint64_t{1} << (x1 / kBlockSize);
  return columns << (y0 / kBlockSize * 8) | columns << (y1 / kBlockSize * 8);
}

HWY_INLINE void PrepareWindow(TileContext& t, uint64_t blocks) {
  t.ahead.AskForSome(t.program->plane, t.program->reads_depth);
  if (t.program->reads_depth && (t.state->depth_marks() & blocks) != 0) t.framebuffer->settle_depth(t.tile, blocks);
  const int plane = t.program->plane;
  if ((t.state->color[plane].is_clear & blocks) != 0) t.framebuffer->settle_color(t.tile, blocks, plane);
  if (t.program->depth_may_grow)
    for (uint64_t todo = blocks; todo != 0; todo &= todo - 1) t.state->depth_max[__builtin_ctzll(todo)] = kDepthMax;
  if (t.program->depth_may_grow) t.knows_deepest = false;
  if (!t.program->writes_depth) return;
  t.state->depth_min_holds &= ~blocks;
  t.hidden.drawn_on |= blocks;
}

// Makes room for `count` fragments of `variant` in `blocks` among those that wait, and gives the depth they are tested
// against on the way in; null: none.
HWY_INLINE uint32_t* PreparePacking(TileContext& t, unsigned variant, int count, uint64_t blocks) {
  PrepareWindow(t, blocks);
  t.statistics->fragments += static_cast<uint64_t>(count);
  // The depth test is the first stage of the unpacked list.
  if (t.block.meter != nullptr && t.program->depth.test)
    t.block.meter->fragments[static_cast<size_t>(t.program->variants[0].stages[0])] += static_cast<uint64_t>(count);
  Packer& packer = t.packer;
  if (packer.variant != variant || packer.queue.count + count > PixelQueue::kCapacity) {
    FlushPacked(t);
    packer.variant = variant;
  }
  packer.blocks |= blocks;
  return t.program->reads_depth ? t.framebuffer->depth_tile(t.tile) : nullptr;
}

// Fragments at the pixels of `mask`, in the window whose first pixel is (x, y), join those that wait once they have
// passed the depth test. `blocks`: the blocks these pixels lie in.
void TestAndPack(TileContext& t, int lane, int x, int y, uint64_t mask, uint64_t blocks) {
  const SetupBatch& s = t.setup;
  uint32_t* depth = PreparePacking(t, s.variant[lane], __builtin_popcountll(mask), blocks);
  const int first = t.packer.queue.count;
  t.packer.Append(s, lane, x, y, mask, *t.program, t.plane_count, depth);
  if (t.flat_color) t.packer.SetFlatColor(s, lane, t.program->params.color_plane, first);
}

void PackTriangle(TileContext& t, int lane) {
  const SetupBatch& s = t.setup;
  const int x = s.min_x[lane], y = s.min_y[lane];
  const TriangleWalk walk(s, lane);
  const uint64_t mask = walk.Window(x, y, s.max_x[lane] - x + 1, s.max_y[lane] - y + 1);
  if (mask != 0) TestAndPack(t, lane, x, y, mask, WindowBlocks(x, y, s.max_x[lane], s.max_y[lane]));
}

// A block of a larger triangle: packed if little of it is covered, else row by row. What waits for the block's pixels
// was drawn before and is stored before.
void WalkBlock(TileContext& t, int lane, int block, uint64_t mask, bool packs) {
  const uint64_t bit = uint64_t{1} << block;
  if (packs && __builtin_popcountll(mask) <= kPackAtMost) {
    TestAndPack(t, lane, block % 8 * kBlockSize, block / 8 * kBlockSize, mask, bit);
    return;
  }
  if ((t.packer.blocks & bit) != 0) FlushPacked(t);
  RunBlock(t, lane, block, mask);
}

// Blocks of the triangle that are covered all over, where `collects`; what else it covers is drawn.
uint64_t WalkBlocks(TileContext& t, const TriangleWalk& walk, int lane, bool packs, bool collects) {
  const SetupBatch& s = t.setup;
  uint64_t filled = 0;
  for (int by = s.min_y[lane] / kBlockSize; by <= s.max_y[lane] / kBlockSize; ++by) {
    for (int bx = s.min_x[lane] / kBlockSize; bx <= s.max_x[lane] / kBlockSize; ++bx) {
      uint64_t mask = walk.Coverage(bx * kBlockSize, by * kBlockSize, s.min_y[lane], s.max_y[lane]);
      if (t.masks_blocks && mask != 0) mask &= BlockMask(t, by * 8 + bx);
      if (collects && mask == ~uint64_t{0}) filled |= uint64_t{1} << (by * 8 + bx);
      else if (mask != 0) WalkBlock(t, lane, by * 8 + bx, mask, packs);
    }
  }
  return filled;
}

HWY_NOINLINE void NoteFilled(TileContext& t, int lane, uint64_t blocks) {
  for (; blocks != 0; blocks &= blocks - 1) {
    const int block = __builtin_ctzll(blocks);
    note_fragments(t.notes, t.setup, lane, t.program->params, t.projective, block % 8 * kBlockSize,
                   block / 8 * kBlockSize, ~uint64_t{0}, FragmentPath::filled);
  }
}

#include "raster/tile/whole_blocks.inl"

// Blocks that are covered all over.
void TakeWholeBlocks(TileContext& t, int lane, uint64_t covered, const BlockProgram& stages) {
  if (covered == 0) return;
  if ((t.packer.blocks & covered) != 0) FlushPacked(t);
  RunCoveredBlocks(t, lane, {covered}, stages);
  if (HWY_UNLIKELY(t.notes != nullptr)) NoteFilled(t, lane, covered);
}

#include "raster/tile/group_walk.inl"
// Somebody wants to know of each block what was drawn there.
HWY_INLINE bool IsWatched(const TileContext& t) { return t.notes != nullptr || t.block.meter != nullptr; }

#include "raster/tile/group_batch.inl"
#include "raster/tile/pixel_batch.inl"

// Block by block, for programs that have no other way.
void WalkEachBlock(TileContext& t, int lane, const BlockProgram& stages, bool packs, bool collects) {
  const TriangleWalk walk(t.setup, lane);
  const bool whole = !t.masks_blocks && walk.CoversTile();
  uint64_t covered = 0;
  if (whole && collects) {
    covered = ~uint64_t{0};
  } else if (whole) {
    FlushPacked(t);
    for (int block = 0; block < kTileBlocks; ++block) RunBlock(t, lane, block, ~uint64_t{0});
  } else {
    covered = WalkBlocks(t, walk, lane, packs, collects);
  }
  TakeWholeBlocks(t, lane, covered, stages);
}

void WalkTriangle(TileContext& t, int lane, bool packs) {
  if (TileHides(t, lane)) return;
  t.even = HasEvenColor(t, lane);
  const BlockProgram& stages = t.even ? t.program->even : t.program->variants[t.setup.variant[lane]];
  const bool collects =
      stages.whole.fills || (t.notes == nullptr && (stages.whole.exists() || stages.nearer.exists()));
  const bool plain = !IsWatched(t);
  if (plain && stages.groups != nullptr) WalkGroups(t, lane, stages, collects);
  else if (plain && stages.whole.row_count != 0) WalkRows(t, lane, stages, packs);
  else WalkEachBlock(t, lane, stages, packs, collects);
  t.even = false;
}

HWY_INLINE bool Packs(const TileContext& t, int lane) {
  return t.program->packs && t.notes == nullptr && (t.setup.variant[lane] & kDouble) == 0;
}

void RunTriangle(TileContext& t, int lane) {
  const SetupBatch& s = t.setup;
  const int width = s.max_x[lane] - s.min_x[lane] + 1, height = s.max_y[lane] - s.min_y[lane] + 1;
  if (width <= 0 || height <= 0) return;
  const bool packs = Packs(t, lane);
  if (packs && width <= kWindow && height <= kWindow) PackTriangle(t, lane);
  else WalkTriangle(t, lane, packs);
}

#include "raster/fragment/line_piece.inl"
#include "raster/tile/lines.inl"
#include "raster/tile/shapes.inl"

#include "raster/tile/points.inl"

#include "raster/tile/image.inl"

void SelectDraw(TileContext& t, const DrawRecord& draw) {
  if (t.program != draw.program) FlushPacked(t);
  if (!t.deferred.MayStay(draw)) ShadeDeferred(t, t.deferred.blocks);
  const Rect tile{t.x, t.y, t.x + kTileSize, t.y + kTileSize};
  const Rect cut = intersect(tile, draw.bounds);
  t.limit = {cut.x0 - t.x, cut.y0 - t.y, cut.x1 - t.x, cut.y1 - t.y};
  t.stippled = draw.program->stippled;
  t.masks_blocks = cut != tile || t.stippled;
  if (t.stippled) SetStipple(t, draw.state->polygon);
  t.program = draw.program;
  t.block.params = &draw.program->params;
  t.plane_count = 2 + draw.vertices.layout.attribute_count;
  t.flat_color = draw.vertices.layout.color >= 0 && draw.program->flat_shading;
  t.projective = draw.vertices.layout.projective;
  t.packs_points = t.notes == nullptr && points_wait(draw.vertices.layout, draw.shape, *draw.program);
}

// Triangles in lanes [first, end) of the batch.
void RunTriangles(TileContext& t, int first, int end) {
  const unsigned lanes = DropHidden(t, ((1u << end) - (1u << first)) & ~EmptyTriangles(t.setup));
  if (lanes == 0) return;
  const unsigned listable = ListableTriangles(t, lanes);
  if (listable == lanes) return ListTriangles(t, listable);
  GroupBatch groups(t, lanes);
  for (unsigned todo = lanes; todo != 0;) {
    const int lane = __builtin_ctz(todo);
    const unsigned others = todo & ~listable, run = others != 0 ? todo & ((others & -others) - 1) : todo;
    if (run == 0 && groups.Add(lane)) {
      todo &= todo - 1;
      continue;
    }
    groups.Draw();
    if (run != 0)
      ListTriangles(t, run);
    else RunTriangle(t, lane);
    todo &= run != 0 ? ~run : todo - 1;
  }
  groups.Draw();
}

// The draw that primitive `id` is of, from `draw` on.
HWY_INLINE size_t DrawOf(const Segment& segment, uint32_t id, size_t draw) {
  const Segment::DrawStart* starts = segment.draws.data();
  const size_t all = segment.draws.size();
  // By steps that double and then halve: often it is the next one, and sometimes hundreds on.
  size_t step = 1;
  while (draw + step < all && starts[draw + step].first_primitive <= id) draw += step, step *= 2;
  for (; step != 0; step /= 2)
    if (draw + step < all && starts[draw + step].first_primitive <= id) draw += step;
  return draw;
}

#include "raster/tile/joined_draws.inl"

// Primitives ids[first .. count) of a batch.
void RunOneByOne(TileContext& t, const Segment& segment, const DrawRecord& record, const uint32_t* ids, int first,
                 int count) {
  for (int lane = first; lane < count; ++lane) {
    const PrimitiveRef& ref = segment.primitives.data()[ids[lane]];
    if (ref.kind == PrimitiveKind::triangle) {
      RunTriangle(t, lane);
      continue;
    }
    ShadeDeferred(t, t.deferred.blocks);
    RunShape(t, ref, segment, record, lane);
  }
}

// A batch for whose primitives `refs` has been read.
HWY_INLINE void SetUpBatch(TileContext& t, const Segment& segment, const DrawRecord& record,
                           const uint32_t* ids, const BatchRefs& refs, int count) {
  // Lanes beyond the batch's count are computed with, though never used.
  if (!t.input_is_clear) t.input.Clear();
  t.input_is_clear = true;
  SetUp(segment, record, ids, refs, count, t.x, t.y, t.limit, t.input, t.setup);
}

// How many of the primitives from ids[at] on, of `total`, are set up together: of a draw that ends before `end`.
HWY_INLINE int BatchCount(const uint32_t* ids, size_t at, size_t total, uint32_t end) {
  if (at + kSetupLanes <= total && ids[at + kSetupLanes - 1] < end) return kSetupLanes;
  int count = 0;
  while (at + static_cast<size_t>(count) < total && ids[at + static_cast<size_t>(count)] < end) ++count;
  return count;
}

// Primitives ids[at .. total) of a draw whose lines are packets for the most part, up to the primitive `end`. Gives where
// it stopped.
size_t RunLineDraw(TileContext& t, const Segment& segment, const DrawRecord& record, const uint32_t* ids, size_t at,
                   size_t total, uint32_t end) {
  const auto ends = [&](size_t i) HWY_ATTR { return i == total || ids[i] >= end; };
  while (!ends(at)) {
    if (IsLineRun(segment, ids[at])) {
      RunLines(t, segment, ids[at++]);
      continue;
    }
    int count = 1;
    while (count < kSetupLanes && !ends(at + static_cast<size_t>(count)) &&
           !IsLineRun(segment, ids[at + static_cast<size_t>(count)]))
      ++count;
    BatchRefs refs;
    refs.Read(segment, record.vertices, record.vertices.layout.stride(), ids + at, count);
    SetUpBatch(t, segment, record, ids + at, refs, count);
    RunOneByOne(t, segment, record, ids + at, 0, count);
    at += static_cast<size_t>(count);
  }
  return at;
}

void RunSegment(TileContext& t, const Segment& segment) {
  const auto& bin = segment.bins.data()[t.tile];
  const uint32_t* ids = bin.data();
  const size_t total = bin.size(), draw_count = segment.draws.size();
  size_t at = 0, draw = 0;
  BatchRefs refs[2];  // of the batch at hand, and of the next one
  int now = 0;
  while (at < total) {
    draw = DrawOf(segment, ids[at], draw);
    const uint32_t end = draw + 1 < draw_count ? segment.draws.data()[draw + 1].first_primitive : ~0u;
    const DrawRecord& record = *segment.draws.data()[draw].draw;
    SelectDraw(t, record);
    if (record.image != nullptr) {
      RunImage(t, *record.image);
      ++at;
      continue;
    }
    if (record.runs_points) {
      at = RunPoints(t, segment, record, ids, at, total, end);
      continue;
    }
    if (record.runs_lines) {
      at = RunLineDraw(t, segment, record, ids, at, total, end);
      continue;
    }
    const size_t stride = record.vertices.layout.stride();
    int read = 0;  // how many primitives of the batch to come are known, in refs[now]
    while (at < total && ids[at] < end) {
      if (t.packs_points && RunWaitingPoint(t, segment, record, ids[at])) {
        PrefetchPoint(segment, record.vertices, ids, at + kPointsAhead, total);
        ++at;
        read = 0;
        continue;
      }
      const int count = BatchCount(ids, at, total, end);
      if (count < kSetupLanes && at + static_cast<size_t>(count) < total) {
        if (const size_t joined = RunJoinedDraws(t, segment, ids, at, total, draw); joined != 0) {
          at += joined;
          break;
        }
      }
      if (count != read) refs[now].Read(segment, record.vertices, stride, ids + at, count);
      if (!refs[now].triangles) ShadeDeferred(t, t.deferred.blocks);
      const int drawn = ArePlainLines(t, segment, record, ids + at, count) ? RunPlainLines(t, record, refs[now], count) : 0;
      if (drawn < count) SetUpBatch(t, segment, record, ids + at, refs[now], count);
      const size_t next = at + static_cast<size_t>(count);
      read = BatchCount(ids, next, total, ~0u);
      if (read > 0) {
        refs[1 - now].Read(segment, record.vertices, stride, ids + next, read);
        PrefetchCorners(segment, refs[1 - now], ids, next, total, read);
      }
      if (refs[now].triangles) RunTriangles(t, 0, count);
      else RunOneByOne(t, segment, record, ids + at, drawn, count);
      now = 1 - now;
      at = next;
    }
  }
}

#if defined(__SANITIZE_ADDRESS__) || !defined(NDEBUG)
// What is used without having been set is NaN, or far outside, rather than what the stack held before.
template <class... T>
void Poison(T&... scratch) {
  (memset(static_cast<void*>(&scratch), 0xFF, sizeof scratch), ...);
}
#else
template <class... T>
HWY_INLINE void Poison(T&...) {}
#endif

void RunTile(std::span<Segment* const> segments, Framebuffer::Impl& framebuffer, uint32_t tile, uint32_t next,
             TileStatistics& statistics) {
  alignas(64) float whole[kBlockPixels];
  for (float& c : whole) c = 1;
  TileContext t;
  Poison(t.setup, t.deferred.setup, t.deferred.owner, t.input, t.planes, t.groups, t.group_tables, t.given_depth,
         t.listed.codes, t.line_pixels);
  t.input_is_clear = false;
  t.hidden.pauses = framebuffer.tiles.data()[tile].hidden.pause > 0;
  t.deferred.pauses = framebuffer.tiles.data()[tile].deferrals.pause > 0;
  t.framebuffer = &framebuffer;
  t.state = &framebuffer.tiles.data()[tile];
  t.tile = tile;
  t.x = static_cast<int>(tile % static_cast<uint32_t>(framebuffer.tiles_x)) * kTileSize;
  t.y = static_cast<int>(tile / static_cast<uint32_t>(framebuffer.tiles_x)) * kTileSize;
  t.statistics = &statistics;
  t.ahead.Expect(segments, framebuffer, next);
  t.notes = statistics.notes;
  t.block.meter = statistics.meter;
  t.block.setup = &t.setup;
  t.block.planes = &t.planes;
  t.block.group_tables = &t.group_tables;
  t.block.line_pixels = &t.line_pixels;
  t.block.coverage = whole;
  for (size_t i = 0; i < segments.size(); ++i) RunSegment(t, *segments.data()[i]);
  FlushPacked(t);
  ShadeDeferred(t, t.deferred.blocks);
  t.state->hidden.note(t.hidden.asked, t.hidden.found);
  if (t.deferred.asked) t.state->deferrals.note(t.deferred.taken, t.deferred.taken - t.deferred.shaded);
}

}  // namespace HWY_NAMESPACE
}  // namespace halfspace::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace halfspace::raster {
namespace {
using RunTileFunction = void (*)(std::span<Segment* const>, Framebuffer::Impl&, uint32_t, uint32_t, TileStatistics&);
RunTileFunction select_run_tile() { HALFSPACE_SELECT_FUNCTION(RunTile) }
}  // namespace

void run_tile(std::span<Segment* const> segments, Framebuffer::Impl& framebuffer, uint32_t tile, uint32_t next,
              TileStatistics& statistics) {
  select_run_tile()(segments, framebuffer, tile, next, statistics);
}

SettlePlanesFunction settle_planes(){HALFSPACE_SELECT_FUNCTION(SettlePlanes)}

SetUpLinesFunction set_up_lines(){HALFSPACE_SELECT_FUNCTION(SetUpLines)}

SetUpLineColumnsFunction set_up_line_columns() {
  HALFSPACE_SELECT_FUNCTION(SetUpLineColumns)
}

namespace {
using ListLineFunction = void (*)(const LineEnds&, int, int, const Rect&, PixelList&);
ListLineFunction select_list_line() { HALFSPACE_SELECT_FUNCTION(ListLine) }
}  // namespace

void list_line(const LineEnds& ends, int tile_x, int tile_y, const Rect& bounds, PixelList& out) {
  select_list_line()(ends, tile_x, tile_y, bounds, out);
}
}  // namespace halfspace::raster
#endif
