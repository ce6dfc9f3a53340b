// HALFSPACE_STATS and HALFSPACE_VIEW=wireframe through the library, as a program meets them.
#include <cstdlib>
#include <string>

#include "tests/api/osmesa_context.h"

namespace halfspace::test {
namespace {

constexpr int kSize = 64;

class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) { setenv(name, value, 1); }
  ~Variable() { unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
};

// A context of its own, since both variables are read when one is made.
class Picture {
 public:
  Picture() : pixels_(kSize * kSize * 4), context_(OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, nullptr)) {
    EXPECT_TRUE(OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, kSize, kSize));
    assert_halfspace();
    clear_all(0, 0, 0, 1);
    glClear(GL_DEPTH_BUFFER_BIT);
    glOrtho(0, kSize, 0, kSize, -1, 1);
  }
  ~Picture() { OSMesaDestroyContext(context_); }
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  std::vector<GLubyte> finish() {
    glFinish();
    return pixels_;
  }

 private:
  std::vector<GLubyte> pixels_;
  OSMesaContext context_;
};

void rectangle(int x0, int y0, int x1, int y1) {
  glBegin(GL_QUADS);
  glVertex2i(x0, y0);
  glVertex2i(x1, y0);
  glVertex2i(x1, y1);
  glVertex2i(x0, y1);
  glEnd();
}

void draw_shapes() {
  glEnable(GL_CULL_FACE);
  glColor3f(1, 0.5f, 0);
  rectangle(5, 5, 50, 40);
  rectangle(60, 5, 52, 60);  // the other way round
  glBegin(GL_TRIANGLE_FAN);
  for (const auto& [x, y] : {std::pair{20, 45}, {60, 45}, {55, 60}, {25, 62}}) glVertex2i(x, y);
  glEnd();
}

std::vector<GLubyte> shapes(GLenum mode) {
  Picture picture;
  if (mode != GL_FILL) glPolygonMode(GL_FRONT_AND_BACK, mode);
  draw_shapes();
  GLint modes[2] = {};
  glGetIntegerv(GL_POLYGON_MODE, modes);
  EXPECT_EQ(GLenum(modes[0]), mode);
  return picture.finish();
}

TEST(Wireframe, ShowsTheEdgesOfWhatIsFilledAndTellsNobody) {
  const std::vector<GLubyte> filled = shapes(GL_FILL), edges = shapes(GL_LINE), corners = shapes(GL_POINT);
  ASSERT_NE(filled, edges);
  const Variable view("HALFSPACE_VIEW", "wireframe");
  EXPECT_EQ(shapes(GL_FILL), edges);
  EXPECT_EQ(shapes(GL_POINT), corners);
}

std::string words_of(const char* wish) {
  const Variable statistics("HALFSPACE_STATS", wish);
  ::testing::internal::CaptureStderr();
  {
    Picture picture;
    glEnable(GL_CULL_FACE);
    rectangle(8, 8, 24, 16);
    glEnable(GL_DEPTH_TEST);
    rectangle(0, 0, 64, 64);
    glBegin(GL_TRIANGLES);
    glVertex2i(0, 0), glVertex2i(0, 8), glVertex2i(8, 0);  // clockwise
    glEnd();
    picture.finish();
  }
  return ::testing::internal::GetCapturedStderr();
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Statistics, OfAPicture) {
  const std::string words = words_of("1");
  EXPECT_TRUE(holds(words, "picture: 3 draws")) << words;
  EXPECT_TRUE(holds(words, "(1 culled, 0 clipped)")) << words;
  // 16 x 8 pixels, and all 64 x 64
  EXPECT_TRUE(holds(words, "4224 fragments (0 in double), overdraw 1.03")) << words;
  EXPECT_TRUE(holds(words, "depth_less")) << words;
  EXPECT_FALSE(holds(words, "halfspace: draw:")) << words;
}

TEST(Statistics, OfEachDraw) {
  const std::string words = words_of("draws");
  EXPECT_TRUE(holds(words, " 128 fragments (")) << words;
  EXPECT_TRUE(holds(words, " 4096 fragments (")) << words;
  EXPECT_TRUE(holds(words, "picture: 3 draws")) << words;
  size_t draws = 0;
  for (size_t at = words.find("halfspace: draw:"); at != std::string::npos;
       at = words.find("halfspace: draw:", at + 1))
    ++draws;
  EXPECT_EQ(draws, 3u) << words;
}

TEST(Statistics, AreSilentUnlessAsked) {
  EXPECT_EQ(words_of(""), "");
  EXPECT_EQ(words_of("0"), "");
}

}  // namespace
}  // namespace halfspace::test
