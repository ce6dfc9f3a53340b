// What two pictures of the same size differ by.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "compare/image.h"

namespace halfspace::compare {

// A jump of more than this many levels, in any channel, between a pixel and one of its eight neighbours in
// picture A makes it an edge pixel. Shading and filtered textures stay below it, silhouettes stay above it.
constexpr double kDefaultEdgeThreshold = 32;

struct EdgeMask {
  int width = 0, height = 0;
  std::vector<uint8_t> is_edge;  // 1 or 0, row by row from the top
};

// Only A is asked: a stray pixel in B alone has to count as a difference inside.
EdgeMask find_edges(const Image& a, double threshold = kDefaultEdgeThreshold);
// A picture that says where the edges are: every pixel that is not black.
EdgeMask edges_from_mask(const Image& mask);
// Where two pictures that paint every primitive in a colour of its own show another one. Throws ImageError
// when the sizes do not agree.
EdgeMask edges_of_coverage(const Image& owners_a, const Image& owners_b);

struct ChannelDifference {
  double max = 0;   // levels
  double mean = 0;  // levels, over all pixels
};

struct WorstPixel {
  int x = 0, y = 0;  // from the top left
  double levels = 0;
  Pixel a{}, b{};
};

struct Difference {
  int width = 0, height = 0;
  bool alpha_compared = false;  // when either picture has alpha; then a missing one counts as 255
  uint64_t pixels = 0;
  uint64_t differing = 0;
  uint64_t edge_pixels = 0;
  uint64_t differing_edge = 0;
  uint64_t differing_interior = 0;
  uint64_t above_1 = 0, above_2 = 0,
           above_8 = 0;  // pixels whose largest channel difference exceeds so many levels
  uint64_t above_1_interior = 0;
  std::array<ChannelDifference, 4> channels;
  double max = 0;           // levels, over all channels
  double max_interior = 0;  // levels, off the edges
  double mean = 0;          // levels, over all pixels and compared channels
  double mean_squared = 0;
  std::optional<WorstPixel> worst;  // the first one from the top left, when several are equally far off
  std::optional<WorstPixel> worst_interior;

  int channel_count() const { return alpha_compared ? 4 : 3; }
  double differing_percent() const;
  double psnr() const;  // decibels against 255; infinity for equal pictures
};

// Throws ImageError when the sizes (also of the mask) do not agree.
Difference compare_images(const Image& a, const Image& b, const EdgeMask& edges);

// |A - B| times `gain`, opaque. Grey in the background helps none: black is equal.
Image amplified_difference(const Image& a, const Image& b, double gain);

// Limits a caller states. None stated: any difference is too much.
struct Limits {
  std::optional<double> differing_percent;
  std::optional<double> difference_levels;
  std::optional<double> interior_levels;
};

// Whether `difference` keeps the limits, and when not, which it broke, in words.
std::vector<std::string> broken_limits(const Difference& difference, const Limits& limits);

}  // namespace halfspace::compare
