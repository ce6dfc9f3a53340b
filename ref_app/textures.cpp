#include "ref_app/textures.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "ref_app/noise.h"

namespace ref_app {
namespace {

uint8_t to_byte(float x) { return static_cast<uint8_t>(clamp_unit(x) * 255.0F + 0.5F); }

// Calls color(x, y) for the centre of every texel; x and y in texels.
template <typename ColorOf>
Image paint(ColorOf color) {
  Image image{kTextureSize, kTextureSize, {}};
  image.rgba.reserve(static_cast<size_t>(kTextureSize) * kTextureSize * 4);
  for (int y = 0; y < kTextureSize; ++y) {
    for (int x = 0; x < kTextureSize; ++x) {
      const glm::vec3 c = color(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      image.rgba.insert(image.rgba.end(), {to_byte(c.r), to_byte(c.g), to_byte(c.b), 255});
    }
  }
  return image;
}

// Distance from x to the nearer edge of its cell of `size` texels.
float edge_distance(float x, float size) {
  const float inside = fraction(x / size) * size;
  return inside < size - inside ? inside : size - inside;
}

}  // namespace

Image make_brick() {
  constexpr float kWidth = 128, kHeight = 64;  // texels, mortar included
  return paint([](float x, float y) {
    const auto row = static_cast<uint32_t>(y / kHeight);
    const float shifted = x + ((row & 1) ? kWidth / 2 : 0.0F);
    const auto column = static_cast<uint32_t>(shifted / kWidth) % 2;
    const float across = edge_distance(shifted, kWidth), along = edge_distance(y, kHeight);
    const float brick = smooth_step(2.0F, 13.0F, across < along ? across : along);

    const float grain = fractal_noise(x / 32, y / 32, 8, 2, 11) - 0.5F;
    const glm::vec3 fired =
        glm::mix(glm::vec3(0.55F, 0.20F, 0.13F), glm::vec3(0.78F, 0.40F, 0.24F), hash_unit(column, row, 3));
    const glm::vec3 mortar(0.66F, 0.52F, 0.43F);
    return glm::mix(mortar, fired, brick) * (1.0F + 0.22F * grain);
  });
}

Image make_wood() {
  constexpr float kPlank = 128;  // texels
  return paint([](float x, float y) {
    const auto plank = static_cast<uint32_t>(x / kPlank);
    const float gap = smooth_step(1.0F, 11.0F, edge_distance(x, kPlank));
    // Grain: rings cut lengthwise, so they run long in y and are bent by a slow noise of the plank's own.
    const float bend = gradient_noise(x / 64, y / 128, 4, 2, 40 + plank);
    const float rings = smooth_wave(x / 32.0F + 1.5F * bend + 0.37F * static_cast<float>(plank));
    const float fibre = gradient_noise(x / 16, y / 128, 16, 2, 60) - 0.5F;
    const float tone = 0.86F + 0.24F * hash_unit(plank, 7, 5);
    const glm::vec3 wood = glm::mix(glm::vec3(0.70F, 0.46F, 0.26F), glm::vec3(0.58F, 0.36F, 0.19F), rings);
    return wood * (tone + 0.12F * fibre) * mix(0.55F, 1.0F, gap);
  });
}

Image make_marble() {
  return paint([](float x, float y) {
    const float turbulence = fractal_noise(x / 128, y / 128, 2, 3, 21);
    const float vein = smooth_wave((x + y) / kTextureSize + 2.4F * turbulence);
    const float thin = vein * vein * vein;
    const float cloud = fractal_noise(x / 128, y / 128, 2, 2, 33);
    const glm::vec3 stone = glm::mix(glm::vec3(0.88F, 0.90F, 0.92F), glm::vec3(0.98F, 0.96F, 0.92F), cloud);
    return glm::mix(stone, glm::vec3(0.24F, 0.34F, 0.42F), 0.42F * thin);
  });
}

Image make_checker() {
  constexpr float kCell = 128;  // texels
  return paint([](float x, float y) {
    const bool odd = ((static_cast<int>(x / kCell) + static_cast<int>(y / kCell)) & 1) != 0;
    const float across = edge_distance(x, kCell), along = edge_distance(y, kCell);
    // Half and half exactly on an edge between two cells, pure 10 texels away from it.
    const float nearest = across < along ? across : along;
    const float pure = 0.5F + 0.5F * smooth_step(0.0F, 10.0F, nearest);
    const glm::vec3 light(0.80F, 0.78F, 0.72F), dark(0.42F, 0.50F, 0.56F);
    const glm::vec3 color = glm::mix(odd ? light : dark, odd ? dark : light, pure);
    return color * (0.94F + 0.12F * fractal_noise(x / 64, y / 64, 4, 2, 70));
  });
}

}  // namespace ref_app
