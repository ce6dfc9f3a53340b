#include "verdict.h"

#include <algorithm>
#include <cstdio>

namespace halfspace::fuzz {
namespace {

bool is_explained(const Picture& picture, const Picture& by, int x, int y, int levels) {
  const int x_end = std::min(x + 2, by.width), y_end = std::min(y + 2, by.height);
  for (int c = 0; c < 4; ++c) {
    int low = 255, high = 0;
    for (int v = std::max(y - 1, 0); v < y_end; ++v) {
      for (int u = std::max(x - 1, 0); u < x_end; ++u) {
        const int value = by.rgba[static_cast<size_t>((v * by.width + u) * 4 + c)];
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
    const int value = picture.rgba[static_cast<size_t>((y * picture.width + x) * 4 + c)];
    if (value < low - levels || value > high + levels) return false;
  }
  return true;
}

std::string name_call(const std::vector<std::pair<uint32_t, uint32_t>>& errors, size_t i) {
  if (i >= errors.size()) return "none";
  char text[64];
  std::snprintf(text, sizeof(text), "0x%x at call %u", errors[i].second, errors[i].first);
  return text;
}

// Where two lists of errors part; "" if nowhere.
std::string compare_errors(const Outcome& ours, const Outcome& theirs) {
  const size_t count = std::max(ours.errors.size(), theirs.errors.size());
  for (size_t i = 0; i < count; ++i) {
    if (i >= ours.errors.size() || i >= theirs.errors.size() || ours.errors[i] != theirs.errors[i])
      return "errors: ours " + name_call(ours.errors, i) + ", theirs " + name_call(theirs.errors, i);
  }
  return "";
}

}  // namespace

std::vector<bool> explained(const Picture& picture, const Picture& by, int levels) {
  std::vector<bool> result(static_cast<size_t>(picture.width * picture.height));
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x)
      result[static_cast<size_t>(y * picture.width + x)] = is_explained(picture, by, x, y, levels);
  }
  return result;
}

Verdict judge(const Outcome& ours, const Outcome& first, const Outcome& second, const Limits& limits) {
  Verdict verdict;
  if (!ours.trouble.empty()) return {false, 0, 0, 0, "our library " + ours.trouble};
  // A reference that fails has nothing to say.
  if (!first.trouble.empty() || !second.trouble.empty()) return verdict;
  if (const std::string difference = compare_errors(ours, first); !difference.empty())
    return {false, 0, 0, 0, difference};

  const auto ours_by_first = explained(ours.picture, first.picture, limits.levels);
  const auto ours_by_second = explained(ours.picture, second.picture, limits.levels);
  const auto first_by_ours = explained(first.picture, ours.picture, limits.levels);
  const auto second_by_ours = explained(second.picture, ours.picture, limits.levels);
  const auto first_by_second = explained(first.picture, second.picture, limits.levels);
  const auto second_by_first = explained(second.picture, first.picture, limits.levels);
  for (size_t i = 0; i < ours_by_first.size(); ++i) {
    const bool settled = first_by_second[i] && second_by_first[i];
    const bool wrong =
        settled && ((!ours_by_first[i] && !ours_by_second[i]) || (!first_by_ours[i] && !second_by_ours[i]));
    if (!wrong) continue;
    if (verdict.wrong++ == 0) {
      verdict.first_x = static_cast<int>(i) % ours.picture.width;
      verdict.first_y = static_cast<int>(i) / ours.picture.width;
    }
  }
  verdict.agrees = verdict.wrong <= limits.pixels;
  if (!verdict.agrees) verdict.reason = std::to_string(verdict.wrong) + " pixels differ";
  return verdict;
}

}  // namespace halfspace::fuzz
