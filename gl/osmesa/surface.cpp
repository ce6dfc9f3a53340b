#include "gl/osmesa/surface.h"

#include <vector>

#include "gl/capture.h"

namespace halfspace::gl {
namespace {

// NaN becomes 0.
float clamp01(float v) { return v > 0 ? (v < 1 ? v : 1.0f) : 0.0f; }

}  // namespace

bool Surface::keeps_framebuffer(const UserBuffer& user) const {
  return framebuffer_ && user_.width == user.width && user_.height == user.height &&
         framebuffer_->format() == user.format.surface_format();
}

void Surface::attach(const UserBuffer& user) {
  if (!keeps_framebuffer(user)) {
    framebuffer_ =
        std::make_unique<raster::Framebuffer>(user.width, user.height, user.format.surface_format());
  }
  user_ = user;
  visual_ = visual_of(user.format, bits_);
}

raster::LinearImage Surface::user_image() const {
  raster::LinearImage image;
  image.data = user_.data;
  image.row_bytes = ptrdiff_t{row_length_ > 0 ? row_length_ : user_.width} * user_.format.pixel_bytes();
  image.width = user_.width;
  image.height = user_.height;
  image.layout = user_.format.layout;
  image.float_components = user_.format.component == Component::float32;
  image.y_up = y_up_;
  return image;
}

void Surface::finish(raster::Device& device, uint8_t) {
  if (!user_.data) {
    device.finish();
    return;
  }
  if (user_.format.component == Component::short16) {
    finish_into_shorts(device);
  } else {
    const raster::LinearImage image = user_image();
    device.finish(&image);
  }
  if (capture_enabled()) capture(device);
}

// GL_UNSIGNED_SHORT is seldom asked for: floats first, then to the nearest of 2^16 - 1 steps.
void Surface::finish_into_shorts(raster::Device& device) {
  const size_t row_values = static_cast<size_t>(user_.width) * static_cast<size_t>(user_.format.components);
  std::vector<float> values(row_values * static_cast<size_t>(user_.height));
  raster::LinearImage image = user_image();
  const ptrdiff_t user_row_bytes = image.row_bytes;
  image.data = values.data();
  image.row_bytes = static_cast<ptrdiff_t>(row_values * sizeof(float));
  image.float_components = true;
  device.finish(&image);
  for (int y = 0; y < user_.height; ++y) {
    const float* from = values.data() + row_values * static_cast<size_t>(y);
    auto* to = reinterpret_cast<GLushort*>(static_cast<char*>(user_.data) + user_row_bytes * y);
    for (size_t i = 0; i < row_values; ++i) to[i] = static_cast<GLushort>(clamp01(from[i]) * 65535.0f + 0.5f);
  }
}

void Surface::capture(raster::Device& device) const {
  std::vector<uint8_t> rgba(static_cast<size_t>(user_.width) * static_cast<size_t>(user_.height) * 4);
  device.read_color({0, 0, user_.width, user_.height}, rgba.data());
  capture_frame(rgba.data(), user_.width, user_.height);
}

}  // namespace halfspace::gl
