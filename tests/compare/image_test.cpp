#include "compare/image.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace halfspace::compare {
namespace {

namespace fs = std::filesystem;

class Folder : public testing::Test {
 protected:
  Folder() : path(fs::temp_directory_path() / ("halfspace_image_test_" + std::to_string(getpid()))) {
    fs::create_directories(path);
  }
  ~Folder() override { fs::remove_all(path); }

  fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path / name, std::ios::binary) << bytes;
    return path / name;
  }

  fs::path path;
};

// All 256 levels, no two channels alike, the top left unlike the other corners.
Image ramp(bool alpha) {
  Image image(64, 4);
  image.has_alpha = alpha;
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const float level = static_cast<float>(i);
    image.pixels[i] = {level, 255 - level, static_cast<float>(i * 7 % 256),
                       alpha ? static_cast<float>(i) : 255};
  }
  return image;
}

TEST_F(Folder, LosslessFormatsKeepEveryLevel) {
  const Image image = ramp(false);
  for (const char* name : {"a.png", "a.bmp", "a.ppm", "a.tif", "a.tga"}) {
    save_image(image, path / name);
    const Image back = load_image(path / name);
    EXPECT_EQ(back.width, 64) << name;
    EXPECT_EQ(back.height, 4) << name;
    EXPECT_FALSE(back.has_alpha) << name;
    EXPECT_EQ(back.pixels, image.pixels) << name;
  }
}

// Colours under alpha 0 are what glReadPixels gave; multiplying them away would hide differences.
TEST_F(Folder, AlphaIsNotMultipliedIn) {
  const Image image = ramp(true);
  for (const char* name : {"a.png", "a.tif", "a.tga"}) {
    save_image(image, path / name);
    EXPECT_EQ(load_image(path / name).pixels, image.pixels) << name;
  }
}

TEST_F(Folder, TopRowComesFirst) {
  const Image image =
      load_image(write("two.ppm", std::string("P6\n1 2\n255\n") + "\x01\x02\x03\x04\x05\x06"));
  ASSERT_EQ(image.height, 2);
  EXPECT_EQ(image.at(0, 0), (Pixel{1, 2, 3, 255}));
  EXPECT_EQ(image.at(0, 1), (Pixel{4, 5, 6, 255}));
}

TEST_F(Folder, GreyBecomesColor) {
  const Image image = load_image(write("grey.pgm", "P5\n2 1\n255\n\x10\x20"));
  EXPECT_EQ(image.at(1, 0), (Pixel{32, 32, 32, 255}));
}

TEST_F(Folder, SixteenBitsKeepTheirFractions) {
  const Image image = load_image(write("deep.pgm", std::string("P5\n1 1\n65535\n") + "\x80\x80"));
  EXPECT_NEAR(image.at(0, 0)[0], 128.0f,
              0.005);  // one of 65535: OpenImageIO's Netpbm reader is off by so much
  const Image other = load_image(write("deeper.pgm", std::string("P5\n1 1\n65535\n") + "\x80\x81"));
  EXPECT_GT(other.at(0, 0)[0], image.at(0, 0)[0]);
}

TEST_F(Folder, TroubleIsNamed) {
  EXPECT_THROW(load_image(path / "missing.png"), ImageError);
  EXPECT_THROW(load_image(path), ImageError);
  EXPECT_THROW(load_image(write("noise.png", "this is no picture")), ImageError);
  save_image(ramp(false), path / "whole.png");
  fs::resize_file(path / "whole.png", fs::file_size(path / "whole.png") / 2);
  EXPECT_THROW(load_image(path / "whole.png"), ImageError);
  EXPECT_THROW(save_image(ramp(false), path / "what.unknown"), ImageError);
  EXPECT_THROW(save_image(ramp(false), path / "no_such_folder" / "a.png"), ImageError);
}

TEST_F(Folder, PngInMemoryIsThePngInAFile) {
  const std::vector<uint8_t> bytes = encode_png(ramp(true));
  const fs::path file = write("memory.png", std::string(bytes.begin(), bytes.end()));
  EXPECT_EQ(load_image(file).pixels, ramp(true).pixels);
}

TEST(Crop, StaysInside) {
  Image image(10, 6);
  image.at(9, 5) = {9, 5, 0, 255};
  image.at(0, 0) = {1, 1, 1, 255};
  const Image corner = crop_around(image, 9, 5, 4);
  EXPECT_EQ(corner.width, 4);
  EXPECT_EQ(corner.at(3, 3), (Pixel{9, 5, 0, 255}));
  EXPECT_EQ(crop_around(image, 0, 0, 4).at(0, 0), (Pixel{1, 1, 1, 255}));
  const Image whole = crop_around(image, 5, 3, 100);
  EXPECT_EQ(whole.width, 10);
  EXPECT_EQ(whole.height, 6);
}

}  // namespace
}  // namespace halfspace::compare
