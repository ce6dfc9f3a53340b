// A list draws what its calls would have drawn, and leaves the same state behind.
#include "list_fixture.h"

namespace halfspace::state {
namespace {

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

// A mesh given triangle by triangle: a corner that comes again with the same attributes is one vertex.
TEST_F(ListTest, RepeatedVerticesAreStoredOnce) {
  const auto mesh = [](Calls to) {
    to.begin(GL_TRIANGLES);
    for (int i = 0; i < 12; ++i) {
      for (int corner : {i, i + 1, i + 2}) {
        to.color(float(corner) / 16);
        to.vertex(float(corner), float(corner % 2));
      }
    }
    to.end();
  };
  expect_same(mesh);
  renew();
  Calls gl = calls();
  gl.new_list(1);
  mesh(gl);
  gl.color(1);  // the same place in another colour is another vertex
  gl.begin(GL_TRIANGLES);
  for (int i = 0; i < 3; ++i) gl.vertex(float(i), float(i % 2));
  gl.end();
  gl.end_list();
  gl.call_list(1);
  ASSERT_EQ(recorded_draws.size(), 1u);
  EXPECT_EQ(recorded_draws[0].batch_count, 14u + 3u);
  EXPECT_EQ(recorded_draws[0].vertices.size(), 36u + 3u);
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

}  // namespace
}  // namespace halfspace::state
