// A context with a drawable in memory, for tests of the state room's operations.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "state/context.h"
#include "state/operations.gen.h"

namespace halfspace::state {

class MemoryDrawable : public Drawable {
 public:
  MemoryDrawable(int width, int height, const VisualConfig& visual, raster::ColorFormat format)
      : visual_(visual), framebuffer_(width, height, format, visual.double_buffered ? 2 : 1) {}
  const VisualConfig& visual() const override { return visual_; }
  int width() const override { return framebuffer_.width(); }
  int height() const override { return framebuffer_.height(); }
  raster::Framebuffer& framebuffer(uint8_t) override { return framebuffer_; }
  void finish(raster::Device& device, uint8_t) override { device.finish(); }

 private:
  VisualConfig visual_;
  raster::Framebuffer framebuffer_;
};

class PixelTest : public ::testing::Test {
 protected:
  static constexpr int kWidth = 37, kHeight = 21;  // pixels; odd, so that a wrong stride shows

  PixelTest() { open({}); }
  ~PixelTest() override { close(); }

  // Starts again with another visual.
  void open(const VisualConfig& visual, raster::ColorFormat format = raster::ColorFormat::rgba8) {
    close();
    drawable_ = std::make_unique<MemoryDrawable>(kWidth, kHeight, visual, format);
    context_ = std::make_unique<Context>(visual, nullptr);
    make_current(context_.get(), drawable_.get());
  }
  void close() {
    make_current(nullptr, nullptr);
    context_.reset();
    drawable_.reset();
  }

  Context& gl() { return *context_; }
  GLenum error() { return op::get_error(*context_); }

 private:
  std::unique_ptr<MemoryDrawable> drawable_;
  std::unique_ptr<Context> context_;
};

// The call before it recorded `code`, and nothing else.
#define EXPECT_GL(code) EXPECT_EQ(error(), GLenum{code})

}  // namespace halfspace::state
