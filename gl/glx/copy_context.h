// glXCopyContext.
#pragma once

#include "state/context.h"

namespace halfspace::gl::glx {

// Copies the attribute groups of `mask` (glPushAttrib's bits) from one context to another that is current
// nowhere.
void copy_attributes(const state::Context& from, state::Context& to, unsigned long mask);

}  // namespace halfspace::gl::glx
