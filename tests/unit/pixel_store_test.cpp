// glPixelStore, and the layout of images in client memory (spec 3.6.1, 3.6.4).
#include <array>
#include <limits>

#include "state/get.h"
#include "tests/unit/pixel_fixture.h"

namespace halfspace::state {
namespace {

struct StoreName {
  GLenum name;
  bool is_flag;
  GLint initial;
};
constexpr StoreName kNames[] = {
    {GL_PACK_SWAP_BYTES, true, 0},   {GL_PACK_LSB_FIRST, true, 0},      {GL_PACK_ROW_LENGTH, false, 0},
    {GL_PACK_SKIP_ROWS, false, 0},   {GL_PACK_SKIP_PIXELS, false, 0},   {GL_PACK_ALIGNMENT, false, 4},
    {GL_UNPACK_SWAP_BYTES, true, 0}, {GL_UNPACK_LSB_FIRST, true, 0},    {GL_UNPACK_ROW_LENGTH, false, 0},
    {GL_UNPACK_SKIP_ROWS, false, 0}, {GL_UNPACK_SKIP_PIXELS, false, 0}, {GL_UNPACK_ALIGNMENT, false, 4},
};

bool is_alignment(GLenum name) { return name == GL_PACK_ALIGNMENT || name == GL_UNPACK_ALIGNMENT; }

class PixelStoreTest : public PixelTest {
 protected:
  GLint get(GLenum name) {
    GLint value = -1;
    op::get_integerv(gl(), name, &value);
    EXPECT_GL(GL_NO_ERROR);
    return value;
  }
};

TEST_F(PixelStoreTest, StartsAsTheSpecSays) {
  for (const StoreName& row : kNames) EXPECT_EQ(get(row.name), row.initial) << std::hex << row.name;
}

TEST_F(PixelStoreTest, EachNameIsItsOwnValue) {
  GLint next = 3;
  for (const StoreName& row : kNames) {
    op::pixel_storei(gl(), row.name, row.is_flag ? 5 : is_alignment(row.name) ? 8 : next++);
    EXPECT_GL(GL_NO_ERROR);
    for (const StoreName& later : kNames) {
      if (&later > &row) {
        EXPECT_EQ(get(later.name), later.initial) << std::hex << row.name << " changed " << later.name;
      }
    }
  }
  next = 3;
  for (const StoreName& row : kNames) {
    EXPECT_EQ(get(row.name), row.is_flag ? 1 : is_alignment(row.name) ? 8 : next++) << std::hex << row.name;
  }
}

TEST_F(PixelStoreTest, RefusesAndKeeps) {
  for (const StoreName& row : kNames) {
    if (row.is_flag) continue;
    op::pixel_storei(gl(), row.name, 2);
    op::pixel_storei(gl(), row.name, -1);
    EXPECT_GL(GL_INVALID_VALUE);
    op::pixel_storef(gl(), row.name, -3.0f);
    EXPECT_GL(GL_INVALID_VALUE);
    op::pixel_storef(gl(), row.name, std::numeric_limits<float>::quiet_NaN());
    EXPECT_GL(GL_INVALID_VALUE);
    op::pixel_storef(gl(), row.name, 1e20f);
    EXPECT_GL(GL_INVALID_VALUE);
    EXPECT_EQ(get(row.name), 2);
  }
  for (GLint value : {0, 3, 5, 6, 7, 9, 16}) {
    op::pixel_storei(gl(), GL_PACK_ALIGNMENT, value);
    EXPECT_GL(GL_INVALID_VALUE);
    EXPECT_EQ(get(GL_PACK_ALIGNMENT), 2);
  }
  op::pixel_storei(gl(), GL_PACK_SKIP_IMAGES, 1);  // 1.2's
  EXPECT_GL(GL_INVALID_ENUM);
  op::pixel_storef(gl(), GL_TEXTURE_2D, 1);
  EXPECT_GL(GL_INVALID_ENUM);
}

TEST_F(PixelStoreTest, FloatsAreRounded) {
  op::pixel_storef(gl(), GL_UNPACK_ROW_LENGTH, 6.6f);
  EXPECT_EQ(get(GL_UNPACK_ROW_LENGTH), 7);
  op::pixel_storef(gl(), GL_UNPACK_ALIGNMENT, 1.4f);
  EXPECT_EQ(get(GL_UNPACK_ALIGNMENT), 1);
  op::pixel_storef(gl(), GL_UNPACK_SWAP_BYTES, 0.25f);
  EXPECT_EQ(get(GL_UNPACK_SWAP_BYTES), 1);
  op::pixel_storef(gl(), GL_UNPACK_SWAP_BYTES, 0.0f);
  EXPECT_EQ(get(GL_UNPACK_SWAP_BYTES), 0);
}

// Spec 3.6.4: k = n l elements when s >= a, else (a / s) ceil(s n l / a); of packed types, n = 1.
TEST(ClientLayout, IsTheSpecsFormula) {
  for (size_t s : {1u, 2u, 4u}) {
    for (size_t n : {1u, 2u, 3u, 4u}) {
      for (GLint a : {1, 2, 4, 8}) {
        for (GLint row_length : {0, 1, 5, 64, 1021}) {
          for (GLsizei width : {1, 3, 64, 333}) {
            const PixelStore store{
                .row_length = row_length, .skip_rows = 7, .skip_pixels = 9, .alignment = a};
            const size_t l = size_t(row_length > 0 ? row_length : width), alignment = size_t(a);
            size_t k = n * l;
            if (s < alignment) k = alignment / s * ((s * n * l + alignment - 1) / alignment);
            const ClientLayout layout = client_layout(store, width, s * n);
            EXPECT_EQ(layout.row_bytes, k * s);
            EXPECT_EQ(layout.offset, 7 * k * s + 9 * n * s);
            EXPECT_EQ(layout.pixel_bytes, n * s);
          }
        }
      }
    }
  }
}

TEST(ClientLayout, DoesNotOverflowAnInt) {
  const PixelStore store{.row_length = 0x7FFFFFFF, .skip_rows = 3, .skip_pixels = 0x7FFFFFFF, .alignment = 8};
  const ClientLayout layout = client_layout(store, 1, 16);
  EXPECT_EQ(layout.row_bytes, size_t{0x7FFFFFFF} * 16);
  EXPECT_EQ(layout.offset, size_t{0x7FFFFFFF} * 16 * 4);
}

}  // namespace
}  // namespace halfspace::state
