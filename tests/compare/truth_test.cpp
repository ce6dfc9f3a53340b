// The reading of truth files and the judgement by them, on pictures whose errors are known beforehand.
#include "compare/truth.h"

#include <gtest/gtest.h>

#include <fstream>

namespace halfspace::compare {
namespace {

namespace fs = std::filesystem;

Truth flat_truth(int width, int height, const std::array<float, 4>& color) {
  Truth truth{width, height, {}};
  truth.pixels.assign(static_cast<size_t>(width * height), {color, 1, 1, 0});
  return truth;
}

TruePixel& at(Truth& truth, int x, int y) { return truth.pixels[static_cast<size_t>(y * truth.width + x)]; }

template <typename Value>
void put(std::ofstream& file, Value value) {
  file.write(reinterpret_cast<const char*>(&value), sizeof value);
}

class TruthFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  // One column; colour, owner, draw and depth of a row tell its number from the bottom.
  fs::path written(const std::string& heading, int rows) {
    const fs::path path = folder_ / "frame_00000.truth";
    std::ofstream file(path, std::ios::binary);
    file << heading << "\n";
    for (int row = 0; row < rows; ++row) {
      for (const float level : {0.25F, 1.0F, 2.0F, 255.0F}) put(file, level + static_cast<float>(row));
      put(file, static_cast<uint32_t>(row + 7));
      put(file, static_cast<uint32_t>(row + 3));
      put(file, 1000.5 + row);
    }
    return path;
  }

  fs::path folder_ = fs::temp_directory_path() / ("halfspace_truth_test_" + std::to_string(getpid()));
};

TEST_F(TruthFile, TheBottomRowComesFirst) {
  const Truth truth = load_truth(written("halfspace-truth 1 1 2", 2));
  ASSERT_EQ(truth.width, 1);
  ASSERT_EQ(truth.height, 2);
  EXPECT_EQ(truth.at(0, 1).color, (std::array<float, 4>{0.25F, 1, 2, 255}));
  EXPECT_EQ(truth.at(0, 1).owner, 7u);
  EXPECT_EQ(truth.at(0, 1).draw, 3u);
  EXPECT_EQ(truth.at(0, 1).depth, 1000.5);
  EXPECT_EQ(truth.at(0, 0).owner, 8u);
}

TEST_F(TruthFile, WhatIsNoTruthIsRefused) {
  EXPECT_THROW(load_truth(written("P6 1 2", 2)), ImageError);
  EXPECT_THROW(load_truth(written("halfspace-truth 2 1 2", 2)), ImageError);
  EXPECT_THROW(load_truth(written("halfspace-truth 1 0 2", 2)), ImageError);
  EXPECT_THROW(load_truth(written("halfspace-truth 1 1 3", 2)), ImageError);
  EXPECT_THROW(load_truth(folder_ / "none.truth"), ImageError);
}

TEST(ErrorOf, TheNearestByteIsRightAndEitherOfTwo) {
  Truth truth = flat_truth(4, 1, {10, 20, 30, 255});
  at(truth, 0, 0).color[0] = 10.49F;
  at(truth, 1, 0).color[1] = 20.5F;   // 20 and 21 are as near
  at(truth, 2, 0).color[2] = 30.52F;  // 31 would be nearer
  at(truth, 3, 0).color[0] = 13;      // three levels
  const TruthError error = error_of(Image(4, 1, {10, 20, 30, 255}), truth);
  EXPECT_EQ(error.pixels, 4u);
  EXPECT_EQ(error.wrong, 2u);
  EXPECT_EQ(error.wrong_percent(), 50);
  EXPECT_EQ(error.max, 3);
  EXPECT_NEAR(error.mean, (0.49 + 0.5 + 0.52 + 3) / 12, 1e-6);
  EXPECT_EQ(error.histogram[0], 2u);  // up to 0.5001
  EXPECT_EQ(error.histogram[1], 1u);  // up to 0.55
  EXPECT_EQ(error.histogram[6], 1u);  // up to 4
}

TEST(ErrorOf, AlphaCountsWhereThePictureHasIt) {
  const Truth truth = flat_truth(1, 1, {10, 20, 30, 100});
  Image picture(1, 1, {10, 20, 30, 255});
  EXPECT_EQ(error_of(picture, truth).wrong, 0u);
  picture.has_alpha = true;
  EXPECT_EQ(error_of(picture, truth).wrong, 1u);
}

// A red primitive left, a blue one right; one pixel too many is red, and one is nobody's colour.
TEST(ErrorOf, AnotherOwnerIsToldByItsColour) {
  Truth truth = flat_truth(6, 1, {200, 0, 0, 255});
  Image picture(6, 1, {200, 0, 0, 255});
  for (int x = 3; x < 6; ++x) {
    at(truth, x, 0) = {{0, 0, 200, 255}, 2, 1, 0};
    picture.at(x, 0) = {0, 0, 200, 255};
  }
  picture.at(3, 0) = {200, 0, 0, 255};
  picture.at(2, 0) = {90, 90, 90, 255};
  const TruthError error = error_of(picture, truth);
  EXPECT_TRUE(error.coverage_is_inferred);
  EXPECT_EQ(error.wrong, 2u);
  EXPECT_EQ(error.coverage, 1u);
  EXPECT_EQ(error.max, 110);  // of the grey one; the other's difference is its owner's
}

TEST(ErrorOf, OwnersThatWereSeenAreNotInferred) {
  const Truth numbers = flat_truth(2, 1, {3, 1, 0, 255});
  Image painted(2, 1, {3, 1, 0, 255});
  painted.at(1, 0) = {4, 1, 0, 255};
  const OwnerFlags same = same_owner_flags(painted, numbers);
  EXPECT_EQ(same, (OwnerFlags{1, 0}));
  const TruthError error = error_of(Image(2, 1, {50, 0, 0, 255}), flat_truth(2, 1, {50, 0, 0, 255}), same);
  EXPECT_FALSE(error.coverage_is_inferred);
  EXPECT_EQ(error.coverage, 1u);
  EXPECT_EQ(error.wrong, 0u);
}

TEST(ErrorOf, PicturesOfOtherSizesAreRefused) {
  EXPECT_THROW(error_of(Image(2, 1), flat_truth(1, 2, {})), ImageError);
}

TEST(TexelOffsets, AreWhatTheWavesSay) {
  Truth truth = flat_truth(4, 1, {100, 100, 255, 255});
  Image picture(4, 1, {100, 100, 255, 255});
  picture.at(0, 0)[1] = static_cast<float>(100.5 + 2 * kLevelsPerTexel);  // two texels of t
  picture.at(1, 0)[0] = 100.5F;                                           // what rounding may do
  at(truth, 2, 0).color[2] = 0;                                           // not textured
  picture.at(2, 0)[0] = 0;
  picture.at(3, 0)[0] = 0;  // another owner
  const Offsets offsets = texel_offsets(picture, truth, {1, 1, 1, 0});
  EXPECT_EQ(offsets.pixels, 2u);
  EXPECT_NEAR(offsets.max, 2, 1e-5);
  EXPECT_NEAR(offsets.mean, 1, 1e-5);
}

TEST(Pooled, IsAsOnePicture) {
  TruthError a, b;
  a.pixels = 100, a.wrong = 10, a.max = 3, a.mean = 0.5, a.coverage = 2, a.histogram[0] = 90;
  b.pixels = 300, b.wrong = 30, b.max = 2, b.mean = 0.1, b.coverage_is_inferred = false;
  b.texels = {200, 0.5, 0.25};
  const TruthError all = pooled(std::vector{a, b});
  EXPECT_EQ(all.pixels, 400u);
  EXPECT_EQ(all.wrong_percent(), 10);
  EXPECT_EQ(all.max, 3);
  EXPECT_DOUBLE_EQ(all.mean, 0.2);
  EXPECT_EQ(all.coverage, 2u);
  EXPECT_TRUE(all.coverage_is_inferred);
  EXPECT_EQ(all.histogram[0], 90u);
  EXPECT_EQ(all.texels->max, 0.5);
}

}  // namespace
}  // namespace halfspace::compare
