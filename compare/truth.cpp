#include "compare/truth.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

namespace halfspace::compare {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "truth files are little endian");

constexpr size_t kRecordBytes = 4 * sizeof(float) + 2 * sizeof(uint32_t) + sizeof(double);
constexpr int kLargestSize = 1 << 15;

TruePixel pixel_from(const char* record) {
  TruePixel pixel{};
  std::memcpy(pixel.color.data(), record, 16);
  std::memcpy(&pixel.owner, record + 16, 4);
  std::memcpy(&pixel.draw, record + 20, 4);
  std::memcpy(&pixel.depth, record + 24, 8);
  return pixel;
}

void read_heading(std::istream& file, const fs::path& path, Truth& truth) {
  std::string line, word;
  int version = 0;
  std::getline(file, line);
  std::istringstream words(line);
  if (!(words >> word >> version >> truth.width >> truth.height) || word != "halfspace-truth" ||
      version != 1 || truth.width < 1 || truth.height < 1 || truth.width > kLargestSize ||
      truth.height > kLargestSize)
    throw ImageError(path.string() +
                     ": does not begin as a truth file does (halfspace-truth 1 WIDTH HEIGHT)");
}

void require_size(const Image& picture, const Truth& truth) {
  if (picture.width == truth.width && picture.height == truth.height) return;
  throw ImageError("the picture has " + std::to_string(picture.width) + "x" + std::to_string(picture.height) +
                   " pixels and the truth " + std::to_string(truth.width) + "x" +
                   std::to_string(truth.height));
}

double worst_channel(const Pixel& pixel, const TruePixel& truth, size_t channels) {
  double worst = 0;
  for (size_t c = 0; c < channels; ++c)
    worst = std::max(worst, std::abs(static_cast<double>(pixel[c]) - static_cast<double>(truth.color[c])));
  return worst;
}

size_t bin_of(double error) {
  return static_cast<size_t>(std::lower_bound(kErrorBins.begin(), kErrorBins.end(), error) -
                             kErrorBins.begin());
}

bool shows_a_neighbour(const Image& picture, const Truth& truth, int x, int y, size_t channels) {
  const TruePixel& own = truth.at(x, y);
  for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, truth.height - 1); ++ny)
    for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, truth.width - 1); ++nx) {
      const TruePixel& other = truth.at(nx, ny);
      if (other.owner != own.owner && worst_channel(picture.at(x, y), other, channels) <= kAnotherOwner)
        return true;
    }
  return false;
}

template <typename Visit>
void for_each_pixel(const Truth& truth, const Visit& visit) {
  for (int y = 0; y < truth.height; ++y)
    for (int x = 0; x < truth.width; ++x) visit(x, y);
}

bool same_number(const Pixel& pixel, const TruePixel& truth) {
  for (size_t c = 0; c < 3; ++c)
    if (std::lround(pixel[c]) != std::lround(truth.color[c])) return false;
  return true;
}

}  // namespace

double TruthError::wrong_percent() const {
  return pixels == 0 ? 0 : 100.0 * static_cast<double>(wrong) / static_cast<double>(pixels);
}

Truth load_truth(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw ImageError(path.string() + ": cannot be read");
  Truth truth;
  read_heading(file, path, truth);
  const size_t width = static_cast<size_t>(truth.width), height = static_cast<size_t>(truth.height);
  truth.pixels.resize(width * height);
  std::vector<char> row(width * kRecordBytes);
  for (size_t y = height; y-- > 0;) {
    if (!file.read(row.data(), static_cast<std::streamsize>(row.size())))
      throw ImageError(path.string() + ": ends before its last pixel");
    for (size_t x = 0; x < width; ++x) truth.pixels[y * width + x] = pixel_from(&row[x * kRecordBytes]);
  }
  return truth;
}

OwnerFlags same_owner_flags(const Image& picture, const Truth& truth) {
  require_size(picture, truth);
  OwnerFlags flags;
  flags.reserve(truth.pixels.size());
  for_each_pixel(truth,
                 [&](int x, int y) { flags.push_back(same_number(picture.at(x, y), truth.at(x, y))); });
  return flags;
}

TruthError error_of(const Image& picture, const Truth& truth, const OwnerFlags& same_owner) {
  require_size(picture, truth);
  const size_t channels = picture.has_alpha ? 4 : 3;
  TruthError error;
  error.pixels = truth.pixels.size();
  error.coverage_is_inferred = same_owner.empty();
  double sum = 0;
  for_each_pixel(truth, [&](int x, int y) {
    const Pixel& pixel = picture.at(x, y);
    const TruePixel& own = truth.at(x, y);
    for (size_t c = 0; c < channels; ++c)
      sum += std::abs(static_cast<double>(pixel[c]) - static_cast<double>(own.color[c]));
    const double worst = worst_channel(pixel, own, channels);
    if (worst > kNearest) ++error.wrong;
    ++error.histogram[bin_of(worst)];
    const bool another = same_owner.empty()
                             ? worst > kAnotherOwner && shows_a_neighbour(picture, truth, x, y, channels)
                             : same_owner[picture.index(x, y)] == 0;
    if (another)
      ++error.coverage;
    else
      error.max = std::max(error.max, worst);
  });
  error.mean = sum / static_cast<double>(error.pixels * channels);
  return error;
}

Offsets texel_offsets(const Image& picture, const Truth& truth, const OwnerFlags& same_owner) {
  require_size(picture, truth);
  constexpr double kTextured = 254;  // of blue
  Offsets offsets;
  double sum = 0;
  for_each_pixel(truth, [&](int x, int y) {
    const Pixel& pixel = picture.at(x, y);
    const TruePixel& own = truth.at(x, y);
    if (!same_owner.empty() && same_owner[picture.index(x, y)] == 0) return;
    if (static_cast<double>(pixel[2]) < kTextured || static_cast<double>(own.color[2]) < kTextured) return;
    const double texels = std::max(worst_channel(pixel, own, 2) - 0.5, 0.0) / kLevelsPerTexel;
    ++offsets.pixels;
    offsets.max = std::max(offsets.max, texels);
    sum += texels;
  });
  if (offsets.pixels > 0) offsets.mean = sum / static_cast<double>(offsets.pixels);
  return offsets;
}

namespace {

void add(Offsets& all, const Offsets& one) {
  const double sum = all.mean * static_cast<double>(all.pixels) + one.mean * static_cast<double>(one.pixels);
  all.pixels += one.pixels;
  all.max = std::max(all.max, one.max);
  all.mean = all.pixels == 0 ? 0 : sum / static_cast<double>(all.pixels);
}

}  // namespace

TruthError pooled(std::span<const TruthError> errors) {
  TruthError all;
  all.coverage_is_inferred = false;
  double sum = 0;
  for (const TruthError& one : errors) {
    all.pixels += one.pixels;
    all.wrong += one.wrong;
    all.coverage += one.coverage;
    all.coverage_is_inferred = all.coverage_is_inferred || one.coverage_is_inferred;
    all.max = std::max(all.max, one.max);
    sum += one.mean * static_cast<double>(one.pixels);
    for (size_t i = 0; i < all.histogram.size(); ++i) all.histogram[i] += one.histogram[i];
    if (!one.texels) continue;
    if (!all.texels) all.texels.emplace();
    add(*all.texels, *one.texels);
  }
  if (all.pixels > 0) all.mean = sum / static_cast<double>(all.pixels);
  return all;
}

}  // namespace halfspace::compare
