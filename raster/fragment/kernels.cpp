// The stages' code, compiled once per ISA level: each alone, and fused.
#include <type_traits>

#include "raster/fragment/program.h"
#include "raster/isa.h"
#include "raster/primitive/line_packet.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/fragment/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace halfspace::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#include "raster/exact_math.inl"
#include "raster/fragment/lanes.inl"
#include "raster/fragment/tile_lanes.inl"
#include "raster/fragment/group_lanes.inl"
#include "raster/fragment/line_piece.inl"
#include "raster/fragment/line_lanes.inl"
#include "raster/fragment/bytes.inl"
#include "raster/fragment/wide.inl"
#include "raster/fragment/stages/alpha_test.inl"
#include "raster/fragment/stages/blend.inl"
#include "raster/fragment/stages/color.inl"
#include "raster/fragment/stages/coord.inl"
#include "raster/fragment/stages/coverage.inl"
#include "raster/fragment/stages/depth.inl"
#include "raster/fragment/stages/env.inl"
#include "raster/fragment/stages/fog.inl"
#include "raster/fragment/stages/lambda.inl"
#include "raster/fragment/stages/logic_op.inl"
#include "raster/fragment/stages/sample.inl"
#include "raster/fragment/stages/sample_draft.inl"
#include "raster/fragment/stages/levels.inl"
#include "raster/fragment/stages/stencil.inl"
#include "raster/fragment/stages/wide_planes.inl"
#include "raster/fragment/stages/wide_sample.inl"
#include "raster/fragment/stages/wide_color.inl"
#include "raster/fragment/stages/write.inl"

enum SlotGroup : unsigned {
  kNone = 0, kColor = 1, kCoord = 2, kTexel = 4, kLevel = 8, kPlace = 16, kEyeDepth = 32, kMip = 64, kTexelAt = 2048,
  kRounded = 4096, kColorLow = 128, kCoordLow = 256, kTexelLow = 512, kLevelLow = 1024,  // what those floats leave of a double
};

template <unsigned kGroups, unsigned kGroup, int kFirst, int kCount>
HWY_INLINE void LoadGroup(const BlockContext& c, int i, Lanes& v) {
  if constexpr ((kGroups & kGroup) != 0)
    for (int s = kFirst; s < kFirst + kCount; ++s) v.slot[s] = hn::Load(DF(), c.slot[s] + i);
}
template <unsigned kGroups>
HWY_INLINE void LoadSlots(const BlockContext& c, int i, Lanes& v) {
  LoadGroup<kGroups, kColor, kR, 4>(c, i, v);
  LoadGroup<kGroups, kCoord, kS, 2>(c, i, v);
  LoadGroup<kGroups, kPlace, kS, 3>(c, i, v);
  LoadGroup<kGroups, kEyeDepth, kW, 1>(c, i, v);
  LoadGroup<kGroups, kTexel, kTexR, 4>(c, i, v);
  LoadGroup<kGroups, kLevel, kLambda, 1>(c, i, v);
  LoadGroup<kGroups, kMip, kMipKey, 2>(c, i, v);
  LoadGroup<kGroups, kRounded, kPixel, 1>(c, i, v);
  LoadGroup<kGroups, kTexelAt, kOffset, 1>(c, i, v);
  LoadGroup<kGroups, kColorLow, kLowR, 4>(c, i, v);
  LoadGroup<kGroups, kCoordLow, kLowS, 2>(c, i, v);
  LoadGroup<kGroups, kTexelLow, kLowTexR, 4>(c, i, v);
  LoadGroup<kGroups, kLevelLow, kLowLambda, 1>(c, i, v);
}

template <unsigned kGroups, unsigned kGroup, int kFirst, int kCount>
HWY_INLINE void StoreGroup(const Lanes& v, int i, BlockContext& c) {
  if constexpr ((kGroups & kGroup) != 0)
    for (int s = kFirst; s < kFirst + kCount; ++s) hn::Store(v.slot[s], DF(), c.slot[s] + i);
}
template <unsigned kGroups>
HWY_INLINE void StoreSlots(const Lanes& v, int i, BlockContext& c) {
  StoreGroup<kGroups, kColor, kR, 4>(v, i, c);
  StoreGroup<kGroups, kCoord, kS, 2>(v, i, c);
  StoreGroup<kGroups, kPlace, kS, 3>(v, i, c);
  StoreGroup<kGroups, kEyeDepth, kW, 1>(v, i, c);
  StoreGroup<kGroups, kTexel, kTexR, 4>(v, i, c);
  StoreGroup<kGroups, kLevel, kLambda, 1>(v, i, c);
  StoreGroup<kGroups, kMip, kMipKey, 2>(v, i, c);
  StoreGroup<kGroups, kRounded, kPixel, 1>(v, i, c);
  StoreGroup<kGroups, kTexelAt, kOffset, 1>(v, i, c);
  StoreGroup<kGroups, kColorLow, kLowR, 4>(v, i, c);
  StoreGroup<kGroups, kCoordLow, kLowS, 2>(v, i, c);
  StoreGroup<kGroups, kTexelLow, kLowTexR, 4>(v, i, c);
  StoreGroup<kGroups, kLevelLow, kLowLambda, 1>(v, i, c);
}

template <StageId id>
struct BodyOf;
#define STAGE(id, body, reads, writes)        \
  template <>                                 \
  struct BodyOf<StageId::id> {                \
    static constexpr unsigned kReads = (reads), kWrites = (writes); \
    template <class T>                        \
    struct Strip;                             \
    template <class T>                        \
    struct Strip<void(T)> {                   \
      using Type = T;                         \
    };                                        \
    using Type = typename Strip<void body>::Type; \
  };
#include "raster/fragment/stages.def"
#undef STAGE

// Stages that read slots where they lie, too: only as the first of a run, or else the slots hold something else.
template <class Body>
concept TakesFromMemory = requires { Body::kTakesFromMemory; };
template <StageId first, StageId... others>
constexpr bool MemoryIsFilled() {
  return (!TakesFromMemory<typename BodyOf<others>::Type> && ...);
}

// What each stage of a run works out once a block.
template <class L, StageId id>
struct OnceOf {
  typename BodyOf<id>::Type::template Once<L> once;
  HWY_INLINE explicit OnceOf(const BlockContext& c) : once(c) {}
};
template <class L, StageId... ids>
struct OnceAll : OnceOf<L, ids>... {
  HWY_INLINE explicit OnceAll(const BlockContext& c) : OnceOf<L, ids>(c)... {}
};

// Runs one stage on a group; false when no lane is left. What was worked out may be for lanes that differ in stores only.
template <class L, class Worked, StageId id>
HWY_INLINE bool Step(const BlockContext& c, const OnceOf<Worked, id>& once, int i, Lanes& v) {
  BodyOf<id>::Type::template Run<L>(c, once.once, i, v);
  if constexpr (BodyOf<id>::Type::kKills) return !hn::AllFalse(DF(), v.live);
  return true;
}

// Slots a run of stages takes from the stages before it: what one of them reads and none before has written.
template <StageId... ids>
constexpr unsigned TakenSlots() {
  unsigned taken = 0, written = 0;
  ((taken |= BodyOf<ids>::kReads & ~written, written |= BodyOf<ids>::kWrites), ...);
  return taken;
}
// What a stage has used up of what it reads: texels in the environment, coordinates in a lookup, the bytes in the write
// that ends the list. Of colours, those that were rounded or written; w is for whoever comes later.
template <StageId id>
constexpr unsigned UsedUp() {
  using Body = BodyOf<id>;
  const bool ends_color = Body::kWrites == kRounded || (Body::kWrites == kNone && !Body::Type::kKills);
  return Body::kReads & (ends_color ? ~0u : ~unsigned{kColor}) & ~unsigned{kEyeDepth};
}
// Slots a run leaves for those after it: all it wrote, but not what a later one of the same run has used up.
template <StageId... ids>
constexpr unsigned LeftSlots() {
  unsigned left = 0;
  ((left = (left & ~UsedUp<ids>()) | BodyOf<ids>::kWrites), ...);
  return left;
}

template <class L, StageId... ids>
HWY_INLINE void RunGroups(BlockContext& c) {
  constexpr bool kKills = (BodyOf<ids>::Type::kKills || ...), kFull = IsFull<L>;
  const OnceAll<L, ids...> once(c);
  const uint64_t live = L::Live(c);  // a local, as is `left`: through memory, each row would wait for the one before
  uint64_t left = 0;
  for (int i = 0; i < kBlockPixels; i += kLanes) {
    const uint64_t group = kFull ? kGroupBits : live >> i & kGroupBits;
    if (!kFull && group == 0) continue;
    Lanes v;
    v.live = MaskFromBits(group);
    LoadSlots<TakenSlots<ids...>()>(c, i, v);
    (Step<L, L, ids>(c, once, i, v) && ...);
    StoreSlots<LeftSlots<ids...>()>(v, i, c);
    if constexpr (kKills) left |= uint64_t{MaskBits(v.live)} << i;
  }
  if constexpr (kKills) c.live = left;
}

// Stages that store pixels say so.
template <class Body>
concept StoresPixels = requires { Body::kStoresPixels; };

// Where pixels are stored, a block that is live all over has code of its own.
template <class L, StageId... ids>
void RunStages(BlockContext& c) {
  static_assert(MemoryIsFilled<ids...>());
  constexpr bool kKills = (BodyOf<ids>::Type::kKills || ...);
  constexpr bool kStores = (StoresPixels<typename BodyOf<ids>::Type> || ...);
  if constexpr (IsBlock<L> && kStores && !kKills) {
    if (c.live == ~uint64_t{0}) return RunGroups<FullLanes, ids...>(c);
  }
  RunGroups<L, ids...>(c);
}

// Stages whose pixels may count from the tile's first say so, and those for which an alpha without slope is less work.
template <class Body>
concept RunsInTiles = requires { Body::kInTiles; } && Body::kInTiles;
template <class Body>
concept RunsInGroups = RunsInTiles<Body> || requires { Body::kInGroups; };
template <class Body>
concept TakesAlpha = requires { Body::kTakesAlpha; } && Body::kTakesAlpha;

HWY_INLINE bool AlphaIsLevel(const BlockContext& c, int lane) {
  const int alpha = c.params->color_plane + 3;
  return c.setup->dfdx_f[alpha][lane] == 0 && c.setup->dfdy_f[alpha][lane] == 0;
}

template <class L, StageId... ids>
HWY_INLINE void RunBlocks(const BlockContext& c) {
  const OnceAll<L, ids...> once(c);
  for (uint64_t todo = c.blocks; todo != 0; todo &= todo - 1) {
    const int first = __builtin_ctzll(todo) * kBlockPixels;
    for (int i = first; i < first + kBlockPixels; i += kLanes) {
      Lanes v;
      v.live = MaskFromBits(kGroupBits);
      (Step<L, L, ids>(c, once, i, v) && ...);
    }
  }
}

// A whole list on whole blocks of a tile.
template <StageId... ids>
void RunTileBlocks(BlockContext& c) {
  constexpr bool kKills = (BodyOf<ids>::Type::kKills || ...);
  if constexpr ((TakesAlpha<typename BodyOf<ids>::Type> || ...)) {
    if (AlphaIsLevel(c, c.lane))
      return RunBlocks<std::conditional_t<kKills, TileLanes<true>, FullTileLanes<true>>, ids...>(c);
  }
  RunBlocks<std::conditional_t<kKills, TileLanes<false>, FullTileLanes<false>>, ids...>(c);
}

// A part of a list on a group of a tile's row of whole blocks; slots count from the row's first pixel. Returns
// which lanes are left. L may be full lanes where all are live; what was worked out once is for any.
template <class L, class Worked, StageId... ids>
HWY_INLINE uint64_t RunRowGroup(BlockContext& c, const OnceAll<Worked, ids...>& once, int i, uint64_t live) {
  const int slot = i % (kRowBlocks * kBlockPixels);
  Lanes v;
  v.live = MaskFromBits(live);
  LoadSlots<TakenSlots<ids...>()>(c, slot, v);
  (Step<L, Worked, ids>(c, once, i, v) && ...);
  StoreSlots<LeftSlots<ids...>()>(v, slot, c);
  if constexpr ((BodyOf<ids>::Type::kKills || ...)) return MaskBits(v.live);
  return live;
}

// Stages with a way of their own through a block that is live all over say so; alone in a kernel they take it, unless
// they find that this block is not for it.
template <class Body>
concept RunsBlocks = requires { Body::kRunsBlocks; } && Body::kRunsBlocks;

template <class L, StageId id>
HWY_INLINE bool RunWholeBlock(BlockContext& c, const OnceOf<L, id>& once, int slots) {
  return BodyOf<id>::Type::RunBlock(
      c, once.once, slots, [&](int i, Lanes& v) HWY_ATTR { LoadSlots<TakenSlots<id>()>(c, i, v); },
      [&](const Lanes& v, int i) HWY_ATTR { StoreSlots<LeftSlots<id>()>(v, i, c); });
}

#include "raster/fragment/packed_lanes.inl"

// Stages that look up texels in two steps say so. Of a kernel that stores pixels, such a first one fetches while the group
// before is worked on.
template <class Body>
concept FetchesTexels =
    kFetchesAhead && requires(const BlockContext& c, Lanes& v) { Body::TakeTexels(Body::FetchTexels(c, 0), v); };
template <StageId first, StageId... others>
constexpr bool StartsByFetching() {
  return FetchesTexels<typename BodyOf<first>::Type>;
}

template <class L, class Worked, StageId first, StageId... others>
HWY_INLINE void RunFetchingAhead(BlockContext& c, const OnceAll<Worked, first, others...>& once, int begin) {
  using First = typename BodyOf<first>::Type;
  auto texels = First::FetchTexels(c, begin);
#pragma GCC unroll 4
  for (int p = 0; p < kBlockPixels; p += kLanes) {
    const int i = begin + p;
    const auto next = First::FetchTexels(c, p + kLanes < kBlockPixels ? i + kLanes : i);
    Lanes v;
    v.live = MaskFromBits(kGroupBits);
    LoadSlots<TakenSlots<first, others...>()>(c, i % (kRowBlocks * kBlockPixels), v);
    First::TakeTexels(texels, v);
    (Step<L, Worked, others>(c, once, i, v) && ...);
    texels = next;
  }
}

// Where pixels are stored, a block that is live all over has code of its own.
template <class L, StageId... ids>
HWY_INLINE void RunRowBlock(BlockContext& c, const OnceAll<L, ids...>& once, int block) {
  constexpr bool kKills = (BodyOf<ids>::Type::kKills || ...);
  const int first = block * kBlockPixels;
  const uint64_t live = c.row_live[block % kRowBlocks];
  if constexpr ((StoresPixels<typename BodyOf<ids>::Type> || ...) && !kKills) {
    if constexpr (StartsByFetching<ids...>()) {
      if (live == ~uint64_t{0}) return RunFetchingAhead<FullTileLanes<false>, L, ids...>(c, once, first);
    }
    if (live == ~uint64_t{0}) {
#pragma GCC unroll 4
      for (int p = 0; p < kBlockPixels; p += kLanes)
        RunRowGroup<FullTileLanes<false>>(c, once, first + p, kGroupBits);
      return;
    }
  }
  if constexpr (sizeof...(ids) == 1 && (RunsBlocks<typename BodyOf<ids>::Type> && ...)) {
    if (live == ~uint64_t{0} && (RunWholeBlock<L, ids>(c, once, first % (kRowBlocks * kBlockPixels)) && ...)) return;
  }
  uint64_t left = 0;
  for (int p = 0; p < kBlockPixels; p += kLanes) {
    const uint64_t group = live >> p & kGroupBits;
    if (group != 0) left |= RunRowGroup<L>(c, once, first + p, group) << p;
  }
  if constexpr (kKills) {
    c.row_live[block % kRowBlocks] = left;
    if (left == 0) c.blocks &= ~(uint64_t{1} << block);
  }
}

// Stages that work out something for each block say so.
template <class Body>
concept HasOncePerBlock = requires { Body::kOncePerBlock; };

template <StageId... ids>
void RunRowBlocks(BlockContext& c) {
  using L = TileLanes<false>;
  if constexpr ((HasOncePerBlock<typename BodyOf<ids>::Type> || ...)) {
    for (uint64_t todo = c.blocks; todo != 0; todo &= todo - 1) {
      const int block = __builtin_ctzll(todo);
      c.live = c.row_live[block % kRowBlocks];
      c.first_slot = block % kRowBlocks * kBlockPixels;
      RunRowBlock<L, ids...>(c, OnceAll<L, ids...>(c), block);
    }
    c.first_slot = 0;
  } else {
    const OnceAll<L, ids...> once(c);
    for (uint64_t todo = c.blocks; todo != 0; todo &= todo - 1)
      RunRowBlock<L, ids...>(c, once, __builtin_ctzll(todo));
  }
}

// Groups that lose all their lanes leave the list: without a branch, which could not be guessed.
template <class L, StageId... ids>
HWY_INLINE void RunListedGroups(BlockContext& c) {
  constexpr bool kKills = (BodyOf<ids>::Type::kKills || ...);
  const OnceAll<L, ids...> once(c);
  TileGroup* left = c.groups;
  const TileGroup* const end = c.groups + c.group_count;
  for (const TileGroup* at = c.groups; at != end; ++at) {
    const TileGroup group = *at;
    const int i = static_cast<int>(group.index()) * kLanes;
    if constexpr (kGroupsOfMany) c.group = group;
    Lanes v;
    v.live = MaskFromBits(group.live());
    (Step<L, L, ids>(c, once, i, v) && ...);
    if constexpr (kKills) {
      *left = group.with(static_cast<unsigned>(MaskBits(v.live)));
      left += left->count();
    }
  }
  if constexpr (kKills) c.group_count = static_cast<int>(left - c.groups);
}

// Of all primitives that the list is of.
HWY_INLINE bool AlphaIsLevelInGroups(const BlockContext& c) {
#if HWY_TARGET == HWY_AVX3
  const int alpha = c.params->color_plane + 3;
  const __m256 dfdx = _mm256_load_ps(c.setup->dfdx_f[alpha]), dfdy = _mm256_load_ps(c.setup->dfdy_f[alpha]);
  const __mmask8 level = _mm256_mask_cmp_ps_mask(_mm256_cmp_ps_mask(dfdx, _mm256_setzero_ps(), _CMP_EQ_OQ), dfdy,
                                                 _mm256_setzero_ps(), _CMP_EQ_OQ);
  return (c.group_lanes & ~unsigned{level}) == 0;
#else
  return AlphaIsLevel(c, c.lane);
#endif
}

template <StageId... ids>
void RunTileGroups(BlockContext& c) {
  if constexpr ((TakesAlpha<typename BodyOf<ids>::Type> || ...)) {
    if (AlphaIsLevelInGroups(c)) return RunListedGroups<GroupLanes<true>, ids...>(c);
  }
  RunListedGroups<GroupLanes<false>, ids...>(c);
}

// Lines that follow each other, as far as the same kernel is theirs: those after them are left in `lines`.
template <class L, StageId... ids>
HWY_INLINE void RunListedLines(BlockContext& c, uint32_t kind_bits) {
  const std::byte *at = c.lines, *const end = c.lines_end;
  const uint32_t kind = LineAt(at).shape & kind_bits;
  c.first_line_plane = LinePacket::first_plane(LineAt(at).variant());
  const OnceAll<L, ids...> once(c);
  LinePixels& list = *c.line_pixels;
  int count = 0, column = 0;
  uint64_t fragments = 0;
  while (at < end && (LineAt(at).shape & kind_bits) == kind) {
    const LinePacket& line = LineAt(at);
    c.line_planes = line.planes();
    const LinePiece<DF> piece(line, column);
    hn::StoreU(piece.Offset(), DI(), list.offset + count);
    AskForPixels<kLanes>(c.color, list.offset + count);
    hn::Store(piece.FromAnchorX(line), DF(), c.line_dx);
    hn::Store(piece.FromAnchorY(line), DF(), c.line_dy);
    Lanes v;
    v.live = MaskFromBits(kGroupBits);
    (Step<L, L, ids>(c, once, count, v) && ...);
    // Without a branch, which could not be guessed: one piece or more?
    const int left = line.count() - column, pixels = left < kLanes ? left : kLanes;
    const uint32_t ends = left <= kLanes ? ~0u : 0u;
    at += line.bytes() & ends;
    column = static_cast<int>(static_cast<uint32_t>(column + kLanes) & ~ends);
    count += pixels;
    fragments += static_cast<uint64_t>(pixels);
    if (count < LinePixels::kCapacity) continue;
    StoreListed(list, count, c.color);
    count = 0;
  }
  StoreListed(list, count, c.color);
  c.lines = at;
  c.line_fragments += fragments;
}

template <StageId... ids>
void RunLineStages(BlockContext& c) {
  if constexpr ((TakesAlpha<typename BodyOf<ids>::Type> || ...)) {
    constexpr uint32_t kKind = LinePacket::kVariantBits | LinePacket::kLevelAlpha;
    if (LineAt(c.lines).alpha_is_level()) return RunListedLines<LineLanes<true>, ids...>(c, kKind);
    return RunListedLines<LineLanes<false>, ids...>(c, kKind);
  }
  RunListedLines<LineLanes<false>, ids...>(c, LinePacket::kVariantBits);
}

// Stages that look at a fragment's depth say so.
template <class Body>
concept TakesDepth = requires { Body::kTakesDepth; };

// By groups go depth tests, alone, and runs that take a colour to memory: neither hands on slots.
template <StageId first, StageId... others>
constexpr bool GoesByGroups() {
  if constexpr (kLanes < kBlockSize) return false;
  else if constexpr (sizeof...(others) == 0) return TakesDepth<typename BodyOf<first>::Type>;
  else return BodyOf<first>::kReads == kNone && !BodyOf<first>::Type::kKills &&
              (StoresPixels<typename BodyOf<others>::Type> || ...);
}

// A kernel and the stages it runs; `packed` is null where the lanes cannot be packed.
struct Entry {
  StageId ids[kMaxStages];
  int count;
  KernelPair kernels;
};

template <StageId... ids>
constexpr Entry MakeEntry() {
  Entry entry{{ids...}, static_cast<int>(sizeof...(ids)), {&RunStages<BlockLanes, ids...>}};
  constexpr bool kPacks = (BodyOf<ids>::Type::kPacks && ...);
  if constexpr (kPacks) entry.kernels.packed = &RunPacked<ids...>;
  constexpr bool kInTiles = (RunsInTiles<typename BodyOf<ids>::Type> && ...);
  constexpr bool kStores = (StoresPixels<typename BodyOf<ids>::Type> || ...);
  if constexpr (kInTiles) entry.kernels.row = &RunRowBlocks<ids...>;
  constexpr bool kStoresDepth = sizeof...(ids) == 1 && ((ids == StageId::depth_always) || ...);
  if constexpr (kInTiles && (kStores || kStoresDepth) && TakenSlots<ids...>() == 0)
    entry.kernels.tile = &RunTileBlocks<ids...>;
  if constexpr ((RunsInGroups<typename BodyOf<ids>::Type> && ...) && TakenSlots<ids...>() == 0 && GoesByGroups<ids...>())
    entry.kernels.groups = &RunTileGroups<ids...>;
  // A pixel at a time the queue of packed fragments is faster (0.89).
  if constexpr (kPacks && kStores && kLanes > 1 && TakenSlots<ids...>() == 0)
    entry.kernels.lines = &RunLineStages<ids...>;
  if constexpr (sizeof...(ids) == 1) {
    entry.kernels.given_depth = entry.kernels.block;
    if constexpr ((TakesDepth<typename BodyOf<ids>::Type> && ...))
      entry.kernels.given_depth = &RunStages<GivenDepthLanes, ids...>;
  }
  return entry;
}

KernelPair FindKernels(const StageId* ids, int length) {
  using enum StageId;
  static constexpr Entry kAlone[] = {
#define STAGE(id, body, reads, writes) MakeEntry<StageId::id>(),
#include "raster/fragment/stages.def"
#undef STAGE
  };
  static constexpr Entry kFused[] = {
#define FUSED(...) MakeEntry<__VA_ARGS__>(),
#include "raster/fragment/fused.def"
#undef FUSED
  };
  if (length == 1) return kAlone[static_cast<size_t>(ids[0])].kernels;
  for (const Entry& entry : kFused) {
    bool same = entry.count == length;
    for (int i = 0; same && i < length; ++i) same = entry.ids[i] == ids[i];
    if (same) return entry.kernels;
  }
  return {};
}

}  // namespace HWY_NAMESPACE
}  // namespace halfspace::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace halfspace::raster {
namespace {
using Finder = KernelPair (*)(const StageId*, int);
Finder select_finder() { HALFSPACE_SELECT_FUNCTION(FindKernels) }
}  // namespace

KernelPair find_kernels(const StageId* ids, int count) { return select_finder()(ids, count); }
}  // namespace halfspace::raster
#endif
