// Hints (spec 5.6).
#pragma once

#include "raster/api/accuracy.h"
#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

struct HintState {
  GLenum perspective_correction = GL_DONT_CARE;
  GLenum point_smooth = GL_DONT_CARE;
  GLenum line_smooth = GL_DONT_CARE;
  GLenum polygon_smooth = GL_DONT_CARE;
  GLenum fog = GL_DONT_CARE;
  // What GL_DONT_CARE stands for, and everything there is no hint for (GL_HALFSPACE_accuracy).
  raster::Accuracy accuracy;
};

// `hint` over `level`: GL_FASTEST is draft, GL_NICEST exact.
raster::Level hinted_level(GLenum hint, raster::Level level);

// The accuracy draws have under the hints; coverage is each kind of shape's own matter.
raster::Accuracy hinted_accuracy(const HintState& hint);

// glAccuracyHALFSPACE. Not compiled into display lists.
void set_accuracy(Context& context, GLenum axis, GLenum level);

// Names of GL_HALFSPACE_accuracy (docs/extensions/HALFSPACE_accuracy.txt).
enum AccuracyName : GLenum {
  kAllAxes = 0x19190,
  kFirstAxis = 0x19191,   // those of raster::kAccuracyAxes, in that order
  kFirstLevel = 0x191A0,  // draft, standard, exact
};

}  // namespace halfspace::state
