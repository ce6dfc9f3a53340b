// A display, windows and a picture whose every pixel is known, for the GLX tests.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#define GL_GLEXT_PROTOTYPES 1
#define GLX_GLXEXT_PROTOTYPES 1
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>

namespace halfspace::test {

struct Pixel {
  int r = 0, g = 0, b = 0, a = 255;
  bool operator==(const Pixel&) const = default;
};
inline std::ostream& operator<<(std::ostream& out, const Pixel& p) {
  return out << '(' << p.r << ' ' << p.g << ' ' << p.b << ' ' << p.a << ')';
}

struct Picture {
  int width = 0, height = 0;
  std::vector<Pixel> pixels;  // the lowest row first
  const Pixel& at(int x, int y) const { return pixels[size_t(y) * size_t(width) + size_t(x)]; }
};

// X errors that reach the program; each test fails on any it did not ask for.
inline int x_error_count = 0;
inline int count_x_error(Display*, XErrorEvent*) {
  ++x_error_count;
  return 0;
}

class GlxTest : public testing::Test {
 protected:
  void SetUp() override {
    x_error_count = 0;
    XSetErrorHandler(count_x_error);
    display_ = XOpenDisplay(nullptr);
    ASSERT_NE(display_, nullptr) << "no X server; run by with_xvfb.sh";
    screen_ = DefaultScreen(display_);
  }

  void TearDown() override {
    if (!display_) return;
    glXMakeCurrent(display_, 0, nullptr);
    XSync(display_, False);
    XCloseDisplay(display_);
    EXPECT_EQ(x_error_count, 0) << "X errors reached the program";
  }

  XVisualInfo* choose(std::vector<int> attributes) {
    attributes.push_back(0);
    return glXChooseVisual(display_, screen_, attributes.data());
  }

  GLXFBConfig config(std::vector<int> attributes) {
    attributes.push_back(0);
    int count = 0;
    GLXFBConfig* found = glXChooseFBConfig(display_, screen_, attributes.data(), &count);
    if (!found) return nullptr;
    const GLXFBConfig first = found[0];
    XFree(found);
    return first;
  }

  Window create_window(const XVisualInfo& visual, int width, int height) {
    XSetWindowAttributes attributes{};
    attributes.colormap = XCreateColormap(display_, RootWindow(display_, screen_), visual.visual, AllocNone);
    attributes.override_redirect = True;  // no window manager between us and the size
    const Window window =
        XCreateWindow(display_, RootWindow(display_, screen_), 100 * windows_++, 0, unsigned(width),
                      unsigned(height), 0, visual.depth, InputOutput, visual.visual,
                      CWColormap | CWBorderPixel | CWOverrideRedirect, &attributes);
    XMapRaised(display_, window);
    XSync(display_, False);
    return window;
  }

  // What GL has. A test of ours must not pass by testing another library.
  static void expect_halfspace() {
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    ASSERT_NE(renderer, nullptr);
    ASSERT_EQ(std::string(renderer).rfind("Halfspace", 0), 0u) << renderer;
  }

  static Picture read_gl(int width, int height) {
    std::vector<uint8_t> bytes(size_t(width) * size_t(height) * 4);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
    Picture picture{width, height, {}};
    for (size_t i = 0; i < bytes.size(); i += 4)
      picture.pixels.push_back({bytes[i], bytes[i + 1], bytes[i + 2], bytes[i + 3]});
    return picture;
  }

  // What X shows, its bits widened as 565 has them to 8.
  Picture read_x(Drawable drawable, int width, int height) {
    XImage* image =
        XGetImage(display_, drawable, 0, 0, unsigned(width), unsigned(height), AllPlanes, ZPixmap);
    Picture picture{width, height, {}};
    if (!image) return picture;
    for (int y = height - 1; y >= 0; --y) {
      for (int x = 0; x < width; ++x) {
        const unsigned long v = XGetPixel(image, x, y);
        if (image->depth == 16) {
          const int r = int(v >> 11 & 31), g = int(v >> 5 & 63), b = int(v & 31);
          picture.pixels.push_back({r << 3 | r >> 2, g << 2 | g >> 4, b << 3 | b >> 2});
        } else {
          picture.pixels.push_back({int(v >> 16 & 255), int(v >> 8 & 255), int(v & 255),
                                    image->depth == 32 ? int(v >> 24 & 255) : 255});
        }
      }
    }
    XDestroyImage(image);
    return picture;
  }

  Display* display_ = nullptr;
  int screen_ = 0;
  std::atomic<int> windows_ = 0;  // side by side: what one covers of another, X does not show
};

// Two rectangles on a background, nothing symmetric: a picture upside down, mirrored, with its components
// swapped or a row off is another one. `a`: the alpha written.
inline constexpr Pixel kBackground{24, 48, 96}, kFirst{248, 128, 8}, kSecond{64, 252, 160};

inline Pixel expected_pixel(int x, int y) {
  if (x >= 7 && x < 19 && y >= 2 && y < 5) return kSecond;
  if (x >= 3 && x < 11 && y >= 4 && y < 17) return kFirst;
  return kBackground;
}

inline Picture expected_picture(int width, int height) {
  Picture picture{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture.pixels.push_back(expected_pixel(x, y));
  return picture;
}

inline void draw_rectangle(const Pixel& color, int x0, int y0, int x1, int y1) {
  glColor4ub(GLubyte(color.r), GLubyte(color.g), GLubyte(color.b), 255);
  glBegin(GL_TRIANGLES);
  for (const auto& [x, y] : {std::pair{x0, y0}, {x1, y0}, {x1, y1}, {x0, y0}, {x1, y1}, {x0, y1}})
    glVertex2i(x, y);
  glEnd();
}

// Into the current drawable of this size.
inline void draw_picture(int width, int height) {
  glViewport(0, 0, width, height);
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glOrtho(0, width, 0, height, -1, 1);
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  glClearColor(float(kBackground.r) / 255, float(kBackground.g) / 255, float(kBackground.b) / 255, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  draw_rectangle(kFirst, 3, 4, 11, 17);
  draw_rectangle(kSecond, 7, 2, 19, 5);
}

// Empty when equal; else where the first difference is. `bits_lost`: 16-bit screens keep 5 or 6 bits.
inline std::string difference(const Picture& got, const Picture& want, bool bits_lost = false) {
  if (got.width != want.width || got.height != want.height || got.pixels.size() != want.pixels.size())
    return "sizes differ";
  const int tolerance = bits_lost ? 8 : 0;
  for (int y = 0; y < got.height; ++y) {
    for (int x = 0; x < got.width; ++x) {
      const Pixel &g = got.at(x, y), &w = want.at(x, y);
      const bool near = std::abs(g.r - w.r) <= tolerance && std::abs(g.g - w.g) <= tolerance &&
                        std::abs(g.b - w.b) <= tolerance && g.a == w.a;
      if (near) continue;
      std::ostringstream out;
      out << "at " << x << ',' << y << ": got " << g << ", want " << w;
      return out.str();
    }
  }
  return {};
}

}  // namespace halfspace::test
