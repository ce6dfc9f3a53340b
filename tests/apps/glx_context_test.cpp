// Contexts: sharing, threads, refusals, two drawables, displays that close.
#include <thread>

#include "tests/apps/glx_fixture.h"

namespace halfspace::test {
namespace {

class GlxContextTest : public GlxTest {
 protected:
  void SetUp() override {
    GlxTest::SetUp();
    if (!display_) return;
    visual_ = choose({GLX_RGBA, GLX_DOUBLEBUFFER});
    ASSERT_NE(visual_, nullptr);
    window_ = create_window(*visual_, 40, 30);
  }
  void TearDown() override {
    if (visual_) XFree(visual_);
    GlxTest::TearDown();
  }
  GLXContext create(GLXContext share = nullptr) { return glXCreateContext(display_, visual_, share, True); }

  XVisualInfo* visual_ = nullptr;
  Window window_ = 0;
};

void bind_single_color(GLuint name, Pixel color) {
  const uint8_t texel[4] = {uint8_t(color.r), uint8_t(color.g), uint8_t(color.b), 255};
  glBindTexture(GL_TEXTURE_2D, name);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texel);
}

Pixel draw_textured(GLuint name) {
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_TEXTURE_2D);
  glBindTexture(GL_TEXTURE_2D, name);
  glColor3f(1, 1, 1);
  glBegin(GL_QUADS);
  glVertex2f(-1, -1), glVertex2f(1, -1), glVertex2f(1, 1), glVertex2f(-1, 1);
  glEnd();
  uint8_t p[4] = {};
  glReadPixels(7, 9, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, p);
  return {p[0], p[1], p[2], p[3]};
}

TEST_F(GlxContextTest, TexturesAreSharedWithThoseWhoAsk) {
  const GLXContext first = create(), sharing = create(first), alone = create();
  ASSERT_TRUE(glXMakeCurrent(display_, window_, first));
  expect_halfspace();
  bind_single_color(17, {10, 20, 30});
  ASSERT_TRUE(glXMakeCurrent(display_, window_, sharing));
  EXPECT_TRUE(glIsTexture(17));
  EXPECT_EQ(draw_textured(17), (Pixel{10, 20, 30}));
  bind_single_color(17, {40, 50, 60});
  ASSERT_TRUE(glXMakeCurrent(display_, window_, alone));
  EXPECT_FALSE(glIsTexture(17));
  glXDestroyContext(display_, first);
  ASSERT_TRUE(glXMakeCurrent(display_, window_, sharing));
  EXPECT_EQ(draw_textured(17), (Pixel{40, 50, 60}));
  glXDestroyContext(display_, sharing);
  glXDestroyContext(display_, alone);
}

TEST_F(GlxContextTest, ReadsFromTheReadDrawable) {
  const GLXContext context = create();
  const Window other = create_window(*visual_, 25, 35);
  ASSERT_TRUE(glXMakeCurrent(display_, other, context));
  draw_picture(25, 35);
  ASSERT_TRUE(glXMakeContextCurrent(display_, window_, other, context));
  EXPECT_EQ(glXGetCurrentDrawable(), window_);
  EXPECT_EQ(glXGetCurrentReadDrawable(), other);
  glClearColor(1, 1, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  EXPECT_EQ(difference(read_gl(25, 35), expected_picture(25, 35)), "");
  glXSwapBuffers(display_, window_);
  EXPECT_EQ(difference(read_gl(25, 35), expected_picture(25, 35)), "");
  EXPECT_EQ(read_x(window_, 40, 30).at(20, 20), (Pixel{255, 255, 255}));
  glXMakeCurrent(display_, 0, nullptr);
  glXDestroyContext(display_, context);
}

TEST_F(GlxContextTest, RefusalsChangeNothing) {
  const GLXContext context = create();
  ASSERT_TRUE(glXMakeCurrent(display_, window_, context));
  int not_a_context = 0;
  EXPECT_FALSE(glXMakeCurrent(display_, window_, reinterpret_cast<GLXContext>(&not_a_context)));
  EXPECT_FALSE(glXMakeCurrent(display_, window_, nullptr));
  EXPECT_FALSE(glXMakeCurrent(display_, 0, context));
  EXPECT_FALSE(glXMakeCurrent(display_, 0x7ffffff, context));
  glBegin(GL_POINTS);
  EXPECT_FALSE(glXMakeCurrent(display_, 0, nullptr)) << "between glBegin and glEnd";
  glEnd();
  EXPECT_EQ(glXGetCurrentContext(), context);
  EXPECT_EQ(glXGetCurrentDisplay(), display_);
  glXDestroyContext(display_, reinterpret_cast<GLXContext>(&not_a_context));
  glXSwapBuffers(display_, 0x7ffffff);
  EXPECT_EQ(glXCreateContext(display_, visual_, reinterpret_cast<GLXContext>(&not_a_context), True), nullptr);
  XVisualInfo nothing{};
  EXPECT_EQ(glXCreateContext(display_, &nothing, nullptr, True), nullptr);
  draw_picture(40, 30);
  EXPECT_EQ(difference(read_gl(40, 30), expected_picture(40, 30)), "");
  glXMakeCurrent(display_, 0, nullptr);
  glXDestroyContext(display_, context);
}

TEST_F(GlxContextTest, AWindowOfAnotherDepthIsRefused) {
  XVisualInfo wanted{};
  wanted.screen = screen_;
  wanted.depth = 32;
  int count = 0;
  XVisualInfo* deep = XGetVisualInfo(display_, VisualScreenMask | VisualDepthMask, &wanted, &count);
  if (!deep) GTEST_SKIP() << "the server has no 32-bit visual";
  const Window window = create_window(*deep, 10, 10);
  const GLXContext context = create();
  EXPECT_FALSE(glXMakeCurrent(display_, window, context));
  glXDestroyContext(display_, context);
  XFree(deep);
}

TEST_F(GlxContextTest, OneThreadAtATime) {
  const GLXContext context = create(), second = create();
  ASSERT_TRUE(glXMakeCurrent(display_, window_, context));
  std::thread([&] {
    EXPECT_EQ(glXGetCurrentContext(), nullptr);
    EXPECT_FALSE(glXMakeCurrent(display_, window_, context)) << "current to the other thread";
    EXPECT_TRUE(glXMakeCurrent(display_, window_, second));
    draw_picture(40, 30);
    // Ends without letting go.
  }).join();
  EXPECT_EQ(difference(read_gl(40, 30), expected_picture(40, 30)), "");
  EXPECT_TRUE(glXMakeCurrent(display_, window_, second)) << "the thread that had it is gone";
  glXMakeCurrent(display_, 0, nullptr);
  glXDestroyContext(display_, context);
  glXDestroyContext(display_, second);
}

TEST_F(GlxContextTest, ThreadsDrawSideBySide) {
  std::vector<std::thread> threads;
  std::vector<std::string> results(4);
  for (size_t i = 0; i < results.size(); ++i) {
    threads.emplace_back([this, i, &results] {
      const int width = 30 + int(i) * 17, height = 40 + int(i);
      const Window window = create_window(*visual_, width, height);
      const GLXContext context = create();
      if (!glXMakeCurrent(display_, window, context)) return void(results[i] = "refused");
      for (int frame = 0; frame < 20 && results[i].empty(); ++frame) {
        draw_picture(width, height);
        results[i] = difference(read_gl(width, height), expected_picture(width, height));
        glXSwapBuffers(display_, window);
      }
      glXMakeCurrent(display_, 0, nullptr);
      glXDestroyContext(display_, context);
      XDestroyWindow(display_, window);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::string& result : results) EXPECT_EQ(result, "");
}

TEST_F(GlxContextTest, ClosingADisplayWhileCurrent) {
  for (int round = 0; round < 3; ++round) {
    Display* other = XOpenDisplay(nullptr);
    int attributes[] = {GLX_RGBA, GLX_DOUBLEBUFFER, 0};
    XVisualInfo* visual = glXChooseVisual(other, DefaultScreen(other), attributes);
    ASSERT_NE(visual, nullptr);
    XSetWindowAttributes window_attributes{};
    const Window window = XCreateWindow(other, DefaultRootWindow(other), 0, 0, 40, 30, 0, CopyFromParent,
                                        InputOutput, CopyFromParent, 0, &window_attributes);
    const GLXContext context = glXCreateContext(other, visual, nullptr, True);
    ASSERT_TRUE(glXMakeCurrent(other, window, context));
    draw_picture(40, 30);
    glXSwapBuffers(other, window);
    XFree(visual);
    XCloseDisplay(other);
    draw_picture(40, 30);  // to memory
    glFinish();
    EXPECT_EQ(difference(read_gl(40, 30), expected_picture(40, 30)), "");
    EXPECT_TRUE(glXMakeCurrent(display_, 0, nullptr));
    glXDestroyContext(display_, context);  // gone already
  }
}

TEST_F(GlxContextTest, CopyContextTakesTheGroupsOfTheMask) {
  const GLXContext from = create(), to = create();
  ASSERT_TRUE(glXMakeCurrent(display_, window_, to));  // its first, so that the next keeps the viewport
  ASSERT_TRUE(glXMakeCurrent(display_, window_, from));
  glViewport(1, 2, 3, 4);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GEQUAL);
  glClearColor(0.25f, 0, 0, 0);
  glXCopyContext(display_, from, to, GL_VIEWPORT_BIT | GL_DEPTH_BUFFER_BIT);
  ASSERT_TRUE(glXMakeCurrent(display_, window_, to));
  GLint box[4] = {}, func = 0;
  GLfloat clear[4] = {};
  glGetIntegerv(GL_VIEWPORT, box);
  glGetIntegerv(GL_DEPTH_FUNC, &func);
  glGetFloatv(GL_COLOR_CLEAR_VALUE, clear);
  EXPECT_EQ(std::vector<int>(box, box + 4), (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(func, GL_GEQUAL);
  EXPECT_TRUE(glIsEnabled(GL_DEPTH_TEST));
  EXPECT_EQ(clear[0], 0.0f) << "not in the mask";
  glXMakeCurrent(display_, 0, nullptr);
  glXDestroyContext(display_, from);
  glXDestroyContext(display_, to);
}

TEST_F(GlxContextTest, AttribsARBGivesWhatThereIs) {
  const GLXFBConfig chosen = config({GLX_DOUBLEBUFFER, True});
  const auto create_version = [&](std::vector<int> attributes) {
    attributes.push_back(0);
    const GLXContext context = glXCreateContextAttribsARB(display_, chosen, nullptr, True, attributes.data());
    if (context) glXDestroyContext(display_, context);
    return context != nullptr;
  };
  EXPECT_TRUE(create_version({}));
  EXPECT_TRUE(create_version({GLX_CONTEXT_MAJOR_VERSION_ARB, 1, GLX_CONTEXT_MINOR_VERSION_ARB, 1}));
  EXPECT_FALSE(create_version({GLX_CONTEXT_MAJOR_VERSION_ARB, 3, GLX_CONTEXT_MINOR_VERSION_ARB, 2}));
  EXPECT_FALSE(create_version({GLX_CONTEXT_MAJOR_VERSION_ARB, 1, 0x7777, 1}));
}

TEST_F(GlxContextTest, QueriesOfAContext) {
  const GLXFBConfig chosen = config({GLX_DOUBLEBUFFER, True, GLX_ALPHA_SIZE, 8});
  const GLXContext context = glXCreateNewContext(display_, chosen, GLX_RGBA_TYPE, nullptr, True);
  int want = -1, got = -2, screen = -1, type = 0;
  glXGetFBConfigAttrib(display_, chosen, GLX_FBCONFIG_ID, &want);
  EXPECT_EQ(glXQueryContext(display_, context, GLX_FBCONFIG_ID, &got), Success);
  EXPECT_EQ(glXQueryContext(display_, context, GLX_SCREEN, &screen), Success);
  EXPECT_EQ(glXQueryContext(display_, context, GLX_RENDER_TYPE, &type), Success);
  EXPECT_EQ(glXQueryContext(display_, context, 0x7777, &type), GLX_BAD_ATTRIBUTE);
  EXPECT_EQ(got, want);
  EXPECT_EQ(screen, screen_);
  EXPECT_EQ(type, GLX_RGBA_TYPE);
  EXPECT_TRUE(glXIsDirect(display_, context));
  EXPECT_EQ(glXCreateNewContext(display_, chosen, GLX_COLOR_INDEX_TYPE, nullptr, True), nullptr);
  glXDestroyContext(display_, context);
}

TEST_F(GlxContextTest, SwapIntervalIsKept) {
  const GLXContext context = create();
  EXPECT_EQ(glXSwapIntervalSGI(2), GLX_BAD_CONTEXT);
  ASSERT_TRUE(glXMakeCurrent(display_, window_, context));
  EXPECT_EQ(glXSwapIntervalSGI(2), 0);
  EXPECT_EQ(glXGetSwapIntervalMESA(), 2);
  EXPECT_EQ(glXSwapIntervalSGI(0), GLX_BAD_VALUE);
  EXPECT_EQ(glXSwapIntervalMESA(0), 0);
  EXPECT_EQ(glXGetSwapIntervalMESA(), 0);
  glXSwapIntervalEXT(display_, window_, 3);
  unsigned interval = 0;
  glXQueryDrawable(display_, window_, GLX_SWAP_INTERVAL_EXT, &interval);
  EXPECT_EQ(interval, 3u);
  glXMakeCurrent(display_, 0, nullptr);
  glXDestroyContext(display_, context);
}

TEST_F(GlxContextTest, ProcAddressesAreTheFunctions) {
  const auto address = [](const char* name) {
    return reinterpret_cast<void*>(glXGetProcAddressARB(reinterpret_cast<const GLubyte*>(name)));
  };
  EXPECT_EQ(address("glXSwapBuffers"), reinterpret_cast<void*>(glXSwapBuffers));
  EXPECT_EQ(address("glVertex3f"), reinterpret_cast<void*>(glVertex3f));
  EXPECT_EQ(address("glXNoSuchThing"), nullptr);
  EXPECT_EQ(address("glNoSuchThing"), nullptr);
  EXPECT_EQ(glXGetProcAddress(nullptr), nullptr);
}

}  // namespace
}  // namespace halfspace::test
