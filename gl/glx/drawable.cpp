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
  swapped_ = has_front_ = false;
  if (bindings_ > 1 && framebuffer_) retired_.push_back(std::move(framebuffer_));
  framebuffer_.reset();
}

void GlxDrawable::unbind() {
  if (--bindings_ == 0) retired_.clear();
}

void GlxDrawable::release() {
  if (presenter_) presenter_->release();
}

// Two planes even when one does: an X window may be given another config later.
raster::Framebuffer& GlxDrawable::framebuffer(uint8_t planes) {
  if (!framebuffer_) {
    framebuffer_ = std::make_unique<raster::Framebuffer>(std::max(size_.width, 1), std::max(size_.height, 1),
                                                         raster::ColorFormat::rgba8, 2);
  }
  if (visual_.double_buffered && (planes & raster::kFrontPlane) != 0 && !has_front_) make_front();
  return *framebuffer_;
}

// Few programs look at the front buffer of a double-buffered window; until one does, what was swapped to it
// lives in the XImage alone.
void GlxDrawable::make_front() {
  if (swapped_ && presenter_) {
    const std::vector<uint8_t> rgba = presenter_->shown(size_.width, size_.height);
    if (!rgba.empty()) copy_pixels(*framebuffer_, raster::kFrontPlane, rgba.data());
  }
  has_front_ = true;
}

void GlxDrawable::present(raster::Device& device, raster::ColorPlane plane, const raster::Rect& part) {
  const raster::LinearImage image = presenter_->image(size_.width, size_.height, config_.opaque());
  device.finish(&image, plane);
  presenter_->put(part.x0, size_.height - part.y1, part.x1 - part.x0, part.y1 - part.y0);
}

void GlxDrawable::capture(raster::Device& device) {
  if (!capture_enabled() || quiet_) return;
  std::vector<uint8_t> rgba(size_t(size_.width) * size_t(size_.height) * 4);
  device.read_color(whole(), rgba.data());
  capture_frame(rgba.data(), size_.width, size_.height);
}

void GlxDrawable::finish(raster::Device& device, uint8_t planes) {
  const bool seen = !visual_.double_buffered || (planes & raster::kFrontPlane) != 0;
  if (!seen && about_to_show_) return;
  if (!seen || !visible()) return device.finish();
  present(device, visual_.double_buffered ? raster::kFrontPlane : raster::kBackPlane, whole());
  if (!visual_.double_buffered) capture(device);
}

void GlxDrawable::swap(raster::Device& device) {
  about_to_show_ = false;
  if (!visual_.double_buffered) return;
  device.begin_pass(&back());
  if (visible()) {
    present(device, raster::kBackPlane, whole());
  } else {
    device.finish();
  }
  swapped_ = true;
  capture(device);
  // A pbuffer has no XImage to make a front plane from.
  has_front_ |= kind_ == Kind::pbuffer;
  if (has_front_) device.copy_plane(raster::kBackPlane, raster::kFrontPlane, whole());
}

void GlxDrawable::show_part(raster::Device& device, const raster::Rect& part) {
  about_to_show_ = false;
  const raster::Rect inside = intersect(part, whole());
  if (!visual_.double_buffered || inside.empty()) return;
  device.begin_pass(&framebuffer(raster::kFrontPlane));
  device.copy_plane(raster::kBackPlane, raster::kFrontPlane, inside);
  if (visible()) present(device, raster::kFrontPlane, inside);
}

}  // namespace halfspace::gl::glx
