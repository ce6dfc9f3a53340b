#include "tests/support/textures.h"

#include <utility>

namespace halfspace::test {

using namespace raster;

void keep_components(BaseFormat format, uint8_t rgba[4]) {
  switch (format) {
    case BaseFormat::alpha:
      rgba[0] = rgba[1] = rgba[2] = 0;
      break;
    case BaseFormat::luminance:
      rgba[1] = rgba[2] = rgba[0];
      rgba[3] = 255;
      break;
    case BaseFormat::luminance_alpha:
      rgba[1] = rgba[2] = rgba[0];
      break;
    case BaseFormat::intensity:
      rgba[1] = rgba[2] = rgba[3] = rgba[0];
      break;
    case BaseFormat::rgb:
      rgba[3] = 255;
      break;
    case BaseFormat::rgba:
      break;
  }
}

void TestTexture::add_level(int width, int height, int border, std::vector<uint8_t> rgba) {
  for (size_t i = 0; i < rgba.size(); i += 4) keep_components(format_, &rgba[i]);
  const int level = int(levels_.size());
  texture_->define_level(level, width, height, border, format_, rgba.data(), 4 * size_t(width + 2 * border));
  levels_.push_back({width, height, border, std::move(rgba)});
}

void TestTexture::add_noise(Random& random, int width, int height, int border) {
  std::vector<uint8_t> rgba(4 * size_t(width + 2 * border) * size_t(height + 2 * border));
  for (uint8_t& component : rgba) component = uint8_t(random.bits());
  add_level(width, height, border, std::move(rgba));
}

void TestTexture::add_color(int width, int height, const uint8_t color[4]) {
  std::vector<uint8_t> rgba;
  for (int i = 0; i < width * height; ++i) rgba.insert(rgba.end(), color, color + 4);
  add_level(width, height, 0, std::move(rgba));
}

std::shared_ptr<const TextureView> TestTexture::view(const Sampler& sampler) {
  return texture_->view(sampler, int(levels_.size()));
}

Sampler sampler_of(Filter filter, Wrap wrap, MipMode mip) {
  Sampler sampler;
  sampler.mag = sampler.min = filter;
  sampler.mip = mip;
  sampler.wrap_s = sampler.wrap_t = wrap;
  return sampler;
}

}  // namespace halfspace::test
