// GLU's quadrics, tessellator and NURBS surfaces, and mipmaps built by gluBuild2DMipmaps.
#include <GL/freeglut.h>
#include <GL/glu.h>

#include <array>
#include <cstdint>

namespace {

int frame = 0;
GLuint star = 0, texture = 0;

using Callback = void (*)();

// A star with a hole: concave, self-crossing, two contours.
void tessellate_star() {
  static std::array<std::array<GLdouble, 3>, 5> outer{
      {{0, 1, 0}, {0.59, -0.81, 0}, {-0.95, 0.31, 0}, {0.95, 0.31, 0}, {-0.59, -0.81, 0}}};
  static std::array<std::array<GLdouble, 3>, 4> hole{
      {{-0.15, -0.15, 0}, {0.15, -0.15, 0}, {0.15, 0.15, 0}, {-0.15, 0.15, 0}}};
  GLUtesselator* tess = gluNewTess();
  gluTessCallback(tess, GLU_TESS_BEGIN, reinterpret_cast<Callback>(glBegin));
  gluTessCallback(tess, GLU_TESS_VERTEX, reinterpret_cast<Callback>(glVertex3dv));
  gluTessCallback(tess, GLU_TESS_END, reinterpret_cast<Callback>(glEnd));
  static std::array<std::array<GLdouble, 3>, 16> made;
  static size_t made_count;
  made_count = 0;
  void (*combine)(GLdouble*, void**, GLfloat*, void**) = [](GLdouble* at, void**, GLfloat*, void** out) {
    made[made_count] = {at[0], at[1], at[2]};
    *out = made[made_count++].data();
  };
  gluTessCallback(tess, GLU_TESS_COMBINE, reinterpret_cast<Callback>(combine));
  gluTessProperty(tess, GLU_TESS_WINDING_RULE, GLU_TESS_WINDING_ODD);
  gluTessNormal(tess, 0, 0, 1);
  gluTessBeginPolygon(tess, nullptr);
  gluTessBeginContour(tess);
  for (auto& v : outer) gluTessVertex(tess, v.data(), v.data());
  gluTessEndContour(tess);
  gluTessBeginContour(tess);
  for (auto& v : hole) gluTessVertex(tess, v.data(), v.data());
  gluTessEndContour(tess);
  gluTessEndPolygon(tess);
  gluDeleteTess(tess);
}

void make_texture() {
  std::array<uint8_t, 64 * 64 * 3> texels;
  for (size_t y = 0; y < 64; ++y)
    for (size_t x = 0; x < 64; ++x) {
      uint8_t* t = &texels[(y * 64 + x) * 3];
      const bool light = ((x / 8) ^ (y / 8)) & 1;
      t[0] = light ? 240 : 60, t[1] = uint8_t(80 + 2 * x), t[2] = light ? 200 : uint8_t(40 + 3 * y);
    }
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  gluBuild2DMipmaps(GL_TEXTURE_2D, GL_RGB, 64, 64, GL_RGB, GL_UNSIGNED_BYTE, texels.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
}

void draw_nurbs() {
  GLfloat points[4][4][3];
  for (int u = 0; u < 4; ++u)
    for (int v = 0; v < 4; ++v) {
      points[u][v][0] = 0.6f * float(u) - 0.9f;
      points[u][v][1] = 0.6f * float(v) - 0.9f;
      points[u][v][2] = (u == 1 || u == 2) && (v == 1 || v == 2) ? 1.2f : -0.4f;
    }
  GLfloat knots[8] = {0, 0, 0, 0, 1, 1, 1, 1};
  GLUnurbs* nurbs = gluNewNurbsRenderer();
  gluNurbsProperty(nurbs, GLU_SAMPLING_TOLERANCE, 15);
  gluNurbsProperty(nurbs, GLU_DISPLAY_MODE, GLU_FILL);
  gluBeginSurface(nurbs);
  gluNurbsSurface(nurbs, 8, knots, 8, knots, 12, 3, &points[0][0][0], 4, 4, GL_MAP2_VERTEX_3);
  gluEndSurface(nurbs);
  gluDeleteNurbsRenderer(nurbs);
}

void draw_quadrics() {
  GLUquadric* quadric = gluNewQuadric();
  gluQuadricTexture(quadric, GL_TRUE);
  glEnable(GL_TEXTURE_2D);
  glTranslated(-2.2, 1, 0);
  gluSphere(quadric, 0.8, 24, 16);
  glTranslated(2.2, -0.4, 0);
  gluCylinder(quadric, 0.6, 0.3, 1.2, 24, 4);
  glDisable(GL_TEXTURE_2D);
  glTranslated(2.2, 0.4, 0);
  gluPartialDisk(quadric, 0.3, 0.8, 24, 4, 30, 270);
  gluDeleteQuadric(quadric);
}

void display() {
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  gluPerspective(40, 1.5, 1, 20);
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  gluLookAt(0, 1, 7, 0, 0, 0, 0, 1, 0);
  glRotated(0.5 * frame, 0, 1, 0);
  glPushMatrix();
  draw_quadrics();
  glPopMatrix();
  glPushMatrix();
  glTranslated(-1.5, -1.2, 0);
  glNormal3d(0, 0, 1);
  glCallList(star);
  glPopMatrix();
  glTranslated(1.3, -1.2, 0);
  glRotated(-50, 1, 0, 0);
  draw_nurbs();
  glutSwapBuffers();
  ++frame;
  glutPostRedisplay();
}

}  // namespace

int main(int argc, char** argv) {
  glutInit(&argc, argv);
  glutInitDisplayMode(GLUT_RGBA | GLUT_DOUBLE | GLUT_DEPTH);
  glutInitWindowSize(480, 320);
  glutCreateWindow("GLU shapes");
  glClearColor(0.16f, 0.12f, 0.1f, 1);
  for (const GLenum on :
       {GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_NORMALIZE, GL_AUTO_NORMAL, GL_COLOR_MATERIAL})
    glEnable(on);
  glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, GL_TRUE);
  glColor3d(0.9, 0.8, 0.6);
  make_texture();
  star = glGenLists(1);
  glNewList(star, GL_COMPILE);
  tessellate_star();
  glEndList();
  glutDisplayFunc(display);
  glutMainLoop();
}
