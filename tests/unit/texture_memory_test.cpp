// Out of memory at any allocation of an operation: GL_OUT_OF_MEMORY, and the state is as it was (spec 2.5).
#include <vector>

#include "tests/support/failing_new.h"
#include "tests/unit/pixel_fixture.h"

namespace halfspace::state {
namespace {

using Texels = std::vector<uint8_t>;

class TextureMemoryTest : public PixelTest {
 protected:
  TextureMemoryTest() {
    for (size_t i = 0; i < source_.size(); ++i) source_[i] = uint8_t(i * 41 + 3);
    op::tex_image_2d(gl(), GL_TEXTURE_2D, 0, GL_RGBA, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, source_.data());
    const GLint linear = GL_LINEAR;
    op::tex_parameteriv(gl(), GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, &linear);
    gl().texture.enabled_2d = true;
  }

  // Runs `call` with the first, the second ... allocation failing, and `unchanged` after each, until it
  // succeeds. Returns how many allocations could fail.
  template <class Call, class Unchanged>
  int fail_everywhere(Call&& call, Unchanged&& unchanged) {
    for (int n = 0; n < 1000; ++n) {
      test::allocations_left = n;
      test::allocation_failed = false;
      call();
      test::allocations_left = -1;
      const GLenum code = error();
      if (!test::allocation_failed) {
        EXPECT_EQ(code, GLenum{GL_NO_ERROR});
        return n;
      }
      EXPECT_EQ(code, GLenum{GL_OUT_OF_MEMORY}) << "allocation " << n;
      unchanged();
    }
    ADD_FAILURE() << "never succeeds";
    return 0;
  }

  Texels image() {
    Texels out(64);
    op::get_tex_image(gl(), GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, out.data());
    return out;
  }
  void expect_old_image() {
    GLint width = 0;
    op::get_tex_level_parameteriv(gl(), GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &width);
    ASSERT_EQ(width, 4);
    EXPECT_EQ(image(), Texels(source_.begin(), source_.begin() + 64));
    EXPECT_NE(current_texture_view(gl()), nullptr);
  }

  Texels source_ = Texels(1024);
};

TEST_F(TextureMemoryTest, TheOldImageStands) {
  for (GLenum format : {GLenum{GL_RGBA}, GLenum{GL_RGB}}) {  // as it lies, and converted
    for (bool hold_view : {false, true}) {
      const auto view = hold_view ? current_texture_view(gl()) : nullptr;
      const int failures = fail_everywhere(
          [&] {
            op::tex_image_2d(gl(), GL_TEXTURE_2D, 0, GLint(format), 8, 8, 0, format, GL_UNSIGNED_BYTE,
                             source_.data());
          },
          [&] { expect_old_image(); });
      EXPECT_GT(failures, 0);
      op::tex_image_2d(gl(), GL_TEXTURE_2D, 0, GL_RGBA, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, source_.data());
    }
  }
}

TEST_F(TextureMemoryTest, SubImagesLeaveTheTexels) {
  const Texels patch(16, 0x77);
  const auto view = current_texture_view(gl());  // makes the level be copied
  const int failures = fail_everywhere(
      [&] {
        op::tex_sub_image_2d(gl(), GL_TEXTURE_2D, 0, 1, 1, 2, 2, GL_RGB, GL_UNSIGNED_BYTE, patch.data());
      },
      [&] { expect_old_image(); });
  EXPECT_GT(failures, 1);
  EXPECT_EQ(image()[(4 + 1) * 4], 0x77);
}

TEST_F(TextureMemoryTest, BindingAndNaming) {
  GLuint name = 0;
  EXPECT_GT(fail_everywhere([&] { op::gen_textures(gl(), 1, &name); }, [&] { EXPECT_EQ(name, 0u); }), 0);
  EXPECT_GT(name, 0u);
  const int failures = fail_everywhere([&] { op::bind_texture(gl(), GL_TEXTURE_2D, 500); },
                                       [&] {
                                         EXPECT_FALSE(op::is_texture(gl(), 500));
                                         EXPECT_EQ(gl().texture.bound_2d->name, 0u);
                                       });
  EXPECT_GT(failures, 1);
  EXPECT_EQ(gl().texture.bound_2d->name, 500u);
}

TEST_F(TextureMemoryTest, ReadingBack) {
  Texels out(64);
  EXPECT_GT(fail_everywhere(
                [&] { op::get_tex_image(gl(), GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, out.data()); },
                [&] { expect_old_image(); }),
            0);
  EXPECT_EQ(out, Texels(source_.begin(), source_.begin() + 64));
  op::clear_color(gl(), 0.2f, 0.4f, 0.6f, 0.8f);
  op::clear(gl(), GL_COLOR_BUFFER_BIT);
  EXPECT_GT(fail_everywhere([&] { op::read_pixels(gl(), 0, 0, 2, 2, GL_BGRA, GL_UNSIGNED_BYTE, out.data()); },
                            [] {}),
            0);
  EXPECT_EQ(Texels(out.begin(), out.begin() + 4), (Texels{153, 102, 51, 204}));
}

}  // namespace
}  // namespace halfspace::state
