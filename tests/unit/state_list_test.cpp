// Display lists: names, errors, and what is compiled and what is not.
#include <thread>

#include "list_fixture.h"

namespace halfspace::state {
namespace {

TEST_F(ListTest, NewListRefuses) {
  Calls gl = calls();
  gl.new_list(0);
  EXPECT_EQ(gl.error(), GLenum(GL_INVALID_VALUE));
  gl.new_list(1, GL_RENDER);
  EXPECT_EQ(gl.error(), GLenum(GL_INVALID_ENUM));
  gl.end_list();
  EXPECT_EQ(gl.error(), GLenum(GL_INVALID_OPERATION));
  gl.new_list(1);
  gl.new_list(2);
  EXPECT_EQ(gl.error(), GLenum(GL_INVALID_OPERATION));
  EXPECT_EQ(gl.get(GL_LIST_INDEX), 1);
  gl.end_list();
  EXPECT_EQ(gl.error(), GLenum(GL_NO_ERROR));
  gl.begin(GL_POINTS);
  gl.new_list(3);
  EXPECT_EQ(current_binding.table, &kInsideBeginEndTable);
  gl.end();
  EXPECT_EQ(gl.error(), GLenum(GL_INVALID_OPERATION));
  EXPECT_FALSE(gl.table().is_list(*context, 3));
}

TEST_F(ListTest, AskingWhichListIsCompiled) {
  Calls gl = calls();
  EXPECT_EQ(gl.get(GL_LIST_INDEX), 0);
  EXPECT_EQ(gl.get(GL_LIST_MODE), 0);
  gl.new_list(7, GL_COMPILE_AND_EXECUTE);
  EXPECT_EQ(gl.get(GL_LIST_INDEX), 7);
  EXPECT_EQ(gl.get(GL_LIST_MODE), GL_COMPILE_AND_EXECUTE);
  gl.end_list();
  EXPECT_EQ(gl.get(GL_LIST_INDEX), 0);
  EXPECT_EQ(gl.get(GL_LIST_MODE), 0);
  EXPECT_EQ(gl.get(GL_MAX_LIST_NESTING), 64);
}

TEST_F(ListTest, NamesAreReservedInARow) {
  const GLuint first = op::gen_lists(*context, 3);
  const GLuint second = op::gen_lists(*context, 2);
  for (GLuint i = 0; i < 3; ++i) EXPECT_TRUE(op::is_list(*context, first + i));
  for (GLuint i = 0; i < 2; ++i) {
    EXPECT_TRUE(op::is_list(*context, second + i));
    EXPECT_TRUE(second + i < first || second + i >= first + 3);
  }
  EXPECT_FALSE(op::is_list(*context, 0));
  op::delete_lists(*context, first + 1, 1);
  EXPECT_TRUE(op::is_list(*context, first));
  EXPECT_FALSE(op::is_list(*context, first + 1));
  EXPECT_TRUE(op::is_list(*context, first + 2));
  EXPECT_EQ(op::gen_lists(*context, 0), 0u);
  EXPECT_EQ(op::get_error(*context), GLenum(GL_NO_ERROR));
  EXPECT_EQ(op::gen_lists(*context, -1), 0u);
  EXPECT_EQ(op::get_error(*context), GLenum(GL_INVALID_VALUE));
  op::delete_lists(*context, first, -1);
  EXPECT_EQ(op::get_error(*context), GLenum(GL_INVALID_VALUE));
  EXPECT_TRUE(op::is_list(*context, first));
  op::delete_lists(*context, 0, INT32_MAX);
  EXPECT_FALSE(op::is_list(*context, first));
  EXPECT_EQ(op::get_error(*context), GLenum(GL_NO_ERROR));
}

TEST_F(ListTest, TheHighestNamesAreNamesToo) {
  Calls gl = calls();
  gl.new_list(UINT32_MAX);
  gl.end_list();
  EXPECT_TRUE(op::is_list(*context, UINT32_MAX));
  EXPECT_NE(op::gen_lists(*context, 5), 0u);
  op::delete_lists(*context, UINT32_MAX, 5);
  EXPECT_FALSE(op::is_list(*context, UINT32_MAX));
}

TEST_F(ListTest, EveryTypeOfNamesCountsFromTheBase) {
  Calls gl = calls();
  for (GLuint name : {99u, 100u, 101u, 300u}) {
    gl.new_list(name);
    gl.table().rotate(*context, 0, 0, 0, 1);  // a step that draws nothing
    gl.color(float(name));
    gl.end_list();
  }
  gl.table().list_base(*context, 100);
  EXPECT_EQ(gl.get(GL_LIST_BASE), 100);
  const auto last_of = [&](GLenum type, const void* names, GLsizei n) {
    context->current.color[0] = -1;
    gl.table().call_lists(*context, n, type, names);
    return int(context->current.color[0]);
  };
  const GLbyte bytes[] = {1, -1};
  const GLubyte unsigned_bytes[] = {0, 200};
  const GLshort shorts[] = {200, -1};
  const GLushort unsigned_shorts[] = {1, 200};
  const GLint ints[] = {1, -1};
  const GLuint unsigned_ints[] = {0, 0xffffffffu};  // wraps around
  const GLfloat floats[] = {200.0f, -1.0f};
  const GLubyte two[] = {0, 0, 0, 200}, three[] = {0, 0, 1, 0, 0, 200}, four[] = {0, 0, 0, 1, 0, 0, 0, 200};
  EXPECT_EQ(last_of(GL_BYTE, bytes, 2), 99);
  EXPECT_EQ(last_of(GL_BYTE, bytes, 1), 101);
  EXPECT_EQ(last_of(GL_UNSIGNED_BYTE, unsigned_bytes, 2), 300);
  EXPECT_EQ(last_of(GL_SHORT, shorts, 2), 99);
  EXPECT_EQ(last_of(GL_UNSIGNED_SHORT, unsigned_shorts, 2), 300);
  EXPECT_EQ(last_of(GL_INT, ints, 2), 99);
  EXPECT_EQ(last_of(GL_UNSIGNED_INT, unsigned_ints, 2), 99);
  EXPECT_EQ(last_of(GL_FLOAT, floats, 2), 99);
  EXPECT_EQ(last_of(GL_FLOAT, floats, 1), 300);
  EXPECT_EQ(last_of(GL_2_BYTES, two, 2), 300);
  EXPECT_EQ(last_of(GL_3_BYTES, three, 2), 300);
  EXPECT_EQ(last_of(GL_4_BYTES, four, 2), 300);
  EXPECT_EQ(gl.error(), GLenum(GL_NO_ERROR));
  EXPECT_EQ(last_of(GL_DOUBLE, floats, 1), -1);
  EXPECT_EQ(gl.error(), GLenum(GL_INVALID_ENUM));
  EXPECT_EQ(last_of(GL_BYTE, bytes, -1), -1);
  EXPECT_EQ(gl.error(), GLenum(GL_INVALID_VALUE));
}

TEST_F(ListTest, NamesAreKeptAndTheBaseIsThatOfTheCall) {
  Calls gl = calls();
  gl.new_list(5);
  gl.color(5);
  gl.end_list();
  GLubyte names[] = {2};
  gl.new_list(1);
  gl.table().call_lists(*context, 1, GL_UNSIGNED_BYTE, names);
  gl.end_list();
  names[0] = 0;
  gl.table().list_base(*context, 3);
  gl.call_list(1);
  EXPECT_EQ(context->current.color[0], 5);
}

// Only so many lists deep; the rest is left out without an error (spec 5.4).
TEST_F(ListTest, NestingEndsQuietly) {
  Calls gl = calls();
  gl.new_list(1);
  gl.table().translate(*context, 1, 0, 0);
  gl.call_list(1);
  gl.end_list();
  gl.call_list(1);
  EXPECT_EQ(context->transform.modelview.top()[12], float(gl.get(GL_MAX_LIST_NESTING)));
  EXPECT_EQ(gl.error(), GLenum(GL_NO_ERROR));
  EXPECT_EQ(context->lists.nesting, 0);
}

TEST_F(ListTest, AListIsReplacedOnlyWhenItIsComplete) {
  Calls gl = calls();
  gl.new_list(1);
  gl.color(0.25f);
  gl.end_list();
  gl.new_list(1, GL_COMPILE_AND_EXECUTE);
  gl.call_list(1);  // still the former one
  EXPECT_EQ(context->current.color[0], 0.25f);
  gl.color(0.75f);
  gl.end_list();
  gl.color(0);
  gl.call_list(1);
  EXPECT_EQ(context->current.color[0], 0.75f);
}

// Spec 5.4: these are executed at once, and a list has nothing of them.
TEST_F(ListTest, WhatIsNotCompiledIsExecuted) {
  Calls gl = calls();
  const OperationTable& t = kCompileTable;
  const float array[4] = {};
  GLuint texture = 0;
  gl.new_list(1);
  t.pixel_storei(*context, GL_PACK_ALIGNMENT, 1);
  t.vertex_pointer(*context, 3, GL_FLOAT, 12, array);
  t.enable_client_state(*context, GL_VERTEX_ARRAY);
  t.gen_textures(*context, 1, &texture);
  const GLuint reserved = t.gen_lists(*context, 1);
  EXPECT_TRUE(t.is_list(*context, reserved));
  t.delete_lists(*context, reserved, 1);
  EXPECT_FALSE(t.is_list(*context, reserved));
  EXPECT_EQ(gl.get(GL_PACK_ALIGNMENT), 1);
  EXPECT_EQ(gl.get(GL_VERTEX_ARRAY_STRIDE), 12);
  EXPECT_NE(texture, 0u);
  const float border[4] = {};
  t.tex_image_2d(*context, GL_PROXY_TEXTURE_2D, 0, GL_RGBA, 8, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, border);
  GLint width = 0;
  t.get_tex_level_parameteriv(*context, GL_PROXY_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &width);
  EXPECT_EQ(width, 8);
  gl.end_list();
  EXPECT_EQ(context->lists.names->lists.at(1)->first, nullptr);
}

TEST_F(ListTest, CompiledCommandsAreNotExecuted) {
  Calls gl = calls();
  const Snapshot before = take_snapshot(*context);
  gl.new_list(1);
  const float matrix[4] = {1, 2, 3, 4};
  gl.enable(GL_BLEND);
  gl.color(0.5f);
  gl.normal(1);
  gl.tex_coord(1);
  gl.edge_flag(false);
  gl.table().index(*context, 3);
  gl.table().material(*context, GL_FRONT, GL_AMBIENT, matrix);
  gl.table().matrix_mode(*context, GL_PROJECTION);
  gl.table().enable(*context, GL_LIST_BASE);  // an error, later
  gl.end_list();
  EXPECT_EQ(take_snapshot(*context), before);
  EXPECT_EQ(gl.error(), GLenum(GL_NO_ERROR));
  gl.call_list(1);
  EXPECT_EQ(gl.error(), GLenum(GL_INVALID_ENUM));
  EXPECT_NE(take_snapshot(*context), before);
  EXPECT_EQ(gl.get(GL_MATRIX_MODE), GL_PROJECTION);
}

// Whatever a command points to is read when it is compiled.
TEST_F(ListTest, ArgumentsAreCopied) {
  Calls gl = calls();
  double matrix[16] = {2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1};
  float emission[4] = {0.5f, 0.25f, 0.125f, 1};
  gl.new_list(1);
  gl.table().load_matrix(*context, matrix);
  gl.table().material(*context, GL_BACK, GL_EMISSION, emission);
  gl.end_list();
  std::fill_n(matrix, 16, 9.0);
  std::fill_n(emission, 4, 9.0f);
  gl.call_list(1);
  EXPECT_EQ(context->transform.modelview.top()[13], 6);
  EXPECT_EQ(context->lighting.material[1].emission[2], 0.125f);
}

TEST_F(ListTest, ImagesAreReadAsPixelStoreSaysWhenTheListIsCompiled) {
  Calls gl = calls();
  // 2 x 2 texels out of rows of 4, one pixel and one row skipped; bytes 0, 1, 2 ...
  std::vector<GLubyte> bytes(4 * 4 * 3);
  for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = GLubyte(i);
  gl.new_list(1);
  gl.table().pixel_storei(*context, GL_UNPACK_ALIGNMENT, 1);
  gl.table().pixel_storei(*context, GL_UNPACK_ROW_LENGTH, 4);
  gl.table().pixel_storei(*context, GL_UNPACK_SKIP_PIXELS, 1);
  gl.table().pixel_storei(*context, GL_UNPACK_SKIP_ROWS, 1);
  gl.table().tex_image_2d(*context, GL_TEXTURE_2D, 0, GL_RGB, 2, 2, 0, GL_RGB, GL_UNSIGNED_BYTE,
                          bytes.data());
  gl.end_list();
  std::fill(bytes.begin(), bytes.end(), GLubyte(99));
  for (GLenum name : std::initializer_list<GLenum>{GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS})
    gl.table().pixel_storei(*context, name, 0);
  gl.table().pixel_storei(*context, GL_UNPACK_SKIP_PIXELS, 2);
  gl.call_list(1);
  EXPECT_EQ(gl.get(GL_UNPACK_SKIP_PIXELS), 2);
  GLubyte texels[12] = {};
  gl.table().pixel_storei(*context, GL_PACK_ALIGNMENT, 1);
  gl.table().get_tex_image(*context, GL_TEXTURE_2D, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
  const std::vector<GLubyte> expected = {15, 16, 17, 18, 19, 20, 27, 28, 29, 30, 31, 32};
  EXPECT_EQ(std::vector<GLubyte>(texels, texels + 12), expected);
  EXPECT_EQ(gl.error(), GLenum(GL_NO_ERROR));
}

TEST_F(ListTest, ContextsShareLists) {
  Context other(VisualConfig{}, context.get());
  calls().new_list(4);
  calls().color(0.5f);
  calls().end_list();
  EXPECT_TRUE(op::is_list(other, 4));
  op::call_list(other, 4);
  EXPECT_EQ(other.current.color[0], 0.5f);
  EXPECT_EQ(context->current.color[0], 1.0f);
  op::delete_lists(other, 4, 1);
  EXPECT_FALSE(op::is_list(*context, 4));
}

// One thread plays and another replaces the list: each call plays one of the two, whole.
TEST_F(ListTest, PlayingAndReplacingAtTheSameTime) {
  Context other(VisualConfig{}, context.get());
  const auto compile = [](Context& c, float value) {
    op::new_list(c, 1, GL_COMPILE);
    kCompileTable.color(c, value, value, value, value);
    op::end_list(c);
  };
  compile(*context, 0.25f);
  std::thread writer([&] {
    for (int i = 0; i < 2000; ++i) compile(other, i % 2 ? 0.25f : 0.75f);
  });
  for (int i = 0; i < 2000; ++i) {
    op::call_list(*context, 1);
    const float* c = context->current.color;
    ASSERT_TRUE(c[0] == c[3] && (c[0] == 0.25f || c[0] == 0.75f));
  }
  writer.join();
}

TEST_F(ListTest, OutOfMemoryLeavesTheFormerList) {
  Calls gl = calls();
  gl.new_list(1);
  gl.color(0.5f);
  gl.end_list();
  gl.new_list(1);
  gl.color(0.75f);
  const GLubyte pixel[4] = {};
  gl.table().tex_image_2d(*context, GL_TEXTURE_2D, 0, GL_RGBA, INT32_MAX, INT32_MAX, 0, GL_RGBA, GL_FLOAT,
                          pixel);
  EXPECT_EQ(gl.error(), GLenum(GL_NO_ERROR));
  gl.end_list();
  EXPECT_EQ(gl.error(), GLenum(GL_OUT_OF_MEMORY));
  gl.call_list(1);
  EXPECT_EQ(context->current.color[0], 0.5f);
}

}  // namespace
}  // namespace halfspace::state
