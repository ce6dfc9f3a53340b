// SDL2, which looks GL up at run time: wide and stippled lines, points, polygon stipple and offset, from
// display lists.
#include <SDL.h>
#include <SDL_opengl.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace {

void draw_torus(GLenum primitive) {
  constexpr int kSides = 24, kRings = 12;
  constexpr double kTurn = 6.283185307179586;
  for (int i = 0; i < kRings; ++i) {
    glBegin(primitive);
    for (int j = 0; j <= kSides; ++j)
      for (const int k : {i, i + 1}) {
        const double ring = kTurn * k / kRings, side = kTurn * j / kSides, radius = 1 + 0.4 * std::cos(ring);
        glColor3d(0.5 + 0.4 * std::cos(side), 0.5 + 0.4 * std::cos(ring), 0.6);
        glVertex3d(radius * std::cos(side), radius * std::sin(side), 0.4 * std::sin(ring));
      }
    glEnd();
  }
}

void record_lists(GLuint first) {
  std::array<GLubyte, 128> checks;
  for (size_t i = 0; i < checks.size(); ++i) checks[i] = (i / 16) % 2 ? 0xf0 : 0x0f;
  glNewList(first, GL_COMPILE);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1, 1);
  draw_torus(GL_QUAD_STRIP);
  glDisable(GL_POLYGON_OFFSET_FILL);
  glEndList();
  glNewList(first + 1, GL_COMPILE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  draw_torus(GL_QUAD_STRIP);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glEndList();
  glNewList(first + 2, GL_COMPILE);
  glPolygonStipple(checks.data());
  glEnable(GL_POLYGON_STIPPLE);
  glColor3d(0.9, 0.7, 0.3);
  glRectd(-2.6, -1.6, -1.6, 1.6);
  glDisable(GL_POLYGON_STIPPLE);
  glEnable(GL_LINE_STIPPLE);
  for (int i = 0; i < 8; ++i) {
    glLineWidth(GLfloat(1 + i));
    glLineStipple(1 + i / 2, GLushort(0x0f27 << (i % 3)));
    glBegin(GL_LINES);
    glVertex2d(1.6, -1.5 + 0.4 * i);
    glVertex2d(2.7, -1.3 + 0.4 * i);
    glEnd();
  }
  glDisable(GL_LINE_STIPPLE);
  glLineWidth(1);
  for (int i = 0; i < 12; ++i) {
    glPointSize(GLfloat(1 + i));
    glBegin(GL_POINTS);
    glVertex2d(-1.4 + 0.25 * i, -1.7);
    glEnd();
  }
  glEndList();
}

void draw(GLuint lists, int frame) {
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glOrtho(-3, 3, -2, 2, -3, 3);
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  glCallList(lists + 2);
  glRotated(50 + frame, 1, 0.2, 0);
  glRotated(20 + 2 * frame, 0, 0, 1);
  glCallList(lists);
  glPushAttrib(GL_CURRENT_BIT);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE_MINUS_DST_COLOR, GL_ZERO);
  glCallList(lists + 1);
  glDisable(GL_BLEND);
  glPopAttrib();
}

}  // namespace

int main(int, char**) {
  if (SDL_Init(SDL_INIT_VIDEO) != 0) return 1;
  SDL_Window* window = SDL_CreateWindow("SDL stipple", 0, 0, 480, 320, SDL_WINDOW_OPENGL);
  if (!window || !SDL_GL_CreateContext(window)) return 1;
  glClearColor(0.12f, 0.14f, 0.12f, 1);
  glEnable(GL_DEPTH_TEST);
  const GLuint lists = glGenLists(3);
  record_lists(lists);
  for (int frame = 0;; ++frame) {
    SDL_Event event;
    while (SDL_PollEvent(&event))
      if (event.type == SDL_QUIT) return SDL_Quit(), 0;
    draw(lists, frame);
    SDL_GL_SwapWindow(window);
  }
}
