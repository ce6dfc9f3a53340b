// One scene in plain OpenGL 1.1 to which effects are added one by one, so that each shows what it costs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ref_app/scenes.h"

namespace ref_app {

// In this order; a scene has all effects up to its own.
enum class Effect : uint8_t {
  flat,         // nothing but the primitives, an object in one colour
  smooth,       // a colour a vertex
  depth,        // depth test and writes
  texture,      // nearest texel, modulated by the colour
  perspective,  // w of the vertices is not 1 any more; what is covered stays the same
  filter,       // linear between texels
  mipmap,       // linear between levels
  light,        // two lights with highlights, normals
  fog,
  blend,
  stencil,     // counts the fragments of each pixel; passes everywhere
  alpha_test,  // passes everywhere
};

// "flat" .. "alpha_test"; then "everything", another name of the last one; and "idle": the first one after
// all others have been set up and switched off.
std::vector<std::string> effect_names();
const char* effect_description(const std::string& name);

// `name` is one of effect_names(). Needs a current context with a stencil buffer.
std::unique_ptr<Scene> make_effect_scene(const std::string& name);

}  // namespace ref_app
