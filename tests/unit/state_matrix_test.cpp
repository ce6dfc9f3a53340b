// Matrix commands against GLM in double, and the sine of our own against long double.
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <random>

#include "state/trigonometry.h"
#include "state_fixture.h"

namespace halfspace::state {
namespace {

class MatrixTest : public StateTest {
 protected:
  // Half a float ulp of rounding each step, measured against the largest term that was summed.
  void expect_top(const glm::dmat4& expected, double scale = 1) {
    const Matrix& top = context->transform.modelview.top();
    for (size_t i = 0; i < 16; ++i) {
      const double want = glm::value_ptr(expected)[i];
      EXPECT_NEAR(double(top[i]), want, 1.2e-7 * std::max(scale, std::fabs(want))) << "element " << i;
    }
  }
  glm::dmat4 top() const {
    glm::dmat4 m;
    std::copy_n(context->transform.modelview.top().begin(), 16, glm::value_ptr(m));
    return m;
  }
};

double ulps(double value, long double truth) {
  const double unit = std::nextafter(std::fabs(value), HUGE_VAL) - std::fabs(value);
  return double(std::fabs((long double)(value)-truth) / (long double)(unit));
}

// |degrees| <= 360, reduced in long double, where this reduction is exact.
long double true_sine(double degrees) {
  const long double kPi = 3.14159265358979323846264338327950288L;
  const long double quarters = std::round((long double)(degrees) / 90);
  const long double rest = ((long double)(degrees)-90 * quarters) * (kPi / 180);
  switch ((int(quarters) % 4 + 4) % 4) {
    case 0:
      return std::sin(rest);
    case 1:
      return std::cos(rest);
    case 2:
      return -std::sin(rest);
    default:
      return -std::cos(rest);
  }
}

TEST(Trigonometry, IsWithinOneUlp) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> angle(-360, 360), exponent(-300, 0);
  double worst = 0;
  for (int i = 0; i < 200'000; ++i) {
    const double degrees = i % 2 ? angle(random) : angle(random) * std::pow(10, exponent(random));
    const SineCosine value = sine_cosine_degrees(degrees);
    worst = std::max(worst, ulps(value.sine, true_sine(degrees)));
    const double other = degrees > 0 ? degrees - 90 : degrees + 90;  // cos(x) = -sin(x - 90) = sin(x + 90)
    if (std::fabs(degrees) >= 45) {
      worst = std::max(worst, ulps(value.cosine, degrees > 0 ? -true_sine(other) : true_sine(other)));
    }
  }
  EXPECT_LT(worst, 1.0);
  RecordProperty("worst_ulps_times_1000", int(worst * 1000));
}

TEST(Trigonometry, IsExactAtQuarterTurnsHoweverMany) {
  const double kSine[] = {0, 1, 0, -1};
  for (int i = -4000; i <= 4000; ++i) {
    const SineCosine value = sine_cosine_degrees(90.0 * i);
    EXPECT_EQ(value.sine, kSine[i & 3]) << i;
    EXPECT_EQ(value.cosine, kSine[(i + 1) & 3]) << i;
  }
  EXPECT_EQ(sine_cosine_degrees(360e15 + 64).sine, sine_cosine_degrees(64).sine);  // both sums are exact
  EXPECT_TRUE(std::isnan(sine_cosine_degrees(HUGE_VAL).sine));
  EXPECT_TRUE(std::isnan(sine_cosine_degrees(double(NAN)).cosine));
}

TEST_F(MatrixTest, CommandsMultiplyFromTheRightLikeGlm) {
  glm::dmat4 expected(1);
  op::translate(*context, 1.5, -2, 3);
  expected = glm::translate(expected, {1.5, -2, 3});
  expect_top(expected);
  op::rotate(*context, 33, 1, -2, 0.5);
  expected = glm::rotate(expected, glm::radians(33.0), glm::normalize(glm::dvec3(1, -2, 0.5)));
  expect_top(expected, 4);
  op::scale(*context, 2, 3, -4);
  expected = glm::scale(expected, {2, 3, -4});
  expect_top(expected, 16);
  const glm::dmat4 factor(1, 2, 3, 4, -5, 6, 7, 8, 9, 10, -11, 12, 13, 14, 15, 16);
  expected = top() * factor;  // from what the float stack holds: one rounding from here
  op::mult_matrix(*context, glm::value_ptr(factor));
  expect_top(expected);
}

TEST_F(MatrixTest, ProjectionsAreGlms) {
  op::frustum(*context, -1, 2, -3, 4, 0.5, 90);
  expect_top(glm::frustum(-1.0, 2.0, -3.0, 4.0, 0.5, 90.0));
  op::load_identity(*context);
  op::ortho(*context, -1, 2, 3, -4, -5, 60);
  expect_top(glm::ortho(-1.0, 2.0, 3.0, -4.0, -5.0, 60.0));
}

TEST_F(MatrixTest, QuarterTurnsAreExact) {
  for (int i = 0; i < 4; ++i) op::rotate(*context, 90, 0, 0, 1);
  EXPECT_EQ(context->transform.modelview.top(), kIdentity);
  op::rotate(*context, 90, 0, 3, 0);
  EXPECT_EQ(context->transform.modelview.top(), (Matrix{0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1}));
}

TEST_F(MatrixTest, RotationKeepsTheLengthOfItsAxis) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    op::load_identity(*context);
    const glm::dvec3 axis(any(random), any(random), any(random));
    op::rotate(*context, 360 * any(random), axis.x, axis.y, axis.z);
    const glm::dvec3 turned = glm::dmat3(top()) * axis;
    EXPECT_LT(glm::distance(turned, axis), 3e-7);
  }
}

TEST_F(MatrixTest, HugeAndZeroAxes) {
  op::rotate(*context, 90, 0, 0, 1e300);
  EXPECT_EQ(context->transform.modelview.top()[1], 1.0f);
  const Matrix before = context->transform.modelview.top();
  op::rotate(*context, 45, 0, 0, 0);
  EXPECT_EQ(context->transform.modelview.top(), before);
}

TEST_F(MatrixTest, LoadedDoublesAreRoundedOnce) {
  double m[16];
  for (int i = 0; i < 16; ++i) m[i] = 0.1 * (i + 1);
  op::load_matrix(*context, m);
  for (size_t i = 0; i < 16; ++i) EXPECT_EQ(context->transform.modelview.top()[i], float(m[i]));
}

// NUMERICS.md: what a million small rotations drift is what float rounding predicts, no more. Each product
// rounds once, to half a unit of 2^-24; a random walk of n such steps goes sqrt(n) of them, here 6e-5. Six
// times that is the limit; a product that is summed in float, or a sine with a bias, goes beyond it.
TEST_F(MatrixTest, AMillionSmallRotationsDriftAsLittleAsRoundingAllows) {
  for (int i = 0; i < 1'000'000; ++i) op::rotate(*context, 0.36, 0, 0, 1);
  EXPECT_LT(std::fabs(glm::determinant(top()) - 1), 4e-4);
  EXPECT_NEAR(top()[0][0], 1, 4e-4);
}

TEST_F(MatrixTest, EachModeHasItsOwnStack) {
  const GLenum kModes[] = {GL_MODELVIEW, GL_PROJECTION, GL_TEXTURE};
  for (GLenum mode : kModes) {
    op::matrix_mode(*context, mode);
    op::translate(*context, mode, 0, 0);
  }
  EXPECT_EQ(context->transform.modelview.top()[12], float(GL_MODELVIEW));
  EXPECT_EQ(context->transform.projection.top()[12], float(GL_PROJECTION));
  EXPECT_EQ(context->transform.texture.top()[12], float(GL_TEXTURE));
}

TEST_F(MatrixTest, StacksAreAsDeepAsTheySayAndComeBack) {
  for (auto [mode, limit] : {std::pair{GL_MODELVIEW, GL_MAX_MODELVIEW_STACK_DEPTH},
                             {GL_PROJECTION, GL_MAX_PROJECTION_STACK_DEPTH},
                             {GL_TEXTURE, GL_MAX_TEXTURE_STACK_DEPTH}}) {
    op::matrix_mode(*context, GLenum(mode));
    GLint depth = 0;
    op::get_integerv(*context, GLenum(limit), &depth);
    ASSERT_GE(depth, mode == GL_MODELVIEW ? 32 : 2);
    for (int i = 1; i < depth; ++i) {
      op::push_matrix(*context);
      op::translate(*context, 1, 0, 0);
    }
    EXPECT_EQ(op::get_error(*context), GLenum(GL_NO_ERROR));
    op::push_matrix(*context);
    EXPECT_EQ(op::get_error(*context), GLenum(GL_STACK_OVERFLOW));
    for (int i = 1; i < depth; ++i) op::pop_matrix(*context);
    EXPECT_EQ(op::get_error(*context), GLenum(GL_NO_ERROR));
    op::pop_matrix(*context);
    EXPECT_EQ(op::get_error(*context), GLenum(GL_STACK_UNDERFLOW));
    GLfloat m[16];
    op::get_floatv(*context,
                   mode == GL_MODELVIEW    ? GL_MODELVIEW_MATRIX
                   : mode == GL_PROJECTION ? GL_PROJECTION_MATRIX
                                           : GL_TEXTURE_MATRIX,
                   m);
    EXPECT_TRUE(std::equal(m, m + 16, kIdentity.begin()));
  }
}

TEST_F(MatrixTest, TheDerivedProductIsDouble) {
  op::matrix_mode(*context, GL_PROJECTION);
  op::frustum(*context, -0.1, 0.1, -0.1, 0.1, 0.1, 100);
  op::matrix_mode(*context, GL_MODELVIEW);
  op::rotate(*context, 17, 1, 2, 3);
  op::translate(*context, 0.1, 0.2, -0.3);
  const auto& state = derive(*context);
  const Matrix &p = context->transform.projection.top(), &m = context->transform.modelview.top();
  for (size_t column = 0; column < 4; ++column) {
    for (size_t row = 0; row < 4; ++row) {
      long double sum = 0;
      for (size_t k = 0; k < 4; ++k) sum += (long double)(p[4 * k + row]) * (long double)(m[4 * column + k]);
      EXPECT_NEAR(state->clip_from_object[4 * column + row], double(sum), 1e-15 * 4);
    }
  }
}

}  // namespace
}  // namespace halfspace::state
