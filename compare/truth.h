// The true picture, as the oracle leaves it (HALFSPACE_TRUTH), and how far a renderer's picture is from it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "compare/image.h"

namespace halfspace::compare {

struct TruePixel {
  std::array<float, 4> color;  // levels, 0 .. 255, before rounding to bytes
  uint32_t owner = 0;          // the primitive of the frame that wrote it last, from 1; 0 is the background
  uint32_t draw = 0;           // that primitive's draw, from 1
  double depth = 0;            // 0 .. 2^24 - 1, before rounding
};

// Row 0 is the top row, as in Image.
struct Truth {
  int width = 0, height = 0;
  std::vector<TruePixel> pixels;

  const TruePixel& at(int x, int y) const {
    return pixels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
};

// Reads a frame_*.truth file: the line "halfspace-truth 1 WIDTH HEIGHT", then for each pixel, the bottom row
// first, four floats, two 32-bit integers and a double, little endian. Throws ImageError.
Truth load_truth(const std::filesystem::path& path);

// A byte this far from the truth is still the right one: the nearest, or either of two when the truth lies
// between.
constexpr double kNearest = 0.5001;

// Upper ends of the histogram's bins, in levels; the last bin has what is beyond.
constexpr std::array<double, 10> kErrorBins{kNearest, 0.55, 0.75, 1, 1.5, 2, 4, 8, 16, 32};

// A channel that is farther off than this is not shaded a little differently: something else is seen there.
constexpr double kAnotherOwner = 8;

struct Offsets {
  uint64_t pixels = 0;       // that show a texture in both pictures
  double max = 0, mean = 0;  // texels
};

// Levels, over red, green and blue, and alpha where the picture has one.
struct TruthError {
  uint64_t pixels = 0;
  uint64_t wrong = 0;  // pixels with a byte that is not the nearest to the truth
  double max = 0;      // of any channel of a pixel whose owner is right
  double mean = 0;     // of all channels; 0.25 is what rounding to bytes alone comes to
  std::array<uint64_t, kErrorBins.size() + 1> histogram{};  // pixels by their worst channel
  uint64_t coverage = 0;                                    // pixels that another primitive owns
  bool coverage_is_inferred = true;  // from the colours; otherwise seen in a picture of the owners
  std::optional<Offsets> texels;

  double wrong_percent() const;
};

// A flag for each pixel, from the top left: whether the right primitive owns it.
using OwnerFlags = std::vector<uint8_t>;
// From pictures that ref_app painted by --paint owners: a primitive's number in red, green, blue.
OwnerFlags same_owner_flags(const Image& picture, const Truth& truth);

// Throws ImageError when the sizes do not agree. Without flags the owners are inferred: another one has a
// pixel that is more than kAnotherOwner off its truth, and no more than that off the truth of a neighbour
// with another owner.
TruthError error_of(const Image& picture, const Truth& truth, const OwnerFlags& same_owner = {});

// From pictures that ref_app painted by --paint texels: red and green tell s and t by kLevelsPerTexel levels
// a texel, blue is 255 where there is a texture. What rounding to bytes alone comes to, half a level, is
// taken off. Pixels with another owner are left out.
constexpr double kLevelsPerTexel = 255.0 / 8;
Offsets texel_offsets(const Image& picture, const Truth& truth, const OwnerFlags& same_owner = {});

// All pixels of several pictures as if they were one.
TruthError pooled(std::span<const TruthError> errors);

}  // namespace halfspace::compare
