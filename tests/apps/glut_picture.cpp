// A program on freeglut that knows nothing of Halfspace: draws, swaps, and writes what X shows in its window.
//   glut_picture OUT.ppm
// Prints GL_RENDERER on stdout.
#include <GL/freeglut.h>
#include <GL/glx.h>
#include <X11/Xutil.h>

#include <cstdio>
#include <vector>

namespace {

constexpr int kWidth = 150, kHeight = 110;
const char* output = nullptr;
int status = 1;

void set_checker_texture() {
  std::vector<unsigned char> texels;
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      const bool odd = ((x + y) & 1) != 0;
      texels.insert(texels.end(), {static_cast<unsigned char>(odd ? 240 : 32),
                                   static_cast<unsigned char>(x * 30), static_cast<unsigned char>(y * 30)});
    }
  }
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 8, 8, 0, GL_RGB, GL_UNSIGNED_BYTE, texels.data());
}

void draw() {
  glViewport(0, 0, kWidth, kHeight);
  glClearColor(0.2f, 0.4f, 0.6f, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glFrustum(-0.075, 0.075, -0.055, 0.055, 0.1, 50);
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  glTranslatef(0, 0, -3);
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_TEXTURE_2D);
  glBegin(GL_TRIANGLES);
  glColor3ub(255, 0, 0), glVertex3f(-1.7f, -1.1f, 0.4f);
  glColor3ub(0, 255, 0), glVertex3f(1.3f, -0.8f, -1.1f);
  glColor3ub(0, 0, 255), glVertex3f(-0.2f, 1.4f, 0.1f);
  glEnd();
  glEnable(GL_TEXTURE_2D);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
  // Cuts through the triangle.
  glBegin(GL_QUADS);
  glTexCoord2f(0, 0), glVertex3f(-0.3f, -0.6f, 1.0f);
  glTexCoord2f(1, 0), glVertex3f(1.2f, -0.6f, -2.0f);
  glTexCoord2f(1, 1), glVertex3f(1.2f, 0.9f, -2.0f);
  glTexCoord2f(0, 1), glVertex3f(-0.3f, 0.9f, 1.0f);
  glEnd();
}

bool write_shown() {
  Display* display = glXGetCurrentDisplay();
  XSync(display, False);
  XImage* image = XGetImage(display, glXGetCurrentDrawable(), 0, 0, kWidth, kHeight, AllPlanes, ZPixmap);
  std::FILE* file = image ? std::fopen(output, "wb") : nullptr;
  if (!file) return false;
  std::fprintf(file, "P6\n%d %d\n255\n", kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const unsigned long pixel = XGetPixel(image, x, y);
      for (const int shift : {16, 8, 0}) std::fputc(static_cast<int>(pixel >> shift & 255), file);
    }
  }
  XDestroyImage(image);
  return std::fclose(file) == 0;
}

void display() {
  draw();
  glutSwapBuffers();
  if (glGetError() == GL_NO_ERROR && write_shown()) status = 0;
  glutLeaveMainLoop();
}

}  // namespace

int main(int argc, char** argv) {
  glutInit(&argc, argv);
  if (argc != 2) return 2;
  output = argv[1];
  glutInitDisplayMode(GLUT_RGB | GLUT_DOUBLE | GLUT_DEPTH);
  glutInitWindowSize(kWidth, kHeight);
  glutInitWindowPosition(20, 30);
  glutCreateWindow("picture");
  glutSetOption(GLUT_ACTION_ON_WINDOW_CLOSE, GLUT_ACTION_CONTINUE_EXECUTION);
  std::printf("%s\n", reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
  set_checker_texture();
  glutDisplayFunc(display);
  glutMainLoop();
  return status;
}
