// Display lists: names, errors, what is compiled and what is not, and that a list draws what its calls would
// have drawn.
#include <functional>
#include <thread>

#include "recording_device.h"
#include "state_fixture.h"

namespace halfspace::state {
namespace {

using raster::recorded_draws;

// Commands as a program gives them: through the table entry points use.
struct Calls {
  Context& c;
  const OperationTable& table() const { return *current_binding.table; }
  void new_list(GLuint name, GLenum mode = GL_COMPILE) { table().new_list(c, name, mode); }
  void end_list() { table().end_list(c); }
  void call_list(GLuint name) { table().call_list(c, name); }
  void begin(GLenum mode) { table().begin(c, mode); }
  void end() { table().end(c); }
  void vertex(float x, float y = 0, float z = 0, float w = 1) { table().vertex(c, x, y, z, w); }
  void color(float r, float g = 0, float b = 0, float a = 1) { table().color(c, r, g, b, a); }
  void normal(float x, float y = 0, float z = 0) { table().normal(c, x, y, z); }
  void tex_coord(float s, float t = 0, float r = 0, float q = 1) { table().tex_coord(c, s, t, r, q); }
  void edge_flag(bool flag) { table().edge_flag(c, flag); }
  void enable(GLenum cap) { table().enable(c, cap); }
  void material(GLenum name, std::vector<float> v) { table().material(c, GL_FRONT, name, v.data()); }
  GLenum error() { return table().get_error(c); }
  GLint get(GLenum name) {
    GLint value = -1;
    table().get_integerv(c, name, &value);
    return value;
  }
};

class ListTest : public StateTest {
 protected:
  ListTest() { recorded_draws.clear(); }
  Calls calls() { return {*context}; }
  // What `stream` makes the device draw, and the state it leaves behind.
  struct Outcome {
    std::vector<std::pair<GLenum, std::vector<raster::RecordedVertex>>> draws;
    Snapshot state;
    GLenum error;
    bool operator==(const Outcome&) const = default;
  };
  // Separate primitives count as one draw however they were parted.
  Outcome take_outcome() {
    op::flush(*context);
    Outcome outcome{{}, take_snapshot(*context), op::get_error(*context)};
    for (const auto& draw : recorded_draws) {
      const GLenum mode = GLenum(draw.primitive);
      const bool separate = mode == GL_POINTS || mode == GL_LINES || mode == GL_TRIANGLES || mode == GL_QUADS;
      auto& draws = outcome.draws;
      if (!separate || draws.empty() || draws.back().first != mode) draws.push_back({mode, {}});
      draws.back().second.insert(draws.back().second.end(), draw.vertices.begin(), draw.vertices.end());
    }
    recorded_draws.clear();
    return outcome;
  }
  void renew() {
    context = std::make_unique<Context>(VisualConfig{}, nullptr);
    make_current(context.get(), &drawable);
    recorded_draws.clear();
  }
  // `before` sets the state up, `stream` is called directly, from a list, and compiled and executed.
  void expect_same(const std::function<void(Calls)>& stream, const std::function<void(Calls)>& before = {}) {
    const auto start = [&] {
      renew();
      if (before) before(calls());
    };
    start();
    stream(calls());
    const Outcome direct = take_outcome();
    start();
    calls().new_list(1);
    stream(calls());
    calls().end_list();
    EXPECT_TRUE(recorded_draws.empty());
    calls().call_list(1);
    EXPECT_EQ(take_outcome(), direct) << "compiled";
    start();
    calls().new_list(1, GL_COMPILE_AND_EXECUTE);
    stream(calls());
    calls().end_list();
    EXPECT_EQ(take_outcome(), direct) << "compiled and executed";
  }
};

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

void draw_shape(Calls gl, GLenum mode, int vertices) {
  gl.begin(mode);
  for (int i = 0; i < vertices; ++i) {
    gl.color(float(i) / 16, 0.5f);
    gl.tex_coord(float(i), 2);
    gl.vertex(float(i), float(i * i % 7), float(i % 3));
  }
  gl.end();
}

TEST_F(ListTest, DrawsWhatItsCallsDraw) {
  for (GLenum mode = GL_POINTS; mode <= GL_POLYGON; ++mode) {
    SCOPED_TRACE(mode);
    for (int vertices : {0, 1, 2, 3, 4, 7, 12, 25}) {
      expect_same([=](Calls gl) { draw_shape(gl, mode, vertices); });
      expect_same([=](Calls gl) { draw_shape(gl, mode, vertices); },
                  [](Calls gl) { gl.enable(GL_TEXTURE_2D); });
    }
  }
}

TEST_F(ListTest, NeighboursBecomeOneBatch) {
  Calls gl = calls();
  gl.new_list(1);
  for (int i = 0; i < 5; ++i) {
    gl.color(float(i));
    draw_shape(gl, GL_TRIANGLES, 7);
  }
  gl.end_list();
  gl.call_list(1);
  ASSERT_EQ(recorded_draws.size(), 1u);
  EXPECT_EQ(recorded_draws[0].vertices.size(), 30u);
  const void* first = recorded_draws[0].position_data;
  gl.call_list(1);
  EXPECT_EQ(recorded_draws[1].position_data, first);  // the list's own memory
}

TEST_F(ListTest, StateBetweenPairsPartsThem) {
  expect_same([](Calls gl) {
    draw_shape(gl, GL_QUADS, 4);
    gl.enable(GL_BLEND);
    draw_shape(gl, GL_QUADS, 4);
    gl.material(GL_SHININESS, {7});
    draw_shape(gl, GL_QUADS, 4);
    draw_shape(gl, GL_TRIANGLES, 3);
  });
}

TEST_F(ListTest, CurrentValuesComeFromTheCallWhereTheListHasNone) {
  const auto textured_red = [](Calls gl) {
    gl.enable(GL_TEXTURE_2D);
    gl.color(1, 0.5f, 0.25f, 0.125f);
    gl.tex_coord(3, 4, 5, 6);
    gl.edge_flag(false);
  };
  const auto plain = [](Calls gl) {
    gl.begin(GL_TRIANGLES);
    for (int i = 0; i < 6; ++i) gl.vertex(float(i));
    gl.end();
  };
  const auto from_the_third = [](Calls gl) {
    gl.begin(GL_TRIANGLES);
    for (int i = 0; i < 6; ++i) {
      if (i == 3) gl.color(0, 0.75f);
      if (i == 4) gl.tex_coord(8);
      gl.vertex(float(i));
    }
    gl.end();
  };
  expect_same(plain, textured_red);
  expect_same(from_the_third, textured_red);
  expect_same([&](Calls gl) { plain(gl), from_the_third(gl), plain(gl); }, textured_red);
}

TEST_F(ListTest, LastValuesStand) {
  expect_same([](Calls gl) {
    gl.color(0.5f);
    gl.begin(GL_LINES);
    gl.vertex(1);
    gl.normal(0, 1);
    gl.vertex(2);
    gl.tex_coord(1, 2, 3, 4);
    gl.edge_flag(false);
    gl.table().index(gl.c, 9);
    gl.end();
    gl.color(0.75f);
  });
}

TEST_F(ListTest, MaterialsBetweenBeginAndEnd) {
  expect_same([](Calls gl) {
    draw_shape(gl, GL_TRIANGLES, 3);
    gl.begin(GL_TRIANGLES);
    gl.material(GL_AMBIENT, {0.1f, 0.2f, 0.3f, 0.4f});
    for (int i = 0; i < 6; ++i) {
      if (i == 3) gl.material(GL_DIFFUSE, {0.5f, 0.6f, 0.7f, 0.8f});
      gl.vertex(float(i));
    }
    gl.material(GL_SHININESS, {12});
    gl.end();
    draw_shape(gl, GL_TRIANGLES, 3);
  });
}

TEST_F(ListTest, WhatIsForbiddenBetweenBeginAndEndIsRefusedLater) {
  const auto forbidden = [](Calls gl) {
    draw_shape(gl, GL_TRIANGLES, 3);
    gl.begin(GL_TRIANGLES);
    gl.color(0.5f);
    gl.vertex(1);
    gl.enable(GL_BLEND);
    gl.vertex(2);
    gl.color(0.25f);
    gl.vertex(3);
    gl.begin(GL_POINTS);
    gl.end();
    gl.end();
  };
  expect_same(forbidden);
  EXPECT_FALSE(context->color_buffer.blend);
  expect_same([](Calls gl) { gl.begin(GL_POLYGON + 1); });
  expect_same([](Calls gl) { gl.end(); });
  expect_same([](Calls gl) { gl.table().draw_arrays(gl.c, GL_POINTS, -1, 3); });
  expect_same([](Calls gl) { gl.table().draw_elements(gl.c, GL_POINTS, 3, GL_FLOAT, nullptr); });
}

TEST_F(ListTest, BeginAndEndInDifferentLists) {
  Calls gl = calls();
  gl.new_list(1);
  draw_shape(gl, GL_TRIANGLES, 3);
  gl.begin(GL_TRIANGLES);
  gl.color(0.5f);
  gl.vertex(1);
  gl.end_list();
  gl.new_list(2);
  gl.vertex(2);
  gl.color(0.25f);
  gl.end_list();
  gl.new_list(3);
  gl.vertex(3);
  gl.end();
  draw_shape(gl, GL_TRIANGLES, 3);
  gl.end_list();
  recorded_draws.clear();
  for (GLuint name : {1u, 2u, 3u}) gl.call_list(name);
  const Outcome listed = take_outcome();
  draw_shape(gl, GL_TRIANGLES, 3);
  gl.begin(GL_TRIANGLES);
  gl.color(0.5f);
  gl.vertex(1);
  gl.vertex(2);
  gl.color(0.25f);
  gl.vertex(3);
  gl.end();
  draw_shape(gl, GL_TRIANGLES, 3);
  EXPECT_EQ(listed, take_outcome());
  EXPECT_EQ(current_binding.table, &kExecuteTable);
}

TEST_F(ListTest, AListCalledBetweenBeginAndEnd) {
  Calls gl = calls();
  gl.new_list(1);
  gl.color(0.5f, 0.25f);
  gl.vertex(1);
  gl.vertex(2);
  gl.end_list();
  gl.new_list(2);
  draw_shape(gl, GL_TRIANGLES, 3);  // its Begin is an error there, and its End ends the other
  gl.end_list();
  gl.begin(GL_LINE_STRIP);
  gl.vertex(0);
  gl.call_list(1);
  gl.call_list(2);
  ASSERT_EQ(recorded_draws.size(), 1u);
  EXPECT_EQ(recorded_draws[0].vertices.size(), 6u);
  EXPECT_EQ(recorded_draws[0].vertices[2].color[1], 0.25f);
  EXPECT_EQ(gl.error(), GLenum(GL_INVALID_OPERATION));
  EXPECT_EQ(current_binding.table, &kExecuteTable);
}

TEST_F(ListTest, ListsCalledWithinACompiledPair) {
  const auto attributes = [](Calls gl) {
    gl.new_list(9);
    gl.color(0.125f);
    gl.vertex(7);
    gl.end_list();
  };
  expect_same(
      [](Calls gl) {
        gl.begin(GL_LINE_STRIP);
        gl.vertex(0);
        gl.call_list(9);
        gl.vertex(1);
        gl.end();
      },
      attributes);
}

TEST_F(ListTest, ArraysAreReadWhenTheListIsCompiled) {
  std::vector<float> positions = {0, 0, 1, 0, 1, 1, 0, 1, 5, 5, 6, 6};
  std::vector<GLubyte> colors = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 0, 1, 2, 3, 4, 5, 6};
  const std::vector<float> first_positions = positions;
  const GLushort indices[] = {2, 0, 1, 5, 4, 3};
  const auto arrays = [&](Calls gl) {
    positions = first_positions;
    gl.table().vertex_pointer(gl.c, 2, GL_FLOAT, 0, positions.data());
    gl.table().color_pointer(gl.c, 3, GL_UNSIGNED_BYTE, 0, colors.data());
    gl.table().enable_client_state(gl.c, GL_VERTEX_ARRAY);
    gl.table().enable_client_state(gl.c, GL_COLOR_ARRAY);
    gl.tex_coord(1, 2);
    gl.enable(GL_TEXTURE_2D);
  };
  expect_same([&](Calls gl) { gl.table().draw_arrays(gl.c, GL_TRIANGLES, 0, 6); }, arrays);
  expect_same([&](Calls gl) { gl.table().draw_arrays(gl.c, GL_QUAD_STRIP, 1, 4); }, arrays);
  expect_same([&](Calls gl) { gl.table().draw_elements(gl.c, GL_TRIANGLES, 6, GL_UNSIGNED_SHORT, indices); },
              arrays);
  expect_same(
      [&](Calls gl) {
        gl.begin(GL_POLYGON);
        for (int i : {3, 1, 4, 0}) gl.table().array_element(gl.c, i);
        gl.end();
      },
      arrays);
  renew();
  arrays(calls());
  calls().new_list(1);
  calls().table().draw_arrays(*context, GL_TRIANGLES, 0, 6);
  calls().end_list();
  std::fill(positions.begin(), positions.end(), 100.0f);
  calls().call_list(1);
  EXPECT_EQ(recorded_draws.back().vertices[2].position[0], 1.0f);
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
  for (GLenum name : {GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS}) gl.table().pixel_storei(*context, name, 0);
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
