// Each bit of glPushAttrib and glPushClientAttrib brings back its group, all of it and nothing else
// (spec 6.1.14; which group a value is of: spec tables 6.5 to 6.27).
#include <cstring>
#include <initializer_list>

#include "tests/api/gl_snapshot.h"
#include "tests/api/osmesa_context.h"

namespace halfspace::test {
namespace {

// Gives all state one of two values; where there are more than two, neither is the initial one.
class Setter {
 public:
  explicit Setter(bool second) : second_(second) {}
  void set_all() {
    set_enables();
    set_raster_position();
    set_vertex_state();
    set_lighting();
    set_shapes();
    set_textures();
    set_fragments();
    set_pixels();
    set_evaluators();
    set_client_state();
    set_matrices();
  }

 private:
  template <class T>
  T pick(T a, T b) const {
    return second_ ? b : a;
  }
  GLenum pick_enum(GLenum a, GLenum b) const { return pick(a, b); }
  GLboolean flag(bool first) const { return first != second_ ? GL_TRUE : GL_FALSE; }
  // `n` different values in [0, 1], others for the other set.
  std::array<GLfloat, 4> unit(int n) const {
    const float base = static_cast<float>(n % 16) / 32 + pick(0.0f, 0.25f);
    return {base, base + 0.0625f, base + 0.125f, base + 0.1875f};
  }

  // The first value of a capability is the one it does not have at the start.
  void set_enables() const {
    for (const StateRow& row : all_state_rows()) {
      if (!(row.groups & kEnable)) continue;
      const bool initially = row.name == GL_DITHER;
      (initially == second_ ? glEnable : glDisable)(row.name);
    }
  }

  // While nothing stands in its way.
  void set_raster_position() const {
    glPushAttrib(GL_ENABLE_BIT | GL_TRANSFORM_BIT);
    for (GLenum i = 0; i < 6; ++i) glDisable(GL_CLIP_PLANE0 + i);
    for (const GLenum cap : std::initializer_list<GLenum>{GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T,
                                                          GL_TEXTURE_GEN_R, GL_TEXTURE_GEN_Q, GL_LIGHTING})
      glDisable(cap);
    for (const GLenum mode : std::initializer_list<GLenum>{GL_TEXTURE, GL_PROJECTION, GL_MODELVIEW}) {
      glMatrixMode(mode);
      glLoadIdentity();
    }
    glViewport(0, 0, 5, 3);
    glColor4fv(unit(1).data());
    glTexCoord4fv(unit(2).data());
    glIndexf(pick(3.0f, 4.0f));
    glRasterPos3f(pick(0.25f, -0.5f), pick(-0.25f, 0.5f), pick(0.125f, -0.625f));
    glPopAttrib();
  }

  void set_vertex_state() const {
    glColor4fv(unit(3).data());
    glTexCoord4fv(unit(4).data());
    glNormal3fv(unit(5).data());
    glIndexf(pick(5.0f, 6.0f));
    glEdgeFlag(flag(false));
    glViewport(pick(1, 2), pick(3, 4), pick(5, 6), pick(7, 8));
    glDepthRange(pick(0.25, 0.125), pick(0.5, 0.75));
    for (GLenum i = 0; i < 6; ++i) {
      const GLdouble plane[] = {pick(1.0, 2.0), 3, 4, 5.0 + i};
      glClipPlane(GL_CLIP_PLANE0 + i, plane);
    }
    glListBase(pick(7u, 8u));
  }

  void set_lighting() const {
    for (GLenum i = 0; i < 8; ++i) {
      const GLenum light = GL_LIGHT0 + i;
      const int n = static_cast<int>(i);
      glLightfv(light, GL_AMBIENT, unit(n).data());
      glLightfv(light, GL_DIFFUSE, unit(n + 1).data());
      glLightfv(light, GL_SPECULAR, unit(n + 2).data());
      glLightfv(light, GL_POSITION, unit(n + 3).data());
      glLightfv(light, GL_SPOT_DIRECTION, unit(n + 4).data());
      glLightf(light, GL_SPOT_EXPONENT, pick(1.0f, 2.0f));
      glLightf(light, GL_SPOT_CUTOFF, pick(30.0f, 40.0f));
      glLightf(light, GL_CONSTANT_ATTENUATION, pick(3.0f, 4.0f));
      glLightf(light, GL_LINEAR_ATTENUATION, pick(5.0f, 6.0f));
      glLightf(light, GL_QUADRATIC_ATTENUATION, pick(7.0f, 8.0f));
    }
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, unit(1).data());
    glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, pick(1, 0));
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, pick(1, 0));
    glShadeModel(pick_enum(GL_FLAT, GL_SMOOTH));
    glColorMaterial(pick_enum(GL_FRONT, GL_BACK), GL_EMISSION);
    for (const GLenum face : std::initializer_list<GLenum>{GL_FRONT, GL_BACK}) {
      const int n = face == GL_FRONT ? 2 : 7;
      glMaterialfv(face, GL_AMBIENT, unit(n).data());
      glMaterialfv(face, GL_DIFFUSE, unit(n + 1).data());
      glMaterialfv(face, GL_SPECULAR, unit(n + 2).data());
      glMaterialfv(face, GL_EMISSION, unit(n + 4).data());
      glMaterialf(face, GL_SHININESS, pick(3.0f, 4.0f));
      glMaterialfv(face, GL_COLOR_INDEXES, unit(n + 3).data());
    }
    glColorMaterial(pick_enum(GL_FRONT, GL_BACK), pick_enum(GL_EMISSION, GL_AMBIENT));
    glFogfv(GL_FOG_COLOR, unit(1).data());
    glFogf(GL_FOG_INDEX, pick(1.0f, 2.0f));
    glFogf(GL_FOG_DENSITY, pick(3.0f, 4.0f));
    glFogf(GL_FOG_START, pick(5.0f, 6.0f));
    glFogf(GL_FOG_END, pick(7.0f, 8.0f));
    glFogi(GL_FOG_MODE, pick(GL_LINEAR, GL_EXP2));
  }

  void set_shapes() const {
    glPointSize(pick(2.0f, 3.0f));
    glLineWidth(pick(4.0f, 5.0f));
    glLineStipple(pick(2, 3), pick<GLushort>(0x1234, 0x4321));
    glCullFace(pick_enum(GL_FRONT, GL_FRONT_AND_BACK));
    glFrontFace(pick_enum(GL_CW, GL_CCW));
    glPolygonMode(GL_FRONT, pick_enum(GL_LINE, GL_POINT));
    glPolygonMode(GL_BACK, pick_enum(GL_POINT, GL_LINE));
    glPolygonOffset(pick(1.0f, 2.0f), pick(3.0f, 4.0f));
    std::array<GLubyte, 128> stipple;
    for (size_t i = 0; i < stipple.size(); ++i) stipple[i] = static_cast<GLubyte>(i * pick(3u, 5u));
    glPushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT);
    for (const GLenum name : std::initializer_list<GLenum>{GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS,
                                                           GL_UNPACK_SKIP_PIXELS, GL_UNPACK_LSB_FIRST})
      glPixelStorei(name, 0);
    glPolygonStipple(stipple.data());
    glPopClientAttrib();
    glHint(GL_PERSPECTIVE_CORRECTION_HINT, pick_enum(GL_FASTEST, GL_NICEST));
    glHint(GL_POINT_SMOOTH_HINT, pick_enum(GL_NICEST, GL_FASTEST));
    glHint(GL_LINE_SMOOTH_HINT, pick_enum(GL_FASTEST, GL_NICEST));
    glHint(GL_POLYGON_SMOOTH_HINT, pick_enum(GL_NICEST, GL_FASTEST));
    glHint(GL_FOG_HINT, pick_enum(GL_FASTEST, GL_NICEST));
  }

  // One object a target and set, so that the bindings differ; its parameters are what the other set has not.
  void set_textures() const {
    for (const GLenum target : std::initializer_list<GLenum>{GL_TEXTURE_1D, GL_TEXTURE_2D}) {
      glBindTexture(target, (target == GL_TEXTURE_1D ? 10u : 20u) + pick(1u, 2u));
      glTexParameteri(target, GL_TEXTURE_MIN_FILTER, pick(GL_NEAREST, GL_LINEAR));
      glTexParameteri(target, GL_TEXTURE_MAG_FILTER, pick(GL_NEAREST, GL_LINEAR));
      glTexParameteri(target, GL_TEXTURE_WRAP_S, pick(GL_CLAMP, GL_REPEAT));
      glTexParameteri(target, GL_TEXTURE_WRAP_T, pick(GL_CLAMP, GL_REPEAT));
      glTexParameterfv(target, GL_TEXTURE_BORDER_COLOR, unit(1).data());
      glTexParameterf(target, GL_TEXTURE_PRIORITY, pick(0.25f, 0.5f));
    }
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, pick(GL_DECAL, GL_BLEND));
    glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, unit(2).data());
    for (const GLenum coord : std::initializer_list<GLenum>{GL_S, GL_T, GL_R, GL_Q}) {
      const int n = static_cast<int>(coord - GL_S);
      glTexGeni(coord, GL_TEXTURE_GEN_MODE, pick(GL_OBJECT_LINEAR, GL_EYE_LINEAR));
      glTexGenfv(coord, GL_OBJECT_PLANE, unit(3 + n).data());
      glTexGenfv(coord, GL_EYE_PLANE, unit(7 + n).data());
    }
  }

  void set_fragments() const {
    glScissor(pick(1, 2), pick(3, 4), pick(5, 6), pick(7, 8));
    glAlphaFunc(pick_enum(GL_LESS, GL_GREATER), pick(0.25f, 0.5f));
    glBlendFunc(pick_enum(GL_SRC_ALPHA, GL_DST_COLOR), pick_enum(GL_DST_ALPHA, GL_SRC_COLOR));
    glLogicOp(pick_enum(GL_XOR, GL_NAND));
    glDepthFunc(pick_enum(GL_EQUAL, GL_GREATER));
    glDepthMask(flag(false));
    glClearDepth(pick(0.25, 0.5));
    glStencilFunc(pick_enum(GL_LESS, GL_GREATER), pick(3, 4), pick(5u, 6u));
    glStencilOp(pick_enum(GL_ZERO, GL_INCR), pick_enum(GL_DECR, GL_INVERT), pick_enum(GL_REPLACE, GL_ZERO));
    glStencilMask(pick(7u, 8u));
    glClearStencil(pick(9, 10));
    glColorMask(flag(false), flag(true), flag(false), flag(true));
    glIndexMask(pick(11u, 12u));
    glClearColor(pick(0.25f, 0.5f), 0.75f, 0.125f, 1);
    glClearIndex(pick(13.0f, 14.0f));
    glClearAccum(pick(0.25f, -0.5f), 0.75f, 0.125f, 1);
    glDrawBuffer(pick_enum(GL_NONE, GL_FRONT_LEFT));
    glReadBuffer(pick_enum(GL_LEFT, GL_FRONT_LEFT));
  }

  void set_pixels() const {
    glPixelZoom(pick(2.0f, 3.0f), pick(4.0f, 5.0f));
    glPixelTransferi(GL_MAP_COLOR, pick(1, 0));
    glPixelTransferi(GL_MAP_STENCIL, pick(1, 0));
    glPixelTransferi(GL_INDEX_SHIFT, pick(1, 2));
    glPixelTransferi(GL_INDEX_OFFSET, pick(3, 4));
    for (const GLenum name : std::initializer_list<GLenum>{
             GL_RED_SCALE, GL_RED_BIAS, GL_GREEN_SCALE, GL_GREEN_BIAS, GL_BLUE_SCALE, GL_BLUE_BIAS,
             GL_ALPHA_SCALE, GL_ALPHA_BIAS, GL_DEPTH_SCALE, GL_DEPTH_BIAS})
      glPixelTransferf(name, pick(2.0f, 3.0f));
    for (GLenum map = GL_PIXEL_MAP_I_TO_I; map <= GL_PIXEL_MAP_A_TO_A; ++map)
      glPixelMapfv(map, pick(2, 4), unit(3).data());
  }

  void set_evaluators() const {
    glMapGrid1f(pick(2, 3), pick(0.25f, 0.5f), pick(2.0f, 3.0f));
    glMapGrid2f(pick(2, 3), pick(0.25f, 0.5f), pick(2.0f, 3.0f), pick(4, 5), pick(0.5f, 0.75f),
                pick(3.0f, 4.0f));
    std::array<GLfloat, 16> points;
    for (size_t i = 0; i < points.size(); ++i) points[i] = static_cast<float>(i) * pick(0.5f, 0.25f);
    glMap1f(GL_MAP1_VERTEX_3, pick(0.0f, 1.0f), 2, 3, pick(2, 3), points.data());
    glMap2f(GL_MAP2_VERTEX_4, pick(0.0f, 1.0f), 2, 4, pick(1, 2), 0, 3, 4, pick(2, 1), points.data());
  }

  void set_client_state() const {
    for (const GLenum array :
         std::initializer_list<GLenum>{GL_VERTEX_ARRAY, GL_NORMAL_ARRAY, GL_COLOR_ARRAY, GL_INDEX_ARRAY,
                                       GL_TEXTURE_COORD_ARRAY, GL_EDGE_FLAG_ARRAY})
      (second_ ? glDisableClientState : glEnableClientState)(array);
    static const GLubyte kElements[2] = {};
    const GLubyte* pointer = kElements + pick(0, 1);
    glVertexPointer(pick(2, 3), pick_enum(GL_SHORT, GL_INT), pick(4, 8), pointer);
    glNormalPointer(pick_enum(GL_SHORT, GL_INT), pick(4, 8), pointer);
    glColorPointer(pick(3, 4), pick_enum(GL_SHORT, GL_INT), pick(4, 8), pointer);
    glIndexPointer(pick_enum(GL_SHORT, GL_INT), pick(4, 8), pointer);
    glTexCoordPointer(pick(2, 3), pick_enum(GL_SHORT, GL_INT), pick(4, 8), pointer);
    glEdgeFlagPointer(pick(4, 8), pointer);
    for (const GLenum name : std::initializer_list<GLenum>{GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST,
                                                           GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST})
      glPixelStorei(name, pick(1, 0));
    for (const GLenum name :
         std::initializer_list<GLenum>{GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS,
                                       GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS})
      glPixelStorei(name, pick(2, 3));
    glPixelStorei(GL_PACK_ALIGNMENT, pick(1, 8));
    glPixelStorei(GL_UNPACK_ALIGNMENT, pick(2, 1));
  }

  void set_matrices() const {
    for (const GLenum mode : std::initializer_list<GLenum>{GL_MODELVIEW, GL_PROJECTION, GL_TEXTURE}) {
      glMatrixMode(mode);
      glTranslated(pick(1.0, 2.0), 3, 4);
    }
    glMatrixMode(pick_enum(GL_TEXTURE, GL_PROJECTION));
  }

  const bool second_;
};

class AttributeTest : public OsmesaTest {
 protected:
  static GlSnapshot set_all(bool second) {
    Setter(second).set_all();
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    const GlSnapshot snapshot = take_gl_snapshot();
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    return snapshot;
  }
  // The first snapshot's values in `groups`, the second one's elsewhere.
  static GlSnapshot mixed(const GlSnapshot& first, const GlSnapshot& second, unsigned groups) {
    GlSnapshot result = second;
    for (const auto& [name, value] : first) {
      if (value.groups & groups) result[name] = value;
    }
    return result;
  }
  // Values that follow the current colour, while colour material is on, or that an invalid position would
  // have.
  static void leave_out(GlSnapshot& snapshot) {
    for (const char* name : {"front GL_EMISSION", "back GL_AMBIENT", "GL_CURRENT_RASTER_POSITION_VALID"})
      snapshot.erase(name);
  }
};

// What the other tests rest on: the two sets differ in every value a group saves.
TEST_F(AttributeTest, TheTwoSetsDiffer) {
  GlSnapshot first = set_all(false), second = set_all(true);
  leave_out(first);
  for (const auto& [name, value] : first) {
    if (value.groups == kNone || name.find("GL_TEXTURE_WIDTH") != name.npos ||
        name.find("GL_TEXTURE_HEIGHT") != name.npos || name.ends_with("D GL_TEXTURE_BORDER") ||
        name.find("INTERNAL_FORMAT") != name.npos)
      continue;
    EXPECT_NE(value.values, second[name].values) << name;
  }
}

TEST_F(AttributeTest, EachBitSavesItsGroup) {
  const unsigned bits[] = {kAccumBuffer,
                           kColorBuffer,
                           kCurrent,
                           kDepthBuffer,
                           kEnable,
                           kEval,
                           kFog,
                           kHint,
                           kLighting,
                           kLine,
                           kList,
                           kPixelMode,
                           kPoint,
                           kPolygon,
                           kPolygonStipple,
                           kScissor,
                           kStencilBuffer,
                           kTexture,
                           kTransform,
                           kViewport,
                           GL_ALL_ATTRIB_BITS & 0xFFFFF,
                           kPoint | kLine,
                           0};
  for (const unsigned bit : bits) {
    GlSnapshot first = set_all(false);
    glPushAttrib(bit);
    GlSnapshot second = set_all(true);
    second["GL_ATTRIB_STACK_DEPTH"].values[0] -= 1;
    glPopAttrib();
    GlSnapshot found = take_gl_snapshot();
    GlSnapshot expected = mixed(first, second, bit);
    leave_out(expected);
    EXPECT_EQ(differences(expected, found), "") << "bit " << std::hex << bit;
  }
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(AttributeTest, EachClientBitSavesItsGroup) {
  const struct {
    GLbitfield mask;
    unsigned groups;
  } kCases[] = {{GL_CLIENT_PIXEL_STORE_BIT, kClientPixelStore},
                {GL_CLIENT_VERTEX_ARRAY_BIT, kClientVertexArray},
                {GL_CLIENT_ALL_ATTRIB_BITS, kClientPixelStore | kClientVertexArray},
                {0, kNone}};
  for (const auto& [mask, groups] : kCases) {
    GlSnapshot first = set_all(false);
    glPushClientAttrib(mask);
    GlSnapshot second = set_all(true);
    second["GL_CLIENT_ATTRIB_STACK_DEPTH"].values[0] -= 1;
    glPopClientAttrib();
    const GlSnapshot found = take_gl_snapshot();
    EXPECT_EQ(differences(mixed(first, second, groups), found), "") << "mask " << std::hex << mask;
  }
}

// glGet answers every name of OpenGL 1.1, in all four types.
TEST_F(AttributeTest, EveryNameIsAnswered) {
  for (const StateRow& row : all_state_rows()) {
    std::vector<GLdouble> doubles(17, -77);
    std::vector<GLfloat> floats(17, -77);
    std::vector<GLint> integers(17, -77);
    std::vector<GLboolean> booleans(17, 0x77);
    glGetDoublev(row.name, doubles.data());
    glGetFloatv(row.name, floats.data());
    glGetIntegerv(row.name, integers.data());
    glGetBooleanv(row.name, booleans.data());
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)) << row.text;
    for (size_t i = 0; i < 17; ++i) {
      const bool answered = i < static_cast<size_t>(row.values);
      EXPECT_EQ(doubles[i] != -77, answered) << row.text << " value " << i;
      EXPECT_EQ(floats[i] != -77, answered) << row.text << " value " << i;
      EXPECT_EQ(integers[i] != -77, answered) << row.text << " value " << i;
      EXPECT_EQ(booleans[i] != 0x77, answered) << row.text << " value " << i;
    }
  }
}

}  // namespace
}  // namespace halfspace::test
