// OpenGL into memory, through the OSMesa API: no window system at all.
#include <GL/gl.h>
#include <GL/osmesa.h>

#include <stdexcept>
#include <vector>

#include "ref_app/backend.h"
#include "ref_app/gl_renderer.h"

namespace ref_app {
namespace {

class OsmesaBackend final : public Backend {
 public:
  explicit OsmesaBackend(const BackendOptions& options)
      : renderer_(options.width, options.height),
        pixels_(static_cast<size_t>(options.width) * static_cast<size_t>(options.height)),
        context_(OSMesaCreateContextExt(OSMESA_RGBA, 24, options.stencil_bits, 0, nullptr)) {
    if (!context_) throw std::runtime_error("OSMesaCreateContextExt gave no context");
    if (!OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, options.width, options.height)) {
      OSMesaDestroyContext(context_);
      throw std::runtime_error("OSMesaMakeCurrent failed");
    }
  }
  ~OsmesaBackend() override { OSMesaDestroyContext(context_); }
  OsmesaBackend(const OsmesaBackend&) = delete;
  OsmesaBackend& operator=(const OsmesaBackend&) = delete;

  Renderer& renderer() override { return renderer_; }
  Window* window() override { return nullptr; }
  BackendStrings strings() override {
    return {gl_string(GL_RENDERER), gl_string(GL_VERSION), gl_string(GL_VENDOR)};
  }
  std::string take_errors() override { return take_gl_errors(); }

 private:
  GlRenderer renderer_;
  std::vector<uint32_t> pixels_;  // OSMesa draws here
  OSMesaContext context_;
};

}  // namespace

std::unique_ptr<Backend> make_backend(const BackendOptions& options) {
  return std::make_unique<OsmesaBackend>(options);
}
const char* backend_name() { return "osmesa"; }

}  // namespace ref_app
