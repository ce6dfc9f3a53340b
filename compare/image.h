// Pictures in memory, and the way to and from files (OpenImageIO).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace halfspace::compare {

// A picture could not be read, written or compared; what() says which one, why, and what to do.
struct ImageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// One colour in levels: 0 .. 255, whole numbers when the file had 8 bits a channel, fractions when it had
// more.
using Pixel = std::array<float, 4>;

// Row 0 is the top row. Alpha is not premultiplied; it is 255 where the file has none.
struct Image {
  int width = 0;
  int height = 0;
  bool has_alpha = false;
  std::vector<Pixel> pixels;

  Image() = default;
  Image(int width_, int height_, const Pixel& fill = {0, 0, 0, 255})
      : width(width_),
        height(height_),
        pixels(static_cast<size_t>(width_) * static_cast<size_t>(height_), fill) {}

  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
  }
  Pixel& at(int x, int y) { return pixels[index(x, y)]; }
  const Pixel& at(int x, int y) const { return pixels[index(x, y)]; }
};

// Reads any format OpenImageIO knows; one, two, three or four channels. Throws ImageError.
Image load_image(const std::filesystem::path& path);

// Writes 8 bits a channel, the format by the file's extension. Throws ImageError.
void save_image(const Image& image, const std::filesystem::path& path);

// The bytes of a PNG file, 8 bits a channel. Throws ImageError.
std::vector<uint8_t> encode_png(const Image& image);

// The part of `image` of `size` by `size` pixels around (x, y), moved so that it lies inside the picture.
Image crop_around(const Image& image, int x, int y, int size);

}  // namespace halfspace::compare
