// Lighting and fog where a length, a distance or an exponent goes to its end.
#include <cmath>

#include "cases.h"

namespace halfspace::hard {
namespace {

void sphere(float radius, int rings, int sides) {
  for (int j = 0; j < rings; ++j) {
    glBegin(GL_QUAD_STRIP);
    for (int i = 0; i <= sides; ++i) {
      for (int k = 1; k >= 0; --k) {
        const SineCosine around = sine_cosine(double(i) / sides - 0.5),
                         up = sine_cosine((j + k) / (2.0 * rings) - 0.25);
        const auto x = float(up.cosine * around.sine), y = float(up.sine),
                   z = float(up.cosine * around.cosine);
        glNormal3f(x, y, z);
        glVertex3f(radius * x, radius * y, radius * z);
      }
    }
    glEnd();
  }
}

// A grid of quads over the window, at depth z, with one normal.
void wall(int cells, float z, float nx, float ny, float nz) {
  for (int j = 0; j < cells; ++j) {
    glBegin(GL_QUAD_STRIP);
    for (int i = 0; i <= cells; ++i) {
      for (int k = 1; k >= 0; --k) {
        glNormal3f(nx, ny, nz);
        glVertex3f(2 * float(i) / float(cells) - 1, 2 * float(j + k) / float(cells) - 1, z);
      }
    }
    glEnd();
  }
}

void material(float ambient, float diffuse, float specular, float shininess) {
  const float a[4] = {ambient, ambient, ambient, 1}, d[4] = {diffuse, 0.7f * diffuse, 0.5f * diffuse, 1},
              s[4] = {specular, specular, specular, 1};
  glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT, a);
  glMaterialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, d);
  glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, s);
  glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, shininess);
}

void light(float x, float y, float z, float w) {
  const float position[4] = {x, y, z, w};
  glEnable(GL_LIGHTING);
  glEnable(GL_LIGHT0);
  glLightfv(GL_LIGHT0, GL_POSITION, position);
}

}  // namespace

void specular_128(Stage&) {
  light(-1, 0.15f, -0.2f, 0);
  glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, 1);
  material(0.1f, 0.5f, 1, 128);
  square_view(1, 10);
  glTranslatef(0, 0, -3.6f);
  glEnable(GL_DEPTH_TEST);
  sphere(2, 40, 60);
}

void zero_normals(Stage& stage) {
  light(0, 0, 1, 0);
  glEnable(GL_NORMALIZE);
  material(0.5f, 0.5f, 0.5f, 10);
  const float global[4] = {0.8f, 0.8f, 0.8f, 1};
  glLightModelfv(GL_LIGHT_MODEL_AMBIENT, global);
  // Zero, and lengths whose square is no float: those still have a direction.
  const float lengths[8] = {0, 1, 1e-20f, 1e-30f, 1e-42f, 1e20f, 1e30f, 3e38f};
  for (int i = 0; i < 8; ++i) {
    glViewport(stage.width * i / 8, 0, stage.width * (i + 1) / 8 - stage.width * i / 8, stage.height);
    wall(2, 0, 0, 0, lengths[i]);
  }
  // 0.8 * 0.5 of ambient light alone where there is no direction; elsewhere as with a normal of length 1.
  const Picture picture = stage.read();
  const uint8_t* unit = picture.pixel(stage.width * 3 / 16, stage.height / 2);
  const Rgb lit{unit[0], unit[1], unit[2]};
  if (lit.r < 200) stage.complain("a normal towards the light leaves it dark");
  stage.expect(picture, [&](int x, int) {
    return std::vector<Rgb>{x < stage.width / 8 ? Rgb{102, 102, 102} : lit};
  });
}

void light_at_vertex(Stage& stage) {
  // The middle of the wall is a vertex, and there the light is.
  light(0, 0, -0.5f, 1);
  glLightf(GL_LIGHT0, GL_QUADRATIC_ATTENUATION, 0.5f);
  material(0.5f, 0.9f, 0.6f, 30);
  wall(8, -0.5f, 0.3f, 0.2f, 0.933f);
  const Picture picture = stage.read();
  // Ambient light is there whatever the direction: 0.2 (global) * 0.5.
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      if (picture.pixel(x, y)[0] < 25) stage.complain("a pixel is darker than ambient light");
}

void spot_128(Stage&) {
  light(0.3f, -0.2f, 1, 1);
  const float down[3] = {-0.1f, 0.05f, -1};
  glLightfv(GL_LIGHT0, GL_SPOT_DIRECTION, down);
  glLightf(GL_LIGHT0, GL_SPOT_EXPONENT, 128);
  glLightf(GL_LIGHT0, GL_SPOT_CUTOFF, 12);
  material(0.3f, 1, 0, 0);
  wall(64, -0.5f, 0, 0, 1);
}

void fog_ends(Stage& stage) {
  const float white[4] = {1, 1, 1, 1};
  glFogfv(GL_FOG_COLOR, white);
  glEnable(GL_FOG);
  struct Fog {
    GLint mode;
    float density, start, end;
    int expected;  // of an object of 40 levels; -1: a gradient
  };
  constexpr Fog kFogs[] = {{GL_EXP, 0, 0, 1, 40},        {GL_EXP2, 0, 0, 1, 40},
                           {GL_EXP, 1e30f, 0, 1, 255},   {GL_EXP2, 1e30f, 0, 1, 255},
                           {GL_LINEAR, 1, 0, 1e38f, 40}, {GL_LINEAR, 1, -1e38f, 0, 255},
                           {GL_LINEAR, 1, 3, 3, -1},     {GL_EXP2, 0.7f, 0, 1, -1}};
  glMatrixMode(GL_PROJECTION);
  glOrtho(-1, 1, -1, 1, 0, 8);
  glMatrixMode(GL_MODELVIEW);
  glColor3ub(40, 40, 40);
  for (int i = 0; i < 16; ++i) {
    const Fog& fog = kFogs[i % 8];
    const int x = stage.width * (i % 8) / 8, half = stage.height / 2;
    // Below as the level has it, above at its most exact.
    glHint(GL_FOG_HINT, i < 8 ? GL_DONT_CARE : GL_NICEST);
    glFogi(GL_FOG_MODE, fog.mode);
    glFogf(GL_FOG_DENSITY, fog.density);
    glFogf(GL_FOG_START, fog.start);
    glFogf(GL_FOG_END, fog.end);
    glViewport(x, i < 8 ? 0 : half, stage.width * (i % 8 + 1) / 8 - x, i < 8 ? half : stage.height - half);
    glBegin(GL_QUADS);
    glVertex3f(-1, -1, -0.5f), glVertex3f(1, -1, -0.5f), glVertex3f(1, 1, -7), glVertex3f(-1, 1, -7);
    glEnd();
  }
  stage.expect(stage.read(), [&](int x, int) {
    for (int i = 0; i < 8; ++i)
      if (x >= stage.width * i / 8 && x < stage.width * (i + 1) / 8 && kFogs[i].expected >= 0)
        return std::vector<Rgb>{{kFogs[i].expected, kFogs[i].expected, kFogs[i].expected}};
    return std::vector<Rgb>{};
  });
}

}  // namespace halfspace::hard
