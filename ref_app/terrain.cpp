#include "ref_app/terrain.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "ref_app/noise.h"
#include "ref_app/shapes.h"

namespace ref_app {
namespace {

constexpr int kQuads = 256;           // along a side of the mesh
constexpr float kTextureRelief = 34;  // height of the whole range in map pixels, for the light on the texture

// Heights in [0, 1], smoothed: a map of 8 bits has steps that light would show.
struct HeightField {
  int width, height;
  std::vector<float> values;

  const float* row(int y) const {
    return &values[static_cast<size_t>(std::clamp(y, 0, height - 1)) * static_cast<size_t>(width)];
  }
};

// One pass of 1 4 6 4 1 along x, transposing, so that two passes smooth both ways.
HeightField smooth_and_transpose(const HeightField& in) {
  HeightField out{in.height, in.width, std::vector<float>(in.values.size())};
  for (int y = 0; y < in.height; ++y) {
    const float* row = in.row(y);
    const auto at = [&](int x) { return row[std::clamp(x, 0, in.width - 1)]; };
    for (int x = 0; x < in.width; ++x) {
      const float sum = at(x - 2) + at(x + 2) + 4 * (at(x - 1) + at(x + 1)) + 6 * at(x);
      out.values[static_cast<size_t>(x) * static_cast<size_t>(in.height) + static_cast<size_t>(y)] =
          sum * 0.0625F;
    }
  }
  return out;
}

HeightField height_field(const Image& map) {
  HeightField field{map.width, map.height, std::vector<float>(map.rgba.size() / 4)};
  for (size_t i = 0; i < field.values.size(); ++i) {
    field.values[i] = static_cast<float>(map.rgba[i * 4]) * (1.0F / 255.0F);
  }
  for (int pass = 0; pass < 4; ++pass) field = smooth_and_transpose(field);
  return field;
}

// Uniform cubic B-spline. Weights of the four neighbours, t in [0,
// 1).
struct SplineWeights {
  std::array<float, 4> value, slope;
};
SplineWeights spline_weights(float t) {
  const float s = 1 - t, sixth = 1.0F / 6.0F;
  return {{s * s * s * sixth, (3 * t * t * t - 6 * t * t + 4) * sixth,
           (3 * s * s * s - 6 * s * s + 4) * sixth, t * t * t * sixth},
          {-0.5F * s * s, 1.5F * t * t - 2 * t, -1.5F * s * s + 2 * s, 0.5F * t * t}};
}

// Slow variation of the ground's colour, in [0, 1].
HeightField ground_patches() {
  HeightField field{kHeightMapSize, kHeightMapSize, {}};
  for (int y = 0; y < kHeightMapSize; ++y) {
    for (int x = 0; x < kHeightMapSize; ++x) {
      field.values.push_back(
          fractal_noise(static_cast<float>(x) / 16, static_cast<float>(y) / 16, 16, 3, 77));
    }
  }
  return field;
}

// One row across a height map, y fixed: heights and their slope along y at every map column.
class SplineRow {
 public:
  // y in map pixels, 0 the first row's centre; beyond the map its edge goes on.
  SplineRow(const HeightField& field, float y)
      : height_(static_cast<size_t>(field.width)), slope_(height_.size()) {
    const auto cell = static_cast<int>(y + 1) - 1;  // floor for y > -1
    const SplineWeights weights = spline_weights(y - static_cast<float>(cell));
    for (int k = 0; k < 4; ++k) {
      const float* row = field.row(cell + k - 1);
      for (size_t x = 0; x < height_.size(); ++x) {
        height_[x] += weights.value[static_cast<size_t>(k)] * row[x];
        slope_[x] += weights.slope[static_cast<size_t>(k)] * row[x];
      }
    }
  }

  struct Sample {
    float height, slope_x, slope_y;  // slopes in full ranges a map pixel
  };
  Sample at(float x) const {
    const auto cell = static_cast<int>(x + 1) - 1;
    const SplineWeights weights = spline_weights(x - static_cast<float>(cell));
    Sample sample{0, 0, 0};
    for (int k = 0; k < 4; ++k) {
      const auto i = static_cast<size_t>(std::clamp(cell + k - 1, 0, static_cast<int>(height_.size()) - 1));
      const auto w = static_cast<size_t>(k);
      sample.height += weights.value[w] * height_[i];
      sample.slope_x += weights.slope[w] * height_[i];
      sample.slope_y += weights.value[w] * slope_[i];
    }
    return sample;
  }

 private:
  std::vector<float> height_, slope_;
};

// x and y from 0 to 1 across the map, y up.
float height_at(float x, float y) {
  const float land = fractal_noise(x * 3, y * 3, 3, 3, 105);
  const float crests = ridged_noise(x * 4, y * 4, 4, 5, 207);
  const float mountainous = smooth_step(0.30F, 0.75F, land);
  return 0.60F * land + 0.75F * mountainous * crests * crests;
}

glm::vec3 ground_color(float height, float steepness, float patch) {
  const glm::vec3 meadow = glm::mix(glm::vec3(0.24F, 0.42F, 0.14F), glm::vec3(0.46F, 0.52F, 0.20F), patch);
  const glm::vec3 rock = glm::mix(glm::vec3(0.40F, 0.36F, 0.32F), glm::vec3(0.56F, 0.50F, 0.44F), patch);
  const glm::vec3 snow(0.95F, 0.97F, 1.0F);
  const float rocky = smooth_step(0.25F, 1.0F, steepness + 0.5F * height + 0.3F * (patch - 0.5F));
  const float snowy =
      smooth_step(0.36F, 0.62F, height + 0.12F * (patch - 0.5F)) * (1 - smooth_step(0.7F, 1.6F, steepness));
  return glm::mix(glm::mix(meadow, rock, rocky), snow, snowy);
}

uint8_t to_byte(float x) { return static_cast<uint8_t>(clamp_unit(x) * 255.0F + 0.5F); }

}  // namespace

Image make_height_map() {
  constexpr size_t kPixels = size_t{kHeightMapSize} * kHeightMapSize;
  std::vector<float> heights(kPixels);
  for (size_t i = 0; i < kPixels; ++i) {
    heights[i] = height_at((static_cast<float>(i % kHeightMapSize) + 0.5F) / kHeightMapSize,
                           (static_cast<float>(i / kHeightMapSize) + 0.5F) / kHeightMapSize);
  }
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  Image map{kHeightMapSize, kHeightMapSize, std::vector<uint8_t>(kPixels * 4)};
  for (size_t i = 0; i < kPixels; ++i) {
    // Valleys flatten out, peaks stay.
    const float range = (heights[i] - *low) / (*high - *low);
    const uint8_t level = to_byte(range * mix(0.45F, 1.0F, range));
    std::fill_n(&map.rgba[i * 4], 3, level);
    map.rgba[i * 4 + 3] = 255;
  }
  return map;
}

Image make_terrain_texture(const Image& heights) {
  constexpr int kSize = kTerrainTextureSize;
  Image image{kSize, kSize, std::vector<uint8_t>(size_t{kSize} * kSize * 4)};
  uint8_t* texel = image.rgba.data();
  const HeightField field = height_field(heights), patches = ground_patches();
  constexpr float kPatch = static_cast<float>(kHeightMapSize) / kSize;
  const glm::vec3 light = light_direction();
  const float map_x = static_cast<float>(heights.width) / kSize,
              map_y = static_cast<float>(heights.height) / kSize;
  for (int y = 0; y < kSize; ++y) {
    const SplineRow row(field, (static_cast<float>(y) + 0.5F) * map_y - 0.5F);
    const SplineRow patch_row(patches, (static_cast<float>(y) + 0.5F) * kPatch - 0.5F);
    for (int x = 0; x < kSize; ++x, texel += 4) {
      const SplineRow::Sample h = row.at((static_cast<float>(x) + 0.5F) * map_x - 0.5F);
      // t grows towards -z, so the slope along the map's y counts the other way in z.
      const glm::vec3 slope(-h.slope_x * kTextureRelief, 1.0F, h.slope_y * kTextureRelief);
      const float lit = glm::dot(glm::normalize(slope), light);
      const float steepness = glm::length(glm::vec2(slope.x, slope.z));
      const float patch = patch_row.at((static_cast<float>(x) + 0.5F) * kPatch - 0.5F).height;
      const glm::vec3 color =
          ground_color(h.height, steepness, patch) * (0.28F + 0.85F * (lit < 0 ? 0.0F : lit));
      texel[0] = to_byte(color.r), texel[1] = to_byte(color.g), texel[2] = to_byte(color.b), texel[3] = 255;
    }
  }
  return image;
}

Geometry make_terrain(const Image& heights, float height) {
  const HeightField field = height_field(heights);
  Geometry mesh;
  constexpr uint32_t kSide = kQuads + 1;
  mesh.vertices.reserve(size_t{kSide} * kSide);
  mesh.indices.reserve(size_t{kTerrainTriangles} * 3);
  for (uint32_t row = 0; row < kSide; ++row) {
    const float v = static_cast<float>(row) / kQuads;
    const SplineRow line(field, v * static_cast<float>(heights.height) - 0.5F);
    for (uint32_t column = 0; column < kSide; ++column) {
      const float u = static_cast<float>(column) / kQuads;
      const float y = height * line.at(u * static_cast<float>(heights.width) - 0.5F).height;
      mesh.vertices.push_back({{2 * u - 1, y, 1 - 2 * v, 1.0F}, glm::vec4(1.0F), {u, v}});
    }
  }
  for (uint32_t row = 0; row < kQuads; ++row) {
    for (uint32_t column = 0; column < kQuads; ++column) {
      const uint32_t i = row * kSide + column;
      for (const uint32_t k : {i, i + 1, i + kSide + 1, i, i + kSide + 1, i + kSide})
        mesh.indices.push_back(k);
    }
  }
  return mesh;
}

}  // namespace ref_app
