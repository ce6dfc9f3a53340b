// The interface the scenes are written against, in the shape of the course's own software API: images are
// added once, a pass begins with a clear, geometry is drawn under a pipeline state, the pass ends when its
// picture is finished.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace ref_app {

// 4 bytes a pixel in the order R, G, B, A; the bottom row comes first.
struct Image {
  int width = 0, height = 0;
  std::vector<uint8_t> rgba;
};

using ImageHandle = uint32_t;
// A name that no image was ever added under. Drawing with it is legal: texturing is then off
// (OpenGL 1.1, 3.8.8).
inline constexpr ImageHandle kImageNeverAdded = 0xFFFFFFFFu;

struct Vertex {
  glm::vec4 position;
  glm::vec4 color;
  glm::vec2 tex_coord;
};
static_assert(sizeof(Vertex) == 40, "the client arrays walk over vertices without gaps");

// A colour by its 8-bit levels: what a renderer stores for it is then no question of rounding.
inline glm::vec3 levels(int red, int green, int blue) { return glm::vec3(red, green, blue) / 255.0F; }

enum class Primitive : uint8_t { triangles, quads };

struct Geometry {
  Primitive primitive = Primitive::triangles;
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;

  size_t triangle_count() const {
    return primitive == Primitive::triangles ? indices.size() / 3 : indices.size() / 4 * 2;
  }
};

struct PipelineState {
  glm::mat4 projection{1.0F};
  glm::mat4 model_view{1.0F};
  bool depth_test = true;
  bool texturing = false;
  ImageHandle image = kImageNeverAdded;  // looked at while texturing
};

struct Pass {
  glm::vec4 clear_color{0.0F, 0.0F, 0.0F, 1.0F};
  float clear_depth = 1.0F;
};

class Renderer {
 public:
  virtual ~Renderer() = default;

  virtual ImageHandle add_image(const Image& image) = 0;
  virtual void remove_image(ImageHandle handle) = 0;

  virtual void begin_pass(const Pass& pass) = 0;
  virtual void draw(const PipelineState& state, const Geometry& geometry) = 0;
  // Returns when the picture is finished.
  virtual void end_pass() = 0;

  // Reads the rows [y, y + rows) of the picture, y up, 4 bytes a pixel.
  virtual void read_rows(int y, int rows, uint8_t* rgba) = 0;

  virtual int width() const = 0;
  virtual int height() const = 0;
};

}  // namespace ref_app
