#include "tests/oracle/outline.h"

namespace halfspace::oracle {
namespace {

constexpr int64_t kBandLow = -8192 * 256,
                  kBandHigh = 24576 * 256 - 1;  // snapped coordinates are held to these

Wide middle(int origin, int size) { return wide(origin) * 256 + wide(size) * 128; }
Wide from_middle(Wide clip, Wide w, int size) { return clip / w * wide(size) * 128; }

int64_t snapped(Wide clip, Wide w, int origin, int size) {
  const Wide v = from_middle(clip, w, size) + wide(0.5);
  const Wide far = wide(1e12);
  return held(floor_of(held(v, -far, far)) + static_cast<int64_t>(middle(origin, size)), kBandLow, kBandHigh);
}

}  // namespace

Place<Wide> place_of(const Corner& c, const raster::Viewport& v) {
  return {middle(v.x, v.width) + from_middle(c.x, c.w, v.width),
          middle(v.y, v.height) + from_middle(c.y, c.w, v.height)};
}

Place<int64_t> snapped_place_of(const Corner& c, const raster::Viewport& v) {
  return {snapped(c.x, c.w, v.x, v.width), snapped(c.y, c.w, v.y, v.height)};
}

}  // namespace halfspace::oracle
