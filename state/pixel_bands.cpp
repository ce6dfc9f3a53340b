#include "state/pixel_bands.h"

#include <cmath>

#include "state/context.h"

namespace halfspace::state {
namespace {

struct Range {
  int begin, end;
};

// Elements [begin, end) along one axis that may reach into [0, limit] pixels.
Range visible_range(double origin, double zoom, Range range, int limit) {
  if (zoom == 0 || !std::isfinite(zoom)) return {0, 0};
  const double a = -origin / zoom, b = (limit - origin) / zoom;
  const auto inside = [&](double v) { return int(std::clamp(v, double(range.begin), double(range.end))); };
  return {inside(std::floor(std::min(a, b)) - 1), inside(std::ceil(std::max(a, b)) + 1)};
}

}  // namespace

raster::Rect visible_part(const Context& context, const raster::PixelPacket& packet,
                          const raster::Rect& part) {
  if (!context.drawable || part.empty()) return {};
  const Range x = visible_range(packet.x, packet.zoom_x, {part.x0, part.x1}, context.drawable->width());
  const Range y = visible_range(packet.y, packet.zoom_y, {part.y0, part.y1}, context.drawable->height());
  return {x.begin, y.begin, x.end, y.end};
}

}  // namespace halfspace::state
