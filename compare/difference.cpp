#include "compare/difference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/difference_text.h"

namespace halfspace::compare {
namespace {

// Not-a-number in one picture only is as far off as can be; in both it is the same.
double level_difference(float a, float b) {
  const bool a_nan = std::isnan(a), b_nan = std::isnan(b);
  if (a_nan || b_nan) return a_nan == b_nan ? 0 : 255;
  return a == b ? 0 : std::abs(static_cast<double>(a) - static_cast<double>(b));
}

double pixel_difference(const Pixel& a, const Pixel& b, int channels) {
  double largest = 0;
  for (size_t c = 0; c < static_cast<size_t>(channels); ++c)
    largest = std::max(largest, level_difference(a[c], b[c]));
  return largest;
}

bool jumps(const Image& image, int x, int y, double threshold) {
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, image.height - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, image.width - 1); ++u)
      if (pixel_difference(image.at(x, y), image.at(u, v), 4) > threshold) return true;
  return false;
}

void require_same_size(const Image& a, int width, int height, const char* what) {
  if (a.width == width && a.height == height) return;
  throw ImageError("sizes differ: " + std::to_string(a.width) + "x" + std::to_string(a.height) + " and " +
                   std::to_string(width) + "x" + std::to_string(height) + " (" + what + ")");
}

void keep_worst(std::optional<WorstPixel>& worst, const WorstPixel& candidate) {
  if (!worst || candidate.levels > worst->levels) worst = candidate;
}

void count_pixel(Difference& d, const WorstPixel& here, bool edge) {
  ++d.differing;
  ++(edge ? d.differing_edge : d.differing_interior);
  d.above_1 += here.levels > 1;
  d.above_2 += here.levels > 2;
  d.above_8 += here.levels > 8;
  d.max = std::max(d.max, here.levels);
  keep_worst(d.worst, here);
  if (edge) return;
  d.above_1_interior += here.levels > 1;
  d.max_interior = std::max(d.max_interior, here.levels);
  keep_worst(d.worst_interior, here);
}

// Sums go into `mean`; the caller divides at the end.
void count_channels(Difference& d, const Pixel& a, const Pixel& b) {
  for (size_t c = 0; c < static_cast<size_t>(d.channel_count()); ++c) {
    const double levels = level_difference(a[c], b[c]);
    d.channels[c].max = std::max(d.channels[c].max, levels);
    d.channels[c].mean += levels;
    d.mean_squared += levels * levels;
  }
}

void sums_to_means(Difference& d) {
  const double pixels = static_cast<double>(d.pixels);
  for (ChannelDifference& channel : d.channels) {
    channel.mean /= pixels;
    d.mean += channel.mean;
  }
  d.mean /= d.channel_count();
  d.mean_squared /= pixels * d.channel_count();
}

}  // namespace

EdgeMask find_edges(const Image& a, double threshold) {
  EdgeMask mask{a.width, a.height, std::vector<uint8_t>(a.pixels.size())};
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) mask.is_edge[a.index(x, y)] = jumps(a, x, y, threshold);
  return mask;
}

EdgeMask edges_from_mask(const Image& picture) {
  EdgeMask mask{picture.width, picture.height, std::vector<uint8_t>(picture.pixels.size())};
  std::transform(picture.pixels.begin(), picture.pixels.end(), mask.is_edge.begin(),
                 [](const Pixel& p) { return static_cast<uint8_t>(p[0] != 0 || p[1] != 0 || p[2] != 0); });
  return mask;
}

EdgeMask edges_of_coverage(const Image& a, const Image& b) {
  require_same_size(a, b.width, b.height, "the pictures of owners");
  EdgeMask mask{a.width, a.height, std::vector<uint8_t>(a.pixels.size())};
  std::transform(a.pixels.begin(), a.pixels.end(), b.pixels.begin(), mask.is_edge.begin(),
                 [](const Pixel& p, const Pixel& q) { return static_cast<uint8_t>(p != q); });
  return mask;
}

double Difference::differing_percent() const {
  return pixels == 0 ? 0 : 100.0 * static_cast<double>(differing) / static_cast<double>(pixels);
}

double Difference::psnr() const {
  if (mean_squared == 0) return std::numeric_limits<double>::infinity();
  return 10 * std::log10(255.0 * 255.0 / mean_squared);
}

Difference compare_images(const Image& a, const Image& b, const EdgeMask& edges) {
  require_same_size(a, b.width, b.height, "A and B");
  require_same_size(a, edges.width, edges.height, "A and the mask");
  Difference d;
  d.width = a.width;
  d.height = a.height;
  d.alpha_compared = a.has_alpha || b.has_alpha;
  d.pixels = a.pixels.size();
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const size_t i = a.index(x, y);
      const bool edge = edges.is_edge[i] != 0;
      d.edge_pixels += edge;
      const double levels = pixel_difference(a.pixels[i], b.pixels[i], d.channel_count());
      if (levels == 0) continue;
      count_pixel(d, {x, y, levels, a.pixels[i], b.pixels[i]}, edge);
      count_channels(d, a.pixels[i], b.pixels[i]);
    }
  }
  sums_to_means(d);
  return d;
}

Image amplified_difference(const Image& a, const Image& b, double gain) {
  require_same_size(a, b.width, b.height, "A and B");
  Image out(a.width, a.height);
  const bool alpha = a.has_alpha || b.has_alpha;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    // A difference in alpha alone has no colour of its own: it shows as grey.
    const double grey = alpha ? level_difference(a.pixels[i][3], b.pixels[i][3]) : 0;
    for (size_t c = 0; c < 3; ++c) {
      const double levels = std::max(grey, level_difference(a.pixels[i][c], b.pixels[i][c]));
      out.pixels[i][c] = static_cast<float>(std::min(255.0, levels * gain));
    }
  }
  return out;
}

std::vector<std::string> broken_limits(const Difference& d, const Limits& limits) {
  std::vector<std::string> broken;
  const bool stated = limits.differing_percent || limits.difference_levels || limits.interior_levels;
  if (!stated && d.differing > 0) broken.push_back(std::to_string(d.differing) + " pixels differ");
  const auto check = [&](const char* what, const char* unit, double value,
                         const std::optional<double>& limit) {
    if (limit && value > *limit)
      broken.push_back(std::string(what) + " " + short_number(value) + unit + ", limit " +
                       short_number(*limit) + unit);
  };
  check("differing pixels", " %", d.differing_percent(), limits.differing_percent);
  check("largest difference", " levels", d.max, limits.difference_levels);
  check("largest difference inside", " levels", d.max_interior, limits.interior_levels);
  return broken;
}

}  // namespace halfspace::compare
