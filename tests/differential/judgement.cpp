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

void require_size(const Truth& truth, const Drawn& drawn) {
  const compare::Image& image = drawn.picture;
  if (image.width != truth.width || image.height != truth.height || drawn.owner.size() != truth.owner.size())
    throw std::runtime_error("a picture has another size than the true one");
}

Misplaced misplaced_at(const Recording& recording, int x, int y, Owner drawn, Owner truth) {
  const double nearest = std::min(distance_to_edge(recording, drawn, x, y).value_or(1e300),
                                  distance_to_edge(recording, truth, x, y).value_or(1e300));
  return {x, y, drawn, truth, nearest};
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

Judgement judge(const Recording& recording, const Truth& truth, const Drawn& drawn) {
  require_size(truth, drawn);
  Judgement judgement;
  judgement.pixels = truth.owner.size();
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      const size_t at = truth.index(x, y);
      const bool interior = truth.interior(x, y);
      if (interior) ++judgement.interior_pixels;
      if (drawn.owner[at] != truth.owner[at]) {
        judgement.misplaced.push_back(misplaced_at(recording, x, y, drawn.owner[at], truth.owner[at]));
        continue;
      }
      judge_color(truth, pixel_at(drawn.picture, x, y), x, y, interior, judgement);
    }
  }
  return judgement;
}

Disagreement between(const Truths& truths, const Drawn& ours, const Drawn& theirs) {
  const Truth& truth = truths.contract();
  require_size(truth, ours);
  require_size(truth, theirs);
  Disagreement result;
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      const compare::Pixel &a = pixel_at(ours.picture, x, y), &b = pixel_at(theirs.picture, x, y);
      double levels = 0;
      for (size_t k = 0; k < 4; ++k) levels = std::max(levels, std::fabs(static_cast<double>(a[k] - b[k])));
      if (levels == 0) continue;
      const size_t at = truth.index(x, y);
      ++result.differing;
      result.max = std::max(result.max, levels);
      if (truth.interior(x, y)) result.max_interior = std::max(result.max_interior, levels);
      if (ours.owner[at] != truth.owner[at] || theirs.owner[at] != truth.owner[at]) {
        ++result.misplaced;
      } else if (!is_right(truth.color[at], a)) {
        ++result.ours_wrong;
      } else if (is_right(truths.snapped.color[at], b) || is_right(truths.ideal.color[at], b)) {
        ++result.corners;
      } else {
        ++result.theirs_wrong;
      }
    }
  }
  return result;
}

}  // namespace halfspace::differential
