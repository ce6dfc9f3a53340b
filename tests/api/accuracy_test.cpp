// GL_HALFSPACE_accuracy and glHint: what they set is what is drawn.
#include <cstdlib>
#include <functional>
#include <initializer_list>

#include "gl/include/GL/halfspace.h"
#include "tests/api/osmesa_context.h"

namespace halfspace::test {
namespace {

constexpr int kSize = 96;
constexpr GLenum kAxes[] = {GL_PERSPECTIVE_ACCURACY_HALFSPACE, GL_INTERPOLATION_ACCURACY_HALFSPACE,
                            GL_FILTER_ACCURACY_HALFSPACE,      GL_LOD_ACCURACY_HALFSPACE,
                            GL_FOG_ACCURACY_HALFSPACE,         GL_POWER_ACCURACY_HALFSPACE,
                            GL_TRANSFORM_ACCURACY_HALFSPACE,   GL_COVERAGE_ACCURACY_HALFSPACE};
constexpr const char* kNames[] = {"perspective", "interpolation", "filter",    "lod",
                                  "fog",         "power",         "transform", "coverage"};

PFNGLACCURACYHALFSPACEPROC accuracy_command() {
  return reinterpret_cast<PFNGLACCURACYHALFSPACEPROC>(OSMesaGetProcAddress("glAccuracyHALFSPACE"));
}

void make_texture() {
  for (int level = 0, size = 32; size >= 1; ++level, size /= 2) {
    std::vector<GLubyte> texels(size_t(size) * size_t(size) * 4);
    unsigned random = 7u + unsigned(level);
    for (GLubyte& texel : texels) texel = GLubyte((random = random * 1664525u + 1013904223u) >> 24);
    glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA, size, size, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
  }
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
}

// Everything an axis could touch: a lit, fogged, textured floor in perspective, smooth points, lines and a
// polygon.
void draw_scene() {
  glViewport(0, 0, kSize, kSize);
  clear_all(0.2f, 0.3f, 0.4f, 1);
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glFrustum(-1, 1, -1, 1, 1, 50);
  glMatrixMode(GL_MODELVIEW);
  glEnable(GL_FOG);
  glFogf(GL_FOG_DENSITY, 0.09f);
  glEnable(GL_LIGHTING);
  glEnable(GL_LIGHT0);
  const GLfloat above[] = {0.3f, 2, -3, 1}, shiny[] = {1, 0.8f, 0.7f, 1};
  glLightfv(GL_LIGHT0, GL_POSITION, above);
  glLightfv(GL_LIGHT0, GL_SPECULAR, shiny);
  glMaterialfv(GL_FRONT, GL_SPECULAR, shiny);
  glMaterialf(GL_FRONT, GL_SHININESS, 50);
  glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, 1);
  make_texture();
  glEnable(GL_TEXTURE_2D);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
  glNormal3f(0, 1, 0);
  for (int strip = 0; strip < 8; ++strip) {
    glBegin(GL_QUAD_STRIP);
    for (int row = 0; row < 12; ++row) {
      const float x = float(strip) - 4, z = -1.2f - 3 * float(row);
      glTexCoord2f(x, z), glVertex3f(x, -1, z);
      glTexCoord2f(x + 1, z), glVertex3f(x + 1, -1, z);
    }
    glEnd();
  }
  glDisable(GL_TEXTURE_2D);
  glDisable(GL_LIGHTING);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  for (const GLenum smooth :
       std::initializer_list<GLenum>{GL_POINT_SMOOTH, GL_LINE_SMOOTH, GL_POLYGON_SMOOTH})
    glEnable(smooth);
  glPointSize(9.5f);
  glLineWidth(2.5f);
  glColor4f(1, 0.9f, 0.2f, 0.8f);
  glBegin(GL_POINTS), glVertex3f(-0.93f, 0.71f, -2), glVertex3f(0.2f, 1.13f, -2), glEnd();
  glBegin(GL_LINES), glVertex3f(-1.3f, 0.2f, -2), glVertex3f(1.1f, 1.7f, -2), glEnd();
  glBegin(GL_TRIANGLES), glVertex3f(0.5f, 0.1f, -2), glVertex3f(1.7f, 0.3f, -2), glVertex3f(1, 1.1f, -2),
      glEnd();
}

// With HALFSPACE_ACCURACY as `environment` and what `before` sets.
std::vector<GLubyte> picture(const char* environment, const std::function<void()>& before) {
  setenv("HALFSPACE_ACCURACY", environment, 1);
  const OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, nullptr);
  unsetenv("HALFSPACE_ACCURACY");
  std::vector<GLubyte> pixels(kSize * kSize * 4);
  EXPECT_TRUE(OSMesaMakeCurrent(context, pixels.data(), GL_UNSIGNED_BYTE, kSize, kSize));
  assert_halfspace();
  before();
  draw_scene();
  glFinish();
  EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
  OSMesaDestroyContext(context);
  return pixels;
}

const std::function<void()> kNothing = [] {};

TEST(AccuracyPictures, TheCommandDrawsWhatTheEnvironmentDoes) {
  for (size_t i = 0; i < std::size(kAxes); ++i) {
    for (const auto& [name, level] :
         {std::pair("draft", GL_DRAFT_HALFSPACE), {"exact", GL_EXACT_HALFSPACE}}) {
      const std::string environment = std::string(kNames[i]) + '=' + name;
      EXPECT_EQ(picture("standard", [&, l = GLenum(level)] { accuracy_command()(kAxes[i], l); }),
                picture(environment.c_str(), kNothing))
          << environment;
    }
  }
  EXPECT_EQ(picture("draft,lod=exact", [] { accuracy_command()(GL_ACCURACY_HALFSPACE, GL_EXACT_HALFSPACE); }),
            picture("exact", kNothing));
}

TEST(AccuracyPictures, FastestIsDraftNicestIsExactAndDontCareIsTheContexts) {
  const auto standard = picture("standard", kNothing);
  for (const auto& [hint, axis] :
       {std::pair(GLenum{GL_PERSPECTIVE_CORRECTION_HINT}, "perspective"), {GLenum{GL_FOG_HINT}, "fog"}}) {
    const std::string name = axis;
    const auto hinted = [&, h = hint](GLenum mode) { return [=] { glHint(h, mode); }; };
    const auto draft = picture((name + "=draft").c_str(), kNothing),
               exact = picture((name + "=exact").c_str(), kNothing);
    EXPECT_EQ(picture("standard", hinted(GL_FASTEST)), draft) << name;
    EXPECT_EQ(picture("standard", hinted(GL_NICEST)), exact) << name;
    EXPECT_EQ(picture("standard", hinted(GL_DONT_CARE)), standard) << name;
    EXPECT_EQ(picture((name + "=draft").c_str(), hinted(GL_DONT_CARE)), draft) << name;
    EXPECT_EQ(picture("exact", hinted(GL_FASTEST)), picture(("exact," + name + "=draft").c_str(), kNothing))
        << name;
  }
}

TEST(AccuracyPictures, SmoothHintsAreForTheirKindOfShape) {
  const auto smooth = [](GLenum mode) {
    return [mode] {
      for (const GLenum hint :
           std::initializer_list<GLenum>{GL_POINT_SMOOTH_HINT, GL_LINE_SMOOTH_HINT, GL_POLYGON_SMOOTH_HINT})
        glHint(hint, mode);
    };
  };
  const auto draft = picture("coverage=draft", kNothing), standard = picture("standard", kNothing);
  EXPECT_EQ(picture("standard", smooth(GL_FASTEST)), draft);
  EXPECT_EQ(picture("standard", smooth(GL_NICEST)), picture("coverage=exact", kNothing));
  EXPECT_EQ(picture("coverage=draft", smooth(GL_DONT_CARE)), draft);
  for (const GLenum hint :
       std::initializer_list<GLenum>{GL_POINT_SMOOTH_HINT, GL_LINE_SMOOTH_HINT, GL_POLYGON_SMOOTH_HINT}) {
    const auto one = picture("standard", [hint] { glHint(hint, GL_FASTEST); });
    EXPECT_NE(one, standard) << hint;
    EXPECT_NE(one, draft) << hint;
  }
}

class AccuracyState : public OsmesaTest {
 protected:
  static GLenum level_of(GLenum axis) {
    GLint value = 0;
    glGetIntegerv(axis, &value);
    return GLenum(value);
  }
};

TEST_F(AccuracyState, IsQueriedSavedAndRefused) {
  const std::string extensions = reinterpret_cast<const char*>(glGetString(GL_EXTENSIONS));
  EXPECT_NE(extensions.find("GL_HALFSPACE_accuracy"), extensions.npos);
  const auto set = accuracy_command();
  ASSERT_NE(set, nullptr);
  for (const GLenum axis : kAxes) EXPECT_EQ(level_of(axis), GLenum{GL_STANDARD_HALFSPACE});
  glPushAttrib(GL_HINT_BIT);
  for (const GLenum axis : kAxes) {
    set(axis, GL_EXACT_HALFSPACE);
    EXPECT_EQ(level_of(axis), GLenum{GL_EXACT_HALFSPACE});
  }
  set(GL_ACCURACY_HALFSPACE, GL_DRAFT_HALFSPACE);
  for (const GLenum axis : kAxes) EXPECT_EQ(level_of(axis), GLenum{GL_DRAFT_HALFSPACE});
  glPopAttrib();
  for (const GLenum axis : kAxes) EXPECT_EQ(level_of(axis), GLenum{GL_STANDARD_HALFSPACE});
  EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});

  const auto refused = [&](GLenum axis, GLenum level, GLenum error) {
    set(axis, level);
    EXPECT_EQ(glGetError(), error) << axis << ", " << level;
    for (const GLenum each : kAxes) EXPECT_EQ(level_of(each), GLenum{GL_STANDARD_HALFSPACE});
  };
  refused(GL_ACCURACY_HALFSPACE - 1, GL_EXACT_HALFSPACE, GL_INVALID_ENUM);
  refused(GL_COVERAGE_ACCURACY_HALFSPACE + 1, GL_EXACT_HALFSPACE, GL_INVALID_ENUM);
  refused(GL_FILTER_ACCURACY_HALFSPACE, GL_DRAFT_HALFSPACE - 1, GL_INVALID_ENUM);
  refused(GL_FILTER_ACCURACY_HALFSPACE, GL_EXACT_HALFSPACE + 1, GL_INVALID_ENUM);
  refused(GL_FILTER_ACCURACY_HALFSPACE, GL_NICEST, GL_INVALID_ENUM);
  glBegin(GL_POINTS);
  set(GL_FILTER_ACCURACY_HALFSPACE, GL_EXACT_HALFSPACE);
  glEnd();
  EXPECT_EQ(glGetError(), GLenum{GL_INVALID_OPERATION});
  EXPECT_EQ(level_of(GL_FILTER_ACCURACY_HALFSPACE), GLenum{GL_STANDARD_HALFSPACE});
  GLint ignored = 5;
  glGetIntegerv(GL_ACCURACY_HALFSPACE, &ignored);
  EXPECT_EQ(glGetError(), GLenum{GL_INVALID_ENUM});
  EXPECT_EQ(ignored, 5);
}

TEST_F(AccuracyState, IsNotCompiledIntoLists) {
  glNewList(1, GL_COMPILE);
  accuracy_command()(GL_LOD_ACCURACY_HALFSPACE, GL_DRAFT_HALFSPACE);
  glEndList();
  EXPECT_EQ(level_of(GL_LOD_ACCURACY_HALFSPACE), GLenum{GL_DRAFT_HALFSPACE});
  accuracy_command()(GL_LOD_ACCURACY_HALFSPACE, GL_EXACT_HALFSPACE);
  glCallList(1);
  EXPECT_EQ(level_of(GL_LOD_ACCURACY_HALFSPACE), GLenum{GL_EXACT_HALFSPACE});
}

TEST(AccuracyWithoutContext, DoesNothing) {
  OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
  accuracy_command()(GL_ACCURACY_HALFSPACE, GL_EXACT_HALFSPACE);
}

}  // namespace
}  // namespace halfspace::test
