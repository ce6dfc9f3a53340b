// freeglut's solid and wire shapes under two lights, with its bitmap and stroke text.
#include <GL/freeglut.h>

#include <cstddef>

namespace {

using Shape = void (*)();

constexpr int kColumns = 6, kRows = 3;
constexpr Shape kShapes[kRows][kColumns] = {
    {[] { glutSolidSphere(0.7, 24, 16); }, [] { glutSolidCone(0.6, 1.2, 24, 8); },
     [] { glutSolidTorus(0.2, 0.5, 16, 32); }, [] { glutSolidCube(0.9); }, [] { glutSolidTeapot(0.6); },
     [] { glutSolidIcosahedron(); }},
    {[] { glutWireSphere(0.7, 16, 10); }, [] { glutWireCone(0.6, 1.2, 16, 6); },
     [] { glutWireTorus(0.2, 0.5, 8, 20); }, [] { glutWireCube(0.9); }, [] { glutWireTeapot(0.6); },
     [] { glutWireIcosahedron(); }},
    {[] { glutSolidOctahedron(); }, [] { glutSolidTetrahedron(); },
     [] {
       glScaled(0.5, 0.5, 0.5);
       glutSolidDodecahedron();
     },
     [] { glutSolidRhombicDodecahedron(); }, [] { glutSolidCylinder(0.5, 1, 24, 4); },
     [] {
       glScaled(0.5, 0.5, 0.5);
       glutWireDodecahedron();
     }},
};

int frame = 0;

void light(GLenum name, float x, float y, float z, float red, float green, float blue) {
  const GLfloat position[] = {x, y, z, 0}, color[] = {red, green, blue, 1};
  glLightfv(name, GL_POSITION, position);
  glLightfv(name, GL_DIFFUSE, color);
  glLightfv(name, GL_SPECULAR, color);
  glEnable(name);
}

void draw_shape(int row, int column) {
  glPushMatrix();
  glTranslated(2.0 * column - 5, 2.2 - 2.1 * row, 0);
  glRotated(25 + frame, 1, 0.3, 0);
  glRotated(30 + 2 * frame, 0, 1, 0);
  const GLfloat color[] = {0.3f + 0.12f * float(column), 0.9f - 0.25f * float(row), 0.4f, 1};
  const GLfloat white[] = {1, 1, 1, 1};
  glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, color);
  glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, white);
  glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, 40);
  kShapes[row][column]();
  glPopMatrix();
}

void draw_text() {
  glDisable(GL_LIGHTING);
  glColor3d(1, 1, 0.6);
  glRasterPos2d(-5.6, 3.35);
  glutBitmapString(GLUT_BITMAP_HELVETICA_18, reinterpret_cast<const unsigned char*>("bitmap text"));
  glPushMatrix();
  glTranslated(1.2, 3.3, 0);
  glScaled(0.003, 0.003, 0.003);
  glutStrokeString(GLUT_STROKE_ROMAN, reinterpret_cast<const unsigned char*>("stroke text"));
  glPopMatrix();
  glEnable(GL_LIGHTING);
}

void display() {
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glOrtho(-6, 6, -4, 4, -5, 5);
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  light(GL_LIGHT0, 1, 2, 3, 0.9f, 0.9f, 0.8f);
  light(GL_LIGHT1, -2, -1, 1, 0.2f, 0.3f, 0.6f);
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) draw_shape(row, column);
  draw_text();
  glutSwapBuffers();
  ++frame;
  glutPostRedisplay();
}

}  // namespace

int main(int argc, char** argv) {
  glutInit(&argc, argv);
  glutInitDisplayMode(GLUT_RGBA | GLUT_DOUBLE | GLUT_DEPTH);
  glutInitWindowSize(480, 320);
  glutCreateWindow("freeglut shapes");
  glClearColor(0.1f, 0.12f, 0.16f, 1);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_LIGHTING);
  glEnable(GL_NORMALIZE);
  glutDisplayFunc(display);
  glutMainLoop();
}
