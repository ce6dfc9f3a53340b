// Renderer in plain OpenGL 1.1 calls. Whichever libGL or libOSMesa the program finds at run time draws it.
#pragma once

#include <string>

#include "ref_app/gapi.h"

namespace ref_app {

// A context must be current whenever a member is called.
class GlRenderer final : public Renderer {
 public:
  GlRenderer(int width, int height) : width_(width), height_(height) {}

  void resize(int width, int height) { width_ = width, height_ = height; }

  ImageHandle add_image(const Image& image) override;
  void remove_image(ImageHandle handle) override;
  void begin_pass(const Pass& pass) override;
  void draw(const PipelineState& state, const Geometry& geometry) override;
  void end_pass() override;
  void read_rows(int y, int rows, uint8_t* rgba) override;
  int width() const override { return width_; }
  int height() const override { return height_; }

 private:
  int width_, height_;
};

// The errors GL has recorded since the last call, by name; empty when there are none.
std::string take_gl_errors();
// glGetString, "(none)" for a null answer.
std::string gl_string(unsigned name);

}  // namespace ref_app
