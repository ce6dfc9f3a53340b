// What is found about one scene, whether it keeps the promise, and both as text and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/scene_run.h"
#include "tests/differential/judgement.h"

namespace halfspace::differential {

// What the standard level promises against the truth.
constexpr double kMostInteriorLevels = 0.55;
constexpr double kMostWrongPercent = 0.02;
// And the draft level against the truth by the 8-bit filter.
constexpr double kMostDraftWrongPercent = 0.1;

// One picture against both truths by the filter it is drawn with.
struct Standing {
  Judgement snapped, ideal;
  const Judgement& contract() const { return kContract == Positions::snapped ? snapped : ideal; }
};

struct SceneVerdict {
  int scene = 0;
  double truth_seconds = 0;  // spent on the true pictures
  Standing ours, ours_draft;
  // Absent when there is no OSMesa.
  std::optional<Standing> osmesa, osmesa_float;
  std::optional<Disagreement> standard_to_float, draft_to_default;

  uint64_t pixels() const { return ours.snapped.pixels; }
  // The promises we break, in words; empty: none.
  std::vector<std::string> broken() const;
};

std::string to_text(const std::vector<SceneVerdict>& verdicts);
nlohmann::json to_json(const std::vector<SceneVerdict>& verdicts);

}  // namespace halfspace::differential
