// From a fragment to the framebuffer: texture, fog, coverage (spec 3.8 - 3.11), then the per-fragment
// operations in their order (spec 4.1).
#pragma once

#include "raster/api/draw_state.h"
#include "tests/oracle/surface.h"
#include "tests/oracle/target.h"
#include "tests/oracle/texture.h"

namespace halfspace::oracle {

// Fragments of pixel rectangles bring a colour of their own, or a depth.
struct Given {
  const float* color = nullptr;  // r g b a
  const uint32_t* depth = nullptr;
};

class Painter {
 public:
  // `texture`: null when texturing is off. level_doubt: how far off a correct renderer's colours may be
  // before they are rounded, levels of 255.
  Painter(Target& target, const raster::DrawState& state, const Texture* texture, uint32_t draw,
          Real level_doubt = kLevelDoubt)
      : target_(target), state_(state), texture_(texture), draw_(draw), level_doubt_(level_doubt) {}

  // Pixels any fragment may be at: the window, cut by the scissor (spec 4.1.1, 4.1.2).
  raster::Rect window() const;
  // And by the viewport, outside of which nothing lies that was clipped.
  raster::Rect bounds() const;

  // What comes is a new primitive; `doubtful`: rounding may have decided over its colour.
  void start_primitive(uint32_t number, bool doubtful) { primitive_ = number, doubtful_ = doubtful; }
  // coverage: the part of the pixel that is covered (spec 3.11).
  void paint(int px, int py, const Surface& surface, Real coverage = 1, const Given& given = {});

 private:
  struct Bytes;
  struct Pixel {
    size_t at;
    Real depth;
    bool doubtful;
  };
  Rgba shade(int px, int py, const Surface& surface, Real coverage, const Given& given, bool* doubtful) const;
  Rgba textured(const Rgba& color, const Surface& surface, int px, int py, bool* doubtful) const;
  bool alpha_test(Real alpha, bool* doubtful) const;
  bool stencil_and_depth_test(Pixel& pixel);
  bool depth_test(Pixel& pixel);
  void change_stencil(size_t at, raster::StencilOp op);
  void write(const Rgba& color, size_t at);
  void write_bytes(const Rgba& color, ColorPixel& pixel) const;
  void blend_byte(const Bytes& s, const ColorPixel& old, size_t k, ColorPixel& pixel) const;
  void write_floats(const Rgba& color, ColorPixel& pixel) const;

  Target& target_;
  const raster::DrawState& state_;
  const Texture* texture_;
  uint32_t draw_;
  Real level_doubt_;
  uint32_t primitive_ = 0;
  bool doubtful_ = false;
};

}  // namespace halfspace::oracle
