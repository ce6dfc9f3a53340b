// All state that OpenGL 1.1 lets a program ask for, by name, with the attribute groups that save it. Plain GL
// calls.
#pragma once

#include <GL/gl.h>

#include <map>
#include <string>
#include <vector>

namespace halfspace::test {

// Bits of glPushAttrib, and beside them those of glPushClientAttrib.
enum AttributeGroup : unsigned {
  kNone = 0,
  kCurrent = GL_CURRENT_BIT,
  kPoint = GL_POINT_BIT,
  kLine = GL_LINE_BIT,
  kPolygon = GL_POLYGON_BIT,
  kPolygonStipple = GL_POLYGON_STIPPLE_BIT,
  kPixelMode = GL_PIXEL_MODE_BIT,
  kLighting = GL_LIGHTING_BIT,
  kFog = GL_FOG_BIT,
  kDepthBuffer = GL_DEPTH_BUFFER_BIT,
  kAccumBuffer = GL_ACCUM_BUFFER_BIT,
  kStencilBuffer = GL_STENCIL_BUFFER_BIT,
  kViewport = GL_VIEWPORT_BIT,
  kTransform = GL_TRANSFORM_BIT,
  kEnable = GL_ENABLE_BIT,
  kColorBuffer = GL_COLOR_BUFFER_BIT,
  kHint = GL_HINT_BIT,
  kEval = GL_EVAL_BIT,
  kList = GL_LIST_BIT,
  kTexture = GL_TEXTURE_BIT,
  kScissor = GL_SCISSOR_BIT,
  kClientPixelStore = 1u << 30,
  kClientVertexArray = 1u << 31,
};

struct StateRow {
  const char* text;
  GLenum name;
  int values;
  unsigned groups;
  bool settable;
};
const std::vector<StateRow>& all_state_rows();  // of gl_state.def

struct StateValue {
  std::vector<double> values;
  unsigned groups;
  bool operator==(const StateValue&) const = default;
};
using GlSnapshot = std::map<std::string, StateValue>;

// Not between Begin and End. Leaves no error; GL_NO_ERROR must be the state before.
GlSnapshot take_gl_snapshot();

// The names of what differs, for a message.
std::string differences(const GlSnapshot& expected, const GlSnapshot& found);

}  // namespace halfspace::test
