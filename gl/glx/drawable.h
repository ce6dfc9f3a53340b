// Windows, pixmaps and pbuffers as state::Drawable.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "gl/glx/connection.h"
#include "gl/glx/fb_config.h"
#include "gl/glx/present.h"
#include "state/drawable.h"

namespace halfspace::gl::glx {

// We keep whatever is asked for; a bound is wanted only so that there is one to report.
inline constexpr int kMaxSwapInterval = 1000;

struct Size {
  int width = 0, height = 0;
  bool operator==(const Size&) const = default;
};

class GlxDrawable final : public state::Drawable {
 public:
  enum class Kind { window, pixmap, pbuffer };

  // A window or pixmap `target` of X; its size is asked for by refresh().
  GlxDrawable(std::shared_ptr<Connection> connection, Kind kind, XID id, XID target, const FbConfig& config);
  // A pbuffer.
  GlxDrawable(XID id, const FbConfig& config, Size size);

  Kind kind() const { return kind_; }
  XID id() const { return id_; }
  XID target() const { return target_; }
  const FbConfig& config() const { return config_; }
  // An X window that never was given a config (by glXCreateWindow) takes the one of the context that draws to
  // it.
  bool is_x_window() const { return kind_ == Kind::window && id_ == target_; }
  void adopt_config(const FbConfig& config);
  // Whether a context made for `config` may draw here.
  bool accepts(const FbConfig& config) const;

  // Asks the server for the size as it is now; false when it knows the window or pixmap no longer.
  bool refresh();
  Size server_size() const { return server_size_; }
  // Whether the buffers have another size than refresh() found, and so have to be made anew.
  bool resized() const { return size_ != server_size_; }
  // Takes the new size. No device may have a pass open on the buffers, unless it runs in another thread which
  // draws here too: for that one the old buffers are kept until unbind.
  void apply_size();

  // Counts contexts current on it.
  void bind() { ++bindings_; }
  void unbind();
  bool bound() const { return bindings_ > 0; }

  // While one of these stands, what finish() shows is no frame of the program's own making: it is not
  // captured.
  class QuietScope {
   public:
    explicit QuietScope(GlxDrawable* drawable) : drawable_(drawable) {
      if (drawable_) drawable_->quiet_ = true;
    }
    ~QuietScope() {
      if (drawable_) drawable_->quiet_ = false;
    }
    QuietScope(const QuietScope&) = delete;
    QuietScope& operator=(const QuietScope&) = delete;

   private:
    GlxDrawable* drawable_;
  };

  // Before the flush that comes before a swap: finish() may leave the back buffer's work to swap(), which
  // converts each tile while it is hot.
  void about_to_show() { about_to_show_ = true; }
  // The back buffer becomes visible, and keeps its contents. Everything drawn must have reached `device`,
  // which ends up with its pass on the back buffer. Nothing happens to what is single buffered.
  void swap(raster::Device& device);
  // Shows a rectangle of the back buffer, in GL's window coordinates.
  void show_part(raster::Device& device, const raster::Rect& part);
  // The connection is about to close.
  void release();

  const state::VisualConfig& visual() const override { return visual_; }
  int width() const override { return size_.width; }
  int height() const override { return size_.height; }
  raster::Framebuffer& framebuffer(uint8_t planes) override;
  void finish(raster::Device& device, uint8_t planes) override;

  unsigned long event_mask = 0;  // glXSelectEvent; nothing ever clobbers our buffers, so no event is sent
  int swap_interval = 1;         // kept for the queries; there is no retrace to wait for
  bool preserved_contents = true, largest = false;  // as the pbuffer was created

 private:
  raster::Framebuffer& back() { return framebuffer(raster::kBackPlane); }
  void make_front();
  bool visible() const { return presenter_ && connection_->display(); }
  // Executes what is pending and shows `part` of a plane, in GL's window coordinates.
  void present(raster::Device& device, raster::ColorPlane plane, const raster::Rect& part);
  raster::Rect whole() const { return {0, 0, size_.width, size_.height}; }
  void capture(raster::Device& device);

  std::shared_ptr<Connection> connection_;
  Kind kind_;
  XID id_, target_ = 0;
  FbConfig config_;
  state::VisualConfig visual_;
  Size size_, server_size_;
  int bindings_ = 0;
  bool quiet_ = false;
  bool about_to_show_ = false;
  bool swapped_ = false;
  bool has_front_ = false;  // the front plane holds what is seen
  std::unique_ptr<raster::Framebuffer> framebuffer_;
  std::vector<std::unique_ptr<raster::Framebuffer>> retired_;
  std::unique_ptr<Presenter> presenter_;
};

}  // namespace halfspace::gl::glx
