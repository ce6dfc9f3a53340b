// glWindowPos (GL_ARB_window_pos; OpenGL 1.4, 2.13): the raster position in window coordinates.
#include <array>

#include "tests/unit/pixel_fixture.h"

namespace halfspace::state {
namespace {

class WindowPositionTest : public PixelTest {
 protected:
  template <size_t kCount>
  std::array<GLdouble, kCount> get(GLenum pname) {
    std::array<GLdouble, kCount> values{};
    op::get_doublev(gl(), pname, values.data());
    return values;
  }
};

TEST_F(WindowPositionTest, TakesWindowCoordinatesAsTheyAre) {
  op::matrix_mode(gl(), GL_PROJECTION);
  op::scale(gl(), 0.01, 7, 3);  // no matrix has a say
  op::viewport(gl(), 3, 4, 5, 6);
  op::depth_range(gl(), 0.75, 0.25);
  op::window_pos(gl(), -11.5f, 300, 0.25f);
  EXPECT_GL(GL_NO_ERROR);
  EXPECT_EQ(get<4>(GL_CURRENT_RASTER_POSITION), (std::array<GLdouble, 4>{-11.5, 300, 0.625, 1}));
  EXPECT_EQ(get<1>(GL_CURRENT_RASTER_DISTANCE)[0], 0);
  op::window_pos(gl(), 0, 0, 9);
  EXPECT_EQ(get<4>(GL_CURRENT_RASTER_POSITION)[2], 0.25);
  op::window_pos(gl(), 0, 0, -9);
  EXPECT_EQ(get<4>(GL_CURRENT_RASTER_POSITION)[2], 0.75);
}

TEST_F(WindowPositionTest, IsValidAgainAndTakesTheCurrentValues) {
  op::raster_pos(gl(), 5, 5, 5, 1);  // outside of the volume
  EXPECT_EQ(get<1>(GL_CURRENT_RASTER_POSITION_VALID)[0], 0);
  op::color(gl(), 0.25f, 2, -1, 0.5f);
  op::tex_coord(gl(), 3, 4, 5, 6);
  op::window_pos(gl(), 1, 2, 0);
  EXPECT_EQ(get<1>(GL_CURRENT_RASTER_POSITION_VALID)[0], 1);
  EXPECT_EQ(get<4>(GL_CURRENT_RASTER_COLOR), (std::array<GLdouble, 4>{0.25, 1, 0, 0.5}));
  EXPECT_EQ(get<4>(GL_CURRENT_RASTER_TEXTURE_COORDS), (std::array<GLdouble, 4>{3, 4, 5, 6}));
}

TEST_F(WindowPositionTest, PixelsAreDrawnThere) {
  const uint8_t pixel[4] = {10, 20, 30, 40};
  op::window_pos(gl(), 7, 9, 0);
  op::draw_pixels(gl(), 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
  std::array<uint8_t, 4> out{};
  op::read_pixels(gl(), 7, 9, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, out.data());
  EXPECT_EQ(out, (std::array<uint8_t, 4>{10, 20, 30, 40}));
}

}  // namespace
}  // namespace halfspace::state
