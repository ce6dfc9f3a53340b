// Points and lines (spec 3.3, 3.4). Their places are on the grid whatever is asked of polygons.
#include <algorithm>

#include "tests/oracle/area.h"
#include "tests/oracle/assembly.h"
#include "tests/oracle/line.h"

namespace halfspace::oracle {
namespace {

constexpr Real kLeastCoverage = 1e-6L;

// Spec 3.3, 3.4.2.1: a size that is not smooth is rounded to the nearest whole one, and is at least 1.
int whole_size(float size, float most) {
  return size >= 1 ? static_cast<int>(std::floor(std::min(real(size), real(most)) + 0.5L)) : 1;
}
// A smooth one to the granularity.
Real smooth_size(float size, float most) {
  const Real step = real(raster::kSizeGranularity);
  return size >= 1 ? std::floor(std::min(real(size), real(most)) / step + 0.5L) * step : 1;
}

Place<Wide> widened(const Place<int64_t>& p) { return {wide(p.x), wide(p.y)}; }
Point in_pixels(const Place<int64_t>& p) { return {real(p.x) / 256, real(p.y) / 256}; }

}  // namespace

void Assembly::line(Corner a, Corner b, const Side& side) {
  Corner ends[2] = {a, b};
  const bool smooth = state_.line.smooth;
  if (volume_.rejects(ends, 2) || !volume_.cut(ends, smooth)) return;
  const Place<int64_t> at[2] = {snapped_place_of(ends[0], state_.viewport),
                                snapped_place_of(ends[1], state_.viewport)};
  if (at[0].x == at[1].x && at[0].y == at[1].y) return;
  // Values belong to the ends as they are, unless half a sub-pixel changes the line too much.
  const Place<Wide> true_at[2] = {place_of(ends[0], state_.viewport), place_of(ends[1], state_.viewport)};
  const bool leaves_grid = line_may_leave_grid(ends[0], ends[1], state_.viewport);
  const bool wide_line = !smooth && whole_size(state_.line.width, raster::kMaxLineWidth) > 1;
  Surface surface = Surface::of_line(ends[0], ends[1], leaves_grid ? true_at[0] : widened(at[0]),
                                     leaves_grid ? true_at[1] : widened(at[1]), wide_line, state_.viewport);
  surface.add_depth(side.offset);
  if (smooth)
    smooth_line(at, surface);
  else
    plain_line(at, surface);
}

// Spec 3.4.2.1: a wide line is moved by (width - 1) / 2 along the minor axis, and each fragment replicated
// there. Spec 3.4.2.2: bit floor(s / repeat) mod 16 of the pattern decides over fragment s.
void Assembly::plain_line(const Place<int64_t> (&at)[2], const Surface& surface) {
  const raster::LineState& state = state_.line;
  const int width = whole_size(state.width, raster::kMaxLineWidth);
  const bool x_major = is_x_major(at[0], at[1]);
  const int64_t shift = int64_t{width - 1} * 128;
  Place<int64_t> a = at[0], b = at[1];
  (x_major ? a.y : a.x) -= shift, (x_major ? b.y : b.x) -= shift;
  // The middle of the line is clipped to the view volume; what is replicated may reach beyond.
  const raster::Viewport& v = state_.viewport;
  const raster::Rect middle{v.x, v.y, v.x + v.width, v.y + v.height}, all = painter_.window();
  const std::vector<LinePixel> pixels = line_pixels(a, b);
  const auto start = static_cast<uint32_t>(progress_.stipple);
  for (uint32_t i = 0; i < pixels.size(); ++i) {
    const uint32_t s = (start + i) / static_cast<uint32_t>(state.repeat);
    if (state.stipple && (state.pattern >> (s % 16) & 1) == 0) continue;
    const int mx = pixels[i].x + (x_major ? 0 : (width - 1) / 2),
              my = pixels[i].y + (x_major ? (width - 1) / 2 : 0);
    if (mx < middle.x0 || mx >= middle.x1 || my < middle.y0 || my >= middle.y1) continue;
    for (int k = 0; k < width; ++k) {
      const int x = pixels[i].x + (x_major ? 0 : k), y = pixels[i].y + (x_major ? k : 0);
      if (x >= all.x0 && x < all.x1 && y >= all.y0 && y < all.y1) painter_.paint(x, y, surface);
    }
  }
  progress_.stipple += static_cast<Real>(pixels.size());
}

// Spec 3.4.2.3: the rectangle around the segment; with a stipple, a rectangle for each element that is set.
void Assembly::smooth_line(const Place<int64_t> (&at)[2], const Surface& surface) {
  const raster::LineState& state = state_.line;
  const Point a = in_pixels(at[0]), b = in_pixels(at[1]);
  const Real length = std::hypot(b.x - a.x, b.y - a.y),
             half = smooth_size(state.width, raster::kMaxLineWidth) / 2;
  const Real ux = (b.x - a.x) / length, uy = (b.y - a.y) / length;
  const auto part = [&](Real from, Real to) {
    const Point p{a.x + ux * from, a.y + uy * from}, q{a.x + ux * to, a.y + uy * to};
    const Real nx = -uy * half, ny = ux * half;
    return std::vector<Point>{
        {p.x - nx, p.y - ny}, {q.x - nx, q.y - ny}, {q.x + nx, q.y + ny}, {p.x + nx, p.y + ny}};
  };
  std::vector<std::vector<Point>> parts;
  const Real start = progress_.stipple, repeat = state.repeat;
  if (!state.stipple) parts.push_back(part(0, length));
  for (Real k = std::floor(start / repeat); state.stipple && k * repeat < start + length; ++k) {
    const Real from = std::max(k * repeat - start, 0.0L), to = std::min((k + 1) * repeat - start, length);
    if ((state.pattern >> static_cast<unsigned>(std::fmod(k, 16)) & 1) != 0 && from < to)
      parts.push_back(part(from, to));
  }
  progress_.stipple += std::floor(length * 256 + 0.5L) / 256;
  const raster::Rect box = painter_.window();
  const Real reach = half + 1;
  const auto pixel = [](Real v, int low, int high) {
    return static_cast<int>(held(std::floor(v), real(low), real(high)));
  };
  const int x0 = pixel(std::min(a.x, b.x) - reach, box.x0, box.x1),
            x1 = pixel(std::max(a.x, b.x) + reach + 1, box.x0, box.x1);
  const int y0 = pixel(std::min(a.y, b.y) - reach, box.y0, box.y1),
            y1 = pixel(std::max(a.y, b.y) + reach + 1, box.y0, box.y1);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      Real area = 0;
      for (const std::vector<Point>& shape : parts) area += polygon_area_in_pixel(shape, x, y);
      if (area >= kLeastCoverage) painter_.paint(x, y, surface, std::min(area, 1.0L));
    }
  }
}

// Spec 3.3: a square of whole pixels, around the middle of the pixel the point lies in where the size is odd,
// around the nearest corner of pixels where it is even; or a disc (spec 3.3.1).
void Assembly::point(const Corner& corner, const Side& side) {
  if (!(corner.w > 0)) return;
  Surface surface = Surface::of_point(corner, state_.viewport);
  surface.add_depth(side.offset);
  const Place<int64_t> at = snapped_place_of(corner, state_.viewport);
  const bool smooth = state_.point.smooth;
  const int size = whole_size(state_.point.size, raster::kMaxPointSize);
  const Real radius = smooth_size(state_.point.size, raster::kMaxPointSize) / 2;
  const raster::Rect box = !smooth && size == 1 ? painter_.bounds() : painter_.window();
  const auto floor_pixel = [](int64_t v) { return static_cast<int>(v >> 8); };
  raster::Rect square;
  if (smooth) {
    const int reach = static_cast<int>(radius) + 2, x = floor_pixel(at.x), y = floor_pixel(at.y);
    square = intersect(box, {x - reach, y - reach, x + reach + 1, y + reach + 1});
  } else {
    const int64_t even = size % 2 == 0 ? 128 : 0;
    const int x = floor_pixel(at.x + even) - size / 2, y = floor_pixel(at.y + even) - size / 2;
    square = intersect(box, {x, y, x + size, y + size});
  }
  for (int y = square.y0; y < square.y1; ++y) {
    for (int x = square.x0; x < square.x1; ++x) {
      const Real part = smooth ? disc_area_in_pixel(in_pixels(at), radius, x, y) : 1;
      if (part >= kLeastCoverage) painter_.paint(x, y, surface, part);
    }
  }
}

}  // namespace halfspace::oracle
