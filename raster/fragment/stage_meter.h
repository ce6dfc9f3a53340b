// What each stage did and how long it took, for HALFSPACE_STATS. Nothing is counted, or costs, unless asked
// for.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace halfspace::raster {

inline constexpr int kMaxStageIds = 160;

struct StageMeter {
  std::array<uint64_t, kMaxStageIds> fragments{};  // lanes alive when the stage began
  std::array<uint64_t, kMaxStageIds> nanoseconds{};
  void add(const StageMeter& other) {
    for (size_t i = 0; i < kMaxStageIds; ++i) {
      fragments[i] += other.fragments[i];
      nanoseconds[i] += other.nanoseconds[i];
    }
  }
};

// As in raster/fragment/stages.def; `id` is a StageId.
std::string_view stage_name(int id);

}  // namespace halfspace::raster
