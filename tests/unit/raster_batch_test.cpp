// What a batch keeps: one program for all draws that need the same, and no more draws than the cache holds.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "raster/batch.h"
#include "raster/primitive/window_box.h"
#include "raster/recycled.h"
#include "raster/surface/framebuffer.h"
#include "raster/tile/tile_worker.h"

namespace {

using namespace halfspace::raster;

class BatchTest : public testing::Test {
 protected:
  const PipelineProgram* program(const DrawState& state, const VertexLayout& layout = {},
                                 ColorFormat format = ColorFormat::rgba8) {
    return &batch.program_for(std::make_shared<const DrawState>(state), layout, format, true).program;
  }
  static std::shared_ptr<const TextureView> one_texel(uint8_t level) {
    Texture texture;
    const uint8_t texel[4] = {level, level, level, 255};
    texture.define_level(0, 1, 1, 0, BaseFormat::rgba, texel, sizeof texel);
    return texture.view({}, 1);
  }
  Batch batch;
};

const std::pair<const char*, std::function<void(DrawState&)>> kForFragments[] = {
    {"shading", [](DrawState& s) { s.raster.flat_shading = true; }},
    {"stipple", [](DrawState& s) { s.polygon.stipple = true; }},
    {"fog", [](DrawState& s) { s.fog.enabled = true; }},
    {"fog's colour", [](DrawState& s) { s.fog.color.g = 0.5f; }},
    {"stencil", [](DrawState& s) { s.stencil.test = true; }},
    {"stencil's reference", [](DrawState& s) { s.stencil.reference = 3; }},
    {"depth", [](DrawState& s) { s.depth.test = true; }},
    {"alpha test", [](DrawState& s) { s.alpha_test.reference = 0.25f; }},
    {"blending", [](DrawState& s) { s.blend.enabled = true; }},
    {"logical operation", [](DrawState& s) { s.logic_op.enabled = true; }},
    {"colour mask", [](DrawState& s) { s.color_mask.b = false; }},
    {"targets", [](DrawState& s) { s.color_targets = kFrontPlane; }},
    {"environment", [](DrawState& s) { s.texture.env = EnvMode::decal; }},
    {"environment's colour", [](DrawState& s) { s.texture.env_color.r = 0.75f; }},
    {"accuracy", [](DrawState& s) { s.accuracy.filter = Level::draft; }},
};

TEST_F(BatchTest, WhatFragmentsMeetMakesAProgram) {
  std::set<const PipelineProgram*> programs{program({})};
  for (const auto& [name, change] : kForFragments) {
    DrawState state;
    change(state);
    EXPECT_TRUE(programs.insert(program(state)).second) << name;
    EXPECT_EQ(programs.count(program(state)), 1u) << name << ": looked up again";
  }
  DrawState textured;
  for (const uint8_t level : {uint8_t{1}, uint8_t{2}}) {
    textured.texture.view = one_texel(level);
    EXPECT_TRUE(programs.insert(program(textured)).second) << "texture " << int{level};
  }
  // Which the number of all the rest does not stand for.
  textured.rest_version = 1;
  EXPECT_TRUE(programs.count(program(textured)) == 1);
  textured.texture.env = EnvMode::decal;
  EXPECT_TRUE(programs.insert(program(textured)).second);
  textured.texture.env_color.r = 0.75f;
  EXPECT_TRUE(programs.insert(program(textured)).second);
  textured.texture.view = one_texel(3);
  EXPECT_TRUE(programs.insert(program(textured)).second);
}

TEST_F(BatchTest, WhatTheVertexStageHasDoneWithMakesNone) {
  DrawState state;
  state.texture.view = one_texel(7);
  const PipelineProgram* first = program(state);
  state.clip_from_object[12] = 0.5;
  state.eye_from_object[5] = 2;
  state.texture.matrix[0] = 3;
  state.lighting.enabled = true;
  state.viewport.width = 40;
  state.raster.cull_back = true;
  EXPECT_EQ(program(state), first);
}

TEST_F(BatchTest, StatesThatDifferInTheirMatricesAreNotKept) {
  const auto made = [](uint64_t rest_version, double scale) {
    auto state = std::make_shared<DrawState>();
    state->rest_version = rest_version;
    state->clip_from_object[0] = scale;
    return std::shared_ptr<const DrawState>(std::move(state));
  };
  const auto first = made(3, 1), second = made(3, 2), another = made(4, 1), unknown = made(0, 1);
  const DrawProgram& found = batch.program_for(first, {}, ColorFormat::rgba8, true);
  for (const auto& state : {first, second, another, unknown})
    ASSERT_EQ(&batch.program_for(state, {}, ColorFormat::rgba8, true), &found);
  EXPECT_EQ(found.state_after_vertices(first), first);
  EXPECT_EQ(found.state_after_vertices(second), first);
  EXPECT_EQ(found.state_after_vertices(another), another) << "it may have another viewport";
  EXPECT_EQ(found.state_after_vertices(unknown), unknown);
}

TEST_F(BatchTest, LayoutAndFormatCountToo) {
  VertexLayout colored;
  colored.color = 0, colored.attribute_count = 4;
  VertexLayout red;
  red.constant_color = {1, 0, 0, 1};
  const std::set<const PipelineProgram*> programs{program({}), program({}, colored), program({}, red),
                                                  program({}, {}, ColorFormat::rgba32f)};
  EXPECT_EQ(programs.size(), 4u);
}

TEST_F(BatchTest, ManySmallDrawsFillIt) {
  int draws = 0;
  for (; !batch.is_full(1, 1) && draws < 100000; ++draws) batch.draws.emplace_back();
  EXPECT_GE(draws, 16);
  EXPECT_LE(draws, 1024) << "several kilobytes each";
}

// How many primitives of a kind fill a batch, dealt to so many tiles in turn, `run` of them to one before the
// next.
size_t primitives_to_fill(PrimitiveKind kind, int tiles, int run = 1) {
  const Framebuffer::Impl framebuffer(16 * kTileSize, 16 * kTileSize, ColorFormat::rgba8, 1);
  Batch batch;
  Segment& segment = batch.open_segment(framebuffer);
  const PrimitiveRef one{{0, 1, 2}, kind, false, false, 0};
  for (uint32_t i = 0; !batch.is_full(1, 1) && i < 1000000; ++i) {
    segment.primitives.push_back(one);
    const int tile = static_cast<int>(i) / run % tiles;
    push_to_bin(segment, tile % 16, tile / 16, i);
  }
  return segment.primitives.size();
}

TEST_F(BatchTest, TrianglesThatLieScatteredAreCollectedLonger) {
  const size_t dense = primitives_to_fill(PrimitiveKind::triangle, 4);
  EXPECT_LE(dense, 16384u) << "their vertices are to stay in the cache";
  EXPECT_GE(primitives_to_fill(PrimitiveKind::triangle, 256), 4 * dense);
  EXPECT_LE(primitives_to_fill(PrimitiveKind::triangle, 256), 16 * dense) << "memory is bounded";
  EXPECT_EQ(primitives_to_fill(PrimitiveKind::line, 256), dense);
}

TEST_F(BatchTest, TrianglesThatGoOnToOtherTilesAreNot) {
  const size_t dense = primitives_to_fill(PrimitiveKind::triangle, 4);
  EXPECT_LE(primitives_to_fill(PrimitiveKind::triangle, 256, 128), 2 * dense)
      << "no tile is visited once less";
}

TEST_F(BatchTest, AWorkersTilesFollowEachOther) {
  const Framebuffer::Impl framebuffer(4 * kTileSize, 4 * kTileSize, ColorFormat::rgba8, 1);
  batch.deal_tiles(framebuffer, true, 3);
  ASSERT_EQ(batch.tiles.size(), 16u);
  uint32_t begin = 0;
  for (const uint32_t end : batch.ends) {
    for (uint32_t i = begin; i + 1 < end; ++i) EXPECT_EQ(batch.tile_after(i), batch.tiles[i + 1]);
    EXPECT_EQ(batch.tile_after(end - 1), kNoTile) << "the next one is another worker's";
    begin = end;
  }
}

TEST(RecycledTest, ObjectsStayInPlaceAndComeBackFresh) {
  const auto held = std::make_shared<int>(5);
  Recycled<std::shared_ptr<int>> list;
  auto* const first = &list.emplace_back();
  *first = held;
  for (int i = 0; i < 100; ++i) list.emplace_back();
  EXPECT_EQ(&list[0], first);
  EXPECT_EQ(list.size(), 101u);
  list.clear();
  EXPECT_TRUE(list.empty());
  EXPECT_EQ(held.use_count(), 1) << "what it held is let go";
  EXPECT_EQ(&list.emplace_back(), first);
  EXPECT_EQ(*first, nullptr);
}

}  // namespace
