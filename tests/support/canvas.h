// A framebuffer, a device and the few calls that tests of the raster room want.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "raster/api/device.h"

namespace halfspace::test {

// One vertex as DrawPacket takes it: clip or object coordinates, colour, texture coordinates s, t, r, q.
struct Vertex {
  float x = 0, y = 0, z = 0, w = 1;
  raster::Color color{1, 1, 1, 1};
  float s = 0, t = 0, r = 0, q = 1;
};

// What came out, row 0 the lowest.
struct Picture {
  int width = 0, height = 0;
  std::vector<uint8_t> rgba;
  std::vector<uint32_t> depth;  // 0 .. 2^24 - 1

  const uint8_t* pixel(int x, int y) const { return &rgba[4 * (size_t(y) * size_t(width) + size_t(x))]; }
  uint32_t depth_at(int x, int y) const { return depth[size_t(y) * size_t(width) + size_t(x)]; }
  bool operator==(const Picture&) const = default;
};

class Canvas {
 public:
  Canvas(int width, int height, int threads = 1, raster::ColorFormat format = raster::ColorFormat::rgba8,
         bool fuse = true);

  int width() const { return framebuffer_->width(); }
  int height() const { return framebuffer_->height(); }
  raster::Device& device() { return *device_; }

  void clear(const raster::Color& color = {0, 0, 0, 0}, double depth = 1);
  void draw(const raster::DrawState& state, raster::Primitive primitive, std::span<const Vertex> vertices,
            std::span<const uint32_t> indices = {});
  // With position only: colour and texture coordinates are one value for all vertices.
  void draw_plain(const raster::DrawState& state, raster::Primitive primitive,
                  std::span<const Vertex> vertices, const raster::Color& color);

  Picture read();
  Picture read(const raster::Rect& rect);

 private:
  std::unique_ptr<raster::Framebuffer> framebuffer_;
  std::unique_ptr<raster::Device> device_;
};

// State that maps clip space to a width x height viewport at (x, y), everything else off.
raster::DrawState plain_state(int width, int height, int x = 0, int y = 0);

// The coordinate in [-1, 1] that a viewport of `size` pixels (a power of two) takes to `snapped` / 256 pixels
// from its origin, without any rounding on the way (|snapped| < 2^23).
float clip_of(int64_t snapped, int size);

Vertex snapped_vertex(int64_t x, int64_t y, int viewport_size, float z = 0,
                      const raster::Color& color = {1, 1, 1, 1});

// Two triangles' worth of vertices for Primitive::quads over [x0, x1] x [y0, y1] (1/256 px).
std::vector<Vertex> snapped_quad(int64_t x0, int64_t y0, int64_t x1, int64_t y1, int viewport_size,
                                 float z = 0, const raster::Color& color = {1, 1, 1, 1});

// FNV-1a over colour and depth.
uint64_t hash(const Picture& picture);

// The names in isa_available().
std::vector<std::string> isa_levels();

// Forces an instruction set for its lifetime.
class IsaScope {
 public:
  explicit IsaScope(const std::string& name);
  ~IsaScope();
  IsaScope(const IsaScope&) = delete;
  IsaScope& operator=(const IsaScope&) = delete;

 private:
  std::string before_;
};

// HALFSPACE_LONG_TESTS is set: sweeps are whole.
bool long_tests();

// The first pixel at which two pictures differ, for messages; empty when they are equal.
std::string first_difference(const Picture& a, const Picture& b);

}  // namespace halfspace::test
