// How a picture comes to an X window or pixmap: an XImage, in shared memory where the server can read it
// there.
#pragma once

#include <X11/Xutil.h>
#include <X11/extensions/XShm.h>
#include <sys/shm.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "gl/glx/connection.h"
#include "gl/glx/fb_config.h"

namespace halfspace::gl::glx {

class Presenter {
 public:
  Presenter(std::shared_ptr<Connection> connection, XID target, const FbConfig& config);
  ~Presenter();
  Presenter(const Presenter&) = delete;
  Presenter& operator=(const Presenter&) = delete;

  // Memory for a picture of this size, when the server has done with the previous picture. Throws
  // std::bad_alloc. The same size again gives the same memory, with the previous picture still in it.
  raster::LinearImage image(int width, int height, bool opaque);
  // Shows a rectangle of the image at the same place of the target; y goes down from the top.
  void put(int x, int y, int width, int height);
  // The picture as it was last put, 4 bytes a pixel, the lowest row first; empty when none was, or its size
  // is another. Bits that the target lacks are made up from those it has.
  std::vector<uint8_t> shown(int width, int height) const;
  // To be called while the connection is still open, when it is about to be closed.
  void release();

 private:
  void create_image(int width, int height);
  bool create_shared(int width, int height);
  void create_plain(int width, int height);
  void destroy_image();

  std::shared_ptr<Connection> connection_;
  XID target_;
  Visual* visual_;
  int depth_;
  raster::PixelLayout layout_;
  GC gc_ = nullptr;
  XImage* image_ = nullptr;
  XShmSegmentInfo segment_{};
  bool shared_ = false;
  bool put_once_ = false;
  unsigned long put_serial_ = 0;  // of the request that reads the shared memory
};

}  // namespace halfspace::gl::glx
