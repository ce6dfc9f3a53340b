// ref_app drawing who owns each pixel: every primitive in a colour of its own, its number. The geometry, the
// matrices and the order stay, so a renderer has to find the owners it finds for the picture.
#include <GL/gl.h>
#include <GL/osmesa.h>

#include <stdexcept>
#include <vector>

#include "ref_app/backend.h"
#include "ref_app/gl_renderer.h"
#include "tests/differential/recording.h"

namespace ref_app {
namespace {

namespace differential = halfspace::differential;

// 24 bits in red, green, blue: k / 255 comes out as k (spec 2.13.9), and a constant stays constant.
glm::vec4 number_as_color(uint32_t number) {
  const auto level = [number](int shift) { return static_cast<float>((number >> shift) & 255u) / 255.0F; };
  return {level(0), level(8), level(16), 1.0F};
}

class OwnerRenderer final : public Renderer {
 public:
  OwnerRenderer(int width, int height) : gl_(width, height) {}

  // Nothing is textured.
  ImageHandle add_image(const Image&) override { return ++last_image_; }
  void remove_image(ImageHandle) override {}

  void begin_pass(const Pass& pass) override {
    Pass numbered = pass;
    numbered.clear_color = number_as_color(0);
    last_ = 0;
    gl_.begin_pass(numbered);
  }
  void draw(const PipelineState& state, const Geometry& geometry) override;
  void end_pass() override { gl_.end_pass(); }

  void read_rows(int y, int rows, uint8_t* rgba) override { gl_.read_rows(y, rows, rgba); }
  int width() const override { return gl_.width(); }
  int height() const override { return gl_.height(); }

 private:
  GlRenderer gl_;
  uint32_t last_ = 0;
  ImageHandle last_image_ = 0;
};

void OwnerRenderer::draw(const PipelineState& state, const Geometry& geometry) {
  Geometry numbered;
  numbered.primitive = geometry.primitive;
  for (size_t i = 0; i < differential::primitive_count(geometry); ++i) {
    const auto corners = differential::primitive_at(geometry, i);
    const glm::vec4 color = number_as_color(++last_);
    for (int k = 0; k < corners.count; ++k) {
      numbered.indices.push_back(static_cast<uint32_t>(numbered.vertices.size()));
      numbered.vertices.push_back({geometry.vertices[corners.vertex[k]].position, color, {0, 0}});
    }
  }
  PipelineState untextured = state;
  untextured.texturing = false;
  gl_.draw(untextured, numbered);
}

class OwnerBackend final : public Backend {
 public:
  explicit OwnerBackend(const BackendOptions& options)
      : renderer_(options.width, options.height),
        pixels_(static_cast<size_t>(options.width) * static_cast<size_t>(options.height)),
        context_(OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, nullptr)) {
    if (!context_) throw std::runtime_error("OSMesaCreateContextExt gave no context");
    if (!OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, options.width, options.height)) {
      OSMesaDestroyContext(context_);
      throw std::runtime_error("OSMesaMakeCurrent failed");
    }
  }
  ~OwnerBackend() override { OSMesaDestroyContext(context_); }
  OwnerBackend(const OwnerBackend&) = delete;
  OwnerBackend& operator=(const OwnerBackend&) = delete;

  Renderer& renderer() override { return renderer_; }
  Window* window() override { return nullptr; }
  BackendStrings strings() override {
    return {gl_string(GL_RENDERER), gl_string(GL_VERSION), gl_string(GL_VENDOR)};
  }
  std::string take_errors() override { return take_gl_errors(); }

 private:
  OwnerRenderer renderer_;
  std::vector<uint32_t> pixels_;  // OSMesa draws here
  OSMesaContext context_;
};

}  // namespace

std::unique_ptr<Backend> make_backend(const BackendOptions& options) {
  return std::make_unique<OwnerBackend>(options);
}
const char* backend_name() { return "osmesa"; }

}  // namespace ref_app
