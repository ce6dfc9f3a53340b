// Windows: what is drawn is what GL reads back and what X shows.
#include "tests/apps/glx_fixture.h"

namespace halfspace::test {
namespace {

class GlxWindowTest : public GlxTest {
 protected:
  bool bits_lost() const { return DefaultDepth(display_, screen_) == 16; }

  // A window with a current context.
  void open(std::vector<int> attributes, int width, int height) {
    visual_ = choose(std::move(attributes));
    ASSERT_NE(visual_, nullptr);
    window_ = create_window(*visual_, width, height);
    context_ = glXCreateContext(display_, visual_, nullptr, True);
    ASSERT_NE(context_, nullptr);
    ASSERT_TRUE(glXMakeCurrent(display_, window_, context_));
    expect_halfspace();
  }

  void TearDown() override {
    if (context_) glXDestroyContext(display_, context_);
    if (visual_) XFree(visual_);
    GlxTest::TearDown();
  }

  XVisualInfo* visual_ = nullptr;
  Window window_ = 0;
  GLXContext context_ = nullptr;
};

TEST_F(GlxWindowTest, DoubleBufferedIsSeenAfterSwapOnly) {
  open({GLX_RGBA, GLX_DEPTH_SIZE, 24, GLX_DOUBLEBUFFER}, 37, 29);
  const Picture before = read_x(window_, 37, 29);
  draw_picture(37, 29);
  EXPECT_EQ(difference(read_gl(37, 29), expected_picture(37, 29)), "");
  glFinish();
  EXPECT_EQ(difference(read_x(window_, 37, 29), before), "") << "nothing may be seen before the swap";
  glXSwapBuffers(display_, window_);
  EXPECT_EQ(difference(read_x(window_, 37, 29), expected_picture(37, 29), bits_lost()), "");
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

TEST_F(GlxWindowTest, BackBufferKeepsItsContentsOverSwaps) {
  open({GLX_RGBA, GLX_DOUBLEBUFFER}, 40, 30);
  draw_picture(40, 30);
  glXSwapBuffers(display_, window_);
  EXPECT_EQ(difference(read_gl(40, 30), expected_picture(40, 30)), "");
  draw_rectangle({1, 2, 3}, 30, 20, 32, 22);
  glXSwapBuffers(display_, window_);
  glXSwapBuffers(display_, window_);
  Picture want = expected_picture(40, 30);
  for (const int i : {20 * 40 + 30, 20 * 40 + 31, 21 * 40 + 30, 21 * 40 + 31})
    want.pixels[size_t(i)] = {1, 2, 3};
  EXPECT_EQ(difference(read_gl(40, 30), want), "");
  EXPECT_EQ(difference(read_x(window_, 40, 30), want, bits_lost()), "");
}

TEST_F(GlxWindowTest, SingleBufferedIsSeenAfterFlush) {
  open({GLX_RGBA}, 33, 21);
  GLboolean double_buffered = GL_TRUE;
  glGetBooleanv(GL_DOUBLEBUFFER, &double_buffered);
  EXPECT_FALSE(double_buffered);
  draw_picture(33, 21);
  glFlush();
  EXPECT_EQ(difference(read_x(window_, 33, 21), expected_picture(33, 21), bits_lost()), "");
  glXSwapBuffers(display_, window_);  // has no effect
  EXPECT_EQ(difference(read_x(window_, 33, 21), expected_picture(33, 21), bits_lost()), "");
}

TEST_F(GlxWindowTest, SingleBufferedIsSeenWhenTheContextIsReleased) {
  open({GLX_RGBA}, 33, 21);
  draw_picture(33, 21);
  ASSERT_TRUE(glXMakeCurrent(display_, 0, nullptr));
  EXPECT_EQ(difference(read_x(window_, 33, 21), expected_picture(33, 21), bits_lost()), "");
}

TEST_F(GlxWindowTest, FrontBufferOfADoubleBufferedWindow) {
  open({GLX_RGBA, GLX_DOUBLEBUFFER}, 40, 30);
  draw_picture(40, 30);
  glXSwapBuffers(display_, window_);
  // The back buffer changes; the front one, asked for only now, is what was swapped to it.
  glClearColor(1, 0, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glReadBuffer(GL_FRONT);
  EXPECT_EQ(difference(read_gl(40, 30), expected_picture(40, 30), bits_lost()), "");
  glDrawBuffer(GL_FRONT);
  draw_rectangle({200, 8, 16}, 39, 29, 40, 30);
  glFlush();
  Picture want = expected_picture(40, 30);
  want.pixels.back() = {200, 8, 16};
  EXPECT_EQ(difference(read_x(window_, 40, 30), want, bits_lost()), "");
  EXPECT_EQ(difference(read_gl(40, 30), want, bits_lost()), "");
  // A swap brings the back buffer to both.
  glXSwapBuffers(display_, window_);
  EXPECT_EQ(read_gl(40, 30).at(3, 5), (Pixel{255, 0, 255}));
  EXPECT_EQ(difference(read_x(window_, 40, 30), read_gl(40, 30), bits_lost()), "");
}

TEST_F(GlxWindowTest, ResizeIsPickedUpAtTheSwap) {
  open({GLX_RGBA, GLX_DOUBLEBUFFER}, 37, 29);
  draw_picture(37, 29);
  glXSwapBuffers(display_, window_);
  for (const auto& [width, height] : {std::pair{211, 97}, {20, 18}, {64, 64}}) {
    XResizeWindow(display_, window_, unsigned(width), unsigned(height));
    XSync(display_, False);
    glXSwapBuffers(display_, window_);
    draw_picture(width, height);
    EXPECT_EQ(difference(read_gl(width, height), expected_picture(width, height)), "");
    glXSwapBuffers(display_, window_);
    EXPECT_EQ(difference(read_x(window_, width, height), expected_picture(width, height), bits_lost()), "");
  }
}

TEST_F(GlxWindowTest, ResizeIsPickedUpAtMakeCurrent) {
  open({GLX_RGBA, GLX_DOUBLEBUFFER}, 37, 29);
  draw_picture(37, 29);
  XResizeWindow(display_, window_, 100, 50);
  XSync(display_, False);
  ASSERT_TRUE(glXMakeCurrent(display_, window_, context_));
  draw_picture(100, 50);
  EXPECT_EQ(difference(read_gl(100, 50), expected_picture(100, 50)), "");
}

TEST_F(GlxWindowTest, FirstMakeCurrentSetsViewportAndScissor) {
  open({GLX_RGBA}, 123, 45);
  GLint box[4] = {};
  glGetIntegerv(GL_VIEWPORT, box);
  EXPECT_EQ(std::vector<int>(box, box + 4), (std::vector<int>{0, 0, 123, 45}));
  glGetIntegerv(GL_SCISSOR_BOX, box);
  EXPECT_EQ(std::vector<int>(box, box + 4), (std::vector<int>{0, 0, 123, 45}));
  // Not the second one.
  glViewport(1, 2, 3, 4);
  XResizeWindow(display_, window_, 60, 60);
  XSync(display_, False);
  ASSERT_TRUE(glXMakeCurrent(display_, window_, context_));
  glGetIntegerv(GL_VIEWPORT, box);
  EXPECT_EQ(std::vector<int>(box, box + 4), (std::vector<int>{1, 2, 3, 4}));
}

TEST_F(GlxWindowTest, DestroyedWhileCurrentItLivesUntilReleased) {
  open({GLX_RGBA, GLX_DOUBLEBUFFER}, 37, 29);
  glXDestroyContext(display_, context_);
  draw_picture(37, 29);
  EXPECT_EQ(difference(read_gl(37, 29), expected_picture(37, 29)), "");
  glXSwapBuffers(display_, window_);
  EXPECT_EQ(difference(read_x(window_, 37, 29), expected_picture(37, 29), bits_lost()), "");
  EXPECT_EQ(glXGetCurrentContext(), context_);
  ASSERT_TRUE(glXMakeCurrent(display_, 0, nullptr));
  EXPECT_EQ(glXGetCurrentContext(), nullptr);
  EXPECT_FALSE(glXMakeCurrent(display_, window_, context_)) << "it is gone by now";
  EXPECT_FALSE(glXIsDirect(display_, context_));
}

TEST_F(GlxWindowTest, AWindowThatDiesTakesNobodyWithIt) {
  open({GLX_RGBA, GLX_DOUBLEBUFFER}, 37, 29);
  draw_picture(37, 29);
  XDestroyWindow(display_, window_);
  glXSwapBuffers(display_, window_);
  draw_picture(37, 29);
  glXSwapBuffers(display_, window_);
  XSync(display_, False);
  EXPECT_EQ(difference(read_gl(37, 29), expected_picture(37, 29)), "");
  EXPECT_FALSE(glXMakeCurrent(display_, window_, context_));
  EXPECT_EQ(glXGetCurrentContext(), context_) << "a refused call changes nothing";
  EXPECT_EQ(x_error_count, 0);
}

TEST_F(GlxWindowTest, TheProgramsOwnErrorsStillReachIt) {
  open({GLX_RGBA, GLX_DOUBLEBUFFER}, 37, 29);
  glXSwapBuffers(display_, window_);
  XMapWindow(display_, 0x7ffffff);  // no such window
  glXSwapBuffers(display_, window_);
  XSync(display_, False);
  EXPECT_EQ(x_error_count, 1);
  x_error_count = 0;
}

TEST_F(GlxWindowTest, SeveralContextsDrawToOneWindow) {
  open({GLX_RGBA, GLX_DOUBLEBUFFER}, 40, 30);
  draw_picture(40, 30);
  const GLXContext second = glXCreateContext(display_, visual_, nullptr, True);
  ASSERT_TRUE(glXMakeCurrent(display_, 0, nullptr));
  ASSERT_TRUE(glXMakeCurrent(display_, window_, second));
  EXPECT_EQ(difference(read_gl(40, 30), expected_picture(40, 30)), "") << "the buffers are the window's";
  glScissor(0, 20, 40, 10);
  glEnable(GL_SCISSOR_TEST);
  glClearColor(0, 1, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ASSERT_TRUE(glXMakeCurrent(display_, window_, context_));
  glXDestroyContext(display_, second);
  glXSwapBuffers(display_, window_);
  Picture want = expected_picture(40, 30);
  std::fill(want.pixels.begin() + 20 * 40, want.pixels.end(), Pixel{0, 255, 0});
  EXPECT_EQ(difference(read_x(window_, 40, 30), want, bits_lost()), "");
}

TEST_F(GlxWindowTest, OneContextDrawsToSeveralWindows) {
  open({GLX_RGBA, GLX_DOUBLEBUFFER}, 40, 30);
  const Window other = create_window(*visual_, 22, 50);
  glClearColor(0, 0, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ASSERT_TRUE(glXMakeCurrent(display_, other, context_));
  draw_picture(22, 50);
  glXSwapBuffers(display_, window_);  // not current: what was drawn to it is shown all the same
  glXSwapBuffers(display_, other);
  EXPECT_EQ(difference(read_x(other, 22, 50), expected_picture(22, 50), bits_lost()), "");
  EXPECT_EQ(read_x(window_, 40, 30).at(5, 5), (Pixel{0, 0, 255}));
}

TEST_F(GlxWindowTest, WithoutAlphaItReadsAsOne) {
  open({GLX_RGBA, GLX_DOUBLEBUFFER}, 10, 10);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  EXPECT_EQ(read_gl(10, 10).at(3, 3), (Pixel{0, 0, 0, 255}));
}

TEST_F(GlxWindowTest, WithAlphaItReadsAsWritten) {
  open({GLX_RGBA, GLX_DOUBLEBUFFER, GLX_ALPHA_SIZE, 8}, 10, 10);
  glClearColor(0, 0, 0, 0.2f);
  glClear(GL_COLOR_BUFFER_BIT);
  EXPECT_EQ(read_gl(10, 10).at(3, 3), (Pixel{0, 0, 0, 51}));
  GLint bits = 0;
  glGetIntegerv(GL_ALPHA_BITS, &bits);
  EXPECT_EQ(bits, 8);
}

TEST_F(GlxWindowTest, TranslucentWindowsCarryAlpha) {
  int count = 0;
  GLXFBConfig* all = glXGetFBConfigs(display_, screen_, &count);
  XVisualInfo* visuals[2] = {};  // without and with alpha
  GLXFBConfig configs[2] = {};
  for (int i = 0; i < count; ++i) {
    XVisualInfo* visual = glXGetVisualFromFBConfig(display_, all[i]);
    int alpha = 0, double_buffered = 0;
    glXGetFBConfigAttrib(display_, all[i], GLX_ALPHA_SIZE, &alpha);
    glXGetFBConfigAttrib(display_, all[i], GLX_DOUBLEBUFFER, &double_buffered);
    const int slot = alpha ? 1 : 0;
    if (visual->depth == 32 && double_buffered && !visuals[slot]) {
      visuals[slot] = visual;
      configs[slot] = all[i];
    } else {
      XFree(visual);
    }
  }
  XFree(all);
  if (!visuals[0] || !visuals[1]) GTEST_SKIP() << "the server has no 32-bit visual";
  for (const int slot : {0, 1}) {
    const Window window = create_window(*visuals[slot], 12, 12);
    const GLXContext context = glXCreateNewContext(display_, configs[slot], GLX_RGBA_TYPE, nullptr, True);
    ASSERT_TRUE(glXMakeCurrent(display_, window, context));
    expect_halfspace();
    glClearColor(0.2f, 0.4f, 0, 0.6f);
    glClear(GL_COLOR_BUFFER_BIT);
    glXSwapBuffers(display_, window);
    EXPECT_EQ(read_x(window, 12, 12).at(5, 5), (Pixel{51, 102, 0, slot ? 153 : 255}));
    glXMakeCurrent(display_, 0, nullptr);
    glXDestroyContext(display_, context);
    XFree(visuals[slot]);
  }
}

TEST_F(GlxWindowTest, CopySubBufferShowsItsRectangleOnly) {
  open({GLX_RGBA, GLX_DOUBLEBUFFER}, 40, 30);
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glXSwapBuffers(display_, window_);
  draw_picture(40, 30);
  glXCopySubBufferMESA(display_, window_, 5, 3, 9, 8);
  Picture want{40, 30, std::vector<Pixel>(40 * 30)};
  for (int y = 3; y < 11; ++y)
    for (int x = 5; x < 14; ++x) want.pixels[size_t(y * 40 + x)] = expected_pixel(x, y);
  EXPECT_EQ(difference(read_x(window_, 40, 30), want, bits_lost()), "");
}

TEST_F(GlxWindowTest, GlxWindowOfAConfig) {
  const GLXFBConfig chosen = config({GLX_DOUBLEBUFFER, True});
  ASSERT_NE(chosen, nullptr);
  visual_ = glXGetVisualFromFBConfig(display_, chosen);
  window_ = create_window(*visual_, 37, 29);
  const GLXWindow glx_window = glXCreateWindow(display_, chosen, window_, nullptr);
  ASSERT_NE(glx_window, GLXWindow(0));
  EXPECT_NE(glx_window, window_);
  context_ = glXCreateNewContext(display_, chosen, GLX_RGBA_TYPE, nullptr, True);
  ASSERT_TRUE(glXMakeContextCurrent(display_, glx_window, glx_window, context_));
  expect_halfspace();
  EXPECT_EQ(glXGetCurrentDrawable(), glx_window);
  draw_picture(37, 29);
  glXSwapBuffers(display_, glx_window);
  EXPECT_EQ(difference(read_x(window_, 37, 29), expected_picture(37, 29), bits_lost()), "");
  unsigned width = 0, id = 0;
  glXQueryDrawable(display_, glx_window, GLX_WIDTH, &width);
  glXQueryDrawable(display_, glx_window, GLX_FBCONFIG_ID, &id);
  int chosen_id = -1;
  glXGetFBConfigAttrib(display_, chosen, GLX_FBCONFIG_ID, &chosen_id);
  EXPECT_EQ(width, 37u);
  EXPECT_EQ(int(id), chosen_id);
  glXDestroyWindow(display_, glx_window);
  draw_picture(37, 29);  // still current
  EXPECT_EQ(difference(read_gl(37, 29), expected_picture(37, 29)), "");
}

TEST_F(GlxWindowTest, LargerThanTheScreenAndOnePixelSmall) {
  open({GLX_RGBA, GLX_DOUBLEBUFFER}, 1, 1);
  glClearColor(0, 1, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glXSwapBuffers(display_, window_);
  EXPECT_EQ(read_x(window_, 1, 1).at(0, 0), (Pixel{0, 255, 0}));
  XResizeWindow(display_, window_, 3000, 2100);
  XSync(display_, False);
  ASSERT_TRUE(glXMakeCurrent(display_, window_, context_));
  draw_picture(3000, 2100);
  glXSwapBuffers(display_, window_);
  EXPECT_EQ(difference(read_gl(3000, 2100), expected_picture(3000, 2100)), "");
}

}  // namespace
}  // namespace halfspace::test
