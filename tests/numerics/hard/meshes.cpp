// Meshes that cover every pixel exactly once (spec 3.5.1 and appendix B, corollary 17), however their corners
// lie.
#include <algorithm>
#include <cmath>

#include "cases.h"

namespace halfspace::hard {
namespace {

struct Corner {
  float x, y, z;
};

// Rows of corners, joined by two triangles a cell, whose diagonal is chosen at random.
struct Mesh {
  int columns, rows;
  std::vector<Corner> corners;

  Corner& at(int i, int j) { return corners[size_t(j) * size_t(columns + 1) + size_t(i)]; }
};

Mesh flat_mesh(int columns, int rows, float x0, float y0, float x1, float y1) {
  Mesh mesh{columns, rows, {}};
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      mesh.corners.push_back(
          {x0 + (x1 - x0) * float(i) / float(columns), y0 + (y1 - y0) * float(j) / float(rows), 0});
    }
  }
  return mesh;
}

// Moves inner corners by up to `reach`, to multiples of `step`. A quarter of a cell turns no triangle over.
void shake(Mesh& mesh, Random& random, float reach, float step) {
  for (int j = 0; j <= mesh.rows; ++j) {
    for (int i = 0; i <= mesh.columns; ++i) {
      if (i == 0 || j == 0 || i == mesh.columns || j == mesh.rows) continue;
      Corner& corner = mesh.at(i, j);
      for (float* v : {&corner.x, &corner.y})
        *v = step * std::floor((*v + random.real(-reach, reach)) / step);
    }
  }
}

// For people: each triangle in a colour of its own.
void paint(const Stage& stage, Random& random) {
  if (!stage.show) return;
  const auto level = [&random] { return GLubyte(random.integer(40, 250)); };
  const GLubyte color[3] = {level(), level(), level()};
  glColor3ubv(color);
}

void draw(const Stage& stage, Mesh& mesh, Random& random) {
  glBegin(GL_TRIANGLES);
  Random colors(1);
  const auto triangle = [&](const Corner& a, const Corner& b, const Corner& c) {
    paint(stage, colors);
    for (const Corner* v : {&a, &b, &c}) glVertex3f(v->x, v->y, v->z);
  };
  for (int j = 0; j < mesh.rows; ++j) {
    for (int i = 0; i < mesh.columns; ++i) {
      const Corner &a = mesh.at(i, j), &b = mesh.at(i + 1, j), &c = mesh.at(i + 1, j + 1),
                   &d = mesh.at(i, j + 1);
      if (random.integer(0, 1)) {
        triangle(a, b, c);
        triangle(c, d, a);
      } else {
        triangle(b, c, d);
        triangle(a, b, d);
      }
    }
  }
  glEnd();
}

void expect_once(Stage& stage) { stage.expect_all({kOnce, kOnce, kOnce}); }

// A mesh in pixels that reaches a little beyond the picture, whose corners sit on multiples of `step`.
void draw_flat(Stage& stage, uint64_t seed, float cell, float reach, float step) {
  Random random(seed);
  const int columns = int(float(stage.width) / cell) + 2, rows = int(float(stage.height) / cell) + 2;
  Mesh mesh = flat_mesh(columns, rows, -cell, -cell, float(columns - 1) * cell, float(rows - 1) * cell);
  shake(mesh, random, reach, step);
  pixel_view(stage);
  count_fragments(stage);
  draw(stage, mesh, random);
}

// A row of cells whose columns are cut at `x` and rows at `y`.
Mesh mesh_of(const std::vector<float>& x, const std::vector<float>& y) {
  Mesh mesh{int(x.size()) - 1, int(y.size()) - 1, {}};
  for (float v : y)
    for (float u : x) mesh.corners.push_back({u, v, 0});
  return mesh;
}

// A floor y = -1 from behind the eye to far ahead, inner corners at random.
constexpr float kFloorX = 50, kFloorBack = 20, kFloorFront = -100;

Mesh floor_mesh(Random& random) {
  constexpr int kCells = 10;
  Mesh mesh{kCells, kCells, {}};
  for (int j = 0; j <= kCells; ++j) {
    for (int i = 0; i <= kCells; ++i) {
      const bool inner = i > 0 && i < kCells && j > 0 && j < kCells;
      const float x = -kFloorX + 2 * kFloorX * float(i) / kCells,
                  z = kFloorBack + (kFloorFront - kFloorBack) * float(j) / kCells;
      mesh.corners.push_back(
          {x + (inner ? random.real(-2.4f, 2.4f) : 0), -1, z + (inner ? random.real(-2.9f, 2.9f) : 0)});
    }
  }
  return mesh;
}

// Whether the ray through window position (x, y) meets the floor between near and far.
bool meets_floor(const Stage& stage, double x, double y, double near, double far) {
  const double dx = 2 * x / stage.width - 1, dy = 2 * y / stage.height - 1;
  if (dy >= 0) return false;
  const double distance = -1 / dy;
  return distance >= near && distance <= std::min(far, double(-kFloorFront)) &&
         std::fabs(dx * distance) <= double(kFloorX);
}

// The same mesh once for each combination of the planes' signs.
void draw_cut_by(Stage& stage, int planes) {
  Random random(71);
  square_view(0.5, 100);
  count_fragments(stage);
  const double equations[2][4] = {{0.8, -0.5, 0.3, 0.9}, {-0.4, 0.7, 0.2, 0.5}};
  Mesh mesh = flat_mesh(12, 12, -9, -9, 9, 9);
  shake(mesh, random, 0.4f, 1.0f / 4096);
  for (Corner& corner : mesh.corners) corner.z = random.real(-4.4f, -4);
  // The outline is straight and outside the view.
  for (int k = 0; k <= 12; ++k)
    for (Corner* corner : {&mesh.at(k, 0), &mesh.at(k, 12), &mesh.at(0, k), &mesh.at(12, k)}) corner->z = -4;
  for (int signs = 0; signs < 1 << planes; ++signs) {
    for (int p = 0; p < planes; ++p) {
      double equation[4];
      for (int k = 0; k < 4; ++k) equation[k] = (signs >> p & 1) ? -equations[p][k] : equations[p][k];
      glClipPlane(GLenum(GL_CLIP_PLANE0 + p), equation);
      glEnable(GLenum(GL_CLIP_PLANE0 + p));
    }
    Random same_diagonals(72);
    draw(stage, mesh, same_diagonals);
  }
  expect_once(stage);
}

}  // namespace

void mesh_random(Stage& stage) {
  draw_flat(stage, 1, 12, 3, 1.0f / 4096);
  expect_once(stage);
}

void mesh_sixteenths(Stage& stage) {
  draw_flat(stage, 2, 6, 1.5f, 1.0f / 16);
  expect_once(stage);
}

void mesh_pixel_centres(Stage& stage) {
  Random random(3);
  const int columns = stage.width / 9 + 3, rows = stage.height / 9 + 3;
  Mesh mesh = flat_mesh(columns, rows, -9, -9, 9 * float(columns - 1), 9 * float(rows - 1));
  shake(mesh, random, 2, 1);
  for (Corner& corner : mesh.corners) corner.x += 0.5f, corner.y += 0.5f;
  pixel_view(stage);
  count_fragments(stage);
  draw(stage, mesh, random);
  expect_once(stage);
}

void mesh_slivers(Stage& stage) {
  Random random(4);
  // Bundles of slivers 1/256 px wide, one of them around a pixel's centre.
  std::vector<float> x{-9};
  for (int cell = 0; cell * 8 < stage.width + 8; ++cell) {
    const float left = 8 * float(cell) + (cell % 2 ? 0.5f : random.real(0, 1)) - 2.0f / 256;
    for (int k = 0; k < 5; ++k) x.push_back(left + float(k) / 256);
  }
  x.push_back(float(stage.width) + 40);
  std::vector<float> y;
  for (int j = -1; j * 32 < stage.height + 64; ++j)
    y.push_back(32 * float(j) + (j > 0 ? random.real(0, 9) : 0));
  Mesh mesh = mesh_of(x, y);
  // Rows are moved against each other, so that slivers lean by up to 4 px over 32.
  for (int j = 0; j <= mesh.rows; ++j) {
    const float lean = random.real(-4, 4);
    for (int i = 1; i < mesh.columns; ++i) mesh.at(i, j).x += lean;
  }
  pixel_view(stage);
  count_fragments(stage);
  draw(stage, mesh, random);
  expect_once(stage);
}

void mesh_far_vertices(Stage& stage) {
  Random random(5);
  pixel_view(stage);
  count_fragments(stage);
  glEnable(GL_SCISSOR_TEST);
  const int w = stage.width / 2, h = stage.height / 2;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const int x = quarter % 2 ? w : 0, y = quarter / 2 ? h : 0;
    glScissor(x, y, quarter % 2 ? stage.width - w : w, quarter / 2 ? stage.height - h : h);
    constexpr float kReach[] = {1e3f, 1e4f, 1e5f, 1e6f};
    constexpr int kSpokes = 9;
    glShadeModel(GL_FLAT);
    glBegin(GL_TRIANGLE_FAN);
    glVertex2f(float(x) + float(w) * random.real(0.2f, 0.8f), float(y) + float(h) * random.real(0.2f, 0.8f));
    Corner first{};
    for (int i = 0; i < kSpokes; ++i) {
      const SineCosine angle = sine_cosine((i + 0.4 * double(random.real(0, 1))) / kSpokes - 0.5);
      const float radius = kReach[quarter] * random.real(1, 2);
      const Corner corner{radius * float(angle.cosine), radius * float(angle.sine), 0};
      if (i == 0) first = corner;
      paint(stage, random);
      glVertex2f(corner.x, corner.y);
    }
    glVertex2f(first.x, first.y);
    glEnd();
  }
  expect_once(stage);
}

void mesh_dust(Stage& stage) {
  Random random(6);
  constexpr int kCells = 708;  // 2 * 708^2 triangles are a million
  Mesh mesh = flat_mesh(kCells, kCells, -1, -1, float(stage.width) + 1, float(stage.height) + 1);
  const float cell = float(std::min(stage.width, stage.height)) / kCells;
  shake(mesh, random, 0.25f * cell, 1.0f / 4096);
  pixel_view(stage);
  count_fragments(stage);
  draw(stage, mesh, random);
  expect_once(stage);
}

void mesh_near_plane(Stage& stage) {
  constexpr double kNear = 1.5, kFar = 60, kReach = 1.0 / 200;
  Random random(7);
  Mesh mesh = floor_mesh(random);
  square_view(kNear, kFar);
  count_fragments(stage);
  draw(stage, mesh, random);
  stage.expect(stage.read(), [&](int x, int y) {
    // Where snapped corners decide, once or never are both right; twice never is.
    int hits = 0;
    for (int k = 0; k < 9; ++k)
      hits += meets_floor(stage, x + 0.5 + kReach * (k % 3 - 1), y + 0.5 + kReach * (k / 3 - 1), kNear, kFar);
    std::vector<Rgb> allowed;
    if (hits > 0) allowed.push_back({kOnce, kOnce, kOnce});
    if (hits < 9) allowed.push_back({0, 0, 0});
    return allowed;
  });
}

void mesh_user_plane(Stage& stage) { draw_cut_by(stage, 1); }
void mesh_two_user_planes(Stage& stage) { draw_cut_by(stage, 2); }

void mesh_guard_band(Stage& stage) {
  Random random(8);
  const auto cuts = [](int size) {
    std::vector<float> at;
    for (float v :
         {131072.0f, 65536.0f, 32768.0f, 32767.0f, 16385.0f, 16384.0f, 16383.5f, 8193.0f, 8192.0f, 4096.0f})
      at.push_back(-v);
    for (float v : {0.3f, 0.55f, 0.8f}) at.push_back(v * float(size));
    for (float v :
         {4096.0f, 8192.0f, 8193.0f, 16383.5f, 16384.0f, 16385.0f, 32767.0f, 32768.0f, 65536.0f, 131072.0f})
      at.push_back(v);
    return at;
  };
  Mesh mesh = mesh_of(cuts(stage.width), cuts(stage.height));
  // The whole thing a little askew, so that edges cross the picture.
  for (Corner& corner : mesh.corners) corner = {corner.x + 0.02f * corner.y, corner.y - 0.015f * corner.x, 0};
  pixel_view(stage);
  count_fragments(stage);
  draw(stage, mesh, random);
  expect_once(stage);
}

void mesh_viewport_16384(Stage& stage) {
  Random random(9);
  GLint most[2] = {16384, 16384};
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, most);
  if (most[0] < 16384 || most[1] < 16384) stage.complain("GL_MAX_VIEWPORT_DIMS is below 16384");
  glViewport(-8011, -7013, 16384, 16384);
  count_fragments(stage);
  Mesh mesh = flat_mesh(400, 400, -1.5f, -1.5f, 1.5f, 1.5f);
  shake(mesh, random, 0.003f, 1.0f / (1 << 24));
  draw(stage, mesh, random);
  expect_once(stage);
}

void zero_area(Stage& stage) {
  Random random(10);
  pixel_view(stage);
  count_fragments(stage);
  rectangle(-1, -1, float(stage.width) + 1, float(stage.height) + 1);
  const auto any = [&] { return float(random.integer(0, 512)) / 2; };
  for (int i = 0; i < 2000; ++i) {
    const float x = any(), y = any(), dx = any() - 128, dy = any() - 128;
    const GLenum modes[] = {GL_TRIANGLES,      GL_QUADS,        GL_POLYGON,
                            GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN, GL_QUAD_STRIP};
    // Six corners on one line, or in one point; twice or four times over, so that the middle is exact.
    const bool point = i % 5 == 0;
    const int along[] = {0, 1, 3, 2, 4, 0};
    const int corners = modes[i % 6] == GL_QUADS || modes[i % 6] == GL_QUAD_STRIP ? 4 : 6;
    paint(stage, random);
    glBegin(modes[i % 6]);
    for (int k = 0; k < corners; ++k) {
      const float t = point ? 0 : float(along[k]) / 4;
      glVertex2f(x + t * dx, y + t * dy);
    }
    glEnd();
  }
  expect_once(stage);
}

}  // namespace halfspace::hard
