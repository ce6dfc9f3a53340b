// The stages' code, compiled once per ISA level: each alone, and fused.
#include "raster/fragment/program.h"
#include "raster/isa.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/fragment/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace halfspace::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#include "raster/fragment/lanes.inl"
#include "raster/fragment/stages/alpha_test.inl"
#include "raster/fragment/stages/blend.inl"
#include "raster/fragment/stages/color.inl"
#include "raster/fragment/stages/coord.inl"
#include "raster/fragment/stages/depth.inl"
#include "raster/fragment/stages/env.inl"
#include "raster/fragment/stages/lambda.inl"
#include "raster/fragment/stages/sample.inl"
#include "raster/fragment/stages/levels.inl"
#include "raster/fragment/stages/write.inl"

enum SlotGroup : unsigned { kNone = 0, kColor = 1, kCoord = 2, kTexel = 4, kLevel = 8 };

struct SlotRange {
  unsigned group;
  int first, last;
};
inline constexpr SlotRange kSlotRanges[] = {
    {kColor, kR, kA}, {kCoord, kS, kT}, {kTexel, kTexR, kTexA}, {kLevel, kLambda, kLambda}};

template <class L, class Body, unsigned kReads, unsigned kWrites>
void RunAlone(BlockContext& c) {
  for (int i = 0; i < kBlockPixels; i += kLanes) {
    if (!L::IsLive(c, i)) continue;
    Lanes v;
    v.live = L::LoadLive(c, i);
    for (const SlotRange& range : kSlotRanges)
      if ((kReads & range.group) != 0)
        for (int s = range.first; s <= range.last; ++s) v.slot[s] = hn::Load(DF(), c.slot[s] + i);
    Body::template Run<L>(c, i, v);
    for (const SlotRange& range : kSlotRanges)
      if ((kWrites & range.group) != 0)
        for (int s = range.first; s <= range.last; ++s) hn::Store(v.slot[s], DF(), c.slot[s] + i);
    if constexpr (Body::kKills) L::StoreLive(c, i, v.live);
  }
}

template <StageId id>
struct BodyOf;
#define STAGE(id, body, reads, writes)        \
  template <>                                 \
  struct BodyOf<StageId::id> {                \
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

// Runs one stage on a group; false when no lane is left.
template <class L, StageId id>
HWY_INLINE bool Step(const BlockContext& c, int i, Lanes& v) {
  BodyOf<id>::Type::template Run<L>(c, i, v);
  if constexpr (BodyOf<id>::Type::kKills) return !hn::AllFalse(DF(), v.live);
  return true;
}

template <class L, StageId... ids>
void RunFused(BlockContext& c) {
  for (int i = 0; i < kBlockPixels; i += kLanes) {
    if (!L::IsLive(c, i)) continue;
    Lanes v;
    v.live = L::LoadLive(c, i);
    (Step<L, ids>(c, i, v) && ...);
  }
}

// One row a stage, one row a fused list; `packed` is null where the lanes cannot be packed.
struct Entry {
  StageId ids[kMaxStages];
  int count;
  BlockFunction block, packed;
};

template <StageId id, unsigned kReads, unsigned kWrites>
constexpr Entry AloneEntry() {
  using Body = typename BodyOf<id>::Type;
  Entry entry{{id}, 1, &RunAlone<BlockLanes, Body, kReads, kWrites>, nullptr};
  if constexpr (Body::kPacks) entry.packed = &RunAlone<PackedLanes, Body, kReads, kWrites>;
  return entry;
}

template <StageId... ids>
constexpr Entry FusedEntry() {
  Entry entry{{ids...}, static_cast<int>(sizeof...(ids)), &RunFused<BlockLanes, ids...>, nullptr};
  if constexpr ((BodyOf<ids>::Type::kPacks && ...)) entry.packed = &RunFused<PackedLanes, ids...>;
  return entry;
}

KernelPair StageKernels(StageId id) {
  static constexpr Entry kEntries[] = {
#define STAGE(id, body, reads, writes) AloneEntry<StageId::id, (reads), (writes)>(),
#include "raster/fragment/stages.def"
#undef STAGE
  };
  const Entry& entry = kEntries[static_cast<size_t>(id)];
  return {entry.block, entry.packed};
}

KernelPair FusedKernels(const StageList& list) {
  using enum StageId;
  static constexpr Entry kEntries[] = {
#define FUSED(...) FusedEntry<__VA_ARGS__>(),
#include "raster/fragment/fused.def"
#undef FUSED
  };
  for (const Entry& entry : kEntries) {
    bool same = entry.count == list.count;
    for (int i = 0; same && i < list.count; ++i) same = entry.ids[i] == list.ids.data()[i];
    if (same) return {entry.block, entry.packed};
  }
  return {nullptr, nullptr};
}

}  // namespace HWY_NAMESPACE
}  // namespace halfspace::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace halfspace::raster {
namespace {
using StageSelector = KernelPair (*)(StageId);
using FusedSelector = KernelPair (*)(const StageList&);
StageSelector select_stage() { HALFSPACE_SELECT_FUNCTION(StageKernels) }
FusedSelector select_fused() { HALFSPACE_SELECT_FUNCTION(FusedKernels) }
}  // namespace

KernelPair stage_kernels(StageId id) { return select_stage()(id); }
KernelPair fused_kernels(const StageList& list) { return select_fused()(list); }
}  // namespace halfspace::raster
#endif
