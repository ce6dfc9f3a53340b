#include "tests/differential/judgement.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace halfspace::differential {
namespace {

// The truth itself is only known to about 1e-12 of a level: ties closer than this may go either way.
constexpr double kTie = 1e-9;

const compare::Pixel& pixel_at(const compare::Image& image, int x, int y) {
  return image.at(x, image.height - 1 - y);
}

double error(const std::array<double, 4>& truth, const compare::Pixel& pixel, size_t channel) {
  return std::fabs(static_cast<double>(pixel[channel]) - truth[channel]);
}

bool is_right(const std::array<double, 4>& truth, const compare::Pixel& pixel) {
  for (size_t k = 0; k < 4; ++k) {
    if (error(truth, pixel, k) > 0.5 + kTie) return false;
  }
  return true;
}

void require_size(const Truth& truth, const compare::Image& image) {
  if (image.width != truth.width || image.height != truth.height)
    throw std::runtime_error("a picture has another size than the true one");
}

void note(WorstColor& worst, int x, int y, double levels) {
  if (levels > worst.levels) worst = {x, y, levels};
}

void judge_color(const Truth& truth, const compare::Pixel& pixel, int x, int y, bool interior,
                 Judgement& judgement) {
  const std::array<double, 4>& color = truth.color[truth.index(x, y)];
  if (!is_right(color, pixel)) ++judgement.wrong_pixels;
  for (size_t k = 0; k < 4; ++k) {
    const double levels = error(color, pixel, k);
    if (levels > 0.5 + kTie) ++judgement.wrong_bytes;
    note(judgement.worst, x, y, levels);
    if (interior) note(judgement.worst_interior, x, y, levels);
  }
}

}  // namespace

Judgement judge(const Truth& truth, const Drawn& drawn) {
  require_size(truth, drawn.picture);
  if (!drawn.owner.empty() && drawn.owner.size() != truth.owner.size())
    throw std::runtime_error("a picture of owners has another size than the true one");
  Judgement judgement;
  judgement.pixels = truth.owner.size();
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      const size_t at = truth.index(x, y);
      const bool interior = truth.interior(x, y);
      if (interior) ++judgement.interior_pixels;
      if (!drawn.owner.empty() && drawn.owner[at] != truth.owner[at]) {
        judgement.misplaced.push_back(
            {x, y, drawn.owner[at], truth.owner[at], static_cast<double>(truth.edge_distance[at])});
        continue;
      }
      judge_color(truth, pixel_at(drawn.picture, x, y), x, y, interior, judgement);
    }
  }
  return judgement;
}

Disagreement between(const Truth& truth, const compare::Image& first, const compare::Image& second) {
  require_size(truth, first);
  require_size(truth, second);
  Disagreement result;
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      const compare::Pixel &a = pixel_at(first, x, y), &b = pixel_at(second, x, y);
      double levels = 0;
      for (size_t k = 0; k < 4; ++k) levels = std::max(levels, std::fabs(static_cast<double>(a[k] - b[k])));
      if (levels == 0) continue;
      ++result.differing;
      result.max = std::max(result.max, levels);
      if (truth.interior(x, y)) result.max_interior = std::max(result.max_interior, levels);
      const std::array<double, 4>& color = truth.color[truth.index(x, y)];
      const bool first_right = is_right(color, a), second_right = is_right(color, b);
      if (first_right && !second_right) ++result.first_right;
      if (second_right && !first_right) ++result.second_right;
    }
  }
  return result;
}

}  // namespace halfspace::differential
