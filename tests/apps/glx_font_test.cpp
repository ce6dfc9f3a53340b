// glXUseXFont: text drawn by lists is the text the server draws.
#include <algorithm>

#include "tests/apps/glx_fixture.h"

namespace halfspace::test {
namespace {

constexpr int kWidth = 150, kHeight = 40, kLeft = 9, kBaseline = 13;
const std::string kText = "Ag(f jW_.";

class GlxFontTest : public GlxTest {
 protected:
  // Whether the server sets a pixel, the lowest row first.
  std::vector<bool> drawn_by_x(Font font) {
    const Pixmap pixmap = XCreatePixmap(display_, RootWindow(display_, screen_), kWidth, kHeight, 1);
    XGCValues values{};
    values.font = font;
    const GC gc = XCreateGC(display_, pixmap, GCFont, &values);
    XSetForeground(display_, gc, 0);
    XFillRectangle(display_, pixmap, gc, 0, 0, kWidth, kHeight);
    XSetForeground(display_, gc, 1);
    XDrawString(display_, pixmap, gc, kLeft, kHeight - kBaseline, kText.data(), int(kText.size()));
    XImage* image = XGetImage(display_, pixmap, 0, 0, kWidth, kHeight, 1, XYPixmap);
    std::vector<bool> set;
    for (int y = kHeight - 1; y >= 0; --y)
      for (int x = 0; x < kWidth; ++x) set.push_back(XGetPixel(image, x, y) != 0);
    XDestroyImage(image);
    XFreeGC(display_, gc);
    XFreePixmap(display_, pixmap);
    return set;
  }

  static std::vector<bool> drawn_by_gl(GLuint base) {
    glClear(GL_COLOR_BUFFER_BIT);
    glOrtho(0, kWidth, 0, kHeight, -1, 1);
    glRasterPos2i(kLeft, kBaseline);
    glListBase(base);
    glCallLists(GLsizei(kText.size()), GL_UNSIGNED_BYTE, kText.data());
    std::vector<bool> set;
    for (const Pixel& p : read_gl(kWidth, kHeight).pixels) set.push_back(p.r != 0);
    return set;
  }
};

TEST_F(GlxFontTest, TextIsTheServersText) {
  XFontStruct* font = XLoadQueryFont(display_, "fixed");
  ASSERT_NE(font, nullptr);
  const GLXFBConfig chosen = config({GLX_DRAWABLE_TYPE, GLX_PBUFFER_BIT, GLX_DOUBLEBUFFER, False});
  const int attributes[] = {GLX_PBUFFER_WIDTH, kWidth, GLX_PBUFFER_HEIGHT, kHeight, 0};
  const GLXPbuffer pbuffer = glXCreatePbuffer(display_, chosen, attributes);
  const GLXContext context = glXCreateNewContext(display_, chosen, GLX_RGBA_TYPE, nullptr, True);
  ASSERT_TRUE(glXMakeContextCurrent(display_, pbuffer, pbuffer, context));
  expect_halfspace();
  glPixelStorei(GL_UNPACK_SKIP_PIXELS, 3);  // what the program has set is none of the font's business
  const GLuint base = glGenLists(128);
  glXUseXFont(font->fid, 32, 96, int(base) + 32);
  GLint skipped = 0;
  glGetIntegerv(GL_UNPACK_SKIP_PIXELS, &skipped);
  EXPECT_EQ(skipped, 3);
  const std::vector<bool> expected = drawn_by_x(font->fid);
  EXPECT_GT(std::count(expected.begin(), expected.end(), true), 40);
  EXPECT_EQ(drawn_by_gl(base), expected);
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
  glXMakeCurrent(display_, 0, nullptr);
  glXDestroyContext(display_, context);
  glXDestroyPbuffer(display_, pbuffer);
  XFreeFont(display_, font);
}

}  // namespace
}  // namespace halfspace::test
