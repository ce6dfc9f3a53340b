// Commands, queries and errors of points, lines, polygons and clip planes.
#include <array>
#include <cmath>
#include <initializer_list>

#include "state_fixture.h"

namespace halfspace::state {
namespace {

class ShapeTest : public StateTest {
 protected:
  template <size_t kCount>
  std::array<double, kCount> get(GLenum name) {
    std::array<double, kCount> values{};
    op::get_doublev(*context, name, values.data());
    return values;
  }
  void expect_refused(GLenum error, auto call) {
    const Snapshot before = take_snapshot(*context);
    const auto planes = context->clip_plane.planes;
    const auto pattern = context->polygon_stipple.pattern;
    call();
    EXPECT_EQ(op::get_error(*context), error);
    EXPECT_TRUE(take_snapshot(*context) == before);
    EXPECT_EQ(context->clip_plane.planes, planes);
    EXPECT_EQ(context->polygon_stipple.pattern, pattern);
  }
};

TEST_F(ShapeTest, WhatIsSetIsReadBackAndDerived) {
  op::point_size(*context, 3.25f);
  op::line_width(*context, 1000);
  op::line_stipple(*context, 300, 0xa5c3);
  op::polygon_offset(*context, -1.5f, 2.5f);
  op::polygon_mode(*context, GL_BACK, GL_POINT);
  for (GLenum cap : std::initializer_list<GLenum>{GL_POINT_SMOOTH, GL_LINE_SMOOTH, GL_LINE_STIPPLE,
                                                  GL_POLYGON_SMOOTH, GL_POLYGON_STIPPLE,
                                                  GL_POLYGON_OFFSET_LINE, GL_CLIP_PLANE1, GL_CLIP_PLANE5})
    op::enable(*context, cap);
  EXPECT_EQ(get<1>(GL_POINT_SIZE)[0], 3.25);
  EXPECT_EQ(get<1>(GL_LINE_WIDTH)[0], 1000);
  EXPECT_EQ(get<1>(GL_LINE_STIPPLE_PATTERN)[0], 0xa5c3);
  EXPECT_EQ(get<1>(GL_LINE_STIPPLE_REPEAT)[0], 256);
  EXPECT_EQ(get<1>(GL_POLYGON_OFFSET_FACTOR)[0], -1.5);
  EXPECT_EQ(get<1>(GL_POLYGON_OFFSET_UNITS)[0], 2.5);
  EXPECT_EQ(get<2>(GL_POINT_SIZE_RANGE), (std::array<double, 2>{1, double(raster::kMaxPointSize)}));
  EXPECT_EQ(get<2>(GL_LINE_WIDTH_RANGE), (std::array<double, 2>{1, double(raster::kMaxLineWidth)}));
  EXPECT_GT(get<1>(GL_LINE_WIDTH_GRANULARITY)[0], 0);
  const raster::DrawState& state = *derive(*context);
  EXPECT_EQ(state.point, (raster::PointState{3.25f, true}));
  EXPECT_EQ(state.line, (raster::LineState{1000, true, true, 0xa5c3, 256}));
  EXPECT_EQ(state.polygon.front, raster::PolygonMode::fill);
  EXPECT_EQ(state.polygon.back, raster::PolygonMode::point);
  EXPECT_TRUE(state.polygon.smooth && state.polygon.stipple && state.polygon.offset_line);
  EXPECT_FALSE(state.polygon.offset_fill || state.polygon.offset_point);
  EXPECT_EQ(int(state.clip_planes.enabled), 2 + 32);
  op::line_stipple(*context, -4, 1);
  EXPECT_EQ(get<1>(GL_LINE_STIPPLE_REPEAT)[0], 1);
}

TEST_F(ShapeTest, Errors) {
  for (float bad : {0.0f, -1.0f, NAN}) {
    expect_refused(GL_INVALID_VALUE, [&] { op::point_size(*context, bad); });
    expect_refused(GL_INVALID_VALUE, [&] { op::line_width(*context, bad); });
  }
  double plane[4] = {1, 2, 3, 4};
  for (GLenum bad :
       std::initializer_list<GLenum>{GLenum(GL_CLIP_PLANE0 - 1), GLenum(GL_CLIP_PLANE5 + 1), GLenum(0)}) {
    expect_refused(GL_INVALID_ENUM, [&] { op::clip_plane(*context, bad, plane); });
    expect_refused(GL_INVALID_ENUM, [&] { op::get_clip_plane(*context, bad, plane); });
  }
  EXPECT_EQ(plane[2], 3);
  op::begin(*context, GL_POINTS);
  const OperationTable& inside = *current_binding.table;
  GLubyte pattern[128] = {7};
  expect_refused(GL_INVALID_OPERATION, [&] { inside.point_size(*context, 2); });
  expect_refused(GL_INVALID_OPERATION, [&] { inside.line_width(*context, 2); });
  expect_refused(GL_INVALID_OPERATION, [&] { inside.line_stipple(*context, 2, 3); });
  expect_refused(GL_INVALID_OPERATION, [&] { inside.polygon_offset(*context, 2, 3); });
  expect_refused(GL_INVALID_OPERATION, [&] { inside.polygon_stipple(*context, pattern); });
  expect_refused(GL_INVALID_OPERATION, [&] { inside.get_polygon_stipple(*context, pattern); });
  expect_refused(GL_INVALID_OPERATION, [&] { inside.clip_plane(*context, GL_CLIP_PLANE0, plane); });
  expect_refused(GL_INVALID_OPERATION, [&] { inside.get_clip_plane(*context, GL_CLIP_PLANE0, plane); });
  inside.end(*context);
}

// Spec 2.11: p M^-1 at the time of the command; so p M^-1 . M v == p . v for any v.
TEST_F(ShapeTest, ClipPlanesGoToEyeCoordinatesAtOnce) {
  op::translate(*context, 1, -2, 3);
  op::rotate(*context, 40, 1, 2, 3);
  op::scale(*context, 2, 0.5, -3);
  const Matrix m = context->transform.modelview.top();
  const double p[4] = {0.3, -1.5, 2, 0.7};
  op::clip_plane(*context, GL_CLIP_PLANE3, p);
  op::load_identity(*context);
  double q[4];
  op::get_clip_plane(*context, GL_CLIP_PLANE3, q);
  const double points[][4] = {{1, 2, 3, 1}, {-4, 0.5, 1, 1}, {0, 0, 0, 1}, {1, -1, 2, 0}};
  for (const auto& v : points) {
    double given = 0, taken = 0;
    for (size_t i = 0; i < 4; ++i) {
      double eye = 0;
      for (size_t j = 0; j < 4; ++j) eye += double(m[4 * j + i]) * v[j];
      given += p[i] * v[i];
      taken += q[i] * eye;
    }
    EXPECT_NEAR(given, taken, 1e-12);
  }
  EXPECT_EQ(derive(*context)->clip_planes.planes[3], (std::array<double, 4>{q[0], q[1], q[2], q[3]}));
  const double singular[16] = {};
  op::load_matrix(*context, singular);
  op::clip_plane(*context, GL_CLIP_PLANE3, p);
  op::get_clip_plane(*context, GL_CLIP_PLANE3, q);
  for (double value : q) EXPECT_TRUE(std::isfinite(value));
}

// Spec 3.5.2, 3.6.4: rows from the bottom, the first element in the highest bit, laid out as the pixel store
// says.
TEST_F(ShapeTest, PolygonStippleIsUnpackedAndPacked) {
  for (uint32_t row : context->polygon_stipple.pattern) EXPECT_EQ(row, ~0u);
  std::array<GLubyte, 128> plain;
  for (size_t i = 0; i < 128; ++i) plain[i] = GLubyte(i * 37 + 11);
  op::polygon_stipple(*context, plain.data());
  for (size_t y = 0; y < 32; ++y) {
    const uint32_t row = uint32_t(plain[4 * y]) << 24 | uint32_t(plain[4 * y + 1]) << 16 |
                         uint32_t(plain[4 * y + 2]) << 8 | plain[4 * y + 3];
    EXPECT_EQ(derive(*context)->polygon.pattern[y], row);
  }
  // The same bits as a part of a larger bitmap: rows of 51 elements, lowest bit first, 2 rows and 11 elements
  // left out.
  for (GLenum name : std::initializer_list<GLenum>{GL_PACK_ROW_LENGTH, GL_UNPACK_ROW_LENGTH})
    op::pixel_storei(*context, name, 51);
  for (GLenum name : std::initializer_list<GLenum>{GL_PACK_SKIP_ROWS, GL_UNPACK_SKIP_ROWS})
    op::pixel_storei(*context, name, 2);
  for (GLenum name : std::initializer_list<GLenum>{GL_PACK_SKIP_PIXELS, GL_UNPACK_SKIP_PIXELS})
    op::pixel_storei(*context, name, 11);
  for (GLenum name : std::initializer_list<GLenum>{GL_PACK_LSB_FIRST, GL_UNPACK_LSB_FIRST})
    op::pixel_storei(*context, name, 1);
  const auto pattern = context->polygon_stipple.pattern;
  std::array<GLubyte, 8 * 40> large;
  large.fill(0xff);
  op::get_polygon_stipple(*context, large.data());
  for (size_t y = 0; y < 40; ++y) {
    for (size_t x = 0; x < 64; ++x) {
      const bool bit = large[8 * y + x / 8] >> (x % 8) & 1;
      const bool ours = y >= 2 && y < 34 && x >= 11 && x < 43;
      const bool expected = !ours || (pattern[y - 2] >> (31 - (x - 11)) & 1);
      ASSERT_EQ(bit, expected) << x << ", " << y;
    }
  }
  context->polygon_stipple = {};
  op::polygon_stipple(*context, large.data());
  EXPECT_EQ(context->polygon_stipple.pattern, pattern);
}

TEST_F(ShapeTest, AttributeGroups) {
  op::push_attrib(*context, GL_POINT_BIT | GL_LINE_BIT | GL_POLYGON_STIPPLE_BIT | GL_TRANSFORM_BIT);
  op::point_size(*context, 5);
  op::line_width(*context, 6);
  op::polygon_offset(*context, 1, 2);
  const std::array<GLubyte, 128> none{};
  op::polygon_stipple(*context, none.data());
  const double plane[4] = {1, 2, 3, 4};
  op::clip_plane(*context, GL_CLIP_PLANE2, plane);
  op::enable(*context, GL_CLIP_PLANE2);
  op::pop_attrib(*context);
  EXPECT_EQ(context->point.size, 1);
  EXPECT_EQ(context->line.width, 1);
  EXPECT_EQ(context->polygon_stipple.pattern[0], ~0u);
  EXPECT_EQ(context->clip_plane.planes[2][3], 0);
  EXPECT_FALSE(context->clip_plane.enabled[2]);
  EXPECT_EQ(context->polygon.offset_factor, 1) << "GL_POLYGON_BIT was not pushed";
}

}  // namespace
}  // namespace halfspace::state
