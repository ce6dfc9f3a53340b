// What Begin/End hands to the device: attributes, batching, and that a primitive too long for one batch is
// drawn in parts that together are the whole.
#include <cmath>

#include "recording_device.h"
#include "state_fixture.h"

namespace halfspace::state {
namespace {

using raster::recorded_draws;
using raster::RecordedDraw;
using raster::RecordedVertex;

using Corner = RecordedVertex;
using Shape = std::vector<Corner>;

// Triangles may start at any corner (the orientation is the order's); lines and quads are taken as they come.
Shape turned(Shape shape) {
  const auto lowest = std::min_element(
      shape.begin(), shape.end(), [](const Corner& a, const Corner& b) { return a.position < b.position; });
  std::rotate(shape.begin(), lowest, shape.end());
  return shape;
}

// Spec 2.6.1: the points, segments, triangles and quads a primitive stands for, provoking vertex last in
// `shapes`' second half of the pair.
std::vector<std::pair<Shape, Corner>> decompose(GLenum mode, const std::vector<Corner>& v) {
  std::vector<std::pair<Shape, Corner>> shapes;
  const auto add = [&](Shape shape, const Corner& provoking) {
    shapes.emplace_back(shape.size() > 2 ? turned(std::move(shape)) : std::move(shape), provoking);
  };
  const size_t n = v.size();
  switch (mode) {
    case GL_POINTS:
      for (size_t i = 0; i < n; ++i) add({v[i]}, v[i]);
      break;
    case GL_LINES:
      for (size_t i = 0; i + 1 < n; i += 2) add({v[i], v[i + 1]}, v[i + 1]);
      break;
    case GL_LINE_STRIP:
    case GL_LINE_LOOP:
      for (size_t i = 0; i + 1 < n; ++i) add({v[i], v[i + 1]}, v[i + 1]);
      if (mode == GL_LINE_LOOP) add({v[n - 1], v[0]}, v[0]);
      break;
    case GL_TRIANGLES:
      for (size_t i = 0; i + 2 < n; i += 3) add({v[i], v[i + 1], v[i + 2]}, v[i + 2]);
      break;
    case GL_TRIANGLE_STRIP:
      for (size_t i = 0; i + 2 < n; ++i) {
        add(i % 2 ? Shape{v[i + 1], v[i], v[i + 2]} : Shape{v[i], v[i + 1], v[i + 2]}, v[i + 2]);
      }
      break;
    case GL_TRIANGLE_FAN:
      for (size_t i = 1; i + 1 < n; ++i) add({v[0], v[i], v[i + 1]}, v[i + 1]);
      break;
    case GL_POLYGON:
      for (size_t i = 1; i + 1 < n; ++i) add({v[0], v[i], v[i + 1]}, v[0]);
      break;
    case GL_QUADS:
      for (size_t i = 0; i + 3 < n; i += 4) add({v[i], v[i + 1], v[i + 2], v[i + 3]}, v[i + 3]);
      break;
    case GL_QUAD_STRIP:
      for (size_t i = 0; i + 3 < n; i += 2) add({v[i], v[i + 1], v[i + 3], v[i + 2]}, v[i + 3]);
      break;
  }
  return shapes;
}

std::vector<std::pair<Shape, Corner>> decompose_recorded() {
  std::vector<std::pair<Shape, Corner>> all;
  for (const RecordedDraw& draw : recorded_draws) {
    const auto part = decompose(GLenum(draw.primitive), draw.vertices);
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

class ImmediateTest : public StateTest {
 protected:
  ImmediateTest() { recorded_draws.clear(); }
  // The drawing of separate primitives waits for its neighbours; a flush ends the wait.
  void end() {
    op::end(*context);
    op::flush(*context);
  }
  void rect(float x1, float y1, float x2, float y2) {
    op::rect(*context, x1, y1, x2, y2);
    op::flush(*context);
  }
  // One point, line ... at x; draws nothing yet.
  void add(GLenum mode, uint32_t vertices, float x) {
    op::begin(*context, mode);
    for (uint32_t i = 0; i < vertices; ++i) op::vertex(*context, x, float(i), 0, 1);
    op::end(*context);
  }
  static std::vector<size_t> batch_sizes() {
    std::vector<size_t> sizes;
    for (const RecordedDraw& draw : recorded_draws) sizes.push_back(draw.vertices.size());
    return sizes;
  }
  void feed(const std::vector<Corner>& corners) {
    for (const Corner& c : corners) {
      op::color(*context, c.color[0], c.color[1], c.color[2], c.color[3]);
      op::tex_coord(*context, c.tex_coord[0], c.tex_coord[1], c.tex_coord[2], c.tex_coord[3]);
      op::vertex(*context, c.position[0], c.position[1], c.position[2], c.position[3]);
    }
  }
  static std::vector<Corner> numbered(size_t count) {
    std::vector<Corner> corners(count);
    for (size_t i = 0; i < count; ++i) {
      const float f = float(i);
      corners[i] = {{f, f + 0.25f, f + 0.5f, 1}, {f, 0.5f, -f, 1}, {-f, f, 0, 1}};
    }
    return corners;
  }
};

TEST_F(ImmediateTest, EveryModeArrivesAsGiven) {
  op::enable(*context, GL_TEXTURE_2D);
  const auto corners = numbered(13);
  for (GLenum mode = GL_POINTS; mode <= GL_POLYGON; ++mode) {
    recorded_draws.clear();
    op::begin(*context, mode);
    feed(corners);
    end();
    ASSERT_EQ(recorded_draws.size(), 1u);
    EXPECT_EQ(GLenum(recorded_draws[0].primitive), mode);
    // Of separate primitives only whole ones arrive.
    const size_t n = mode == GL_LINES ? 2 : mode == GL_TRIANGLES ? 3 : mode == GL_QUADS ? 4 : 1;
    EXPECT_EQ(recorded_draws[0].vertices,
              std::vector<Corner>(corners.begin(), corners.begin() + ptrdiff_t(corners.size() / n * n)));
    EXPECT_EQ(recorded_draws[0].target, &drawable.framebuffer(0));
  }
}

TEST_F(ImmediateTest, LongPrimitivesPartWithoutASeam) {
  op::enable(*context, GL_TEXTURE_2D);
  for (size_t count : {size_t{kMaxBatchVertices}, size_t{kMaxBatchVertices} + 4,
                       size_t{kMaxBatchVertices} * 2 - 1, size_t{kMaxBatchVertices} * 2 + 7}) {
    const auto corners = numbered(count);
    for (GLenum mode = GL_POINTS; mode <= GL_POLYGON; ++mode) {
      recorded_draws.clear();
      op::begin(*context, mode);
      feed(corners);
      end();
      for (const RecordedDraw& draw : recorded_draws) EXPECT_LE(draw.batch_count, kMaxBatchVertices);
      EXPECT_EQ(recorded_draws.size() > 1, count > kMaxBatchVertices) << mode;
      EXPECT_TRUE(decompose_recorded() == decompose(mode, corners)) << "mode " << mode << ", " << count;
    }
  }
}

TEST_F(ImmediateTest, AColourThatNeverChangesIsConstant) {
  op::color(*context, 0.25f, 0.5f, 0.75f, 1);
  op::begin(*context, GL_TRIANGLES);
  op::color(*context, 1, 0.5f, 0, 1);  // before the first vertex
  for (int i = 0; i < 3; ++i) {
    op::vertex(*context, float(i), 0, 0, 1);
  }
  end();
  ASSERT_EQ(recorded_draws.size(), 1u);
  EXPECT_TRUE(recorded_draws[0].constant_color);
  EXPECT_FALSE(recorded_draws[0].has_tex_coord);
  for (const auto& v : recorded_draws[0].vertices) EXPECT_EQ(v.color, (std::array<float, 4>{1, 0.5f, 0, 1}));

  op::begin(*context, GL_LINES);
  op::vertex(*context, 0, 0, 0, 1);
  op::color(*context, 0, 0, 0, 1);
  op::vertex(*context, 1, 0, 0, 1);
  end();
  EXPECT_FALSE(recorded_draws[1].constant_color);
  EXPECT_EQ(recorded_draws[1].vertices[0].color, (std::array<float, 4>{1, 0.5f, 0, 1}));
  EXPECT_EQ(recorded_draws[1].vertices[1].color, (std::array<float, 4>{0, 0, 0, 1}));
  op::begin(*context, GL_POINTS);  // what the last batch did is forgotten
  op::vertex(*context, 0, 0, 0, 1);
  end();
  EXPECT_TRUE(recorded_draws[2].constant_color);
  // The current colour outlives End.
  EXPECT_EQ(context->current.color[0], 0);
}

void set_shininess(Context& context, float shininess) {
  op::material(context, GL_FRONT_AND_BACK, GL_SHININESS, &shininess);
}

TEST_F(ImmediateTest, NormalsComeWithLighting) {
  for (bool textured : {false, true}) {
    recorded_draws.clear();
    (textured ? op::enable : op::disable)(*context, GL_TEXTURE_2D);
    op::enable(*context, GL_LIGHTING);
    op::tex_coord(*context, 5, 6, 7, 8);
    op::begin(*context, GL_TRIANGLES);
    for (int i = 0; i < 3; ++i) {
      op::normal(*context, float(i), 2, -3);
      op::color(*context, 0, float(i), 0, 1);
      op::vertex(*context, float(i), 1, 0, 1);
    }
    end();
    op::disable(*context, GL_LIGHTING);
    rect(0, 0, 1, 1);
    ASSERT_EQ(recorded_draws.size(), 2u);
    EXPECT_TRUE(recorded_draws[0].has_normal);
    EXPECT_EQ(recorded_draws[0].has_tex_coord, textured);
    EXPECT_FALSE(recorded_draws[1].has_normal);
    for (size_t i = 0; i < 3; ++i) {
      const Corner& v = recorded_draws[0].vertices[i];
      EXPECT_EQ(v.normal, (std::array<float, 4>{float(i), 2, -3, 1}));
      EXPECT_EQ(v.color, (std::array<float, 4>{0, float(i), 0, 1}));
      EXPECT_EQ(v.tex_coord,
                textured ? (std::array<float, 4>{5, 6, 7, 8}) : (std::array<float, 4>{0, 0, 0, 1}));
    }
  }
}

TEST_F(ImmediateTest, EdgeFlagsComeWithPolygonModes) {
  for (GLenum mode = GL_POINTS; mode <= GL_POLYGON; ++mode) {
    recorded_draws.clear();
    op::polygon_mode(*context, GL_BACK, GL_LINE);
    op::begin(*context, mode);
    for (int i = 0; i < 12; ++i) {
      op::edge_flag(*context, i % 3 == 1);
      op::vertex(*context, float(i), 1, 0, 1);
    }
    end();
    ASSERT_EQ(recorded_draws.size(), 1u);
    const bool counts = mode == GL_TRIANGLES || mode == GL_QUADS || mode == GL_POLYGON;
    EXPECT_EQ(recorded_draws[0].has_edge_flags, counts) << mode;
    for (size_t i = 0; i < 12; ++i) EXPECT_EQ(recorded_draws[0].vertices[i].edge_flag, !counts || i % 3 == 1);
    op::polygon_mode(*context, GL_BACK, GL_FILL);
    rect(0, 0, 1, 1);
    EXPECT_FALSE(recorded_draws[1].has_edge_flags);
  }
}

// Its facing and its offset are the whole's (spec 3.5.1, 3.5.5), and its edges.
TEST_F(ImmediateTest, APolygonThatIsNotFilledIsNeverParted) {
  const size_t count = kMaxBatchVertices * 5 + 1000;
  const auto draw = [&](GLenum mode) {
    recorded_draws.clear();
    op::begin(*context, mode);
    for (size_t i = 0; i < count; ++i) {
      op::edge_flag(*context, i % 3 == 1);
      op::vertex(*context, float(i), 1, 0, 1);
    }
    end();
  };
  op::polygon_mode(*context, GL_FRONT, GL_LINE);
  draw(GL_POLYGON);
  ASSERT_EQ(recorded_draws.size(), 1u);
  ASSERT_EQ(recorded_draws[0].vertices.size(), count);
  for (size_t i = 0; i < count; ++i) {
    ASSERT_EQ(recorded_draws[0].vertices[i].position[0], float(i));
    ASSERT_EQ(recorded_draws[0].vertices[i].edge_flag, i % 3 == 1);
  }
  // The buffer is long now; batches are not.
  draw(GL_QUADS);
  std::vector<size_t> expected(5, kMaxBatchVertices);
  expected.push_back(1000);
  EXPECT_EQ(batch_sizes(), expected);
}

TEST_F(ImmediateTest, MaterialsSetBetweenBeginAndEndBelongToTheVerticesAfter) {
  op::enable(*context, GL_LIGHTING);
  set_shininess(*context, 1);
  op::begin(*context, GL_TRIANGLES);
  for (int i = 0; i < 6; ++i) {
    if (i >= 2) set_shininess(*context, 100);  // replaced before any vertex has it
    if (i >= 2) set_shininess(*context, float(2 + i / 2));
    op::vertex(*context, float(i), 0, 0, 1);
  }
  end();
  rect(0, 0, 1, 1);
  ASSERT_EQ(recorded_draws.size(), 2u);
  const float expected[] = {1, 1, 3, 3, 4, 4};
  for (size_t i = 0; i < 6; ++i) EXPECT_EQ(recorded_draws[0].vertices[i].material.shininess, expected[i]);
  EXPECT_EQ(recorded_draws[1].vertices[0].material.shininess, 4);
}

TEST_F(ImmediateTest, MaterialsOutliveTheParting) {
  op::enable(*context, GL_LIGHTING);
  const size_t count = kMaxBatchVertices * 2 + 7;
  std::vector<Corner> corners(count);
  for (size_t i = 0; i < count; ++i) {
    corners[i].position = {float(i), 0, 0, 1};
    corners[i].color = {1, 1, 1, 1};
    corners[i].tex_coord = {0, 0, 0, 1};
    corners[i].material.shininess = float(i % 100);
  }
  for (GLenum mode = GL_POINTS; mode <= GL_POLYGON; ++mode) {
    recorded_draws.clear();
    set_shininess(*context, 128);
    op::begin(*context, mode);
    for (const Corner& c : corners) {
      set_shininess(*context, c.material.shininess);
      op::vertex(*context, c.position[0], 0, 0, 1);
    }
    end();
    EXPECT_GT(recorded_draws.size(), 1u);
    for (size_t i = 0; i < recorded_draws.size(); ++i) {
      EXPECT_EQ(recorded_draws[i].continues, i > 0 && (mode == GL_LINE_STRIP || mode == GL_LINE_LOOP));
    }
    EXPECT_TRUE(decompose_recorded() == decompose(mode, corners)) << mode;
  }
}

TEST_F(ImmediateTest, NothingIsDrawnWithoutVerticesOrOutside) {
  op::begin(*context, GL_TRIANGLES);
  end();
  op::vertex(*context, 0, 0, 0, 1);
  op::begin(*context, GL_POINTS);
  op::vertex(*context, 5, 0, 0, 1);
  end();
  ASSERT_EQ(recorded_draws.size(), 1u);
  EXPECT_EQ(recorded_draws[0].vertices.size(), 1u);
}

TEST_F(ImmediateTest, RectIsAQuadCounterClockwise) {
  rect(1, 2, 3, 4);
  ASSERT_EQ(recorded_draws.size(), 1u);
  const auto& v = recorded_draws[0].vertices;
  ASSERT_EQ(v.size(), 4u);
  const std::array<float, 4> expected[] = {{1, 2, 0, 1}, {3, 2, 0, 1}, {3, 4, 0, 1}, {1, 4, 0, 1}};
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(v[i].position, expected[i]);
  EXPECT_EQ(current_binding.table, &kExecuteTable);
}

TEST_F(ImmediateTest, NeighbouringPairsAreOneBatch) {
  using Sizes = std::vector<size_t>;
  for (auto [mode, n] : {std::pair{GL_POINTS, 1u}, {GL_LINES, 2u}, {GL_TRIANGLES, 3u}, {GL_QUADS, 4u}}) {
    recorded_draws.clear();
    for (int i = 0; i < 3; ++i) add(GLenum(mode), 2 * n + n - 1, float(i));  // the last one unfinished
    EXPECT_TRUE(recorded_draws.empty());
    op::flush(*context);
    const size_t each = mode == GL_POINTS ? 2 : 2 * n;
    ASSERT_EQ(batch_sizes(), Sizes{3 * each}) << mode;
    for (size_t i = 0; i < 3 * each; ++i)
      EXPECT_EQ(recorded_draws[0].vertices[i].position[0], float(i / each));
  }
  // Strips and their like do not wait.
  recorded_draws.clear();
  add(GL_TRIANGLE_STRIP, 3, 0);
  add(GL_TRIANGLE_STRIP, 4, 0);
  EXPECT_EQ(batch_sizes(), (Sizes{3, 4}));
}

TEST_F(ImmediateTest, WhatDiffersIsABatchOfItsOwnInOrder) {
  using Sizes = std::vector<size_t>;
  add(GL_TRIANGLES, 3, 0);
  add(GL_QUADS, 4, 1);  // another mode
  op::enable(*context, GL_BLEND);
  add(GL_QUADS, 8, 2);  // another state
  op::enable(*context, GL_TEXTURE_2D);
  add(GL_QUADS, 12, 3);  // another vertex
  add(GL_LINE_STRIP, 2, 4);
  const float point[] = {5, 0};
  add(GL_POINTS, 3, 5);
  op::vertex_pointer(*context, 2, GL_FLOAT, 0, point);
  op::enable_client_state(*context, GL_VERTEX_ARRAY);
  op::draw_arrays(*context, GL_POINTS, 0, 1);
  EXPECT_EQ(batch_sizes(), (Sizes{3, 4, 8, 12, 2, 3, 1}));
  for (size_t i = 0; i < 6; ++i) EXPECT_EQ(recorded_draws[i].vertices[0].position[0], float(i));
  EXPECT_FALSE(recorded_draws[1].state->blend.enabled);
  EXPECT_TRUE(recorded_draws[2].state->blend.enabled);
}

TEST_F(ImmediateTest, StateSetAfterEndDoesNotReachWhatWaits) {
  add(GL_TRIANGLES, 3, 0);
  op::enable(*context, GL_BLEND);
  op::draw_buffer(*context, GL_NONE);
  ASSERT_EQ(recorded_draws.size(), 1u);
  EXPECT_FALSE(recorded_draws[0].state->blend.enabled);
}

TEST_F(ImmediateTest, ColoursChangedBetweenPairsVary) {
  op::color(*context, 1, 0, 0, 1);
  add(GL_POINTS, 1, 0);
  op::color(*context, 0, 1, 0, 1);
  add(GL_POINTS, 1, 1);
  op::flush(*context);
  ASSERT_EQ(batch_sizes(), std::vector<size_t>{2});
  EXPECT_FALSE(recorded_draws[0].constant_color);
  EXPECT_EQ(recorded_draws[0].vertices[0].color, (std::array<float, 4>{1, 0, 0, 1}));
  EXPECT_EQ(recorded_draws[0].vertices[1].color, (std::array<float, 4>{0, 1, 0, 1}));
}

TEST_F(ImmediateTest, WaitingBatchesPartWithoutASeamToo) {
  op::enable(*context, GL_TEXTURE_2D);
  const size_t kPairs = kMaxBatchVertices / 3 + 100;
  for (size_t i = 0; i < kPairs; ++i) add(GL_TRIANGLES, 3, float(i));
  op::flush(*context);
  EXPECT_EQ(batch_sizes(), (std::vector<size_t>{kMaxBatchVertices, 300}));
  EXPECT_EQ(recorded_draws[1].vertices[0].position[0], float(kMaxBatchVertices / 3));
}

// A mesh of cells, each two triangles or a quad, as most programs give it: cell by cell.
std::vector<Corner> cells(size_t columns, size_t rows, GLenum mode) {
  const std::vector<std::pair<size_t, size_t>> kTriangles{{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
  const std::vector<std::pair<size_t, size_t>> kQuad{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  std::vector<Corner> corners;
  for (size_t row = 0; row < rows; ++row)
    for (size_t column = 0; column < columns; ++column)
      for (auto [x, y] : mode == GL_QUADS ? kQuad : kTriangles) {
        Corner corner;
        corner.position = {float(column + x), float(row + y), 0.5f, 1};
        corner.color = {float(column + x), 0, 0, 1};
        corner.tex_coord = {0, float(row + y), 0, 1};
        corners.push_back(corner);
      }
  return corners;
}

TEST_F(ImmediateTest, AMeshsVerticesArriveOnce) {
  op::enable(*context, GL_TEXTURE_2D);
  for (GLenum mode : {GLenum{GL_TRIANGLES}, GLenum{GL_QUADS}}) {
    recorded_draws.clear();
    const auto corners = cells(20, 10, mode);
    op::begin(*context, mode);
    feed(corners);
    end();
    ASSERT_EQ(recorded_draws.size(), 1u);
    EXPECT_EQ(recorded_draws[0].vertices, corners);
    // A few may be missed, whose hashes are others' too.
    EXPECT_GE(recorded_draws[0].batch_count, 21 * 11u);
    EXPECT_LE(recorded_draws[0].batch_count, 21 * 11u + 20);
  }
}

// Of a batch that goes on, and is parted, and whose pairs end with unfinished triangles.
TEST_F(ImmediateTest, AMeshInPiecesIsWhole) {
  op::enable(*context, GL_TEXTURE_2D);
  const auto corners = cells(300, 80, GL_TRIANGLES);
  ASSERT_GT(corners.size(), 2 * kMaxBatchVertices);
  for (size_t each : {size_t{12}, size_t{300}, corners.size()}) {
    recorded_draws.clear();
    for (size_t first = 0; first < corners.size(); first += each) {
      const size_t count = std::min(each, corners.size() - first);
      op::begin(*context, GL_TRIANGLES);
      feed({corners.begin() + ptrdiff_t(first), corners.begin() + ptrdiff_t(first + count)});
      feed({corners[0], corners[1]});
      op::end(*context);
    }
    op::flush(*context);
    EXPECT_GT(recorded_draws.size(), 2u);
    for (const RecordedDraw& draw : recorded_draws) {
      EXPECT_LE(draw.vertices.size(), kMaxBatchVertices);
      EXPECT_LE(draw.batch_count, draw.vertices.size() / 2);
    }
    EXPECT_TRUE(decompose_recorded() == decompose(GL_TRIANGLES, corners)) << each;
  }
}

// Of two vertices that differ in one number, or in its sign alone, each is drawn as it is.
TEST_F(ImmediateTest, VerticesThatDifferAreNotShared) {
  op::enable(*context, GL_TEXTURE_2D);
  op::enable(*context, GL_LIGHTING);
  op::begin(*context, GL_TRIANGLES);
  const auto corner = [&](int changed) {
    const auto number = [&](int i) { return i == changed ? -0.0f : 0.0f; };
    op::color(*context, number(4), number(5), number(6), number(7));
    op::tex_coord(*context, number(8), number(9), number(10), number(11));
    op::normal(*context, number(12), number(13), number(14));
    op::vertex(*context, number(0), number(1), number(2), number(3));
  };
  for (int changed = 0; changed < 15; ++changed)
    for (int i : {-1, changed, -1}) corner(i);
  end();
  ASSERT_EQ(recorded_draws.size(), 1u);
  EXPECT_GE(recorded_draws[0].batch_count, 16u);
  for (int changed = 0; changed < 15; ++changed) {
    const Corner& v = recorded_draws[0].vertices[size_t(3 * changed + 1)];
    for (int i = 0; i < 15; ++i) {
      const auto& quad = i < 4 ? v.position : i < 8 ? v.color : i < 12 ? v.tex_coord : v.normal;
      EXPECT_EQ(std::signbit(quad[size_t(i % 4)]), i == changed) << changed << ' ' << i;
    }
  }
}

TEST_F(ImmediateTest, VerticesOfSeveralMaterialsAreNotShared) {
  op::enable(*context, GL_LIGHTING);
  set_shininess(*context, 1);
  op::begin(*context, GL_TRIANGLES);
  for (int i = 0; i < 12; ++i) {
    if (i % 3 == 0 && i >= 6) set_shininess(*context, float(i));
    op::vertex(*context, float(i % 3), 0, 0, 1);
  }
  end();
  const float expected[] = {1, 1, 1, 1, 1, 1, 6, 6, 6, 9, 9, 9};
  ASSERT_EQ(recorded_draws.size(), 1u);
  EXPECT_EQ(recorded_draws[0].batch_count, 9u);
  for (size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(recorded_draws[0].vertices[i].position[0], float(i % 3));
    EXPECT_EQ(recorded_draws[0].vertices[i].material.shininess, expected[i]);
  }
}

// Where nothing comes again nobody looks for it, until some thousand vertices later.
TEST_F(ImmediateTest, VerticesAreSharedWhereThatPays) {
  const auto draw = [&](bool again) {
    recorded_draws.clear();
    op::begin(*context, GL_TRIANGLES);
    for (int i = 0; i < 3000; ++i) op::vertex(*context, float(again ? i % 3 : i), 0, 0, 1);
    end();
    return recorded_draws[0].batch_count;
  };
  EXPECT_EQ(draw(true), 3u);
  EXPECT_EQ(draw(false), 3000u);
  EXPECT_EQ(draw(true), 3000u);
  for (int i = 0; i < 6; ++i) draw(true);
  EXPECT_EQ(draw(true), 3u);
}

TEST_F(ImmediateTest, ReadingAndReleasingEndTheWait) {
  add(GL_POINTS, 1, 0);
  read_framebuffer(*context);
  EXPECT_EQ(recorded_draws.size(), 1u);
  add(GL_POINTS, 1, 0);
  op::clear(*context, GL_COLOR_BUFFER_BIT);
  EXPECT_EQ(recorded_draws.size(), 2u);
  add(GL_POINTS, 1, 0);
  make_current(nullptr, nullptr);
  EXPECT_EQ(recorded_draws.size(), 3u);
  EXPECT_EQ(recorded_draws[2].target, &drawable.framebuffer(0));
}

TEST_F(ImmediateTest, OutOfMemoryIsAnErrorAndTheNextDrawIsRight) {
  raster::fail_next_draw = true;
  rect(0, 0, 1, 1);
  EXPECT_EQ(op::get_error(*context), GLenum(GL_OUT_OF_MEMORY));
  EXPECT_TRUE(recorded_draws.empty());
  rect(0, 0, 1, 1);
  EXPECT_EQ(op::get_error(*context), GLenum(GL_NO_ERROR));
  EXPECT_EQ(recorded_draws.size(), 1u);
}

// Depth and stencil are still drawn (spec 4.2.1).
TEST_F(ImmediateTest, DrawBufferNoneDrawsNoColor) {
  rect(0, 0, 1, 1);
  op::draw_buffer(*context, GL_NONE);
  rect(0, 0, 1, 1);
  flush_vertices(*context);
  ASSERT_EQ(recorded_draws.size(), 2u);
  EXPECT_NE(recorded_draws[0].state->color_targets, 0);
  EXPECT_EQ(recorded_draws[1].state->color_targets, 0);
  EXPECT_EQ(op::get_error(*context), GLenum(GL_NO_ERROR));
}

// A draw keeps the state it was made with; unchanged state is not made again.
TEST_F(ImmediateTest, DrawStateIsMadeOnceAChange) {
  rect(0, 0, 1, 1);
  rect(0, 0, 1, 1);
  op::depth_func(*context, GL_GEQUAL);
  op::enable(*context, GL_CULL_FACE);
  op::cull_face(*context, GL_FRONT);
  op::shade_model(*context, GL_FLAT);
  rect(0, 0, 1, 1);
  ASSERT_EQ(recorded_draws.size(), 3u);
  EXPECT_EQ(recorded_draws[0].state, recorded_draws[1].state);
  const raster::DrawState &before = *recorded_draws[1].state, &after = *recorded_draws[2].state;
  EXPECT_EQ(before.depth.func, raster::CompareFunc::less);
  EXPECT_FALSE(before.raster.cull_front || before.raster.cull_back || before.raster.flat_shading);
  EXPECT_EQ(after.depth.func, raster::CompareFunc::greater_equal);
  EXPECT_TRUE(after.raster.cull_front && !after.raster.cull_back && after.raster.flat_shading);
}

}  // namespace
}  // namespace halfspace::state
