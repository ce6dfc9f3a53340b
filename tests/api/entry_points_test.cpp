// What the generated entry points do to their arguments on the way to the operations.
#include <array>
#include <cstdint>
#include <limits>

#include "tests/api/osmesa_context.h"

namespace halfspace::test {
namespace {

using Vector4 = std::array<float, 4>;

class EntryPointsTest : public OsmesaTest {
 protected:
  static Vector4 get(GLenum name) {
    Vector4 v{-9, -9, -9, -9};
    glGetFloatv(name, v.data());
    return v;
  }
  static Vector4 color() { return get(GL_CURRENT_COLOR); }
  static Vector4 tex_coord() { return get(GL_CURRENT_TEXTURE_COORDS); }
  static GLenum error() { return glGetError(); }
};

// Table 2.9: unsigned c / (2^n - 1), signed (2c + 1) / (2^n - 1); the largest value is exactly 1.
TEST_F(EntryPointsTest, IntegerColorsReachOne) {
  glColor4b(127, -128, 0, 63);
  EXPECT_EQ(color(), (Vector4{1.0f, -1.0f, 1 / 255.0f, 127 / 255.0f}));
  glColor4s(32767, -32768, 0, 16383);
  EXPECT_EQ(color(), (Vector4{1.0f, -1.0f, 1 / 65535.0f, 32767 / 65535.0f}));
  glColor4i(INT32_MAX, INT32_MIN, INT32_MAX, 0);
  EXPECT_EQ(color(), (Vector4{1.0f, -1.0f, 1.0f, static_cast<float>(1 / 4294967295.0)}));
  glColor4us(65535, 0, 13107, 39321);
  EXPECT_EQ(color(), (Vector4{1.0f, 0.0f, 0.2f, 0.6f}));
  glColor4ui(UINT32_MAX, 0, 858993459u, 2576980377u);
  EXPECT_EQ(color(), (Vector4{1.0f, 0.0f, 0.2f, 0.6f}));
}

TEST_F(EntryPointsTest, EveryUnsignedByteComesBack) {
  for (int c = 0; c < 256; ++c) {
    const auto byte = static_cast<GLubyte>(c);
    glColor4ub(byte, static_cast<GLubyte>(255 - c), byte, byte);
    const Vector4 expected{static_cast<float>(c / 255.0), static_cast<float>((255 - c) / 255.0),
                           static_cast<float>(c / 255.0), static_cast<float>(c / 255.0)};
    ASSERT_EQ(color(), expected) << c;
  }
}

TEST_F(EntryPointsTest, ThreeComponentColorsAreOpaque) {
  const std::array<GLbyte, 3> b{127, -128, 127};
  const std::array<GLshort, 3> s{32767, -32768, 32767};
  const std::array<GLint, 3> i{INT32_MAX, INT32_MIN, INT32_MAX};
  const std::array<GLubyte, 3> ub{255, 0, 255};
  const std::array<GLushort, 3> us{65535, 0, 65535};
  const std::array<GLuint, 3> ui{UINT32_MAX, 0, UINT32_MAX};
  const std::array<GLfloat, 3> f{0.25f, 0.5f, 0.75f};
  const std::array<GLdouble, 3> d{0.125, 0.5, 0.75};
  const Vector4 with_minus{1, -1, 1, 1}, with_zero{1, 0, 1, 1};
  glColor4f(0, 0, 0, 0);
  glColor3bv(b.data());
  EXPECT_EQ(color(), with_minus);
  glColor3sv(s.data());
  EXPECT_EQ(color(), with_minus);
  glColor3iv(i.data());
  EXPECT_EQ(color(), with_minus);
  glColor3ubv(ub.data());
  EXPECT_EQ(color(), with_zero);
  glColor3usv(us.data());
  EXPECT_EQ(color(), with_zero);
  glColor3uiv(ui.data());
  EXPECT_EQ(color(), with_zero);
  glColor3fv(f.data());
  EXPECT_EQ(color(), (Vector4{0.25f, 0.5f, 0.75f, 1}));
  glColor3dv(d.data());
  EXPECT_EQ(color(), (Vector4{0.125f, 0.5f, 0.75f, 1}));
  glColor3b(0, 127, 127);
  EXPECT_EQ(color(), (Vector4{1 / 255.0f, 1, 1, 1}));
  glColor3d(2.5, -1, 0);  // kept as given; clamped when it is used
  EXPECT_EQ(color(), (Vector4{2.5f, -1, 0, 1}));
}

TEST_F(EntryPointsTest, NormalsAreNormalizedIntegers) {
  const auto normal = [] {
    const Vector4 v = get(GL_CURRENT_NORMAL);
    return std::array<float, 3>{v[0], v[1], v[2]};
  };
  using Vector3 = std::array<float, 3>;
  glNormal3b(127, -128, 0);
  EXPECT_EQ(normal(), (Vector3{1, -1, 1 / 255.0f}));
  glNormal3s(32767, -32768, 0);
  EXPECT_EQ(normal(), (Vector3{1, -1, 1 / 65535.0f}));
  const std::array<GLint, 3> i{INT32_MAX, INT32_MIN, INT32_MAX};
  glNormal3iv(i.data());
  EXPECT_EQ(normal(), (Vector3{1, -1, 1}));
  glNormal3d(0.5, 2, -3);
  EXPECT_EQ(normal(), (Vector3{0.5f, 2, -3}));
}

TEST_F(EntryPointsTest, TextureCoordinatesArePaddedAndNotNormalized) {
  glTexCoord4f(9, 9, 9, 9);
  glTexCoord1s(-7);
  EXPECT_EQ(tex_coord(), (Vector4{-7, 0, 0, 1}));
  glTexCoord2i(3, 4);
  EXPECT_EQ(tex_coord(), (Vector4{3, 4, 0, 1}));
  const std::array<GLdouble, 3> d{0.5, -0.25, 8};
  glTexCoord3dv(d.data());
  EXPECT_EQ(tex_coord(), (Vector4{0.5f, -0.25f, 8, 1}));
  const std::array<GLshort, 4> s{1, 2, 3, 4};
  glTexCoord4sv(s.data());
  EXPECT_EQ(tex_coord(), (Vector4{1, 2, 3, 4}));
}

TEST_F(EntryPointsTest, EdgeFlagVector) {
  const GLboolean off = GL_FALSE;
  glEdgeFlagv(&off);
  GLboolean flag = GL_TRUE;
  glGetBooleanv(GL_EDGE_FLAG, &flag);
  EXPECT_EQ(flag, GL_FALSE);
}

TEST_F(EntryPointsTest, MatricesOfFloatsAndDoubles) {
  std::array<GLfloat, 16> f{};
  std::array<GLdouble, 16> d{};
  std::array<GLfloat, 16> got{};
  for (size_t i = 0; i < 16; ++i) {
    f[i] = static_cast<GLfloat>(i) + 0.5f;
    d[i] = static_cast<GLdouble>(i) - 0.25;
  }
  glLoadMatrixf(f.data());
  glGetFloatv(GL_MODELVIEW_MATRIX, got.data());
  EXPECT_EQ(got, f);
  glLoadMatrixd(d.data());
  glGetFloatv(GL_MODELVIEW_MATRIX, got.data());
  for (size_t i = 0; i < 16; ++i) EXPECT_EQ(got[i], static_cast<GLfloat>(d[i]));
  glLoadIdentity();
  glMultMatrixf(f.data());
  glGetFloatv(GL_MODELVIEW_MATRIX, got.data());
  EXPECT_EQ(got, f);
}

// Spec 3.8.4, 3.8.13, 2.14.2: a scalar form takes no name that stands for a vector.
TEST_F(EntryPointsTest, ScalarFormsRefuseVectorNames) {
  glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, 1);
  EXPECT_EQ(error(), static_cast<GLenum>(GL_INVALID_ENUM));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, 1);
  EXPECT_EQ(error(), static_cast<GLenum>(GL_INVALID_ENUM));
  glTexEnvf(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, 1);
  EXPECT_EQ(error(), static_cast<GLenum>(GL_INVALID_ENUM));
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, 1);
  EXPECT_EQ(error(), static_cast<GLenum>(GL_INVALID_ENUM));
  glMaterialf(GL_FRONT, GL_DIFFUSE, 1);
  EXPECT_EQ(error(), static_cast<GLenum>(GL_INVALID_ENUM));
  glMateriali(GL_FRONT, GL_COLOR_INDEXES, 1);
  EXPECT_EQ(error(), static_cast<GLenum>(GL_INVALID_ENUM));
  glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
  glMaterialf(GL_FRONT, GL_SHININESS, 12);
  glMateriali(GL_BACK, GL_SHININESS, 13);
  EXPECT_EQ(error(), static_cast<GLenum>(GL_NO_ERROR));
  GLint filter = 0;
  glGetTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, &filter);
  EXPECT_EQ(filter, GL_NEAREST);
}

// Each rectangle form fills the lower left quarter of a 4 x 4 window.
TEST_F(EntryPointsTest, RectanglesOfEveryType) {
  std::vector<GLubyte> buffer(4 * 4 * 4);
  ASSERT_TRUE(OSMesaMakeCurrent(context_, buffer.data(), GL_UNSIGNED_BYTE, 4, 4));
  glViewport(0, 0, 4, 4);
  const std::array<GLshort, 2> s0{-1, -1}, s1{0, 0};
  const std::array<GLint, 2> i0{-1, -1}, i1{0, 0};
  const std::array<GLfloat, 2> f0{-1, -1}, f1{0, 0};
  const std::array<GLdouble, 2> d0{-1, -1}, d1{0, 0};
  const auto expect_quarter = [&](const char* form) {
    glFinish();
    for (size_t i = 0; i < 16; ++i) {
      const bool inside = i % 4 < 2 && i / 4 < 2;
      EXPECT_EQ(buffer[i * 4 + 1], inside ? 255 : 0) << form << " pixel " << i;
    }
    clear_all(0, 0, 0, 0);
  };
  clear_all(0, 0, 0, 0);
  glColor3f(1, 1, 1);
  glRects(-1, -1, 0, 0), expect_quarter("s");
  glRecti(-1, -1, 0, 0), expect_quarter("i");
  glRectf(-1, -1, 0, 0), expect_quarter("f");
  glRectd(-1, -1, 0, 0), expect_quarter("d");
  glRectsv(s0.data(), s1.data()), expect_quarter("sv");
  glRectiv(i0.data(), i1.data()), expect_quarter("iv");
  glRectfv(f0.data(), f1.data()), expect_quarter("fv");
  glRectdv(d0.data(), d1.data()), expect_quarter("dv");
}

// Every glVertex form draws the same rectangle; 2 and 3 components take w = 1, 4 components bring w = 2.
TEST_F(EntryPointsTest, VerticesOfEveryForm) {
  std::vector<GLubyte> buffer(4 * 4 * 4);
  ASSERT_TRUE(OSMesaMakeCurrent(context_, buffer.data(), GL_UNSIGNED_BYTE, 4, 4));
  glViewport(0, 0, 4, 4);
  constexpr std::array<std::array<int, 2>, 4> kCorners{{{-1, -1}, {0, -1}, {0, 0}, {-1, 0}}};
  const auto draw = [&](const char* form, auto&& vertex) {
    clear_all(0, 0, 0, 0);
    glBegin(GL_QUADS);
    for (const auto& corner : kCorners) vertex(corner[0], corner[1]);
    glEnd();
    glFinish();
    for (size_t i = 0; i < 16; ++i) {
      const bool inside = i % 4 < 2 && i / 4 < 2;
      EXPECT_EQ(buffer[i * 4 + 1], inside ? 255 : 0) << form << " pixel " << i;
    }
  };
  glColor3f(1, 1, 1);
#define FORMS(letter, Type)                                                                                  \
  draw("2" #letter, [](int x, int y) { glVertex2##letter(static_cast<Type>(x), static_cast<Type>(y)); });    \
  draw("3" #letter, [](int x, int y) { glVertex3##letter(static_cast<Type>(x), static_cast<Type>(y), 0); }); \
  draw("4" #letter,                                                                                          \
       [](int x, int y) { glVertex4##letter(static_cast<Type>(2 * x), static_cast<Type>(2 * y), 0, 2); });   \
  draw("2" #letter "v", [](int x, int y) {                                                                   \
    const Type v[] = {static_cast<Type>(x), static_cast<Type>(y)};                                           \
    glVertex2##letter##v(v);                                                                                 \
  });                                                                                                        \
  draw("3" #letter "v", [](int x, int y) {                                                                   \
    const Type v[] = {static_cast<Type>(x), static_cast<Type>(y), 0};                                        \
    glVertex3##letter##v(v);                                                                                 \
  });                                                                                                        \
  draw("4" #letter "v", [](int x, int y) {                                                                   \
    const Type v[] = {static_cast<Type>(2 * x), static_cast<Type>(2 * y), 0, 2};                             \
    glVertex4##letter##v(v);                                                                                 \
  })
  FORMS(s, GLshort);
  FORMS(i, GLint);
  FORMS(f, GLfloat);
  FORMS(d, GLdouble);
#undef FORMS
  EXPECT_EQ(error(), static_cast<GLenum>(GL_NO_ERROR));
}

// Spec 2.6.3: what is refused between glBegin and glEnd, and that nothing else than the error comes of it.
TEST_F(EntryPointsTest, InsideBeginEndOnlyVertexCallsWork) {
  GLint value = -7;
  const auto refused = [&](const char* name, auto&& call) {
    glBegin(GL_POINTS);
    call();
    glEnd();
    EXPECT_EQ(error(), static_cast<GLenum>(GL_INVALID_OPERATION)) << name;
  };
  refused("glViewport", [] { glViewport(1, 1, 1, 1); });
  refused("glBegin", [] { glBegin(GL_LINES); });
  refused("glGetIntegerv", [&] { glGetIntegerv(GL_VIEWPORT, &value); });
  refused("glGetError", [] { EXPECT_EQ(glGetError(), 0u); });
  refused("glGetString", [] { EXPECT_EQ(glGetString(GL_VENDOR), nullptr); });
  refused("glIsEnabled", [] { EXPECT_EQ(glIsEnabled(GL_DITHER), GL_FALSE); });
  refused("glClear", [] { glClear(GL_COLOR_BUFFER_BIT); });
  refused("glFinish", [] { glFinish(); });
  refused("glRectf", [] { glRectf(0, 0, 1, 1); });
  refused("glTexParameterf", [] { glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, 0); });
  EXPECT_EQ(value, -7);
  std::array<GLint, 4> viewport{};
  glGetIntegerv(GL_VIEWPORT, viewport.data());
  EXPECT_EQ(viewport, (std::array<GLint, 4>{0, 0, kWidth, kHeight}));
  glBegin(GL_POINTS);
  glColor3f(0, 0, 0);
  glTexCoord2f(0, 0);
  glNormal3f(0, 0, 1);
  glEdgeFlag(GL_TRUE);
  glMaterialf(GL_FRONT, GL_SHININESS, 1);
  glEnd();
  EXPECT_EQ(error(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST(WithoutContext, NothingHappens) {
  ASSERT_EQ(OSMesaGetCurrentContext(), nullptr);
  GLint value = -7;
  glGetIntegerv(GL_VIEWPORT, &value);
  EXPECT_EQ(value, -7);
  glBegin(GL_TRIANGLES);
  glVertex3f(0, 0, 0);
  glEnd();
  glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, 0);
  EXPECT_EQ(glGetString(GL_VERSION), nullptr);
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  EXPECT_EQ(glIsTexture(1), GL_FALSE);
}

}  // namespace
}  // namespace halfspace::test
