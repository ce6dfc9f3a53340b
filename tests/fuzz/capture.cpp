#include "capture.h"

#include <GL/gl.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>

namespace halfspace::fuzz {
namespace {

struct Hit {
  uint32_t low = 0, high = 0;
  std::vector<uint32_t> names;
};

std::vector<Hit> read_hits(const Capture& capture) {
  std::vector<Hit> hits;
  const auto& words = capture.words;
  for (size_t at = 0; at + 3 <= words.size();) {
    const size_t end = std::min(words.size(), at + 3 + words[at]);
    hits.push_back({words[at + 1],
                    words[at + 2],
                    {words.begin() + static_cast<std::ptrdiff_t>(at + 3),
                     words.begin() + static_cast<std::ptrdiff_t>(end)}});
    at = end;
  }
  return hits;
}

std::string compare_hits(const Capture& ours, const Capture& theirs) {
  const std::vector<Hit> a = read_hits(ours), b = read_hits(theirs);
  if (a.size() != b.size())
    return "hits: ours " + std::to_string(a.size()) + ", theirs " + std::to_string(b.size());
  const auto near = [](uint32_t x, uint32_t y) { return (x > y ? x - y : y - x) <= 1u << 20; };
  for (size_t i = 0; i < a.size(); ++i) {
    const std::string which = " of hit " + std::to_string(i) + " differ";
    if (a[i].names != b[i].names) return "names" + which;
    if (!near(a[i].low, b[i].low) || !near(a[i].high, b[i].high)) return "depths" + which;
  }
  return "";
}

// x y (z (w)), colour, texture coordinates.
using Corner = std::vector<double>;

// Neighbouring polygons are one item.
struct Item {
  uint32_t token = 0;
  std::vector<Corner> corners;
  double value = 0;                  // of a marker
  double area = 0, moments[2] = {};  // of polygons
};

size_t corner_size(uint32_t type) {
  switch (type) {
    case GL_2D:
      return 2;
    case GL_3D:
      return 3;
    case GL_3D_COLOR:
      return 7;
    case GL_3D_COLOR_TEXTURE:
      return 11;
    default:
      return 12;
  }
}

void add_area(Item& item, const std::vector<Corner>& v) {
  for (size_t i = 1; i + 1 < v.size(); ++i) {
    const Corner &a = v[0], &b = v[i], &c = v[i + 1];
    const double area = ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2;
    item.area += area;
    for (size_t k = 0; k < 2; ++k) item.moments[k] += area * (a[k] + b[k] + c[k]) / 3;
  }
}

class Reader {
 public:
  explicit Reader(const Capture& capture) : capture_(capture), size_(corner_size(capture.type)) {}

  std::vector<Item> read() {
    std::vector<Item> items;
    while (at_ < capture_.words.size()) {
      const auto token = static_cast<uint32_t>(number());
      if (token == GL_POLYGON_TOKEN)
        add_polygon(items);
      else
        items.push_back(read_item(token));
    }
    return items;
  }

 private:
  double number() {
    return at_ < capture_.words.size() ? double(std::bit_cast<float>(capture_.words[at_++])) : 0;
  }
  Corner corner() {
    Corner corner(size_);
    for (double& c : corner) c = number();
    return corner;
  }
  Item read_item(uint32_t token) {
    // Mesa does not tell of each line where its stipple starts anew.
    if (token == GL_LINE_RESET_TOKEN) token = GL_LINE_TOKEN;
    const bool line = token == GL_LINE_TOKEN;
    Item item{token, {}};
    if (token == GL_PASS_THROUGH_TOKEN)
      item.value = number();
    else
      for (int i = 0; i < (line ? 2 : 1); ++i) item.corners.push_back(corner());
    return item;
  }
  void add_polygon(std::vector<Item>& items) {
    if (items.empty() || items.back().token != GL_POLYGON_TOKEN) items.push_back({GL_POLYGON_TOKEN, {}});
    std::vector<Corner> corners(static_cast<size_t>(std::clamp(number(), 0.0, 1000.0)));
    for (Corner& c : corners) c = corner();
    Item& item = items.back();
    add_area(item, corners);
    item.corners.insert(item.corners.end(), corners.begin(), corners.end());
  }

  const Capture& capture_;
  size_t size_, at_ = 0;
};

bool near(const Corner& a, const Corner& b) {
  for (size_t i = 0; i < a.size(); ++i) {
    const double limit = i < 2 ? 1.0 / 32 : std::max(std::fabs(a[i]), 1.0) / 64;
    if (!(std::fabs(a[i] - b[i]) <= limit)) return false;
  }
  return true;
}

bool same_polygons(const Item& ours, const Item& theirs) {
  if (std::fabs(ours.area - theirs.area) > 4) return false;
  for (size_t k = 0; k < 2; ++k) {
    if (std::fabs(ours.moments[k] - theirs.moments[k]) > 4 * 96) return false;
  }
  return std::all_of(ours.corners.begin(), ours.corners.end(), [&](const Corner& c) {
    return std::any_of(theirs.corners.begin(), theirs.corners.end(),
                       [&](const Corner& other) { return near(c, other); });
  });
}

bool same(const Item& ours, const Item& theirs) {
  if (ours.token != theirs.token || ours.value != theirs.value) return false;
  if (ours.token == GL_POLYGON_TOKEN) return same_polygons(ours, theirs);
  return std::equal(ours.corners.begin(), ours.corners.end(), theirs.corners.begin(), theirs.corners.end(),
                    near);
}

std::string text_of(const std::vector<Item>& items, size_t i) {
  if (i >= items.size()) return "nothing";
  char text[64];
  std::snprintf(text, sizeof(text), "%x", items[i].token);
  std::string all = text;
  for (const Corner& corner : items[i].corners) {
    all += " |";
    for (double c : corner) std::snprintf(text, sizeof(text), " %.7g", c), all += text;
  }
  return all;
}

std::string compare_feedback(const Capture& ours, const Capture& theirs) {
  const std::vector<Item> a = Reader(ours).read(), b = Reader(theirs).read();
  for (size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    if (i >= a.size() || i >= b.size() || !same(a[i], b[i]))
      return "feedback: ours " + text_of(a, i) + ", theirs " + text_of(b, i);
  }
  return "";
}

}  // namespace

std::string compare(const Capture& ours, const Capture& theirs) {
  const std::string at = " (call " + std::to_string(ours.call) + ")";
  if (ours.call != theirs.call || ours.mode != theirs.mode) return "another render mode ends" + at;
  // Whether all fits depends on how polygons are cut; what is left of it is not looked at.
  if (ours.mode == GL_FEEDBACK && (ours.result < 0 || theirs.result < 0)) return "";
  if ((ours.result < 0) != (theirs.result < 0)) return "one buffer overflows" + at;
  const std::string difference =
      ours.mode == GL_SELECT ? compare_hits(ours, theirs) : compare_feedback(ours, theirs);
  return difference.empty() ? "" : difference + at;
}

}  // namespace halfspace::fuzz
