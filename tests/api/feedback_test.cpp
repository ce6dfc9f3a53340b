// Feedback (spec 5.3): which values come back, for each kind of primitive and each type of buffer.
#include "tests/api/osmesa_context.h"

namespace halfspace::test {
namespace {

using Values = std::vector<GLfloat>;

constexpr GLfloat kPoint = GL_POINT_TOKEN, kLine = GL_LINE_TOKEN, kReset = GL_LINE_RESET_TOKEN,
                  kPolygon = GL_POLYGON_TOKEN, kPass = GL_PASS_THROUGH_TOKEN;

class FeedbackTest : public OsmesaTest {
 protected:
  // Window x = 8 * x + 8, y = 4 * y + 4; depth = z / 2 + 1 / 2.
  void SetUp() override {
    OsmesaTest::SetUp();
    glViewport(0, 0, 16, 8);
  }
  void start(GLenum type, GLsizei size = 256) {
    buffer_.assign(256, -99);
    glFeedbackBuffer(size, type, buffer_.data());
    EXPECT_EQ(glRenderMode(GL_FEEDBACK), 0);
  }
  Values finish() {
    const GLint count = glRenderMode(GL_RENDER);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    EXPECT_GE(count, 0);
    return {buffer_.begin(), buffer_.begin() + std::max(count, 0)};
  }
  static GLint integer(GLenum name) {
    GLint v = -1;
    glGetIntegerv(name, &v);
    return v;
  }
  static void vertices(GLenum mode, std::initializer_list<std::array<double, 2>> list) {
    glBegin(mode);
    for (const auto& v : list) glVertex2dv(v.data());
    glEnd();
  }

  Values buffer_;
};

TEST_F(FeedbackTest, EachTypeHasItsValues) {
  const Values expected[] = {
      {kPoint, 12, 2},
      {kPoint, 12, 2, 0.625f},
      {kPoint, 12, 2, 0.625f, 0.25f, 0.5f, 0.75f, 1},
      {kPoint, 12, 2, 0.625f, 0.25f, 0.5f, 0.75f, 1, 3, 4, 5, 6},
      {kPoint, 12, 2, 0.625f, 2, 0.25f, 0.5f, 0.75f, 1, 3, 4, 5, 6},
  };
  const GLenum types[] = {GL_2D, GL_3D, GL_3D_COLOR, GL_3D_COLOR_TEXTURE, GL_4D_COLOR_TEXTURE};
  for (size_t i = 0; i < 5; ++i) {
    start(types[i]);
    glColor4f(0.25f, 0.5f, 0.75f, 2);
    glTexCoord4f(3, 4, 5, 6);
    glBegin(GL_POINTS);
    glVertex4f(1, -1, 0.5f, 2);
    glEnd();
    EXPECT_EQ(finish(), expected[i]) << i;
  }
}

TEST_F(FeedbackTest, TextureCoordinatesGoThroughTheMatrix) {
  glMatrixMode(GL_TEXTURE);
  glTranslated(1, 2, 3);
  glScaled(2, 2, 2);
  start(GL_3D_COLOR_TEXTURE);
  glTexCoord3f(1, 2, 3);
  vertices(GL_POINTS, {{0, 0}});
  EXPECT_EQ(finish(), (Values{kPoint, 8, 4, 0.5f, 1, 1, 1, 1, 3, 6, 9, 1}));
}

TEST_F(FeedbackTest, LinesSayWhereTheStippleStarts) {
  start(GL_2D);
  vertices(GL_LINES, {{0, 0}, {1, 0}, {0, 0}, {0, 1}});
  vertices(GL_LINE_STRIP, {{0, 0}, {1, 0}, {1, 1}});
  vertices(GL_LINE_LOOP, {{0, 0}, {1, 0}, {1, 1}});
  EXPECT_EQ(finish(), (Values{kReset, 8, 4, 16, 4, kReset, 8,  4, 8,  8,  //
                              kReset, 8, 4, 16, 4, kLine,  16, 4, 16, 8,  //
                              kReset, 8, 4, 16, 4, kLine,  16, 4, 16, 8, kLine, 16, 8, 8, 4}));
}

TEST_F(FeedbackTest, PolygonsComeWhole) {
  start(GL_2D);
  vertices(GL_TRIANGLES, {{0, 0}, {1, 0}, {0, 1}});
  vertices(GL_QUADS, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  vertices(GL_POLYGON, {{0, 0}, {1, 0}, {1, 0.5}, {0.5, 1}, {0, 1}});
  EXPECT_EQ(finish(), (Values{kPolygon, 3, 8, 4, 16, 4, 8,  8,         //
                              kPolygon, 4, 8, 4, 16, 4, 16, 8, 8,  8,  //
                              kPolygon, 5, 8, 4, 16, 4, 16, 6, 12, 8, 8, 8}));
}

TEST_F(FeedbackTest, AVeryLongPolygonIsStillOne) {
  constexpr int kCorners = 100'000;
  Values buffer(2 * kCorners + 2);
  glFeedbackBuffer(2 * kCorners + 2, GL_2D, buffer.data());
  glRenderMode(GL_FEEDBACK);
  glBegin(GL_POLYGON);
  for (int i = 0; i < kCorners; ++i)
    glVertex2d(i == kCorners - 1 ? 0 : i / double(kCorners), i == kCorners - 1);
  glEnd();
  EXPECT_EQ(glRenderMode(GL_RENDER), 2 * kCorners + 2);
  EXPECT_EQ(buffer[0], kPolygon);
  EXPECT_EQ(buffer[1], kCorners);
}

// All triangles of a strip turn the same way, and the colour of a flat one is its last vertex's.
TEST_F(FeedbackTest, StripsAndFansComeApart) {
  start(GL_2D);
  vertices(GL_TRIANGLE_STRIP, {{0, 0}, {1, 0}, {0, 1}, {1, 1}});
  EXPECT_EQ(finish(), (Values{kPolygon, 3, 8, 4, 16, 4, 8, 8, kPolygon, 3, 8, 8, 16, 4, 16, 8}));
  start(GL_2D);
  vertices(GL_TRIANGLE_FAN, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  EXPECT_EQ(finish(), (Values{kPolygon, 3, 8, 4, 16, 4, 16, 8, kPolygon, 3, 8, 4, 16, 8, 8, 8}));
  start(GL_2D);
  vertices(GL_QUAD_STRIP, {{0, 0}, {0, 1}, {0.5, 0}, {0.5, 1}, {1, 0}, {1, 1}});
  EXPECT_EQ(finish(), (Values{kPolygon, 4, 8,  4, 8,  8, 12, 8, 12, 4,  //
                              kPolygon, 4, 12, 4, 12, 8, 16, 8, 16, 4}));
}

TEST_F(FeedbackTest, FlatColoursAreTheProvokingVertexs) {
  const auto colored = [](GLenum mode, int count) {
    const double x[] = {0, 1, 1, 0}, y[] = {0, 0, 1, 1};
    glBegin(mode);
    for (int i = 0; i < count; ++i) {
      glColor3d(0.25 * i, 0, 0);
      glVertex2d(x[i], y[i]);
    }
    glEnd();
  };
  const auto red_of_all = [](const Values& v, size_t count, size_t first) {
    for (size_t i = 1; i < count; ++i) EXPECT_EQ(v[first + 7 * i + 3], v[first + 3]);
    return v[first + 3];
  };
  glShadeModel(GL_FLAT);
  start(GL_3D_COLOR);
  colored(GL_LINES, 2);
  EXPECT_EQ(red_of_all(finish(), 2, 1), 0.25f);
  start(GL_3D_COLOR);
  colored(GL_TRIANGLES, 3);
  EXPECT_EQ(red_of_all(finish(), 3, 2), 0.5f);
  start(GL_3D_COLOR);
  colored(GL_QUADS, 4);
  EXPECT_EQ(red_of_all(finish(), 4, 2), 0.75f);
  start(GL_3D_COLOR);
  glColor3d(0, 0, 0);
  colored(GL_POLYGON, 4);
  EXPECT_EQ(red_of_all(finish(), 4, 2), 0);
}

// Cut at the volume, not at the guard band, with what varies cut along.
TEST_F(FeedbackTest, PrimitivesAreClipped) {
  start(GL_3D_COLOR);
  glBegin(GL_LINES);
  glColor3f(0, 0, 0);
  glVertex3f(0, 0, 0);
  glColor3f(1, 0, 0);
  glVertex3f(2, 0, 0.5f);
  glVertex3f(5, 0, 0);  // outside
  glVertex3f(5, 1, 0);
  glEnd();
  EXPECT_EQ(finish(), (Values{kReset, 8, 4, 0.5f, 0, 0, 0, 1, 16, 4, 0.625f, 0.5f, 0, 0, 1}));
  start(GL_2D);
  vertices(GL_POINTS, {{1.0625, 0}, {1, 1}});
  EXPECT_EQ(finish(), (Values{kPoint, 16, 8}));
  start(GL_2D);
  vertices(GL_TRIANGLES, {{0, 0}, {2, 0}, {0, 1}});
  // The cut cuts the corner off: four vertices, in the order of the old ones.
  const Values cut = finish();
  ASSERT_EQ(cut.size(), 10u);
  EXPECT_EQ(cut[1], 4);
  std::vector<std::array<GLfloat, 2>> corners;
  for (size_t i = 2; i < cut.size(); i += 2) corners.push_back({cut[i], cut[i + 1]});
  const auto first = std::find(corners.begin(), corners.end(), std::array<GLfloat, 2>{8, 4});
  ASSERT_NE(first, corners.end());
  std::rotate(corners.begin(), first, corners.end());
  EXPECT_EQ(corners, (std::vector<std::array<GLfloat, 2>>{{8, 4}, {16, 4}, {16, 6}, {8, 8}}));
}

TEST_F(FeedbackTest, CulledPolygonsAreNotReported) {
  glEnable(GL_CULL_FACE);
  start(GL_2D);
  vertices(GL_TRIANGLES, {{0, 0}, {0, 1}, {1, 0}});
  vertices(GL_POINTS, {{0, 0}});
  EXPECT_EQ(finish(), (Values{kPoint, 8, 4}));
}

// Colours are those lighting gives, of the side that is seen.
TEST_F(FeedbackTest, ColoursAreLit) {
  const GLfloat white[] = {1, 1, 1, 1}, front[] = {0.25f, 0.5f, 0.75f, 1}, back[] = {0.5f, 0.25f, 0.125f, 1};
  glLightModelfv(GL_LIGHT_MODEL_AMBIENT, white);
  glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
  glMaterialfv(GL_FRONT, GL_AMBIENT, front);
  glMaterialfv(GL_BACK, GL_AMBIENT, back);
  glEnable(GL_LIGHTING);
  start(GL_3D_COLOR);
  vertices(GL_POINTS, {{0, 0}});
  vertices(GL_TRIANGLES, {{0, 0}, {0, 1}, {1, 0}});
  const Values found = finish();
  EXPECT_EQ((Values{found.begin(), found.begin() + 8}), (Values{kPoint, 8, 4, 0.5f, 0.25f, 0.5f, 0.75f, 1}));
  EXPECT_EQ((Values{found.begin() + 8, found.begin() + 17}),
            (Values{kPolygon, 3, 8, 4, 0.5f, 0.5f, 0.25f, 0.125f, 1}));
}

// Each vertex has the material that was current when it was given.
TEST_F(FeedbackTest, MaterialsChangeBetweenVertices) {
  const GLfloat white[] = {1, 1, 1, 1}, first[] = {0.25f, 0, 0, 1}, second[] = {0.75f, 0, 0, 1};
  glLightModelfv(GL_LIGHT_MODEL_AMBIENT, white);
  glEnable(GL_LIGHTING);
  start(GL_3D_COLOR);
  glBegin(GL_LINES);
  glMaterialfv(GL_FRONT, GL_AMBIENT, first);
  glVertex2f(0, 0);
  glMaterialfv(GL_FRONT, GL_AMBIENT, second);
  glVertex2f(1, 0);
  glEnd();
  EXPECT_EQ(finish(), (Values{kReset, 8, 4, 0.5f, 0.25f, 0, 0, 1, 16, 4, 0.5f, 0.75f, 0, 0, 1}));
}

TEST_F(FeedbackTest, CoordinatesAreGenerated) {
  const GLfloat plane[] = {2, 0, 0, 1};
  glTexGeni(GL_S, GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR);
  glTexGenfv(GL_S, GL_OBJECT_PLANE, plane);
  glEnable(GL_TEXTURE_GEN_S);
  start(GL_3D_COLOR_TEXTURE);
  glTexCoord2f(7, 8);
  vertices(GL_POINTS, {{0.5, 0}});
  EXPECT_EQ(finish(), (Values{kPoint, 12, 4, 0.5f, 1, 1, 1, 1, 2, 8, 0, 1}));
}

TEST_F(FeedbackTest, UserPlanesCut) {
  const GLdouble plane[] = {1, 0, 0, -0.5};
  glClipPlane(GL_CLIP_PLANE3, plane);
  glEnable(GL_CLIP_PLANE3);
  start(GL_2D);
  vertices(GL_POINTS, {{0.25, 0}, {0.75, 0}});
  vertices(GL_LINES, {{0, 0}, {1, 0}, {0, 0}, {0, 1}});
  EXPECT_EQ(finish(), (Values{kPoint, 14, 4, kReset, 12, 4, 16, 4}));
}

// Spec 3.5.4, 2.6.2: edges and points that are marked as boundary; the stipple starts anew with each polygon.
TEST_F(FeedbackTest, PolygonModesMakeLinesAndPoints) {
  const auto flagged = [] {
    glBegin(GL_TRIANGLES);
    glEdgeFlag(GL_TRUE);
    glVertex2f(0, 0);
    glEdgeFlag(GL_FALSE);
    glVertex2f(1, 0);
    glEdgeFlag(GL_TRUE);
    glVertex2f(0, 1);
    glEnd();
  };
  glPolygonMode(GL_FRONT, GL_LINE);
  start(GL_2D);
  flagged();
  EXPECT_EQ(finish(), (Values{kReset, 8, 4, 16, 4, kLine, 8, 8, 8, 4}));
  glPolygonMode(GL_FRONT, GL_POINT);
  start(GL_2D);
  flagged();
  EXPECT_EQ(finish(), (Values{kPoint, 8, 4, kPoint, 8, 8}));
  glFrontFace(GL_CW);  // now the back is seen, which is filled
  start(GL_2D);
  flagged();
  EXPECT_EQ(finish(), (Values{kPolygon, 3, 8, 4, 16, 4, 8, 8}));
}

TEST_F(FeedbackTest, PixelsReportTheRasterPosition) {
  const GLubyte pixel[4] = {};
  start(GL_3D);
  glRasterPos3f(0.5f, 0, 0.5f);
  glBitmap(1, 1, 0, 0, 2, 0, pixel);
  glDrawPixels(1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
  glCopyPixels(0, 0, 1, 1, GL_COLOR);
  glRasterPos2f(3, 0);  // invalid
  glBitmap(1, 1, 0, 0, 2, 0, pixel);
  EXPECT_EQ(finish(), (Values{GL_BITMAP_TOKEN, 12, 4, 0.75f, GL_DRAW_PIXEL_TOKEN, 14, 4, 0.75f,
                              GL_COPY_PIXEL_TOKEN, 14, 4, 0.75f}));
}

TEST_F(FeedbackTest, PassThroughStandsBetweenThePrimitives) {
  glPassThrough(99);  // nothing outside feedback
  start(GL_2D);
  vertices(GL_POINTS, {{0, 0}});
  glPassThrough(3.5f);
  vertices(GL_POINTS, {{1, 0}});
  EXPECT_EQ(finish(), (Values{kPoint, 8, 4, kPass, 3.5f, kPoint, 16, 4}));
}

TEST_F(FeedbackTest, ArraysAreReportedToo) {
  const GLfloat positions[] = {0, 0, 1, 0, 1, 1};
  const GLubyte indices[] = {2, 0, 1};
  glEnableClientState(GL_VERTEX_ARRAY);
  glVertexPointer(2, GL_FLOAT, 0, positions);
  start(GL_2D);
  glDrawArrays(GL_LINE_STRIP, 0, 2);
  glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_BYTE, indices);
  EXPECT_EQ(finish(), (Values{kReset, 8, 4, 16, 4, kPolygon, 3, 16, 8, 8, 4, 16, 4}));
  glDisableClientState(GL_VERTEX_ARRAY);
}

TEST_F(FeedbackTest, OverflowKeepsWhatFits) {
  start(GL_2D, 5);
  vertices(GL_POINTS, {{0, 0}, {1, 0}});
  EXPECT_EQ(glRenderMode(GL_RENDER), -1);
  EXPECT_EQ((Values{buffer_.begin(), buffer_.begin() + 6}), (Values{kPoint, 8, 4, kPoint, 16, -99}));
  start(GL_2D, 6);
  vertices(GL_POINTS, {{0, 0}, {1, 0}});
  EXPECT_EQ(finish().size(), 6u);
}

TEST_F(FeedbackTest, NothingIsDrawn) {
  clear_all(0, 0, 1, 1);
  start(GL_2D);
  glColor3f(1, 0, 0);
  vertices(GL_QUADS, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
  finish();
  GLubyte pixel[4] = {};
  glReadPixels(2, 1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
  EXPECT_EQ(pixel[0], 0);
  EXPECT_EQ(pixel[2], 255);
  vertices(GL_QUADS, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
  glReadPixels(2, 1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
  EXPECT_EQ(pixel[0], 255);
}

TEST_F(FeedbackTest, TheBufferIsQueriedAndGuarded) {
  start(GL_3D_COLOR, 100);
  EXPECT_EQ(integer(GL_FEEDBACK_BUFFER_SIZE), 100);
  EXPECT_EQ(integer(GL_FEEDBACK_BUFFER_TYPE), GL_3D_COLOR);
  EXPECT_EQ(integer(GL_RENDER_MODE), GL_FEEDBACK);
  void* pointer = nullptr;
  glGetPointerv(GL_FEEDBACK_BUFFER_POINTER, &pointer);
  EXPECT_EQ(pointer, buffer_.data());
  GLfloat other[4];
  glFeedbackBuffer(4, GL_2D, other);
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_INVALID_OPERATION));
  EXPECT_EQ(integer(GL_FEEDBACK_BUFFER_SIZE), 100);
  finish();
  glFeedbackBuffer(4, GL_2D - 1, other);
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_INVALID_ENUM));
  glFeedbackBuffer(-4, GL_2D, other);
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_INVALID_VALUE));
  EXPECT_EQ(integer(GL_FEEDBACK_BUFFER_TYPE), GL_3D_COLOR);
}

}  // namespace
}  // namespace halfspace::test
