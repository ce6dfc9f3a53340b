// The accumulation buffer (spec 4.2.4), a tile at a time.
#pragma once

#include "raster/api/device.h"
#include "raster/surface/framebuffer.h"

namespace halfspace::raster {

// The accumulation buffer's fixed point: this is 1.0.
inline constexpr int kAccumOne = 32767;
// Rounded to nearest, clamped to [-1, 1].
int16_t accum_fixed(float value);

// What holds for all tiles of one glAccum.
class Accumulation {
 public:
  // Asks the framebuffer for what the command needs. Throws std::bad_alloc before anything is changed.
  Accumulation(Framebuffer::Impl& framebuffer, const AccumCommand& command);
  void run(size_t tile) const;

 private:
  struct Block;  // pixels of one block
  void run_block(const Block& block) const;
  void take_colors(const Block& block) const;
  void change(const Block& block) const;
  void give_back(const Block& block, int plane) const;

  Framebuffer::Impl& fb_;
  const AccumCommand& command_;
  Rect rect_;
  uint8_t targets_ = 0;  // of return_
  int32_t terms_[256];   // accum, load: what a byte of colour adds
};

}  // namespace halfspace::raster
