#include "gl/glx/drawable.h"

#include <algorithm>
#include <utility>

#include "gl/capture.h"
#include "gl/glx/copy_pixels.h"

namespace halfspace::gl::glx {

GlxDrawable::GlxDrawable(std::shared_ptr<Connection> connection, Kind kind, XID id, XID target,
                         const FbConfig& config)
    : connection_(std::move(connection)), kind_(kind), id_(id), target_(target) {
  adopt_config(config);
  presenter_ = std::make_unique<Presenter>(connection_, target, config);
}

GlxDrawable::GlxDrawable(XID id, const FbConfig& config, Size size)
    : kind_(Kind::pbuffer), id_(id), size_(size), server_size_(size) {
  adopt_config(config);
}

void GlxDrawable::adopt_config(const FbConfig& config) {
  config_ = config;
  visual_ = config.bits;
  // A GLXPixmap's front buffer is the X pixmap, and glXSwapBuffers has no effect on it (GLX 1.4, 3.3.10):
  // with a back buffer nothing drawn would ever be seen.
  if (kind_ == Kind::pixmap) visual_.double_buffered = false;
}

bool GlxDrawable::accepts(const FbConfig& config) const {
  if (!is_x_window()) return compatible(config, config_);
  return config.screen == config_.screen && config.depth == config_.depth && config.layout == config_.layout;
}

bool GlxDrawable::refresh() {
  if (kind_ == Kind::pbuffer) return true;
  if (!connection_->display()) return false;
  Window root;
  int x, y;
  unsigned width, height, border, depth;
  RequestScope scope(*connection_);
  if (!XGetGeometry(connection_->display(), target_, &root, &x, &y, &width, &height, &border, &depth))
    return false;
  if (int(depth) != config_.depth) return false;  // the id is another's by now
  constexpr unsigned kLimit = raster::kMaxSurfaceSize;
  server_size_ = {int(std::min(width, kLimit)), int(std::min(height, kLimit))};
  return true;
}

void GlxDrawable::apply_size() {
  if (!resized()) return;
  size_ = server_size_;
  swapped_ = false;
  if (bindings_ > 1) {
    if (front_) retired_.push_back(std::move(front_));
    if (back_) retired_.push_back(std::move(back_));
  }
  front_.reset();
  back_.reset();
}

void GlxDrawable::unbind() {
  if (--bindings_ == 0) retired_.clear();
}

void GlxDrawable::release() {
  if (presenter_) presenter_->release();
}

std::unique_ptr<raster::Framebuffer> GlxDrawable::make_buffer() const {
  return std::make_unique<raster::Framebuffer>(std::max(size_.width, 1), std::max(size_.height, 1),
                                               raster::ColorFormat::rgba8);
}

raster::Framebuffer& GlxDrawable::back() {
  if (!back_) back_ = make_buffer();
  return *back_;
}

// Few programs look at the front buffer of a double-buffered window; until one does, what was swapped to it
// lives in the XImage alone.
raster::Framebuffer& GlxDrawable::front() {
  if (!visual_.double_buffered) return back();
  if (!front_) {
    front_ = make_buffer();
    if (swapped_ && presenter_) copy_to_front(presenter_->shown(size_.width, size_.height));
  }
  return *front_;
}

void GlxDrawable::copy_to_front(std::vector<uint8_t> rgba) {
  if (!rgba.empty()) copy_pixels(*front_, rgba.data());
}

void GlxDrawable::present(raster::Device& device) {
  const raster::LinearImage image = presenter_->image(size_.width, size_.height, config_.opaque());
  device.finish(&image);
  presenter_->put(0, 0, size_.width, size_.height);
}

void GlxDrawable::capture(raster::Device& device) {
  if (!capture_enabled() || quiet_) return;
  std::vector<uint8_t> rgba(size_t(size_.width) * size_t(size_.height) * 4);
  device.read_color({0, 0, size_.width, size_.height}, rgba.data());
  capture_frame(rgba.data(), size_.width, size_.height);
}

void GlxDrawable::finish(raster::Device& device, raster::Framebuffer& target) {
  const bool seen = !visual_.double_buffered || &target == front_.get();
  if (!seen && about_to_show_) return;
  if (!seen || !visible()) return device.finish();
  present(device);
  if (!visual_.double_buffered) capture(device);
}

void GlxDrawable::swap(raster::Device& device) {
  about_to_show_ = false;
  if (!visual_.double_buffered) return;
  device.begin_pass(&back());
  if (visible()) {
    present(device);
  } else {
    device.finish();
  }
  swapped_ = true;
  capture(device);
  // A pbuffer has no XImage for front() to fall back on.
  if (!front_ && kind_ == Kind::pbuffer) front_ = make_buffer();
  if (!front_) return;
  std::vector<uint8_t> rgba(size_t(front_->width()) * size_t(front_->height()) * 4);
  device.read_color({0, 0, front_->width(), front_->height()}, rgba.data());
  copy_to_front(std::move(rgba));
}

void GlxDrawable::show_part(raster::Device& device, const raster::Rect& part) {
  about_to_show_ = false;
  const raster::Rect inside = intersect(part, {0, 0, size_.width, size_.height});
  if (!visible() || inside.empty()) return;
  device.begin_pass(&back());
  const raster::LinearImage image = presenter_->image(size_.width, size_.height, config_.opaque());
  device.finish(&image);
  presenter_->put(inside.x0, size_.height - inside.y1, inside.x1 - inside.x0, inside.y1 - inside.y0);
}

}  // namespace halfspace::gl::glx
