#include "raster/api/framebuffer.h"

#include "tests/oracle/contract/impl.h"

namespace halfspace::raster {

Framebuffer::Framebuffer(int width, int height, ColorFormat format, int planes)
    : impl_(std::make_unique<Impl>(width, height, format, planes)) {}
Framebuffer::~Framebuffer() = default;

int Framebuffer::width() const { return impl_->target.width; }
int Framebuffer::height() const { return impl_->target.height; }
ColorFormat Framebuffer::format() const { return impl_->target.format; }
int Framebuffer::planes() const { return impl_->target.color[1].empty() ? 1 : 2; }

}  // namespace halfspace::raster
