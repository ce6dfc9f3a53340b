// Pbuffers and pixmaps.
#include "tests/apps/glx_fixture.h"

namespace halfspace::test {
namespace {

class GlxOffscreenTest : public GlxTest {
 protected:
  GLXContext create(GLXFBConfig chosen) {
    const GLXContext context = glXCreateNewContext(display_, chosen, GLX_RGBA_TYPE, nullptr, True);
    EXPECT_NE(context, nullptr);
    return context;
  }
  void release(GLXContext context) {
    glXMakeCurrent(display_, 0, nullptr);
    glXDestroyContext(display_, context);
  }
  unsigned query(GLXDrawable drawable, int attribute) {
    unsigned value = ~0u;
    glXQueryDrawable(display_, drawable, attribute, &value);
    return value;
  }
};

TEST_F(GlxOffscreenTest, PbufferHoldsThePicture) {
  for (const int double_buffered : {False, True}) {
    const GLXFBConfig chosen =
        config({GLX_DRAWABLE_TYPE, GLX_PBUFFER_BIT, GLX_DOUBLEBUFFER, double_buffered, GLX_ALPHA_SIZE, 8});
    ASSERT_NE(chosen, nullptr);
    const int attributes[] = {GLX_PBUFFER_WIDTH, 61, GLX_PBUFFER_HEIGHT, 43, GLX_PRESERVED_CONTENTS, True, 0};
    const GLXPbuffer pbuffer = glXCreatePbuffer(display_, chosen, attributes);
    ASSERT_NE(pbuffer, GLXPbuffer(0));
    EXPECT_EQ(query(pbuffer, GLX_WIDTH), 61u);
    EXPECT_EQ(query(pbuffer, GLX_HEIGHT), 43u);
    EXPECT_EQ(query(pbuffer, GLX_PRESERVED_CONTENTS), 1u);
    EXPECT_EQ(query(pbuffer, GLX_LARGEST_PBUFFER), 0u);
    const GLXContext context = create(chosen);
    ASSERT_TRUE(glXMakeContextCurrent(display_, pbuffer, pbuffer, context));
    expect_halfspace();
    draw_picture(61, 43);
    EXPECT_EQ(difference(read_gl(61, 43), expected_picture(61, 43)), "");
    glXSwapBuffers(display_, pbuffer);
    glClearColor(1, 0, 0, 1);
    if (double_buffered) glClear(GL_COLOR_BUFFER_BIT);
    glReadBuffer(GL_FRONT);
    EXPECT_EQ(difference(read_gl(61, 43), expected_picture(61, 43)), "") << "after the swap";
    glXDestroyPbuffer(display_, pbuffer);
    EXPECT_EQ(difference(read_gl(61, 43), expected_picture(61, 43)), "") << "it stays while it is current";
    release(context);
    EXPECT_EQ(query(pbuffer, GLX_PRESERVED_CONTENTS), 0u) << "and is gone afterwards";
  }
}

TEST_F(GlxOffscreenTest, PbufferSizes) {
  const GLXFBConfig chosen = config({GLX_DRAWABLE_TYPE, GLX_PBUFFER_BIT});
  int largest = 0;
  glXGetFBConfigAttrib(display_, chosen, GLX_MAX_PBUFFER_WIDTH, &largest);
  ASSERT_GT(largest, 4095);
  const int too_wide[] = {GLX_PBUFFER_WIDTH, largest + 1, GLX_PBUFFER_HEIGHT, 5, 0};
  EXPECT_EQ(glXCreatePbuffer(display_, chosen, too_wide), GLXPbuffer(0));
  const int as_wide_as_can_be[] = {
      GLX_PBUFFER_WIDTH, largest + 1, GLX_PBUFFER_HEIGHT, 5, GLX_LARGEST_PBUFFER, 1, 0};
  const GLXPbuffer pbuffer = glXCreatePbuffer(display_, chosen, as_wide_as_can_be);
  ASSERT_NE(pbuffer, GLXPbuffer(0));
  EXPECT_EQ(query(pbuffer, GLX_WIDTH), unsigned(largest));
  EXPECT_EQ(query(pbuffer, GLX_LARGEST_PBUFFER), 1u);
  glXDestroyPbuffer(display_, pbuffer);
  const GLXPbuffer empty = glXCreatePbuffer(display_, chosen, nullptr);  // 0 x 0 is the default
  ASSERT_NE(empty, GLXPbuffer(0));
  const GLXContext context = create(chosen);
  ASSERT_TRUE(glXMakeContextCurrent(display_, empty, empty, context));
  glClear(GL_COLOR_BUFFER_BIT);
  glFinish();
  release(context);
}

TEST_F(GlxOffscreenTest, PbufferOfAnotherConfigIsRefused) {
  const GLXFBConfig with = config({GLX_DRAWABLE_TYPE, GLX_PBUFFER_BIT, GLX_ALPHA_SIZE, 8});
  const GLXFBConfig without = config({GLX_DRAWABLE_TYPE, GLX_PBUFFER_BIT});
  const int attributes[] = {GLX_PBUFFER_WIDTH, 8, GLX_PBUFFER_HEIGHT, 8, 0};
  const GLXPbuffer pbuffer = glXCreatePbuffer(display_, with, attributes);
  const GLXContext context = create(without);
  EXPECT_FALSE(glXMakeContextCurrent(display_, pbuffer, pbuffer, context));
  glXDestroyContext(display_, context);
  glXDestroyPbuffer(display_, pbuffer);
}

TEST_F(GlxOffscreenTest, SelectedEventsAreKept) {
  const GLXFBConfig chosen = config({GLX_DRAWABLE_TYPE, GLX_PBUFFER_BIT});
  const GLXPbuffer pbuffer = glXCreatePbuffer(display_, chosen, nullptr);
  unsigned long mask = 1;
  glXGetSelectedEvent(display_, pbuffer, &mask);
  EXPECT_EQ(mask, 0ul);
  glXSelectEvent(display_, pbuffer, GLX_PBUFFER_CLOBBER_MASK);
  glXGetSelectedEvent(display_, pbuffer, &mask);
  EXPECT_EQ(mask, static_cast<unsigned long>(GLX_PBUFFER_CLOBBER_MASK));
  glXDestroyPbuffer(display_, pbuffer);
}

TEST_F(GlxOffscreenTest, PixmapShowsWhatWasDrawn) {
  for (const int double_buffered : {False, True}) {  // a pixmap is drawn to at once in either case
    std::vector<int> list = {GLX_RGBA};
    if (double_buffered) list.push_back(GLX_DOUBLEBUFFER);
    XVisualInfo* visual = choose(list);
    ASSERT_NE(visual, nullptr);
    const Pixmap pixmap =
        XCreatePixmap(display_, RootWindow(display_, screen_), 37, 29, unsigned(visual->depth));
    const GLXPixmap glx_pixmap = glXCreateGLXPixmap(display_, visual, pixmap);
    ASSERT_NE(glx_pixmap, GLXPixmap(0));
    const GLXContext context = glXCreateContext(display_, visual, nullptr, False);
    ASSERT_TRUE(glXMakeCurrent(display_, glx_pixmap, context));
    expect_halfspace();
    draw_picture(37, 29);
    glXWaitGL();
    EXPECT_EQ(difference(read_x(pixmap, 37, 29), expected_picture(37, 29), visual->depth == 16), "");
    glXDestroyGLXPixmap(display_, glx_pixmap);
    release(context);
    XFreePixmap(display_, pixmap);
    XFree(visual);
  }
}

TEST_F(GlxOffscreenTest, PixmapMustHaveTheConfigsDepth) {
  const GLXFBConfig chosen = config({GLX_DRAWABLE_TYPE, GLX_PIXMAP_BIT});
  const Pixmap bitmap = XCreatePixmap(display_, RootWindow(display_, screen_), 8, 8, 1);
  EXPECT_EQ(glXCreatePixmap(display_, chosen, bitmap, nullptr), GLXPixmap(0));
  EXPECT_EQ(glXCreatePixmap(display_, chosen, 0x7ffffff, nullptr), GLXPixmap(0));
  XFreePixmap(display_, bitmap);
}

}  // namespace
}  // namespace halfspace::test
