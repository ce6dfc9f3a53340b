// Where corners lie in the window, and which pixel centres a polygon of them holds, exactly.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tests/oracle/corner.h"

namespace halfspace::oracle {

// Window coordinates in 1/256 px, y up: integers where corners are snapped, else as they are.
template <class T>
struct Place {
  T x, y;
};
template <class T>
using Outline = std::vector<Place<T>>;

// Spec 2.11.1, unrounded, in 1/256 px.
Place<Wide> place_of(const Corner& corner, const raster::Viewport& viewport);
// Rounded to the grid: floor(v + 1/2), counted from the viewport's middle so that a picture does not change
// when the viewport moves by whole pixels.
Place<int64_t> snapped_place_of(const Corner& corner, const raster::Viewport& viewport);

template <class T>
T twice_area(const Outline<T>& p) {
  T area = 0;
  for (size_t i = 1; i + 1 < p.size(); ++i)
    area += (p[i].x - p[0].x) * (p[i + 1].y - p[0].y) - (p[i].y - p[0].y) * (p[i + 1].x - p[0].x);
  return area;
}

// How often the outline goes around the centre of pixel (px, py), or rather around a point that lies by an
// infinitesimal e to the right of it and by e^2 below: so a centre on an edge two polygons share belongs to
// one of them (spec 3.5.1), to the one whose left or top edge it is. Snapped corners stay within 2^23, so
// that products fit.
template <class T>
int winding(const Outline<T>& p, int px, int py) {
  const T x = T(px) * 256 + 128, y = T(py) * 256 + 128;
  int around = 0;
  for (size_t i = 0; i < p.size(); ++i) {
    const Place<T>&a = p[i], &b = p[i + 1 < p.size() ? i + 1 : 0];
    if ((a.y < y) == (b.y < y)) continue;  // the ray to the right, at y - e^2, cannot meet it
    const T side = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
    if (a.y < y && side > 0) ++around;
    if (b.y < y && side < 0) --around;
  }
  return around;
}

// visit(px, py) for the pixels of `bounds` that the outline holds.
template <class T, class Visit>
void for_pixels_inside(const Outline<T>& outline, const raster::Rect& bounds, Visit visit) {
  if (outline.empty() || bounds.empty()) return;
  T left = outline[0].x, right = left, low = outline[0].y, high = low;
  for (const Place<T>& p : outline) {
    left = p.x < left ? p.x : left, right = p.x > right ? p.x : right;
    low = p.y < low ? p.y : low, high = p.y > high ? p.y : high;
  }
  // A pixel more than it takes on every side.
  const auto pixel = [](T v, int least, int most) {
    const T p = v / 256;
    return p < T(least) ? least : p > T(most) ? most : static_cast<int>(p);
  };
  const int x0 = pixel(left - 512, bounds.x0, bounds.x1), x1 = pixel(right + 512, bounds.x0, bounds.x1);
  const int y0 = pixel(low - 512, bounds.y0, bounds.y1), y1 = pixel(high + 512, bounds.y0, bounds.y1);
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      if (winding(outline, x, y) != 0) visit(x, y);
}

}  // namespace halfspace::oracle
