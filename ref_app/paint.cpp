#include "ref_app/paint.h"

#include <cmath>
#include <stdexcept>

namespace ref_app {
namespace {

// 0 .. 255 over kTexelsUp texels, and back.
uint8_t wave(int texel) {
  const int phase = texel % (2 * kTexelsUp);
  const int height = phase <= kTexelsUp ? phase : 2 * kTexelsUp - phase;
  return static_cast<uint8_t>(std::lround(255.0 * height / kTexelsUp));
}

Geometry numbered(const Geometry& geometry, uint32_t& last) {
  const size_t corners = geometry.primitive == Primitive::triangles ? 3 : 4;
  Geometry out;
  out.primitive = geometry.primitive;
  out.vertices.reserve(geometry.indices.size());
  for (size_t i = 0; i + corners <= geometry.indices.size(); i += corners) {
    const glm::vec4 color = number_as_color(++last);
    for (size_t k = 0; k < corners; ++k) {
      out.indices.push_back(static_cast<uint32_t>(out.vertices.size()));
      out.vertices.push_back({geometry.vertices[geometry.indices[i + k]].position, color, {0, 0}});
    }
  }
  return out;
}

Geometry in_one_color(const Geometry& geometry, const glm::vec4& color) {
  Geometry out = geometry;
  for (Vertex& vertex : out.vertices) vertex.color = color;
  return out;
}

}  // namespace

Paint paint_of(const std::string& name) {
  if (name == "scene") return Paint::scene;
  if (name == "owners") return Paint::owners;
  if (name == "texels") return Paint::texels;
  throw std::out_of_range("no such paint: " + name);
}

glm::vec4 number_as_color(uint32_t number) {
  const auto level = [number](int shift) { return static_cast<float>((number >> shift) & 255u) / 255.0F; };
  return {level(0), level(8), level(16), 1.0F};
}

Image make_texel_image(int width, int height) {
  Image image{width, height, {}};
  image.rgba.reserve(static_cast<size_t>(width) * static_cast<size_t>(height) * 4);
  for (int t = 0; t < height; ++t)
    for (int s = 0; s < width; ++s) {
      const uint8_t texel[4] = {wave(s), wave(t), 255, 255};
      image.rgba.insert(image.rgba.end(), texel, texel + 4);
    }
  return image;
}

ImageHandle PaintedRenderer::add_image(const Image& image) {
  return renderer_.add_image(paint_ == Paint::texels ? make_texel_image(image.width, image.height) : image);
}

void PaintedRenderer::begin_pass(const Pass& pass) {
  Pass black = pass;
  black.clear_color = {0, 0, 0, 1};
  primitives_ = 0;
  renderer_.begin_pass(black);
}

void PaintedRenderer::draw(const PipelineState& state, const Geometry& geometry) {
  PipelineState painted = state;
  if (paint_ == Paint::owners) {
    painted.texturing = false;
    renderer_.draw(painted, numbered(geometry, primitives_));
  } else {
    const bool textured = state.texturing && state.image != kImageNeverAdded;
    painted.texturing = textured;
    const float level = textured ? 1.0F : 0.0F;
    renderer_.draw(painted, in_one_color(geometry, {level, level, level, 1}));
  }
}

}  // namespace ref_app
