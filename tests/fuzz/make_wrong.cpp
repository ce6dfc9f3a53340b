// Calls GL refuses: the same error from everyone, and nothing else happens. And calls that mean nothing
// without colour indices.
#include "maker.h"

namespace halfspace::fuzz {
namespace {

struct Wrong {
  Command command;
  std::vector<double> arguments;
};

// No version of GL and no extension of Mesa's has this value.
constexpr double kNoEnum = 0x1234;

// One wrong argument each. Where a later version allows what 1.1 forbids there is no such line.
const std::vector<Wrong>& wrong_calls() {
  using enum Command;
  static const std::vector<Wrong> kWrong = {
      {glAccum, {kNoEnum, 0}},
      {glAlphaFunc, {kNoEnum, 0}},
      {glBegin, {kNoEnum}},
      {glBindTexture, {kNoEnum, 1}},
      {glBitmap, {-1, 1, 0, 0, 0, 0, 0}},
      {glBlendFunc, {kNoEnum, GL_ONE}},
      {glBlendFunc, {GL_ONE, kNoEnum}},
      {glBlendFunc, {GL_ONE, GL_SRC_ALPHA_SATURATE + 0x100}},
      {glCallLists, {-1, GL_BYTE, 0}},
      {glCallLists, {1, kNoEnum, 0}},
      {glClear, {0x1}},
      {glColorMaterial, {kNoEnum, GL_AMBIENT}},
      {glColorMaterial, {GL_FRONT, GL_SHININESS}},
      {glColorPointer, {2, GL_FLOAT, 0, 0}},
      {glColorPointer, {4, GL_FLOAT, -1, 0}},
      {glCopyPixels, {0, 0, -1, 1, GL_COLOR}},
      {glCopyPixels, {0, 0, 1, 1, kNoEnum}},
      {glCullFace, {kNoEnum}},
      {glDeleteLists, {1, -1}},
      {glDeleteTextures, {-1, 0}},
      {glDepthFunc, {kNoEnum}},
      {glDisable, {kNoEnum}},
      {glDisableClientState, {kNoEnum}},
      {glDrawArrays, {kNoEnum, 0, 3}},
      {glDrawArrays, {GL_TRIANGLES, 0, -1}},
      {glDrawBuffer, {kNoEnum}},
      {glDrawElements, {GL_TRIANGLES, -1, GL_UNSIGNED_INT, 0}},
      {glDrawElements, {GL_TRIANGLES, 3, GL_FLOAT, 0}},
      {glDrawPixels, {-1, 1, GL_RGBA, GL_UNSIGNED_BYTE, 0}},
      {glDrawPixels, {1, 1, kNoEnum, GL_UNSIGNED_BYTE, 0}},
      {glDrawPixels, {1, 1, GL_RGBA, kNoEnum, 0}},
      {glEdgeFlagPointer, {-1, 0}},
      {glEnable, {kNoEnum}},
      {glEnableClientState, {kNoEnum}},
      {glEvalMesh1, {GL_TRIANGLES, 0, 1}},
      {glEvalMesh2, {kNoEnum, 0, 1, 0, 1}},
      {glFogf, {GL_FOG_DENSITY, -1}},
      {glFogf, {kNoEnum, 1}},
      {glFogi, {GL_FOG_MODE, kNoEnum}},
      {glFrontFace, {kNoEnum}},
      {glFrustum, {-1, 1, -1, 1, 0, 1}},
      {glFrustum, {1, 1, -1, 1, 1, 2}},
      {glGenLists, {-1}},
      {glHint, {kNoEnum, GL_NICEST}},
      {glHint, {GL_FOG_HINT, kNoEnum}},
      {glIndexPointer, {GL_RGBA, 0, 0}},
      {glInterleavedArrays, {kNoEnum, 0, 0}},
      {glInterleavedArrays, {GL_V2F, -1, 0}},
      {glIsEnabled, {kNoEnum}},
      {glLightModelf, {kNoEnum, 1}},
      {glLightf, {GL_LIGHT0, GL_CONSTANT_ATTENUATION, -1}},
      {glLightf, {GL_LIGHT0, GL_SPOT_CUTOFF, 91}},
      {glLightf, {GL_LIGHT0, GL_SPOT_EXPONENT, 129}},
      {glLightf, {GL_LIGHT0, kNoEnum, 1}},
      {glLightf, {kNoEnum, GL_SPOT_EXPONENT, 1}},
      {glLineWidth, {-1}},
      {glLineWidth, {0}},
      {glLogicOp, {kNoEnum}},
      {glMapGrid1d, {0, 0, 1}},
      {glMapGrid2f, {0, 0, 1, 1, 0, 1}},
      {glMap1f, {GL_MAP1_VERTEX_3, 0, 1, 2, 2, 0}},
      {glMap1f, {GL_MAP1_VERTEX_3, 0, 1, 3, 0, 0}},
      {glMap1f, {GL_MAP1_VERTEX_3, 1, 1, 3, 2, 0}},
      {glMap1f, {kNoEnum, 0, 1, 3, 2, 0}},
      {glMap2f, {GL_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 0, 0}},
      {glMaterialf, {GL_FRONT, GL_SHININESS, 129}},
      {glMaterialf, {GL_FRONT, kNoEnum, 1}},
      {glMaterialf, {kNoEnum, GL_SHININESS, 1}},
      {glMatrixMode, {kNoEnum}},
      {glNormalPointer, {GL_UNSIGNED_BYTE, 0, 0}},
      {glOrtho, {-1, 1, -1, 1, 1, 1}},
      {glOrtho, {1, 1, -1, 1, -1, 1}},
      {glPixelMapfv, {GL_PIXEL_MAP_I_TO_R, 3, 0}},
      {glPixelMapfv, {GL_PIXEL_MAP_R_TO_R, 0, 0}},
      {glPixelMapfv, {kNoEnum, 1, 0}},
      {glPixelStorei, {GL_UNPACK_ALIGNMENT, 3}},
      {glPixelStorei, {GL_UNPACK_ROW_LENGTH, -1}},
      {glPixelStorei, {GL_PACK_SKIP_ROWS, -1}},
      {glPixelStorei, {kNoEnum, 1}},
      {glPixelTransferf, {kNoEnum, 1}},
      {glPointSize, {-1}},
      {glPointSize, {0}},
      {glPolygonMode, {kNoEnum, GL_FILL}},
      {glPolygonMode, {GL_FRONT, kNoEnum}},
      {glReadBuffer, {kNoEnum}},
      {glRenderMode, {kNoEnum}},
      {glScissor, {0, 0, -1, 1}},
      {glSelectBuffer, {-1, 0}},
      {glFeedbackBuffer, {-1, GL_2D, 0}},
      {glFeedbackBuffer, {1, kNoEnum, 0}},
      {glShadeModel, {kNoEnum}},
      {glStencilFunc, {kNoEnum, 0, 0}},
      {glStencilOp, {GL_KEEP, kNoEnum, GL_KEEP}},
      {glTexCoordPointer, {0, GL_FLOAT, 0, 0}},
      {glTexEnvi, {GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, kNoEnum}},
      {glTexEnvi, {GL_TEXTURE_ENV, kNoEnum, GL_MODULATE}},
      {glTexEnvi, {kNoEnum, GL_TEXTURE_ENV_MODE, GL_MODULATE}},
      {glTexGeni, {GL_S, GL_TEXTURE_GEN_MODE, kNoEnum}},
      {glTexGeni, {GL_R, GL_TEXTURE_GEN_MODE, GL_SPHERE_MAP}},
      {glTexGeni, {kNoEnum, GL_TEXTURE_GEN_MODE, GL_EYE_LINEAR}},
      {glTexImage2D, {GL_TEXTURE_2D, -1, GL_RGBA, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, 0}},
      {glTexImage2D, {GL_TEXTURE_2D, 0, GL_RGBA, -1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, 0}},
      {glTexImage2D, {GL_TEXTURE_2D, 0, GL_RGBA, 4, 4, 2, GL_RGBA, GL_UNSIGNED_BYTE, 0}},
      {glTexImage2D, {GL_TEXTURE_2D, 0, GL_RGBA, 1, 1, 0, kNoEnum, GL_UNSIGNED_BYTE, 0}},
      {glTexImage2D, {GL_TEXTURE_2D, 0, GL_RGBA, 1, 1, 0, GL_RGBA, kNoEnum, 0}},
      {glTexImage1D, {kNoEnum, 0, GL_RGBA, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, 0}},
      {glTexImage1D, {GL_TEXTURE_1D, 0, kNoEnum, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, 0}},
      {glTexParameteri, {GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR_MIPMAP_LINEAR}},
      {glTexParameteri, {GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, kNoEnum}},
      {glTexParameteri, {GL_TEXTURE_2D, kNoEnum, GL_LINEAR}},
      {glTexParameteri, {kNoEnum, GL_TEXTURE_WRAP_S, GL_CLAMP}},
      {glVertexPointer, {1, GL_FLOAT, 0, 0}},
      {glVertexPointer, {3, GL_UNSIGNED_BYTE, 0, 0}},
      {glViewport, {0, 0, 1, -1}},
  };
  return kWrong;
}

void add_wrong_call(Maker& m) {
  if (m.in_list) return;
  const std::vector<Wrong>& all = wrong_calls();
  const int count = m.random.between(1, 4);
  for (int i = 0; i < count; ++i) {
    const Wrong& wrong = all[static_cast<size_t>(m.random.below(static_cast<int>(all.size())))];
    // Something to point to, where there is a pointer: nobody should look at it.
    m.stream.push_back({wrong.command, wrong.arguments, std::vector<uint8_t>(256)});
  }
}

// Right elsewhere, refused between Begin and End (spec 2.6.3). The triangle is drawn as if nothing had been
// said.
void add_misplaced_call(Maker& m) {
  if (m.in_list) return;
  using enum Command;
  static const std::vector<Wrong> kMisplaced = {
      {glAlphaFunc, {GL_NEVER, 0}},
      {glBlendFunc, {GL_ZERO, GL_ZERO}},
      {glClear, {GL_COLOR_BUFFER_BIT}},
      {glClearColor, {1, 1, 1, 1}},
      {glColorMask, {0, 0, 0, 0}},
      {glCullFace, {GL_FRONT}},
      {glDepthFunc, {GL_NEVER}},
      {glDepthRange, {1, 0}},
      {glDisable, {GL_DEPTH_TEST}},
      {glEnable, {GL_SCISSOR_TEST}},
      {glFlush, {}},
      {glFrontFace, {GL_CW}},
      {glLineWidth, {7}},
      {glLoadIdentity, {}},
      {glMatrixMode, {GL_TEXTURE}},
      {glOrtho, {-1, 1, -1, 1, -1, 1}},
      {glPointSize, {7}},
      {glPolygonMode, {GL_FRONT_AND_BACK, GL_POINT}},
      {glPopMatrix, {}},
      {glPushAttrib, {GL_ALL_ATTRIB_BITS}},
      {glPushMatrix, {}},
      {glRasterPos2i, {0, 0}},
      {glRectf, {-1, -1, 1, 1}},
      {glRotatef, {45, 0, 0, 1}},
      {glScissor, {0, 0, 1, 1}},
      {glShadeModel, {GL_FLAT}},
      {glStencilFunc, {GL_NEVER, 0, 0}},
      {glTranslatef, {1, 1, 0}},
      {glViewport, {0, 0, 5, 5}},
  };
  Shape shape = random_shape(m);
  const auto inside = static_cast<size_t>(m.random.below(static_cast<int>(shape.vertices.size())));
  m.call(glBegin, {double(shape.mode)});
  for (size_t i = 0; i < shape.vertices.size(); ++i) {
    const Vertex& v = shape.vertices[i];
    const Wrong& wrong = kMisplaced[static_cast<size_t>(m.random.below(static_cast<int>(kMisplaced.size())))];
    if (i == inside) m.stream.push_back({wrong.command, wrong.arguments, {}});
    m.call(glColor4d, {v.color[0], v.color[1], v.color[2], v.color[3]});
    m.call(glVertex3d, {v.position[0], v.position[1], v.position[2]});
  }
  m.call(glEnd);
}

void add_index_state(Maker& m) {
  using enum Command;
  switch (m.random.below(6)) {
    case 0:
      return m.call(glIndexd, {m.random.real(0, 300)});
    case 1:
      return m.call(glIndexub, {double(m.random.below(256))});
    case 2:
      return m.call(glClearIndex, {double(m.random.below(256))});
    case 3:
      return m.call(glIndexMask, {double(m.random.below(256))});
    case 4:
      m.set_enabled(GL_INDEX_LOGIC_OP, m.random.chance(70));
      return m.call(glIndexi, {double(m.random.below(256))});
    default:
      return m.call(glFogi, {GL_FOG_INDEX, double(m.random.below(256))});
  }
}

// Indices that go through the maps to colours (spec 3.6.3). Mesa forgets to shift and offset them.
void add_index_pixels(Maker& m) {
  using enum Command;
  if (m.in_list || m.transfers) return;
  for (GLenum map = GL_PIXEL_MAP_I_TO_R; map <= GL_PIXEL_MAP_I_TO_A; ++map) {
    std::vector<float> table(static_cast<size_t>(1 << m.random.between(0, 5)));
    for (float& entry : table) entry = static_cast<float>(m.random.level());
    m.call(glPixelMapfv, {double(map), double(table.size()), 0}, table);
  }
  set_raster_position(m);
  const int width = m.random.between(1, 24), height = m.random.between(1, 16);
  std::vector<uint8_t> image;
  for (int i = 0; i < width * height; ++i) image.push_back(static_cast<uint8_t>(m.random.bits()));
  m.call(glPixelStorei, {GL_UNPACK_ALIGNMENT, 1});
  m.call(glDrawPixels, {double(width), double(height), GL_COLOR_INDEX, GL_UNSIGNED_BYTE, 0}, image);
}

}  // namespace

const std::vector<Feature>& refused_features() {
  static const std::vector<Feature> kFeatures = {
      {.group = "wrong", .add = add_wrong_call, .weight = 3},
      {.group = "wrong", .add = add_misplaced_call, .draws = true},
      {.group = "color_index", .add = add_index_state, .weight = 2},
      {.group = "color_index", .add = add_index_pixels, .draws = true},
  };
  return kFeatures;
}

}  // namespace halfspace::fuzz
