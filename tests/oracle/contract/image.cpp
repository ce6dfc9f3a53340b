#include "tests/oracle/contract/image.h"

#include <algorithm>
#include <cstring>

namespace halfspace::oracle {
namespace {

using raster::PixelLayout;

// Components in the order of memory; shorter than four for layouts without alpha.
const char* order_of(PixelLayout layout) {
  switch (layout) {
    case PixelLayout::rgba:
      return "rgba";
    case PixelLayout::argb:
      return "argb";
    case PixelLayout::rgb:
      return "rgb";
    case PixelLayout::bgr:
      return "bgr";
    default:
      return "bgra";
  }
}

size_t component(char letter) { return std::string_view("rgba").find(letter); }

uint16_t rgb565_of(const std::array<uint8_t, 4>& c) {
  const auto narrow = [](unsigned byte, unsigned most) { return (byte * most + 127) / 255; };
  return static_cast<uint16_t>(narrow(c[0], 31) << 11 | narrow(c[1], 63) << 5 | narrow(c[2], 31));
}

template <class T>
std::byte* store(const std::array<T, 4>& color, PixelLayout layout, std::byte* out) {
  for (const char* letter = order_of(layout); *letter != '\0'; ++letter, out += sizeof(T))
    std::memcpy(out, &color[component(*letter)], sizeof(T));
  return out;
}

}  // namespace

void store_image(const Target& target, raster::ColorPlane plane, const raster::LinearImage& image) {
  const std::vector<ColorPixel>& pixels = target.color[static_cast<size_t>(place_of_plane(plane))];
  const bool of_bytes = target.format == raster::ColorFormat::rgba8;
  for (int y = 0; y < std::min(target.height, image.height); ++y) {
    std::byte* out =
        static_cast<std::byte*>(image.data) + image.row_bytes * (image.y_up ? y : image.height - 1 - y);
    for (int x = 0; x < std::min(target.width, image.width); ++x) {
      const ColorPixel& pixel = pixels[target.at(x, y)];
      std::array<uint8_t, 4> bytes = pixel.byte;
      std::array<float, 4> floats = pixel.value;
      for (size_t k = 0; of_bytes && k < 4; ++k) floats[k] = static_cast<float>(bytes[k]) / 255.0f;
      if (image.opaque) bytes[3] = 255, floats[3] = 1;
      if (image.layout == PixelLayout::rgb565) {
        const uint16_t word = rgb565_of(bytes);
        std::memcpy(out, &word, sizeof word);
        out += sizeof word;
      } else if (image.float_components) {
        out = store(floats, image.layout, out);
      } else {
        out = store(bytes, image.layout, out);
      }
    }
  }
}

}  // namespace halfspace::oracle
