// How exact, against how fast: a dial for each thing that can be done more or less exactly. docs/numerics.md
// says what each level does and how far off it may be. No level touches which pixels a primitive covers, or
// their depth.
#pragma once

#include <cstdint>

namespace halfspace::raster {

enum class Level : uint8_t { draft, standard, exact };

struct Accuracy {
  Level perspective = Level::standard;    // the divide by w
  Level interpolation = Level::standard;  // planes of what varies, and colours on their way to memory
  Level filter = Level::standard;         // weights and sums of a texture's filter
  Level lod = Level::standard;            // the level-of-detail parameter
  Level fog = Level::standard;            // the exponential
  Level power = Level::standard;          // of specular highlights and spotlights
  Level transform =
      Level::standard;               // of normals and texture coordinates, and lighting; positions always are
  Level coverage = Level::standard;  // of the pixels at a smooth shape's edge

  static constexpr Accuracy all(Level level) {
    return {level, level, level, level, level, level, level, level};
  }
  bool operator==(const Accuracy&) const = default;
};

struct AccuracyAxis {
  const char* name;
  Level Accuracy::*level;
};

// All of them, in the order above.
inline constexpr AccuracyAxis kAccuracyAxes[] = {
    {"perspective", &Accuracy::perspective},
    {"interpolation", &Accuracy::interpolation},
    {"filter", &Accuracy::filter},
    {"lod", &Accuracy::lod},
    {"fog", &Accuracy::fog},
    {"power", &Accuracy::power},
    {"transform", &Accuracy::transform},
    {"coverage", &Accuracy::coverage},
};
inline constexpr const char* kLevelNames[] = {"draft", "standard", "exact"};

}  // namespace halfspace::raster
