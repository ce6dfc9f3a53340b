// glXChooseFBConfig and glXChooseVisual: matching (GLX 1.4, 3.3.3, table 3.4) and the order of what matches.
#pragma once

#include <span>
#include <vector>

#include "gl/glx/fb_config.h"

namespace halfspace::gl::glx {

// The configs that match `attributes` (pairs up to None; null: all defaults), best first. Empty also when the
// list names an attribute nobody knows.
std::vector<const FbConfig*> choose_configs(std::span<const FbConfig> configs, const int* attributes);

// The best config for a glXChooseVisual list, in which booleans stand alone; null when none matches.
const FbConfig* choose_visual(std::span<const FbConfig> configs, const int* attributes);

}  // namespace halfspace::gl::glx
