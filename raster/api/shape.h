// How points, lines and polygons turn into fragments (spec 3.3, 3.4, 3.5).
#pragma once

#include <array>
#include <optional>

#include "raster/api/accuracy.h"
#include "raster/api/types.h"

namespace halfspace::raster {

struct PointState {
  float size = 1;  // pixels, > 0; clamped to [1, kMaxPointSize] where it is used
  bool smooth = false;
  std::optional<Level> coverage = {};  // of smooth ones, in place of Accuracy::coverage
  bool operator==(const PointState&) const = default;
};

struct LineState {
  float width = 1;  // pixels, > 0; clamped to [1, kMaxLineWidth] where it is used
  bool smooth = false;
  bool stipple = false;
  uint16_t pattern = 0xffff;  // lowest bit first
  int repeat = 1;             // 1 .. 256
  std::optional<Level> coverage = {};
  bool operator==(const LineState&) const = default;
};

enum class PolygonMode : uint8_t { point, line, fill };

struct PolygonState {
  PolygonMode front = PolygonMode::fill, back = PolygonMode::fill;
  bool smooth = false;
  bool stipple = false;
  std::array<uint32_t, 32> pattern{};  // [y % 32], bit 31 - x % 32: a fragment is made
  bool offset_fill = false, offset_line = false, offset_point = false;
  float offset_factor = 0, offset_units = 0;
  std::optional<Level> coverage = {};
  bool operator==(const PolygonState&) const = default;
};

inline constexpr float kMaxPointSize = 256, kMaxLineWidth = 256;  // pixels, aliased and smooth
inline constexpr double kSizeGranularity = 0.125;                  // pixels: smooth sizes are rounded to these

}  // namespace halfspace::raster
