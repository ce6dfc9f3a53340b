// What each effect costs, and that one which is off costs nothing: `halfspace cost --effects`.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/cost.h"

namespace halfspace::compare {

// A stage of the fragment programs, as HALFSPACE_STATS prints it.
struct StageUse {
  std::string name;
  uint64_t fragments = 0;
};

// The first picture of a log that HALFSPACE_STATS=1 left.
struct PictureStatistics {
  uint64_t vertices = 0, lit_vertices = 0, fragments = 0;
  std::vector<StageUse> stages;  // those that ran
};

// Throws std::runtime_error when there is no picture in `log`.
PictureStatistics statistics_of(const std::string& log);

// The scene with all effects up to this one.
struct EffectStep {
  std::string name, description;
  Summary ours, mesa;  // ms of processor time
  PictureStatistics statistics;
  std::vector<std::string> stages;     // the effect's own that ran
  std::optional<double> instructions;  // of ours, a frame
};

struct EffectsResult {
  std::string processor, our_renderer, our_version, mesa_version;
  int width = 0, height = 0, rounds = 0;
  std::vector<EffectStep> steps;  // each with one effect more
  // The first step after every other effect has been set up and switched off again.
  EffectStep idle;
  Summary idle_ratio;  // to the first step, in the same round
  // Fragments that stages saw, and vertices that were lit, in steps without the effect: nothing, when what is
  // off is absent.
  uint64_t done_while_off = 0;
};

// Draws ref_app_effects; of `options`: rounds, frames, size, core, library, out. With `instructions` also
// counts them, by valgrind. Throws what draw_scenes throws.
EffectsResult measure_effects(const CostOptions& options, bool instructions, const Progress& progress);

// Fills in each step's `stages` and `done_while_off` from the statistics. Throws std::runtime_error when an
// effect is on and none of the stages known as its own ran.
void find_stages(EffectsResult& result);

std::string to_text(const EffectsResult& result);
nlohmann::json to_json(const EffectsResult& result);
// Each effect's time on top of those before it, ours and llvmpipe's.
std::string effects_chart(const EffectsResult& result);

}  // namespace halfspace::compare
