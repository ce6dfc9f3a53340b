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

template <class Body, unsigned kReads, unsigned kWrites>
void RunAlone(BlockContext& c) {
  for (int i = 0; i < kBlockPixels; i += kLanes) {
    if (!GroupIsLive(c, i)) continue;
    Lanes v;
    v.live = LoadLive(c, i);
    for (const SlotRange& range : kSlotRanges)
      if ((kReads & range.group) != 0)
        for (int s = range.first; s <= range.last; ++s) v.slot[s] = hn::Load(DF(), c.slot[s] + i);
    Body::Run(c, i, v);
    for (const SlotRange& range : kSlotRanges)
      if ((kWrites & range.group) != 0)
        for (int s = range.first; s <= range.last; ++s) hn::Store(v.slot[s], DF(), c.slot[s] + i);
    if constexpr (Body::kKills) StoreLive(c, i, v.live);
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
template <StageId id>
HWY_INLINE bool Step(const BlockContext& c, int i, Lanes& v) {
  BodyOf<id>::Type::Run(c, i, v);
  if constexpr (BodyOf<id>::Type::kKills) return !hn::AllFalse(DF(), v.live);
  return true;
}

template <StageId... ids>
void RunFused(BlockContext& c) {
  for (int i = 0; i < kBlockPixels; i += kLanes) {
    if (!GroupIsLive(c, i)) continue;
    Lanes v;
    v.live = LoadLive(c, i);
    (Step<ids>(c, i, v) && ...);
  }
}

BlockFunction StageFunction(StageId id) {
  static constexpr BlockFunction kFunctions[] = {
#define STAGE(id, body, reads, writes) &RunAlone<BodyOf<StageId::id>::Type, (reads), (writes)>,
#include "raster/fragment/stages.def"
#undef STAGE
  };
  return kFunctions[static_cast<size_t>(id)];
}

struct FusedEntry {
  StageId ids[kMaxStages];
  int count;
  BlockFunction function;
};

template <StageId... ids>
constexpr FusedEntry MakeFused() {
  return {{ids...}, static_cast<int>(sizeof...(ids)), &RunFused<ids...>};
}

BlockFunction FusedFunction(const StageList& list) {
  using enum StageId;
  static constexpr FusedEntry kEntries[] = {
#define FUSED(...) MakeFused<__VA_ARGS__>(),
#include "raster/fragment/fused.def"
#undef FUSED
  };
  for (const FusedEntry& entry : kEntries) {
    bool same = entry.count == list.count;
    for (int i = 0; same && i < list.count; ++i) same = entry.ids[i] == list.ids.data()[i];
    if (same) return entry.function;
  }
  return nullptr;
}

}  // namespace HWY_NAMESPACE
}  // namespace halfspace::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace halfspace::raster {
namespace {
using StageSelector = BlockFunction (*)(StageId);
using FusedSelector = BlockFunction (*)(const StageList&);
StageSelector select_stage() { HALFSPACE_SELECT_FUNCTION(StageFunction) }
FusedSelector select_fused() { HALFSPACE_SELECT_FUNCTION(FusedFunction) }
}  // namespace

BlockFunction stage_function(StageId id) { return select_stage()(id); }
BlockFunction fused_function(const StageList& list) { return select_fused()(list); }
}  // namespace halfspace::raster
#endif
