#include "truth.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace halfspace::hard {
namespace {

constexpr size_t kRecord = 32;  // four floats, two 32-bit numbers, a double

bool is_interior(const Truth& truth, int x, int y) {
  const auto owner = [&](int u, int v) {
    return truth.pixels[size_t(v) * size_t(truth.width) + size_t(u)].owner;
  };
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, truth.height - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, truth.width - 1); ++u)
      if (owner(u, v) != owner(x, y)) return false;
  return true;
}

}  // namespace

Truth read_truth(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic;
  int version = 0;
  Truth truth;
  file >> magic >> version >> truth.width >> truth.height;
  file.get();
  if (!file || magic != "halfspace-truth" || version != 1)
    throw std::runtime_error(path + " is not a frame of the oracle");
  const size_t count = size_t(truth.width) * size_t(truth.height);
  std::vector<char> bytes(count * kRecord);
  if (!file.read(bytes.data(), std::streamsize(bytes.size()))) throw std::runtime_error(path + " is cut off");
  truth.pixels.resize(count);
  for (size_t i = 0; i < count; ++i) {
    const char* record = &bytes[i * kRecord];
    TruePixel& pixel = truth.pixels[i];
    std::memcpy(pixel.rgba, record, 16);
    std::memcpy(&pixel.owner, record + 16, 4);
    std::memcpy(&pixel.draw, record + 20, 4);
    std::memcpy(&pixel.depth, record + 24, 8);
  }
  return truth;
}

Error measure(const Picture& picture, const Truth& truth) {
  if (picture.width != truth.width || picture.height != truth.height)
    throw std::runtime_error("the sizes differ");
  Error error;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const size_t i = picture.index(x, y);
      const TruePixel& want = truth.pixels[i];
      double color = 0;
      for (int c = 0; c < 4; ++c)
        color = std::max(color, std::fabs(double(picture.rgba[4 * i + size_t(c)]) - double(want.rgba[c])));
      if (!is_interior(truth, x, y)) {
        error.edge_wrong += color >= 1;
        continue;
      }
      ++error.interior;
      error.color = std::max(error.color, color);
      error.depth = std::max(error.depth, std::fabs(double(picture.depth[i]) - want.depth));
    }
  }
  return error;
}

}  // namespace halfspace::hard
