// Selection (spec 5.2): names, hits and their depths.
#include <cmath>

#include "tests/api/osmesa_context.h"

namespace halfspace::test {
namespace {

GLuint depth_word(double z) { return static_cast<GLuint>(std::floor(z * 4294967295.0 + 0.5)); }

class SelectionTest : public OsmesaTest {
 protected:
  void SetUp() override {
    OsmesaTest::SetUp();
    glSelectBuffer(static_cast<GLsizei>(words_.size()), words_.data());
  }
  // Starts selecting with one name on the stack.
  static void select(GLuint name) {
    EXPECT_EQ(glRenderMode(GL_SELECT), 0);
    glInitNames();
    glPushName(name);
  }
  std::vector<GLuint> finish(GLint records) {
    EXPECT_EQ(glRenderMode(GL_RENDER), records);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    size_t used = 0;
    for (GLint i = 0; i < records; ++i) used += 3 + words_[used];
    return {words_.begin(), words_.begin() + static_cast<ptrdiff_t>(used)};
  }
  static GLenum error() { return glGetError(); }
  static GLint integer(GLenum name) {
    GLint v = -1;
    glGetIntegerv(name, &v);
    return v;
  }
  static void triangle(double z0, double z1, double z2, double x = 0) {
    glBegin(GL_TRIANGLES);
    glVertex3d(x - 0.5, -0.5, z0);
    glVertex3d(x + 0.5, -0.5, z1);
    glVertex3d(x, 0.5, z2);
    glEnd();
  }

  std::vector<GLuint> words_ = std::vector<GLuint>(64, 0xABABABAB);
};

TEST_F(SelectionTest, ARecordIsNamesAndTheRangeOfDepths) {
  select(7);
  glPushName(8);
  triangle(-0.5, 0.25, 0.5);
  glLoadName(9);
  triangle(0, 0, 0, 5);  // beside the volume
  glLoadName(10);
  glBegin(GL_POINTS);
  glVertex3d(0, 0, 0.75);
  glEnd();
  EXPECT_EQ(finish(2), (std::vector<GLuint>{2, depth_word(0.25), depth_word(0.75), 7, 8,  //
                                            2, depth_word(0.875), depth_word(0.875), 7, 10}));
}

// Depths are those of what is left of a primitive, and the depth range is in them.
TEST_F(SelectionTest, DepthsAreOfWhatIsVisible) {
  select(1);
  glBegin(GL_LINES);
  glVertex3d(0, 0, -3);
  glVertex3d(0, 0, 0.5);
  glEnd();
  glLoadName(2);
  glDepthRange(1, 0.5);
  glBegin(GL_LINES);
  glVertex3d(0, 0, -1);
  glVertex3d(0, 0, 0);
  glEnd();
  EXPECT_EQ(finish(2), (std::vector<GLuint>{1, 0, depth_word(0.75), 1, 1, depth_word(0.75), 0xFFFFFFFF, 2}));
}

TEST_F(SelectionTest, HitsOfSeveralPrimitivesAreOneRecord) {
  select(3);
  triangle(0, 0, 0);
  triangle(-1, -1, -1);
  triangle(0.5, 0.5, 0.5);
  EXPECT_EQ(finish(1), (std::vector<GLuint>{1, 0, depth_word(0.75), 3}));
}

TEST_F(SelectionTest, ValidRasterPositionsAreHits) {
  const GLubyte pixel[4] = {};
  select(1);
  glRasterPos3f(0, 0, 0.5f);
  glLoadName(2);
  glRasterPos3f(0, 3, 0.5f);  // invalid
  glLoadName(3);
  glBitmap(1, 1, 0, 0, 0, 0, pixel);
  EXPECT_EQ(finish(1), (std::vector<GLuint>{1, depth_word(0.75), depth_word(0.75), 1}));
}

TEST_F(SelectionTest, EachChangeOfTheNamesEndsARecord) {
  EXPECT_EQ(glRenderMode(GL_SELECT), 0);
  triangle(0, 0, 0);  // no names at all
  glPushName(1);
  triangle(0, 0, 0);
  glPushName(2);
  triangle(0, 0, 0);
  glPopName();
  triangle(0, 0, 0);
  glInitNames();
  triangle(0, 0, 0);
  const GLuint z = depth_word(0.5);
  EXPECT_EQ(finish(5), (std::vector<GLuint>{0, z, z, 1, z, z, 1, 2, z, z, 1, 2, 1, z, z, 1, 0, z, z}));
}

TEST_F(SelectionTest, WhatIsCulledIsNotHit) {
  glEnable(GL_CULL_FACE);
  select(1);
  triangle(0, 0, 0);
  glLoadName(2);
  glFrontFace(GL_CW);
  triangle(0, 0, 0);
  glLoadName(3);
  glCullFace(GL_FRONT);
  triangle(0, 0, 0);
  const GLuint z = depth_word(0.5);
  EXPECT_EQ(finish(2), (std::vector<GLuint>{1, z, z, 1, 1, z, z, 3}));
}

// Neither scissor nor the tests on fragments matter, and nothing is drawn or cleared.
TEST_F(SelectionTest, PicturesStay) {
  clear_all(0, 0, 1, 1);
  glFinish();
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, 0, 0);
  glEnable(GL_ALPHA_TEST);
  glAlphaFunc(GL_NEVER, 0);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_NEVER);
  select(1);
  triangle(0, 0, 0);
  glDisable(GL_SCISSOR_TEST);
  glClearColor(1, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_ALPHA_TEST);
  glDisable(GL_DEPTH_TEST);
  glBegin(GL_QUADS);
  glVertex2d(-1, -1), glVertex2d(1, -1), glVertex2d(1, 1), glVertex2d(-1, 1);
  glEnd();
  finish(1);
  std::vector<GLubyte> pixels(kWidth * kHeight * 4);
  glReadPixels(0, 0, kWidth, kHeight, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  for (size_t i = 0; i < pixels.size(); i += 4) EXPECT_EQ(pixels[i + 0], 0);
  for (size_t i = 0; i < pixels.size(); i += 4) EXPECT_EQ(pixels[i + 2], 255);
}

TEST_F(SelectionTest, OverflowKeepsWhatFits) {
  glSelectBuffer(6, words_.data());
  select(1);
  triangle(0, 0, 0);
  glLoadName(2);
  triangle(1, 1, 1);
  EXPECT_EQ(glRenderMode(GL_RENDER), -1);
  EXPECT_EQ(words_[3], 1u);
  EXPECT_EQ(words_[4], 1u);
  EXPECT_EQ(words_[5], 0xFFFFFFFFu);
  EXPECT_EQ(words_[6], 0xABABABABu);
  EXPECT_EQ(words_[7], 0xABABABABu);
}

TEST_F(SelectionTest, SelectingAgainStartsAnew) {
  select(1);
  triangle(0, 0, 0);
  EXPECT_EQ(glRenderMode(GL_SELECT), 1);
  EXPECT_EQ(integer(GL_NAME_STACK_DEPTH), 0);
  EXPECT_EQ(glRenderMode(GL_RENDER), 0);
  EXPECT_EQ(glRenderMode(GL_RENDER), 0);
}

TEST_F(SelectionTest, NamesCountOnlyWhileSelecting) {
  glPushName(1);
  glPopName();
  glPopName();
  glLoadName(1);
  glInitNames();
  EXPECT_EQ(error(), static_cast<GLenum>(GL_NO_ERROR));
  EXPECT_EQ(integer(GL_NAME_STACK_DEPTH), 0);
}

TEST_F(SelectionTest, TheStackHasAnEnd) {
  EXPECT_EQ(integer(GL_MAX_NAME_STACK_DEPTH), 64);
  EXPECT_EQ(glRenderMode(GL_SELECT), 0);
  glLoadName(1);
  EXPECT_EQ(error(), static_cast<GLenum>(GL_INVALID_OPERATION));
  glPopName();
  EXPECT_EQ(error(), static_cast<GLenum>(GL_STACK_UNDERFLOW));
  for (GLuint i = 0; i < 64; ++i) glPushName(i);
  EXPECT_EQ(error(), static_cast<GLenum>(GL_NO_ERROR));
  glPushName(64);
  EXPECT_EQ(error(), static_cast<GLenum>(GL_STACK_OVERFLOW));
  EXPECT_EQ(integer(GL_NAME_STACK_DEPTH), 64);
  triangle(0, 0, 0);
  glPopName();
  EXPECT_EQ(glRenderMode(GL_RENDER), -1);  // 67 words
}

TEST_F(SelectionTest, TheBufferIsNotTakenAwayInUse) {
  EXPECT_EQ(integer(GL_SELECTION_BUFFER_SIZE), 64);
  glSelectBuffer(-1, words_.data());
  EXPECT_EQ(error(), static_cast<GLenum>(GL_INVALID_VALUE));
  EXPECT_EQ(glRenderMode(GL_SELECT), 0);
  GLuint other[4];
  glSelectBuffer(4, other);
  EXPECT_EQ(error(), static_cast<GLenum>(GL_INVALID_OPERATION));
  void* pointer = nullptr;
  glGetPointerv(GL_SELECTION_BUFFER_POINTER, &pointer);
  EXPECT_EQ(pointer, words_.data());
  glRenderMode(GL_RENDER);
}

TEST_F(SelectionTest, ModesAreEnteredPrepared) {
  EXPECT_EQ(glRenderMode(GL_FEEDBACK), 0);  // no buffer was given
  EXPECT_EQ(error(), static_cast<GLenum>(GL_INVALID_OPERATION));
  EXPECT_EQ(glRenderMode(GL_POINTS), 0);
  EXPECT_EQ(error(), static_cast<GLenum>(GL_INVALID_ENUM));
  EXPECT_EQ(integer(GL_RENDER_MODE), GL_RENDER);
  EXPECT_EQ(glRenderMode(GL_SELECT), 0);
  EXPECT_EQ(integer(GL_RENDER_MODE), GL_SELECT);
  EXPECT_EQ(glRenderMode(GL_RENDER), 0);
}

}  // namespace
}  // namespace halfspace::test
