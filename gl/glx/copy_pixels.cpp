#include "gl/glx/copy_pixels.h"

#include <array>
#include <memory>

#include "raster/api/device.h"

namespace halfspace::gl::glx {

using namespace raster;

// The renderer takes pixels in as textures: one texel a pixel, nearest, replacing, both ends exact in 8 bits.
void copy_pixels(Framebuffer& target, ColorPlane plane, const uint8_t* rgba) {
  const int width = target.width(), height = target.height();
  Texture texture;
  texture.define_level(0, width, height, 0, BaseFormat::rgba, rgba, size_t(width) * 4);
  Sampler sampler;
  sampler.mag = sampler.min = Filter::nearest;
  sampler.mip = MipMode::none;
  sampler.wrap_s = sampler.wrap_t = Wrap::clamp_to_edge;

  auto state = std::make_shared<DrawState>();
  state->viewport = {0, 0, width, height, 0, 1};
  state->texture.view = texture.view(sampler, 1);
  state->texture.env = EnvMode::replace;
  state->color_targets = plane;

  constexpr std::array<float, 8> kPositions{-1, -1, 1, -1, 1, 1, -1, 1};
  constexpr std::array<float, 8> kTexCoords{0, 0, 1, 0, 1, 1, 0, 1};
  DrawPacket packet;
  packet.state = state;
  packet.primitive = Primitive::quads;
  packet.batch.position = {kPositions.data(), 2 * sizeof(float), 2};
  packet.batch.tex_coord = {kTexCoords.data(), 2 * sizeof(float), 2};
  packet.batch.count = packet.index_count = 4;

  DeviceOptions options;
  options.threads = 1;
  Device device(options);
  device.begin_pass(&target);
  device.draw(packet);
  device.finish();
  device.begin_pass(nullptr);
}

}  // namespace halfspace::gl::glx
