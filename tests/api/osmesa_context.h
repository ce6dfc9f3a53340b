// An OSMesa context for a test: created, current on a buffer of its own, known to be ours.
#pragma once

#include <GL/osmesa.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace halfspace::test {

inline void assert_halfspace() {
  const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  ASSERT_NE(renderer, nullptr);
  ASSERT_EQ(std::string(renderer).substr(0, 9), "Halfspace") << renderer;
}

class OsmesaTest : public ::testing::Test {
 protected:
  static constexpr int kWidth = 5, kHeight = 3;  // odd and different, so that a mixed-up stride shows

  void SetUp() override {
    context_ = OSMesaCreateContext(OSMESA_RGBA, nullptr);
    ASSERT_NE(context_, nullptr);
    buffer_.assign(kWidth * kHeight * 4, 0xEE);
    ASSERT_TRUE(OSMesaMakeCurrent(context_, buffer_.data(), GL_UNSIGNED_BYTE, kWidth, kHeight));
    assert_halfspace();
  }
  // While it is current: a release would show the picture in a test's own buffer, which is gone.
  void TearDown() override { OSMesaDestroyContext(context_); }

  OSMesaContext context_ = nullptr;
  std::vector<GLubyte> buffer_;
};

// Clears one pixel, (x, y) from the lower left.
inline void clear_pixel(int x, int y, float r, float g, float b, float a) {
  glEnable(GL_SCISSOR_TEST);
  glScissor(x, y, 1, 1);
  glClearColor(r, g, b, a);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
}

inline void clear_all(float r, float g, float b, float a) {
  glClearColor(r, g, b, a);
  glClear(GL_COLOR_BUFFER_BIT);
}

}  // namespace halfspace::test
