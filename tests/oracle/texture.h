// Texture lookup, written down from spec 3.8.4 - 3.8.10 in long double.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "raster/api/texture.h"
#include "tests/oracle/interpolation.h"

namespace halfspace::oracle {

using Rgba = std::array<long double, 4>;  // in [0, 1]

// A level as glTexImage2D describes it: width x height texels within `border` texels on every side.
struct Level {
  int width = 0, height = 0, border = 0;
  std::vector<uint8_t> rgba;  // (width + 2 border) x (height + 2 border), bottom row first

  // i in [-border, width + border), j likewise.
  Rgba texel(int i, int j) const;
};

struct Texture {
  std::vector<Level> levels;  // [0] the base level
  raster::Sampler sampler;
  raster::BaseFormat base_format = raster::BaseFormat::rgba;
};

struct Lookup {
  Rgba color{};
  long double lod = 0;     // lambda of equation 3.18
  bool magnified = false;  // lambda <= c
  bool doubtful = false;   // rounding may decide which texel, level or filter is taken
};

// The texture at (s, t), each with its derivatives by window x and y.
Lookup sample(const Texture& texture, const Affine<long double>& s, const Affine<long double>& t);

// One level by one filter. *doubtful, if asked for, is set where rounding may decide which texel is taken.
Rgba sample_level(const Texture& texture, int level, raster::Filter filter, long double s, long double t,
                  bool* doubtful = nullptr);

}  // namespace halfspace::oracle
