// GLFW, which looks GL up at run time: a corridor of textured boxes in fog.
#include <GLFW/glfw3.h>

#include <array>
#include <cstdint>

namespace {

void make_texture() {
  std::array<uint8_t, 32 * 32 * 4> texels;
  for (size_t i = 0; i < 32 * 32; ++i) {
    const size_t x = i % 32, y = i / 32;
    const bool joint = y % 8 == 0 || (x + (y / 8 % 2) * 8) % 16 == 0;
    texels[i * 4] = joint ? 190 : uint8_t(150 + 3 * (x % 16));
    texels[i * 4 + 1] = joint ? 185 : uint8_t(70 + y);
    texels[i * 4 + 2] = joint ? 170 : 50;
    texels[i * 4 + 3] = 255;
  }
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 32, 32, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

void quad(const double corners[4][3], double width) {
  const double tex[4][2] = {{0, 0}, {width, 0}, {width, 1}, {0, 1}};
  for (int i = 0; i < 4; ++i) {
    glTexCoord2dv(tex[i]);
    glVertex3dv(corners[i]);
  }
}

void draw(double z) {
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glFrustum(-0.15, 0.15, -0.1, 0.1, 0.2, 60);
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  glTranslated(0, 0, z);
  glBegin(GL_QUADS);
  for (int i = 0; i < 20; ++i) {
    const double near = -2.0 * i, far = near - 2.0, x = i % 3 == 2 ? 1.6 : 1.0;
    const double left[4][3] = {{-x, -1, near}, {-x, -1, far}, {-x, 1, far}, {-x, 1, near}};
    const double right[4][3] = {{x, -1, far}, {x, -1, near}, {x, 1, near}, {x, 1, far}};
    const double floor[4][3] = {{-2, -1, near}, {2, -1, near}, {2, -1, far}, {-2, -1, far}};
    glColor3d(1, 1, 1);
    quad(left, 2);
    quad(right, 2);
    glColor3d(0.5, 0.6, 0.5);
    quad(floor, 4);
  }
  glEnd();
}

}  // namespace

int main() {
  if (!glfwInit()) return 1;
  GLFWwindow* window = glfwCreateWindow(480, 320, "GLFW fog", nullptr, nullptr);
  if (!window) return 1;
  glfwMakeContextCurrent(window);
  const GLfloat fog[] = {0.55f, 0.6f, 0.7f, 1};
  glClearColor(fog[0], fog[1], fog[2], fog[3]);
  glFogfv(GL_FOG_COLOR, fog);
  glFogi(GL_FOG_MODE, GL_EXP2);
  glFogf(GL_FOG_DENSITY, 0.07f);
  glEnable(GL_FOG);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_TEXTURE_2D);
  make_texture();
  for (int frame = 0; !glfwWindowShouldClose(window); ++frame) {
    draw(0.05 * (frame % 40));
    glfwSwapBuffers(window);
    glfwPollEvents();
  }
  glfwTerminate();
}
