// Depth: 24 bits, of which none may be lost.
#include <cmath>

#include "cases.h"

namespace halfspace::hard {
namespace {

constexpr int kCells = 8;
constexpr Rgb kRed{200, 0, 0}, kGreen{0, 200, 0};

void color(const Rgb& c) { glColor3ub(GLubyte(c.r), GLubyte(c.g), GLubyte(c.b)); }

// A hilly floor in perspective, with parts that hide others.
void hills(uint64_t seed) {
  Random random(seed);
  constexpr int kColumns = 24;
  float height[kColumns + 1][kColumns + 1];
  for (auto& row : height)
    for (float& h : row) h = random.real(-1.6f, -0.3f);
  for (int j = 0; j < kColumns; ++j) {
    glBegin(GL_TRIANGLE_STRIP);
    for (int i = 0; i <= kColumns; ++i) {
      for (int k = 0; k < 2; ++k) {
        const float x = float(i) - kColumns / 2.0f, z = -1.5f - 0.7f * float(j + k);
        glNormal3f(0.2f * float(i % 3 - 1), 0.9f, 0.3f);
        glTexCoord2f(x / 4, z / 4);
        glVertex3f(x, height[j + k][i], z);
      }
    }
    glEnd();
  }
}

// The scene of depth_range_reversed: random triangles over each other.
void pile() {
  Random random(43);
  glBegin(GL_TRIANGLES);
  for (int i = 0; i < 60; ++i) {
    color({int(random.integer(40, 255)), int(random.integer(40, 255)), int(random.integer(40, 255))});
    for (int k = 0; k < 3; ++k) {
      const float x = random.real(-1.2f, 1.2f), y = random.real(-1.2f, 1.2f);
      glVertex3f(x, y, random.real(-1, 1));
    }
  }
  glEnd();
}

}  // namespace

void depth_ladder(Stage& stage) {
  Random random(41);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glEnable(GL_SCISSOR_TEST);
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i) {
      const int x0 = stage.width * i / kCells, y0 = stage.height * j / kCells;
      glScissor(x0, y0, stage.width * (i + 1) / kCells - x0, stage.height * (j + 1) / kCells - y0);
      constexpr int kRungs = 16;
      // Somewhere in the range, far from its middle, where rounding jumps by one.
      const int64_t base = (j * kCells + i) * int64_t{262144} + random.integer(1, 200000);
      const int first = int(random.integer(0, kRungs - 1));
      for (int k = 0; k < kRungs; ++k) {
        const int rung = (first + 5 * k) % kRungs;
        // -1 + m * 2^-23 is a float, and the viewport takes it to m * (1 - 2^-24) units.
        const float z = float(-1 + double(base + rung) / 8388608);
        color(rung == 0 ? kGreen : Rgb{100 + 8 * rung, 0, 8 * rung});
        rectangle(-1, -1, 1, 1, z);
      }
    }
  }
  stage.expect_all(kGreen);
}

void polygon_offset_pairs(Stage& stage) {
  Random random(42);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glEnable(GL_SCISSOR_TEST);
  const auto middle = [&](int j) { return stage.height * (2 * j + 1) / (2 * kCells); };
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i) {
      const int x0 = stage.width * i / kCells, w = stage.width * (i + 1) / kCells - x0;
      float z[4];
      for (float& v : z) v = random.real(-0.9f, 0.9f);
      z[3] = z[0] + z[2] - z[1];
      // The window's whole plane is drawn, and the cell cut out of it: slopes up to 2 in 256 px.
      const auto plane = [&] {
        glBegin(GL_QUADS);
        glVertex3f(-1, -1, z[0] / 2), glVertex3f(1, -1, z[1] / 2), glVertex3f(1, 1, z[2] / 2),
            glVertex3f(-1, 1, z[3] / 2);
        glEnd();
      };
      for (int half = 0; half < 2; ++half) {
        const int y0 = half ? middle(j) : stage.height * j / kCells,
                  y1 = half ? stage.height * (j + 1) / kCells : middle(j);
        glScissor(x0, y0, w, y1 - y0);
        glDisable(GL_POLYGON_OFFSET_FILL);
        color(kRed);
        plane();
        glEnable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(0, half ? -1.0f : 1.0f);
        color(kGreen);
        plane();
      }
    }
  }
  stage.expect(stage.read(), [&](int, int y) {
    for (int j = 0; j < kCells; ++j)
      if (y >= stage.height * j / kCells && y < stage.height * (j + 1) / kCells)
        return std::vector<Rgb>{y < middle(j) ? kRed : kGreen};
    return std::vector<Rgb>{};
  });
}

void multipass_equal(Stage& stage) {
  square_view(0.5, 60);
  glEnable(GL_DEPTH_TEST);
  color({60, 60, 60});
  hills(44);
  glDepthFunc(GL_EQUAL);
  glDepthMask(GL_FALSE);
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_ALWAYS, 0, 255);
  glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
  const auto texels = noise(45, 16, 16);
  constexpr int kPasses = 6;
  for (int pass = 0; pass < kPasses; ++pass) {
    glPushAttrib(GL_ALL_ATTRIB_BITS);
    if (pass == 1 || pass == 5) bind_texture(texels, 16, 16, pass == 1 ? GL_NEAREST : GL_LINEAR, GL_REPEAT);
    if (pass == 2 || pass == 5) glEnable(GL_FOG);
    if (pass == 3) glEnable(GL_LIGHTING), glEnable(GL_LIGHT0);
    if (pass == 4 || pass == 5) glEnable(GL_BLEND), glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    if (pass == 4) glShadeModel(GL_FLAT), glColor4f(1, 0.5f, 0.25f, 0.5f);
    hills(44);
    glPopAttrib();
  }
  const Picture drawn = stage.read();
  std::vector<uint8_t> count(drawn.depth.size());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, stage.width, stage.height, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, count.data());
  size_t missed = 0;
  for (size_t i = 0; i < count.size(); ++i)
    missed += count[i] != (drawn.depth[i] == (1u << 24) - 1 ? 0 : kPasses);
  if (missed) stage.complain(std::to_string(missed) + " pixels missed a pass");
}

void depth_range_reversed(Stage& stage) {
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_SCISSOR_TEST);
  const int w = stage.width / 2;
  glScissor(0, 0, w, stage.height);
  glViewport(0, 0, w, stage.height);
  pile();
  glScissor(w, 0, w, stage.height);
  glViewport(w, 0, w, stage.height);
  glClearDepth(0);
  glClear(GL_DEPTH_BUFFER_BIT);
  glDepthRange(1, 0);
  glDepthFunc(GL_GREATER);
  pile();
  const Picture picture = stage.read();
  stage.expect(picture, [&](int x, int y) {
    if (x >= w) return std::vector<Rgb>{};
    const uint8_t* p = picture.pixel(x + w, y);
    return std::vector<Rgb>{{p[0], p[1], p[2]}};
  });
  for (int y = 0; y < stage.height; ++y) {
    for (int x = 0; x < w; ++x) {
      const auto left = int64_t(picture.depth[picture.index(x, y)]),
                 right = int64_t(picture.depth[picture.index(x + w, y)]);
      if (left + right != (1 << 24) - 1)
        stage.complain("depth " + std::to_string(left) + " is mirrored as " + std::to_string(right));
    }
  }
}

}  // namespace halfspace::hard
