// The drawable behind an OSMesa context: a framebuffer of ours, shown in a buffer of the user's.
#pragma once

#include <memory>

#include "gl/osmesa/format.h"
#include "state/drawable.h"

namespace halfspace::gl {

// Where and how the user wants to see the picture.
struct UserBuffer {
  void* data = nullptr;  // null: there is no one to show it to
  GLenum type = GL_UNSIGNED_BYTE;
  BufferFormat format;
  int width = 0, height = 0;
  bool operator==(const UserBuffer&) const = default;
};

class Surface final : public state::Drawable {
 public:
  explicit Surface(const AncillaryBits& bits) : bits_(bits) {}

  // Shows the picture in `user` from now on. The framebuffer, and with it the picture, stays when size and
  // kind of components stay. Only while no device has its pass on this surface. May throw std::bad_alloc,
  // changing nothing.
  void attach(const UserBuffer& user);
  // Stops writing to the user's memory: it may be gone by the time pending work is executed.
  void detach() { user_.data = nullptr; }
  // Whether attach(user) would keep the framebuffer.
  bool keeps_framebuffer(const UserBuffer& user) const;

  const UserBuffer& user() const { return user_; }
  bool has_depth() const { return bits_.depth > 0; }
  // Bytes a value of OSMesaGetDepthBuffer.
  int depth_value_bytes() const { return bits_.depth <= 16 ? 2 : 4; }

  void set_row_length(int pixels) { row_length_ = pixels; }
  int row_length() const { return row_length_; }
  void set_y_up(bool y_up) { y_up_ = y_up; }
  bool y_up() const { return y_up_; }

  const state::VisualConfig& visual() const override { return visual_; }
  int width() const override { return user_.width; }
  int height() const override { return user_.height; }
  raster::Framebuffer& framebuffer(uint8_t) override { return *framebuffer_; }
  void finish(raster::Device& device, uint8_t planes) override;

 private:
  raster::LinearImage user_image() const;
  void finish_into_shorts(raster::Device& device);
  void capture(raster::Device& device) const;

  AncillaryBits bits_;
  UserBuffer user_;
  state::VisualConfig visual_;
  std::unique_ptr<raster::Framebuffer> framebuffer_;
  int row_length_ = 0;  // pixels; 0 is the width
  bool y_up_ = true;
};

}  // namespace halfspace::gl
