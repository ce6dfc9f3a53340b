// Evaluators (spec 5.1): points against the sum of Bernstein polynomials with binomial coefficients in long
// double, meshes against the coordinates they stand for, and everything that can be set, asked and refused.
#include <cmath>
#include <random>

#include "recording_device.h"
#include "state_fixture.h"

namespace halfspace::state {
namespace {

using raster::recorded_draws;

long double power(long double base, int exponent) {
  long double result = 1;
  while (exponent-- > 0) result *= base;
  return result;
}

// n over i, t^i (1 - t)^(n - i).
long double bernstein(int n, int i, long double t) {
  if (i < 0 || i > n) return 0;
  long double binomial = 1;
  for (int k = 1; k <= i; ++k) binomial = binomial * (n - k + 1) / k;
  return binomial * power(t, i) * power(1 - t, n - i);
}

using Row = std::vector<float>;

class EvaluatorTest : public StateTest {
 protected:
  EvaluatorTest() { recorded_draws.clear(); }

  Row random_points(size_t count) {
    Row points(count);
    std::uniform_real_distribution<float> number(-2, 2);
    for (float& p : points) p = number(random_);
    return points;
  }
  // The one vertex that evaluating at u draws.
  raster::RecordedVertex vertex_at(double u) {
    recorded_draws.clear();
    op::begin(*context, GL_POINTS);
    op::eval_coord1(*context, u);
    op::end(*context);
    op::flush(*context);
    EXPECT_EQ(recorded_draws.size(), 1u);
    return recorded_draws.at(0).vertices.at(0);
  }
  raster::RecordedVertex vertex_at(double u, double v) {
    recorded_draws.clear();
    op::begin(*context, GL_POINTS);
    op::eval_coord2(*context, u, v);
    op::end(*context);
    op::flush(*context);
    EXPECT_EQ(recorded_draws.size(), 1u);
    return recorded_draws.at(0).vertices.at(0);
  }
  void expect_error(GLenum code) { EXPECT_EQ(op::get_error(*context), code); }

  std::mt19937 random_{7};
};

// Half an ulp of the result, and room for sums in double.
void expect_near(float value, long double truth) {
  EXPECT_LE(std::abs((long double)(value)-truth), 0x1p-24L * std::abs(truth) + 1e-14L) << value;
}

TEST_F(EvaluatorTest, CurvesOfEveryOrder) {
  for (int order = 1; order <= kMaxEvalOrder; ++order) {
    SCOPED_TRACE(order);
    const Row points = random_points(size_t(order) * 5);
    op::map1f(*context, GL_MAP1_VERTEX_4, 2, 5, 5, order, points.data());
    op::enable(*context, GL_MAP1_VERTEX_4);
    for (double u : {2.0, 2.1, 3.5, 4.75, 5.0}) {
      const auto vertex = vertex_at(u);
      for (size_t k = 0; k < 4; ++k) {
        long double truth = 0;
        for (int i = 0; i < order; ++i) {
          truth +=
              bernstein(order - 1, i, ((long double)(u)-2) / 3) * (long double)(points[size_t(i) * 5 + k]);
        }
        expect_near(vertex.position[k], truth);
      }
    }
  }
}

TEST_F(EvaluatorTest, EndsAreControlPoints) {
  const Row points = random_points(3 * 7);
  op::map1f(*context, GL_MAP1_VERTEX_3, -1, 0.3f, 3, 7, points.data());
  op::enable(*context, GL_MAP1_VERTEX_3);
  for (size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(vertex_at(-1).position[k], points[k]);
    EXPECT_EQ(vertex_at(double(0.3f)).position[k], points[18 + k]);
  }
  EXPECT_EQ(vertex_at(0).position[3], 1.0f);
}

TEST_F(EvaluatorTest, SurfacesWithStrides) {
  for (const auto& [u_order, v_order] : {std::pair{1, 4}, {4, 1}, {3, 5}, {8, 8}, {2, 30}}) {
    // u runs fastest in memory: the strides need not be in the order of the loops.
    const GLint u_stride = 4, v_stride = 4 * u_order + 1;
    const Row points = random_points(size_t(v_stride * v_order));
    std::vector<double> wide(points.begin(), points.end());
    op::map2d(*context, GL_MAP2_VERTEX_3, 0, 1, u_stride, u_order, 4, 2, v_stride, v_order, wide.data());
    op::enable(*context, GL_MAP2_VERTEX_3);
    for (double u : {0.0, 0.3, 1.0}) {
      for (double v : {2.0, 2.5, 3.9}) {
        const auto vertex = vertex_at(u, v);
        for (size_t k = 0; k < 3; ++k) {
          long double truth = 0;
          for (int i = 0; i < u_order; ++i) {
            for (int j = 0; j < v_order; ++j) {
              const float point = points[size_t(i * u_stride + j * v_stride) + k];
              truth += bernstein(u_order - 1, i, (long double)(u)) *
                       bernstein(v_order - 1, j, ((long double)(v)-4) / -2) * (long double)(point);
            }
          }
          expect_near(vertex.position[k], truth);
        }
      }
    }
  }
}

TEST_F(EvaluatorTest, AttributesAreEvaluatedAndCurrentValuesStay) {
  const float vertices[] = {0, 0, 0, 4, 8, 12}, colors[] = {0, 0, 0, 0, 1, 0.5f, 0.25f, 0.75f};
  const float coordinates[] = {0, 0, 10, 20}, normals[] = {1, 0, 0, 0, 1, 0};
  op::enable(*context, GL_TEXTURE_2D);
  op::color(*context, 0.1f, 0.2f, 0.3f, 0.4f);
  op::tex_coord(*context, 5, 6, 7, 8);
  op::map1f(*context, GL_MAP1_VERTEX_3, 0, 1, 3, 2, vertices);
  op::map1f(*context, GL_MAP1_COLOR_4, 0, 1, 4, 2, colors);
  op::map1f(*context, GL_MAP1_TEXTURE_COORD_2, 0, 1, 2, 2, coordinates);
  op::map1f(*context, GL_MAP1_TEXTURE_COORD_1, 0, 1, 1, 2, coordinates);
  op::map1f(*context, GL_MAP1_NORMAL, 0, 1, 3, 2, normals);
  for (GLenum cap : std::initializer_list<GLenum>{GL_MAP1_VERTEX_3, GL_MAP1_COLOR_4, GL_MAP1_TEXTURE_COORD_1,
                                                  GL_MAP1_TEXTURE_COORD_2, GL_MAP1_NORMAL})
    op::enable(*context, cap);
  const Snapshot before = take_snapshot(*context);
  const auto vertex = vertex_at(0.5);
  EXPECT_EQ(vertex.position, (std::array<float, 4>{2, 4, 6, 1}));
  EXPECT_EQ(vertex.color, (std::array<float, 4>{0.5f, 0.25f, 0.125f, 0.375f}));
  EXPECT_EQ(vertex.tex_coord, (std::array<float, 4>{5, 10, 0, 1}));  // two coordinates win over one
  EXPECT_EQ(take_snapshot(*context), before);
  // The next vertex has the current colour again.
  op::begin(*context, GL_LINES);
  op::eval_coord1(*context, 1);
  op::vertex(*context, 9, 9, 9, 1);
  op::end(*context);
  op::flush(*context);
  EXPECT_EQ(recorded_draws.back().vertices[0].color[1], 0.5f);
  EXPECT_EQ(recorded_draws.back().vertices[1].color, (std::array<float, 4>{0.1f, 0.2f, 0.3f, 0.4f}));
  EXPECT_EQ(recorded_draws.back().vertices[1].tex_coord, (std::array<float, 4>{5, 6, 7, 8}));
}

TEST_F(EvaluatorTest, WithoutAVertexMapThereIsNoVertex) {
  op::enable(*context, GL_MAP1_COLOR_4);
  op::begin(*context, GL_POINTS);
  op::eval_coord1(*context, 0.5);
  op::eval_coord2(*context, 0.5, 0.5);
  op::end(*context);
  op::flush(*context);
  EXPECT_TRUE(recorded_draws.empty());
}

// The mesh commands, as the spec writes them down with EvalPoint; and both within a list.
TEST_F(EvaluatorTest, MeshesAreLoopsOfPoints) {
  const Row points = random_points(3 * 4 * 4);
  op::map2f(*context, GL_MAP2_VERTEX_3, 0, 1, 12, 4, 0, 1, 3, 4, points.data());
  op::map1f(*context, GL_MAP1_VERTEX_3, 0, 1, 3, 4, points.data());
  op::enable(*context, GL_MAP2_VERTEX_3);
  op::enable(*context, GL_MAP1_VERTEX_3);
  op::map_grid1(*context, 7, 0.1, 0.9);
  op::map_grid2(*context, 5, 0.0, 1.0, 3, 0.25, 0.5);
  const auto point1 = [&](GLint i) { op::eval_coord1(*context, i == 7 ? 0.9 : i * ((0.9 - 0.1) / 7) + 0.1); };
  const auto point2 = [&](GLint i, GLint j) {
    op::eval_coord2(*context, i == 5 ? 1.0 : i * (1.0 / 5), j == 3 ? 0.5 : j * (0.25 / 3) + 0.25);
  };
  const auto drawn = [&](auto&& draw) {
    recorded_draws.clear();
    draw();
    op::flush(*context);
    std::vector<std::pair<int, std::vector<raster::RecordedVertex>>> all;
    for (const auto& d : recorded_draws) all.push_back({int(d.primitive), d.vertices});
    return all;
  };
  const auto pair = [&](GLenum mode, auto&& body) {
    op::begin(*context, mode);
    body();
    op::end(*context);
  };
  for (const auto& strip : {std::pair{GL_LINE, GL_LINE_STRIP}, {GL_POINT, GL_POINTS}}) {
    const auto loop = [&] {
      for (GLint i = -1; i <= 8; ++i) point1(i);
    };
    EXPECT_EQ(drawn([&] { op::eval_mesh1(*context, GLenum(strip.first), -1, 8); }),
              drawn([&] { pair(GLenum(strip.second), loop); }));
  }
  const auto quads = drawn([&] {
    for (GLint j = 0; j < 3; ++j) {
      pair(GL_QUAD_STRIP, [&] {
        for (GLint i = 1; i <= 5; ++i) point2(i, j), point2(i, j + 1);
      });
    }
  });
  EXPECT_EQ(drawn([&] { op::eval_mesh2(*context, GL_FILL, 1, 5, 0, 3); }), quads);
  const auto lines = drawn([&] {
    for (GLint j = 0; j <= 3; ++j) {
      pair(GL_LINE_STRIP, [&] {
        for (GLint i = 1; i <= 5; ++i) point2(i, j);
      });
    }
    for (GLint i = 1; i <= 5; ++i) {
      pair(GL_LINE_STRIP, [&] {
        for (GLint j = 0; j <= 3; ++j) point2(i, j);
      });
    }
  });
  EXPECT_EQ(drawn([&] { op::eval_mesh2(*context, GL_LINE, 1, 5, 0, 3); }), lines);
  const auto dots = drawn([&] {
    pair(GL_POINTS, [&] {
      for (GLint j = 0; j <= 3; ++j) {
        for (GLint i = 1; i <= 5; ++i) point2(i, j);
      }
    });
  });
  EXPECT_EQ(drawn([&] { op::eval_mesh2(*context, GL_POINT, 1, 5, 0, 3); }), dots);
  EXPECT_EQ(drawn([&] { pair(GL_POINTS, [&] { op::eval_point1(*context, 3); }); }),
            drawn([&] { pair(GL_POINTS, [&] { point1(3); }); }));
  op::new_list(*context, 1, GL_COMPILE);
  kCompileTable.eval_mesh2(*context, GL_FILL, 1, 5, 0, 3);
  op::end_list(*context);
  EXPECT_EQ(drawn([&] { op::call_list(*context, 1); }), quads);
}

// In a list the control points are those of the call that gave them, the map that of the time it is played.
TEST_F(EvaluatorTest, ListsKeepControlPoints) {
  Row points = random_points(3 * 4 * 4);
  const Row first = points;
  op::enable(*context, GL_MAP2_VERTEX_3);
  op::map2f(*context, GL_MAP2_VERTEX_3, 0, 1, 12, 4, 0, 1, 3, 4, points.data());
  const auto truth = vertex_at(0.3, 0.6);
  op::new_list(*context, 1, GL_COMPILE);
  kCompileTable.map2f(*context, GL_MAP2_VERTEX_3, 0, 1, 12, 4, 0, 1, 3, 4, points.data());
  kCompileTable.begin(*context, GL_POINTS);
  kCompileTable.eval_coord2(*context, 0.3, 0.6);
  kCompileTable.end(*context);
  kCompileTable.map2f(*context, GL_MAP2_VERTEX_3, 0, 1, 2, 4, 0, 1, 3, 4, points.data());  // refused, later
  op::end_list(*context);
  std::fill(points.begin(), points.end(), 0.0f);
  op::map2f(*context, GL_MAP2_VERTEX_3, 0, 1, 12, 4, 0, 1, 3, 4, points.data());
  recorded_draws.clear();
  expect_error(GL_NO_ERROR);
  op::call_list(*context, 1);
  op::flush(*context);
  expect_error(GL_INVALID_VALUE);
  EXPECT_EQ(recorded_draws.at(0).vertices.at(0), truth);
}

TEST_F(EvaluatorTest, AutomaticNormals) {
  // A bilinear patch on z = x y, as (x w, y w, z w, w) with w = 2 at one corner, so that the quotient counts.
  const float patch[] = {0, 0, 0, 1, 0, 1, 0, 1, 1, 0, 0, 1, 2, 2, 2, 2};
  op::map2f(*context, GL_MAP2_VERTEX_4, 0, 1, 8, 2, 0, 1, 4, 2, patch);
  op::enable(*context, GL_MAP2_VERTEX_4);
  op::enable(*context, GL_AUTO_NORMAL);
  op::enable(*context, GL_LIGHTING);  // or nobody asks for normals
  recorded_draws.clear();
  for (double u : {0.0, 0.25, 0.75, 1.0}) {
    for (double v : {0.0, 0.5, 1.0}) {
      const auto vertex = vertex_at(u, v);
      // Derivatives of (x, y, z) / w by differences in long double.
      const auto surface = [&](long double x, long double y, size_t k) {
        long double sum = 0, w = 0;
        for (size_t i = 0; i < 2; ++i) {
          for (size_t j = 0; j < 2; ++j) {
            const long double weight = (i ? x : 1 - x) * (j ? y : 1 - y);
            sum += weight * (long double)(patch[i * 8 + j * 4 + k]);
            w += weight * (long double)(patch[i * 8 + j * 4 + 3]);
          }
        }
        return sum / w;
      };
      const long double h = 1e-6L, a = (long double)(u), b = (long double)(v);
      long double by_u[3], by_v[3];
      for (size_t k = 0; k < 3; ++k) {
        by_u[k] = (surface(a + h, b, k) - surface(a - h, b, k)) / (2 * h);
        by_v[k] = (surface(a, b + h, k) - surface(a, b - h, k)) / (2 * h);
      }
      const long double n[3] = {by_u[1] * by_v[2] - by_u[2] * by_v[1], by_u[2] * by_v[0] - by_u[0] * by_v[2],
                                by_u[0] * by_v[1] - by_u[1] * by_v[0]};
      const long double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      for (size_t k = 0; k < 3; ++k) {
        EXPECT_LE(std::abs((long double)(vertex.normal[k]) - n[k] / length), 1e-7L) << vertex.normal[k];
      }
    }
  }
}

// The slopes are by u and v: where one of them runs backwards, the same point has the opposite normal.
TEST_F(EvaluatorTest, AutomaticNormalsFollowTheDomain) {
  const Row points = random_points(3 * 4 * 4);
  op::enable(*context, GL_MAP2_VERTEX_3);
  op::enable(*context, GL_AUTO_NORMAL);
  op::enable(*context, GL_LIGHTING);
  op::map2f(*context, GL_MAP2_VERTEX_3, 0, 1, 12, 4, 0, 1, 3, 4, points.data());
  const auto forwards = vertex_at(0.25, 0.75);
  op::map2f(*context, GL_MAP2_VERTEX_3, 1, 0, 12, 4, 0, 1, 3, 4, points.data());
  const auto backwards = vertex_at(0.75, 0.75);
  EXPECT_EQ(backwards.position, forwards.position);
  EXPECT_NE(forwards.normal[0], 0.0f);
  for (size_t k = 0; k < 3; ++k) EXPECT_EQ(backwards.normal[k], -forwards.normal[k]);
}

TEST_F(EvaluatorTest, AnswersWhatWasSet) {
  const Row points = random_points(2 * 3 * 4 + 1);
  op::map2f(*context, GL_MAP2_COLOR_4, 0.5f, 2, 12, 2, -1, 3, 4, 3, points.data());
  GLfloat coefficients[24], domain[4];
  GLint order[2], rounded[24];
  GLdouble exact[24];
  op::get_mapfv(*context, GL_MAP2_COLOR_4, GL_COEFF, coefficients);
  op::get_mapdv(*context, GL_MAP2_COLOR_4, GL_COEFF, exact);
  op::get_mapiv(*context, GL_MAP2_COLOR_4, GL_COEFF, rounded);
  op::get_mapfv(*context, GL_MAP2_COLOR_4, GL_DOMAIN, domain);
  op::get_mapiv(*context, GL_MAP2_COLOR_4, GL_ORDER, order);
  for (size_t i = 0; i < 24; ++i) {
    EXPECT_EQ(coefficients[i], points[i]);
    EXPECT_EQ(exact[i], double(points[i]));
    EXPECT_EQ(rounded[i], GLint(std::floor(double(points[i]) + 0.5)));
  }
  EXPECT_EQ(std::vector<GLint>(order, order + 2), (std::vector<GLint>{2, 3}));
  EXPECT_EQ(Row(domain, domain + 4), (Row{0.5f, 2, -1, 3}));
  op::get_mapiv(*context, GL_MAP1_TEXTURE_COORD_4, GL_ORDER, order);
  op::get_mapfv(*context, GL_MAP1_TEXTURE_COORD_4, GL_COEFF, coefficients);
  op::get_mapfv(*context, GL_MAP1_TEXTURE_COORD_4, GL_DOMAIN, domain);
  EXPECT_EQ(order[0], 1);
  EXPECT_EQ(Row(coefficients, coefficients + 4), (Row{0, 0, 0, 1}));
  EXPECT_EQ(Row(domain, domain + 2), (Row{0, 1}));
  expect_error(GL_NO_ERROR);
}

TEST_F(EvaluatorTest, Refusals) {
  const Row points = random_points(200);
  const Snapshot before = take_snapshot(*context);
  const float* p = points.data();
  op::map1f(*context, GL_MAP2_VERTEX_3, 0, 1, 3, 2, p), expect_error(GL_INVALID_ENUM);
  op::map1f(*context, GL_MAP1_VERTEX_3, 1, 1, 3, 2, p), expect_error(GL_INVALID_VALUE);
  op::map1f(*context, GL_MAP1_VERTEX_3, 0, 1, 2, 2, p), expect_error(GL_INVALID_VALUE);
  op::map1f(*context, GL_MAP1_VERTEX_3, 0, 1, 3, 0, p), expect_error(GL_INVALID_VALUE);
  op::map1f(*context, GL_MAP1_VERTEX_3, 0, 1, 3, kMaxEvalOrder + 1, p), expect_error(GL_INVALID_VALUE);
  op::map2f(*context, GL_MAP1_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 2, p), expect_error(GL_INVALID_ENUM);
  op::map2f(*context, GL_MAP2_VERTEX_3, 1, 1, 3, 2, 0, 1, 6, 2, p), expect_error(GL_INVALID_VALUE);
  op::map2f(*context, GL_MAP2_VERTEX_3, 0, 1, 3, 2, 2, 2, 6, 2, p), expect_error(GL_INVALID_VALUE);
  op::map2f(*context, GL_MAP2_VERTEX_3, 0, 1, 2, 2, 0, 1, 6, 2, p), expect_error(GL_INVALID_VALUE);
  op::map2f(*context, GL_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, -6, 2, p), expect_error(GL_INVALID_VALUE);
  op::map2f(*context, GL_MAP2_VERTEX_3, 0, 1, 3, 0, 0, 1, 6, 2, p), expect_error(GL_INVALID_VALUE);
  op::map2f(*context, GL_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 31, p), expect_error(GL_INVALID_VALUE);
  op::map_grid1(*context, 0, 0, 1), expect_error(GL_INVALID_VALUE);
  op::map_grid2(*context, 0, 0, 1, 1, 0, 1), expect_error(GL_INVALID_VALUE);
  op::map_grid2(*context, 1, 0, 1, -1, 0, 1), expect_error(GL_INVALID_VALUE);
  op::eval_mesh1(*context, GL_FILL, 0, 1), expect_error(GL_INVALID_ENUM);
  op::eval_mesh2(*context, GL_LINES, 0, 1, 0, 1), expect_error(GL_INVALID_ENUM);
  GLint answer[4] = {};
  op::get_mapiv(*context, GL_MAP1_VERTEX_3, GL_MAX_EVAL_ORDER, answer), expect_error(GL_INVALID_ENUM);
  op::get_mapiv(*context, GL_AUTO_NORMAL, GL_ORDER, answer), expect_error(GL_INVALID_ENUM);
  op::get_mapiv(*context, GL_MAP1_VERTEX_3, GL_ORDER, answer), expect_error(GL_NO_ERROR);
  EXPECT_EQ(answer[0], 1);
  EXPECT_EQ(take_snapshot(*context), before);
}

}  // namespace
}  // namespace halfspace::state
