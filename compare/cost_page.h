// docs/accuracy.md: what was measured, with pictures, and what it means.
#pragma once

#include <string>

#include "compare/cost.h"
#include "compare/effects.h"

namespace halfspace::compare {

struct AccuracyMeasured {
  CostResult scenes;  // the reference scenes and the one with everything
  CostResult cases;   // the hard cases, at the three levels and by other renderers
  EffectsResult effects;
};

// The page; it shows accuracy/cost.svg, accuracy/axes.svg, accuracy/scenes.svg and accuracy/effects.svg
// beside it.
std::string accuracy_page(const AccuracyMeasured& measured);

// The scene on which every axis of the dial has something to do, or else all of them as one.
CostScene scene_for_axes(const CostResult& result);

}  // namespace halfspace::compare
