// The attribute stacks: depth, errors, and what becomes of textures. That each bit saves its group and
// nothing else is tested through the API.
#include "state/attribute_stack.h"
#include "state_fixture.h"

namespace halfspace::state {
namespace {

class AttributeStackTest : public StateTest {
 protected:
  AttributeStackTest() : StateTest(double_buffered()) {}
  GLint integer(GLenum name) {
    GLint v[16] = {};
    op::get_integerv(*context, name, v);
    return v[0];
  }
  GLint parameter(GLenum target, GLenum name) {
    GLint v = 0;
    op::get_tex_parameteriv(*context, target, name, &v);
    return v;
  }
  void set_parameter(GLenum target, GLenum name, GLint value) {
    op::tex_parameteriv(*context, target, name, &value);
  }
  GLenum error() { return op::get_error(*context); }
};

TEST_F(AttributeStackTest, IsSixteenDeepAndLastInFirstOut) {
  for (int i = 0; i < 16; ++i) {
    EXPECT_EQ(integer(GL_ATTRIB_STACK_DEPTH), i);
    op::viewport(*context, i, 2 * i, 3, 4);
    op::push_attrib(*context, GL_VIEWPORT_BIT);
  }
  EXPECT_EQ(error(), GLenum(GL_NO_ERROR));
  op::push_attrib(*context, GL_VIEWPORT_BIT);
  EXPECT_EQ(error(), GLenum(GL_STACK_OVERFLOW));
  EXPECT_EQ(integer(GL_ATTRIB_STACK_DEPTH), 16);
  for (int i = 15; i >= 0; --i) {
    op::viewport(*context, 99, 99, 99, 99);
    op::pop_attrib(*context);
    EXPECT_EQ(integer(GL_VIEWPORT), i);
  }
  EXPECT_EQ(error(), GLenum(GL_NO_ERROR));
  op::pop_attrib(*context);
  EXPECT_EQ(error(), GLenum(GL_STACK_UNDERFLOW));
  EXPECT_EQ(integer(GL_ATTRIB_STACK_DEPTH), 0);
}

TEST_F(AttributeStackTest, TheClientStackIsAnother) {
  for (int i = 0; i < 16; ++i) {
    op::pixel_storei(*context, GL_PACK_SKIP_ROWS, i);
    op::push_client_attrib(*context, GL_CLIENT_PIXEL_STORE_BIT);
  }
  EXPECT_EQ(integer(GL_CLIENT_ATTRIB_STACK_DEPTH), 16);
  EXPECT_EQ(integer(GL_ATTRIB_STACK_DEPTH), 0);
  EXPECT_EQ(error(), GLenum(GL_NO_ERROR));
  op::push_client_attrib(*context, 0);
  EXPECT_EQ(error(), GLenum(GL_STACK_OVERFLOW));
  for (int i = 15; i >= 0; --i) {
    op::pixel_storei(*context, GL_PACK_SKIP_ROWS, 99);
    op::pop_client_attrib(*context);
    EXPECT_EQ(integer(GL_PACK_SKIP_ROWS), i);
  }
  op::pop_client_attrib(*context);
  EXPECT_EQ(error(), GLenum(GL_STACK_UNDERFLOW));
}

// The drawing that follows a pop is made with the values that came back.
TEST_F(AttributeStackTest, PoppedValuesReachTheDrawState) {
  op::enable(*context, GL_BLEND);
  op::push_attrib(*context, GL_ALL_ATTRIB_BITS);
  const auto before = derive(*context);
  op::disable(*context, GL_BLEND);
  op::viewport(*context, 1, 2, 3, 4);
  op::cull_face(*context, GL_FRONT);
  op::enable(*context, GL_CULL_FACE);
  op::depth_func(*context, GL_ALWAYS);
  ASSERT_FALSE(derive(*context)->blend.enabled);
  op::pop_attrib(*context);
  const auto after = derive(*context);
  EXPECT_TRUE(after->blend.enabled);
  EXPECT_EQ(after->viewport, before->viewport);
  EXPECT_FALSE(after->raster.cull_front);
  EXPECT_EQ(after->depth, before->depth);
}

// A colour that comes back between two pairs of Begin and End is the colour of the second alone.
TEST_F(AttributeStackTest, APopBetweenPrimitivesParts) {
  op::color(*context, 1, 0, 0, 1);
  op::push_attrib(*context, GL_CURRENT_BIT);
  op::color(*context, 0, 1, 0, 1);
  op::ortho(*context, 0, 64, 0, 48, -1, 1);
  op::rect(*context, 0, 0, 32, 48);
  op::pop_attrib(*context);
  op::rect(*context, 32, 0, 64, 48);
  const auto pixel = [this](int x) {
    std::array<GLubyte, 4> v{};
    op::read_pixels(*context, x, 20, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, v.data());
    return v;
  };
  EXPECT_EQ(pixel(16), (std::array<GLubyte, 4>{0, 255, 0, 255}));
  EXPECT_EQ(pixel(48), (std::array<GLubyte, 4>{255, 0, 0, 255}));
}

// The parameters go back to the object that was bound at the push, whatever is bound at the pop.
TEST_F(AttributeStackTest, TextureParametersReturnToTheirObject) {
  op::bind_texture(*context, GL_TEXTURE_2D, 5);
  set_parameter(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP);
  op::push_attrib(*context, GL_TEXTURE_BIT);
  set_parameter(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  op::bind_texture(*context, GL_TEXTURE_2D, 6);
  set_parameter(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  op::pop_attrib(*context);
  EXPECT_EQ(parameter(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S), GL_CLAMP);
  op::bind_texture(*context, GL_TEXTURE_2D, 6);
  EXPECT_EQ(parameter(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S), GL_CLAMP_TO_EDGE);
}

TEST_F(AttributeStackTest, ADeletedTextureDoesNotComeBack) {
  op::bind_texture(*context, GL_TEXTURE_1D, 7);
  set_parameter(GL_TEXTURE_1D, GL_TEXTURE_WRAP_S, GL_CLAMP);
  op::push_attrib(*context, GL_TEXTURE_BIT);
  const std::weak_ptr<TextureObject> object = context->texture.bound_1d;
  const GLuint name = 7;
  op::delete_textures(*context, 1, &name);
  op::pop_attrib(*context);
  EXPECT_EQ(context->texture.bound_1d, context->texture.default_1d);
  EXPECT_EQ(parameter(GL_TEXTURE_1D, GL_TEXTURE_WRAP_S), GL_REPEAT);
  EXPECT_FALSE(op::is_texture(*context, 7));
  EXPECT_TRUE(object.expired());  // a popped level keeps nothing alive
}

TEST_F(AttributeStackTest, NoBitsIsAPushLikeAnyOther) {
  op::push_attrib(*context, 0);
  op::shade_model(*context, GL_FLAT);
  op::pop_attrib(*context);
  EXPECT_EQ(integer(GL_SHADE_MODEL), GL_FLAT);
  EXPECT_EQ(error(), GLenum(GL_NO_ERROR));
}

}  // namespace
}  // namespace halfspace::state
