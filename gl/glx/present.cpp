#include "gl/glx/present.h"

#include <sys/ipc.h>

#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

namespace halfspace::gl::glx {

using raster::PixelLayout;

Presenter::Presenter(std::shared_ptr<Connection> connection, XID target, const FbConfig& config)
    : connection_(std::move(connection)),
      target_(target),
      visual_(config.visual),
      depth_(config.depth),
      layout_(config.layout) {}

Presenter::~Presenter() { release(); }

void Presenter::release() {
  destroy_image();
  if (gc_ && connection_->display()) {
    RequestScope scope(*connection_);
    XFreeGC(connection_->display(), gc_);
  }
  gc_ = nullptr;
}

void Presenter::destroy_image() {
  if (!image_) return;
  Display* display = connection_->display();
  if (shared_) {
    if (display) {
      RequestScope scope(*connection_);
      XShmDetach(display, &segment_);
    }
    shmdt(segment_.shmaddr);
    image_->data = nullptr;  // not XDestroyImage's to free
  }
  XDestroyImage(image_);
  image_ = nullptr;
  shared_ = put_once_ = false;
}

// The segment is marked for removal as soon as the server has it, so that it goes with the two processes.
bool Presenter::create_shared(int width, int height) {
  Display* display = connection_->display();
  XImage* image = XShmCreateImage(display, visual_, unsigned(depth_), ZPixmap, nullptr, &segment_,
                                  unsigned(width), unsigned(height));
  if (!image) return false;
  const size_t size = size_t(image->bytes_per_line) * size_t(height);
  segment_.shmid = shmget(IPC_PRIVATE, size, IPC_CREAT | 0600);
  void* memory = segment_.shmid < 0 ? nullptr : shmat(segment_.shmid, nullptr, 0);
  const bool mapped = memory && memory != reinterpret_cast<void*>(-1);
  bool attached = false;
  if (mapped) {
    segment_.shmaddr = image->data = static_cast<char*>(memory);
    segment_.readOnly = True;
    RequestScope scope(*connection_);
    attached = XShmAttach(display, &segment_) && scope.sync();
  }
  if (segment_.shmid >= 0) shmctl(segment_.shmid, IPC_RMID, nullptr);
  if (attached) {
    image_ = image;
    return true;
  }
  if (mapped) shmdt(memory);
  image->data = nullptr;
  XDestroyImage(image);
  return false;
}

void Presenter::create_plain(int width, int height) {
  XImage* image = XCreateImage(connection_->display(), visual_, unsigned(depth_), ZPixmap, 0, nullptr,
                               unsigned(width), unsigned(height), 32, 0);
  if (!image) throw std::bad_alloc();
  image->byte_order =
      LSBFirst;  // as the layouts say; XPutImage converts for a server that wants it otherwise
  image->data = static_cast<char*>(std::calloc(size_t(image->bytes_per_line), size_t(height)));
  if (!image->data) {
    XDestroyImage(image);
    throw std::bad_alloc();
  }
  image_ = image;
}

void Presenter::create_image(int width, int height) {
  destroy_image();
  if (connection_->has_shared_memory()) {
    shared_ = create_shared(width, height);
    if (!shared_) connection_->shared_memory_failed();
  }
  if (!shared_) create_plain(width, height);
}

raster::LinearImage Presenter::image(int width, int height, bool opaque) {
  if (!image_ || image_->width != width || image_->height != height) {
    create_image(width, height);
  } else if (shared_ && put_once_ && LastKnownRequestProcessed(connection_->display()) < put_serial_) {
    RequestScope scope(*connection_);
    scope.sync();
  }
  raster::LinearImage out;
  out.data = image_->data;
  out.row_bytes = image_->bytes_per_line;
  out.width = width;
  out.height = height;
  out.layout = layout_;
  out.y_up = false;
  out.opaque = opaque;
  return out;
}

void Presenter::put(int x, int y, int width, int height) {
  Display* display = connection_->display();
  if (!display || !image_) return;
  RequestScope scope(*connection_);
  if (!gc_) {
    XGCValues values{};
    values.graphics_exposures = False;
    gc_ = XCreateGC(display, target_, GCGraphicsExposures, &values);
  }
  if (shared_) {
    put_serial_ = NextRequest(display);
    XShmPutImage(display, target_, gc_, image_, x, y, x, y, unsigned(width), unsigned(height), False);
  } else {
    XPutImage(display, target_, gc_, image_, x, y, x, y, unsigned(width), unsigned(height));
  }
  XFlush(display);
  put_once_ = true;
}

std::vector<uint8_t> Presenter::shown(int width, int height) const {
  if (!put_once_ || image_->width != width || image_->height != height) return {};
  std::vector<uint8_t> rgba(size_t(width) * size_t(height) * 4);
  uint8_t* out = rgba.data();
  for (int y = height - 1; y >= 0; --y) {
    const char* row = image_->data + ptrdiff_t(y) * image_->bytes_per_line;
    for (size_t x = 0; x < size_t(width); ++x, out += 4) {
      uint8_t p[4] = {0, 0, 0, 255};
      if (layout_ == PixelLayout::rgb565) {
        uint16_t word;
        std::memcpy(&word, row + 2 * x, 2);
        const unsigned r = word >> 11, g = (word >> 5) & 63u, b = word & 31u;
        out[0] = uint8_t(r << 3 | r >> 2), out[1] = uint8_t(g << 2 | g >> 4),
        out[2] = uint8_t(b << 3 | b >> 2);
        out[3] = 255;
        continue;
      }
      const size_t pixel_bytes = layout_ == PixelLayout::rgb || layout_ == PixelLayout::bgr ? 3 : 4;
      std::memcpy(p, row + pixel_bytes * x, pixel_bytes);
      if (layout_ == PixelLayout::bgra || layout_ == PixelLayout::bgr) std::swap(p[0], p[2]);
      std::memcpy(out, p, 4);
    }
  }
  return rgba;
}

}  // namespace halfspace::gl::glx
