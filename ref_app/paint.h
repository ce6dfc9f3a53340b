// The scenes painted by number: what a pixel shows is who drew it, or which part of a texture it took,
// instead of how it looks. Geometry, matrices and order stay as they are, so a renderer covers the same
// pixels, and two renderers can be compared in that.
#pragma once

#include <string>

#include "ref_app/gapi.h"

namespace ref_app {

enum class Paint : uint8_t {
  scene,   // as it looks
  owners,  // every primitive in a colour of its own: its number in the frame, from 1; the background is 0
  texels,  // textures that spell their own coordinates
};

// "scene", "owners" or "texels"; throws std::out_of_range for anything else.
Paint paint_of(const std::string& name);

// A primitive's number in red (the lowest eight bits), green and blue. k / 255 comes out as k (spec 2.13.9).
glm::vec4 number_as_color(uint32_t number);

// An image of the same size whose red tells s and whose green tells t: both rise by 255 / kTexelsUp levels a
// texel for kTexelsUp texels and fall for as many, so that a linear filter gives the straight line between
// two texels. Blue is 255.
inline constexpr int kTexelsUp = 8;
Image make_texel_image(int width, int height);

// Draws by another renderer what it is told to draw, in other paint. Where texels are painted, what has no
// texture is black, with blue 0.
class PaintedRenderer final : public Renderer {
 public:
  // `paint` is not Paint::scene.
  PaintedRenderer(Renderer& renderer, Paint paint) : renderer_(renderer), paint_(paint) {}

  ImageHandle add_image(const Image& image) override;
  void remove_image(ImageHandle handle) override { renderer_.remove_image(handle); }
  void begin_pass(const Pass& pass) override;
  void draw(const PipelineState& state, const Geometry& geometry) override;
  void end_pass() override { renderer_.end_pass(); }
  void read_rows(int y, int rows, uint8_t* rgba) override { renderer_.read_rows(y, rows, rgba); }
  int width() const override { return renderer_.width(); }
  int height() const override { return renderer_.height(); }

 private:
  Renderer& renderer_;
  Paint paint_;
  uint32_t primitives_ = 0;  // of this pass so far
};

}  // namespace ref_app
