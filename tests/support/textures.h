// One texture twice: as the raster room holds it and as the oracle does.
#pragma once

#include <memory>

#include "tests/oracle/texture.h"
#include "tests/support/random.h"

namespace halfspace::test {

class TestTexture {
 public:
  explicit TestTexture(raster::BaseFormat format = raster::BaseFormat::rgba) : format_(format) {}

  // Appends a level. rgba as Texture::define_level takes it; components the format lacks are filled in here.
  void add_level(int width, int height, int border, std::vector<uint8_t> rgba);
  void add_noise(Random& random, int width, int height, int border = 0);
  void add_color(int width, int height, const uint8_t rgba[4]);

  raster::BaseFormat format() const { return format_; }
  std::shared_ptr<const raster::TextureView> view(const raster::Sampler& sampler);
  oracle::Texture reference(const raster::Sampler& sampler) const { return {levels_, sampler}; }

 private:
  raster::BaseFormat format_;
  std::vector<oracle::Level> levels_;
  std::shared_ptr<raster::Texture> texture_ = std::make_shared<raster::Texture>();
};

// Spec 3.6.4, table 3.15: the texel that storing (r, g, b, a) in a format leaves, by the rules define_level
// states.
void keep_components(raster::BaseFormat format, uint8_t rgba[4]);

raster::Sampler sampler_of(raster::Filter filter, raster::Wrap wrap,
                           raster::MipMode mip = raster::MipMode::none);

}  // namespace halfspace::test
