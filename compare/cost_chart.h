// The result of `halfspace cost` as pictures (SVG).
#pragma once

#include <string>

#include "compare/cost.h"

namespace halfspace::compare {

// Time over error for one scene, a point a setting, with the Pareto front.
std::string scene_chart(const CostScene& scene);
// The same for every scene of `result`, small, side by side.
std::string scenes_chart(const CostResult& result);
// What each axis of the dial costs and buys: its time and its wrong pixels at draft and at exact, beside
// standard's.
std::string axes_chart(const CostScene& scene);

}  // namespace halfspace::compare
