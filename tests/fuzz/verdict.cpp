#include "verdict.h"

#include <algorithm>
#include <cstdio>

#include "capture.h"

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

// Pixels whose neighbours are all set, too.
std::vector<bool> shrunk(const std::vector<bool>& set, int width, int height) {
  std::vector<bool> result(set.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      bool all = true;
      for (int v = std::max(y - 1, 0); v < std::min(y + 2, height); ++v) {
        for (int u = std::max(x - 1, 0); u < std::min(x + 2, width); ++u)
          all = all && set[static_cast<size_t>(v * width + u)];
      }
      result[static_cast<size_t>(y * width + x)] = all;
    }
  }
  return result;
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

std::string compare_captures(const Outcome& ours, const Outcome& theirs) {
  if (ours.captures.size() != theirs.captures.size()) return "another number of captures";
  for (size_t i = 0; i < ours.captures.size(); ++i) {
    if (const std::string difference = compare(ours.captures[i], theirs.captures[i]); !difference.empty())
      return difference;
  }
  return "";
}

// Calls look(x, y) for a pixel and those around it until it returns true.
template <class Look>
bool any_around(const Picture& picture, int x, int y, Look look) {
  for (int v = std::max(y - 1, 0); v < std::min(y + 2, picture.height); ++v) {
    for (int u = std::max(x - 1, 0); u < std::min(x + 2, picture.width); ++u) {
      if (look(static_cast<size_t>(v * picture.width + u))) return true;
    }
  }
  return false;
}

// Depth lies within what the other has around, give or take 2^-12; stencil is something the other has around.
std::vector<bool> explained_depth(const Outcome& outcome, const Outcome& by) {
  std::vector<bool> result(outcome.depth.size());
  for (size_t i = 0; i < result.size(); ++i) {
    const int x = static_cast<int>(i) % by.picture.width, y = static_cast<int>(i) / by.picture.width;
    float low = 2, high = -1;
    any_around(by.picture, x, y, [&](size_t k) {
      low = std::min(low, by.depth[k]), high = std::max(high, by.depth[k]);
      return false;
    });
    constexpr float kLimit = 1.0f / 4096;
    result[i] = outcome.depth[i] >= low - kLimit && outcome.depth[i] <= high + kLimit;
  }
  return result;
}
std::vector<bool> explained_stencil(const Outcome& outcome, const Outcome& by) {
  std::vector<bool> result(outcome.stencil.size());
  for (size_t i = 0; i < result.size(); ++i) {
    const int x = static_cast<int>(i) % by.picture.width, y = static_cast<int>(i) / by.picture.width;
    result[i] = any_around(by.picture, x, y, [&](size_t k) { return by.stencil[k] == outcome.stencil[i]; });
  }
  return result;
}

// Pixels where ours and the references part. explain(a, b): which pixels of a b explains.
template <class Explain>
std::vector<bool> wrong_pixels(const Outcome& ours, const Outcome& first, const Outcome& second,
                               Explain explain) {
  const auto ours_by_first = explain(ours, first), ours_by_second = explain(ours, second);
  const auto first_by_ours = explain(first, ours), second_by_ours = explain(second, ours);
  const auto first_by_second = explain(first, second), second_by_first = explain(second, first);
  std::vector<bool> agreed(ours_by_first.size()), wrong(agreed.size());
  for (size_t i = 0; i < agreed.size(); ++i) agreed[i] = first_by_second[i] && second_by_first[i];
  const auto settled = shrunk(agreed, first.picture.width, first.picture.height);
  for (size_t i = 0; i < wrong.size(); ++i) {
    wrong[i] = settled[i] &&
               ((!ours_by_first[i] && !ours_by_second[i]) || (!first_by_ours[i] && !second_by_ours[i]));
  }
  return wrong;
}

// Sets `verdict` if there are more wrong pixels than `most`.
void count_wrong(const std::vector<bool>& wrong, int most, int width, const char* what, Verdict& verdict) {
  const auto count = static_cast<int>(std::count(wrong.begin(), wrong.end(), true));
  if (count <= most || !verdict.agrees) return;
  const auto first = static_cast<int>(std::find(wrong.begin(), wrong.end(), true) - wrong.begin());
  verdict = {false, count, first % width, first / width, std::to_string(count) + " pixels differ" + what};
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

Limits widened(const Limits& limits, const Stream& stream) {
  const auto enables = [&](GLenum capability) {
    return std::find(stream.begin(), stream.end(), Call{Command::glEnable, {double(capability)}, {}}) !=
           stream.end();
  };
  Limits result = limits;
  const bool smooth = enables(GL_POINT_SMOOTH) || enables(GL_LINE_SMOOTH);
  if (smooth) result.levels = std::max(limits.levels, 64);
  if (smooth || enables(GL_LINE_STIPPLE)) result.pixels = std::max(limits.pixels, 24);
  return result;
}

Verdict judge(const Outcome& ours, const Outcome& first, const Outcome& second, const Limits& limits) {
  Verdict verdict;
  if (!ours.trouble.empty()) return {false, 0, 0, 0, "our library " + ours.trouble};
  // A reference that fails has nothing to say.
  if (!first.trouble.empty() || !second.trouble.empty()) return verdict;
  if (const std::string difference = compare_errors(ours, first); !difference.empty())
    return {false, 0, 0, 0, difference};

  const std::string captured = compare_captures(ours, first);
  if (!captured.empty() && !compare_captures(ours, second).empty()) return {false, 0, 0, 0, captured};

  const int width = ours.picture.width;
  const auto colors = [&](const Outcome& a, const Outcome& b) {
    return explained(a.picture, b.picture, limits.levels);
  };
  count_wrong(wrong_pixels(ours, first, second, colors), limits.pixels, width, "", verdict);
  count_wrong(wrong_pixels(ours, first, second, explained_depth), limits.pixels, width, " in depth", verdict);
  count_wrong(wrong_pixels(ours, first, second, explained_stencil), limits.pixels, width, " in stencil",
              verdict);
  return verdict;
}

}  // namespace halfspace::fuzz
