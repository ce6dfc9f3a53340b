// The truth against the oracle and against a ray, and the judge against pictures with known faults.
#include "tests/differential/truth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/differential/scene_verdict.h"
#include "tests/oracle/texture.h"
#include "tests/oracle/triangle.h"
#include "tests/support/random.h"

namespace halfspace::differential {
namespace {

constexpr int kWidth = 48, kHeight = 40;

ref_app::Image noise_image(int width, int height) {
  test::Random random(7);
  ref_app::Image image{width, height, {}};
  for (int i = 0; i < width * height * 4; ++i)
    image.rgba.push_back(static_cast<uint8_t>(random.integer(0, 255)));
  return image;
}

ref_app::Geometry triangle(const glm::vec4 (&corner)[3]) {
  ref_app::Geometry geometry;
  const glm::vec4 colors[3] = {{1, 0.25F, 0, 1}, {0, 0.5F, 1, 0.75F}, {0.125F, 1, 0.5F, 0.5F}};
  for (uint32_t i = 0; i < 3; ++i) {
    geometry.vertices.push_back(
        {corner[i], colors[i], {static_cast<float>(i) * 1.5F, 2.0F - static_cast<float>(i)}});
    geometry.indices.push_back(i);
  }
  return geometry;
}

Recording recording_of(const ref_app::Geometry& geometry) {
  Recording recording;
  recording.width = kWidth, recording.height = kHeight;
  recording.draws.push_back({{}, geometry});
  return recording;
}

// The picture a perfect renderer leaves.
Drawn perfect(const Truth& truth) {
  Drawn drawn;
  drawn.picture = compare::Image(truth.width, truth.height);
  drawn.owner = truth.owner;
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      for (size_t k = 0; k < 4; ++k) {
        drawn.picture.at(x, truth.height - 1 - y)[k] =
            static_cast<float>(std::floor(truth.color[truth.index(x, y)][k] + 0.5));
      }
    }
  }
  return drawn;
}

TEST(Truth, UncutTrianglesAreTheOracles) {
  test::Random random(3);
  for (int round = 0; round < 60; ++round) {
    glm::vec4 corner[3];
    std::array<oracle::ClipPoint, 3> clip;
    for (size_t i = 0; i < 3; ++i) {
      const float w = random.real(0.5F, 3.5F);
      const auto within = [&] { return random.real(-1.5F, 1.5F) * w; };
      corner[i] = {within(), within(), random.real(-0.9F, 0.9F) * w, w};
      const auto wide = [](float v) { return static_cast<double>(v); };
      clip[i] = {wide(corner[i].x), wide(corner[i].y), wide(corner[i].z), wide(corner[i].w)};
    }
    const ref_app::Geometry geometry = triangle(corner);
    const Truth truth = true_picture(recording_of(geometry));
    const oracle::Triangle expected({0, 0, kWidth, kHeight, 0, 1}, clip);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const size_t at = truth.index(x, y);
        ASSERT_EQ(truth.owner[at], expected.covers(x, y) ? 1u : 0u) << round << ": " << x << ", " << y;
        if (truth.owner[at] == 0) continue;
        for (int k = 0; k < 4; ++k) {
          std::array<long double, 3> value;
          for (size_t i = 0; i < 3; ++i) value[i] = static_cast<long double>(geometry.vertices[i].color[k]);
          EXPECT_NEAR(truth.color[at][static_cast<size_t>(k)],
                      static_cast<double>(expected.attribute(value, x, y).value * 255), 1e-9);
        }
      }
    }
  }
}

// A floor that passes behind the eye: what it shows is where the ray through the pixel meets it.
TEST(Truth, ACutFloorIsWhereRaysMeetIt) {
  // Clip coordinates of (x, -1, -d) for an eye at the origin that looks along -z, near 0.1, far 10, 90
  // degrees.
  const auto floor_at = [](float x, float d) { return glm::vec4(x, -1.0F, (10.1F * d - 2.0F) / 9.9F, d); };
  const glm::vec4 corner[3] = {floor_at(-20, 8), floor_at(20, 8), floor_at(0, -6)};
  ref_app::Geometry geometry = triangle(corner);
  // s = x, t = d.
  geometry.vertices[0].tex_coord = {-20, 8};
  geometry.vertices[1].tex_coord = {20, 8};
  geometry.vertices[2].tex_coord = {0, -6};
  Recording recording = recording_of(geometry);
  for (ref_app::Vertex& v : recording.draws[0].geometry.vertices) v.color = glm::vec4(1);
  recording.draws[0].state.texturing = true;
  recording.draws[0].state.image = 5;
  recording.images[5] = noise_image(8, 4);
  for (const Positions positions : {Positions::snapped, Positions::ideal}) {
    const Truth truth = true_picture(recording, {positions, Filter::exact});
    int owned = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const size_t at = truth.index(x, y);
        if (truth.owner[at] == 0) continue;
        ++owned;
        const Real d = -1 / ((y + 0.5L) / kHeight * 2 - 1), s = ((x + 0.5L) / kWidth * 2 - 1) * d;
        ASSERT_GE(d, 0.1L);
        const std::array<Real, 4> expected = sample(Filter::exact, recording.images[5], s, d);
        for (size_t k = 0; k < 4; ++k)
          EXPECT_NEAR(truth.color[at][k], static_cast<double>(expected[k] * 255), 1e-6) << x << ", " << y;
      }
    }
    EXPECT_GT(owned, 500);
  }
}

TEST(Truth, LaterPrimitivesShowOnlyWhereTheyAreNearer) {
  const glm::vec4 big[3] = {{-3, -3, 0, 1}, {3, -3, 0, 1}, {0, 3, 0, 1}};
  Recording recording = recording_of(triangle(big));
  const auto over = [&](float z) {
    const glm::vec4 corner[3] = {{-3, -3, z, 1}, {3, -3, z, 1}, {0, 3, z, 1}};
    Recording two = recording;
    two.draws.push_back({{}, triangle(corner)});
    const Truth truth = true_picture(two);
    return truth.owner[truth.index(kWidth / 2, kHeight / 2)];
  };
  EXPECT_EQ(over(-0.25F), 2u);
  EXPECT_EQ(over(0.25F), 1u);
  EXPECT_EQ(over(0.0F), 1u);  // GL_LESS
  recording.draws[0].state.depth_test = false;
  EXPECT_EQ(over(0.25F), 2u);  // nothing was written to the depth buffer
}

TEST(TrueFilter, ExactIsTheOracles) {
  const ref_app::Image image = noise_image(8, 16);
  oracle::Texture texture;
  texture.levels.push_back({8, 16, 0, image.rgba});
  texture.sampler.wrap_s = texture.sampler.wrap_t = raster::Wrap::repeat;
  test::Random random(11);
  for (int i = 0; i < 2000; ++i) {
    const Real s = static_cast<Real>(random.real(-3, 3)), t = static_cast<Real>(random.real(-3, 3));
    const auto expected = oracle::sample_level(texture, 0, raster::Filter::linear, s, t);
    const auto color = sample(Filter::exact, image, s, t);
    for (size_t k = 0; k < 4; ++k) EXPECT_NEAR(static_cast<double>(color[k] - expected[k]), 0, 1e-15);
  }
}

TEST(TrueFilter, EightBitRoundsEachStep) {
  ref_app::Image image{2, 2, {}};
  for (const int level : {10, 21, 250, 3})
    image.rgba.insert(image.rgba.end(), 4, static_cast<uint8_t>(level));
  const auto level = [&](Real u, Real v) {
    return static_cast<double>(sample(Filter::eight_bit, image, u / 2, v / 2)[0] * 255);
  };
  EXPECT_DOUBLE_EQ(level(0.5L, 0.5L), 10);
  EXPECT_DOUBLE_EQ(level(1.5L, 1.5L), 3);
  // Half way: 10 + (128 * 11 + 128 >> 8) = 16, 250 + (128 * -247 + 128 >> 8) = 127; then 16 + (128 * 111 +
  // 128 >> 8).
  EXPECT_DOUBLE_EQ(level(1.0L, 0.5L), 16);
  EXPECT_DOUBLE_EQ(level(1.0L, 1.5L), 127);
  EXPECT_DOUBLE_EQ(level(1.0L, 1.0L), 72);
  // Less than half of 1/256 texel is nothing, more is a whole step.
  EXPECT_DOUBLE_EQ(level(0.5L, 0.5L + 15.4L / 256), level(0.5L, 0.5L + 15 / 256.0L));
  EXPECT_DOUBLE_EQ(level(0.5L, 0.5L + 15.6L / 256), level(0.5L, 0.5L + 16 / 256.0L));
  EXPECT_NE(level(0.5L, 0.5L + 15 / 256.0L), level(0.5L, 0.5L + 16 / 256.0L));
  // Beyond the last texel comes the first.
  EXPECT_DOUBLE_EQ(level(2.0L, 0.5L), level(0.0L, 0.5L));
  EXPECT_DOUBLE_EQ(level(-0.5L, 0.5L), 21);
}

class Judge : public testing::Test {
 protected:
  Judge() {
    const glm::vec4 corner[3] = {{-0.9F, -0.9F, 0, 1}, {0.9F, -0.8F, 0, 1}, {0, 0.9F, 0, 1}};
    recording_ = recording_of(triangle(corner));
    truth_ = true_picture(recording_);
    drawn_ = perfect(truth_);
    perfect_ = judge(recording_, truth_, drawn_);
  }
  SceneVerdict verdict(const Judgement& judgement) const {
    SceneVerdict verdict;
    verdict.scene = 1;
    verdict.ours = {judgement, judgement};
    verdict.ours_draft = {perfect_, perfect_};
    return verdict;
  }

  Recording recording_;
  Truth truth_;
  Drawn drawn_;
  Judgement perfect_;
};

TEST_F(Judge, FindsNothingInAPerfectPicture) {
  const Judgement judgement = judge(recording_, truth_, drawn_);
  EXPECT_EQ(judgement.pixels, uint64_t{kWidth * kHeight});
  EXPECT_EQ(judgement.wrong_pixels, 0u);
  EXPECT_LE(judgement.worst.levels, 0.5);
  EXPECT_GT(judgement.worst.levels, 0.4);
  EXPECT_TRUE(judgement.misplaced.empty());
  EXPECT_TRUE(verdict(judgement).broken().empty());
}

TEST_F(Judge, FindsOneLevelInOneByte) {
  const int x = 20, y = 9;
  ASSERT_TRUE(truth_.interior(x, y));
  float& byte = drawn_.picture.at(x, kHeight - 1 - y)[2];
  byte += truth_.color[truth_.index(x, y)][2] < static_cast<double>(byte) ? 1.0F : -1.0F;
  const Judgement judgement = judge(recording_, truth_, drawn_);
  EXPECT_EQ(judgement.wrong_pixels, 1u);
  EXPECT_EQ(judgement.wrong_bytes, 1u);
  EXPECT_EQ(judgement.worst_interior.x, x);
  EXPECT_EQ(judgement.worst_interior.y, y);
  EXPECT_GE(judgement.worst_interior.levels, 1);
  // One pixel of so few is more than 0.02 % as well.
  EXPECT_EQ(verdict(judgement).broken().size(), 2u);
  SceneVerdict draft = verdict(perfect_);
  EXPECT_TRUE(draft.broken().empty());
  // Of the draft level, 0.1 % may be wrong.
  Judgement worse = judgement;
  worse.wrong_pixels = worse.pixels / 1000;
  draft.ours_draft = {worse, worse};
  EXPECT_TRUE(draft.broken().empty());
  ++worse.wrong_pixels;
  draft.ours_draft = {worse, worse};
  EXPECT_EQ(draft.broken().size(), 1u);
}

TEST_F(Judge, FindsAPixelOfTheWrongOwner) {
  const int x = 20, y = 9;
  drawn_.owner[truth_.index(x, y)] = 0;
  const Judgement judgement = judge(recording_, truth_, drawn_);
  EXPECT_EQ(judgement.wrong_pixels, 0u);
  ASSERT_EQ(judgement.misplaced.size(), 1u);
  EXPECT_EQ(judgement.misplaced[0].x, x);
  EXPECT_EQ(judgement.misplaced[0].y, y);
  EXPECT_EQ(judgement.misplaced[0].drawn, 0u);
  EXPECT_EQ(judgement.misplaced[0].truth, 1u);
  EXPECT_GT(judgement.misplaced[0].edge_distance, 1);
  EXPECT_EQ(verdict(judgement).broken().size(), 1u);
}

TEST_F(Judge, TellsWhyTwoPicturesDiffer) {
  const Truths truths{truth_, true_picture(recording_, {Positions::ideal, Filter::exact})};
  Drawn theirs = perfect(truths.ideal);
  const Disagreement none = between(truths, drawn_, drawn_);
  EXPECT_EQ(none.differing, 0u);
  EXPECT_EQ(between(truths, drawn_, theirs).differing, between(truths, drawn_, theirs).corners);

  theirs = drawn_;
  theirs.picture.at(20, kHeight - 1 - 9)[0] += 3;
  theirs.owner[truth_.index(21, 9)] = 0;
  theirs.picture.at(21, kHeight - 1 - 9)[0] += 2;
  Drawn ours = drawn_;
  ours.picture.at(22, kHeight - 1 - 9)[1] -= 2;
  const Disagreement found = between(truths, ours, theirs);
  EXPECT_EQ(found.differing, 3u);
  EXPECT_EQ(found.theirs_wrong, 1u);
  EXPECT_EQ(found.misplaced, 1u);
  EXPECT_EQ(found.ours_wrong, 1u);
  EXPECT_EQ(found.max_interior, 3);
}

}  // namespace
}  // namespace halfspace::differential
