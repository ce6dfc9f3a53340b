// The same interface straight on raster/api, without any GL between: the course's software renderer.
#include <map>

#include "raster/api/device.h"
#include "ref_app/backend.h"

namespace ref_app {
namespace {

namespace raster = halfspace::raster;

raster::Primitive raster_primitive(Primitive primitive) {
  return primitive == Primitive::triangles ? raster::Primitive::triangles : raster::Primitive::quads;
}

// Multiplied in double from the float matrices, as raster/api asks.
std::array<double, 16> clip_from_object(const PipelineState& state) {
  const glm::dmat4 product = glm::dmat4(state.projection) * glm::dmat4(state.model_view);
  std::array<double, 16> matrix{};
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) matrix[static_cast<size_t>(column * 4 + row)] = product[column][row];
  }
  return matrix;
}

class RasterRenderer final : public Renderer {
 public:
  RasterRenderer(int width, int height) : framebuffer_(width, height, raster::ColorFormat::rgba8) {
    device_.begin_pass(&framebuffer_);
  }
  ~RasterRenderer() override { device_.begin_pass(nullptr); }
  RasterRenderer(const RasterRenderer&) = delete;
  RasterRenderer& operator=(const RasterRenderer&) = delete;

  ImageHandle add_image(const Image& image) override {
    raster::Texture texture;
    texture.define_level(0, image.width, image.height, 0, raster::BaseFormat::rgba, image.rgba.data(),
                         static_cast<size_t>(image.width) * 4);
    raster::Sampler sampler;
    sampler.mag = sampler.min = raster::Filter::linear;
    sampler.mip = raster::MipMode::none;
    const ImageHandle handle = next_handle_++;
    views_[handle] = texture.view(sampler, 1);
    return handle;
  }
  void remove_image(ImageHandle handle) override { views_.erase(handle); }

  void begin_pass(const Pass& pass) override {
    raster::ClearCommand clear;
    clear.color = clear.depth = true;
    clear.color_value = {pass.clear_color.r, pass.clear_color.g, pass.clear_color.b, pass.clear_color.a};
    clear.depth_value = static_cast<double>(pass.clear_depth);
    device_.clear(clear);
  }
  void draw(const PipelineState& state, const Geometry& geometry) override;
  void end_pass() override { device_.finish(); }

  void read_rows(int y, int rows, uint8_t* rgba) override {
    device_.read_color({0, y, width(), y + rows}, rgba);
  }
  int width() const override { return framebuffer_.width(); }
  int height() const override { return framebuffer_.height(); }

 private:
  raster::Framebuffer framebuffer_;
  raster::Device device_;
  std::map<ImageHandle, std::shared_ptr<const raster::TextureView>> views_;
  ImageHandle next_handle_ = 1;
};

void RasterRenderer::draw(const PipelineState& state, const Geometry& geometry) {
  if (geometry.indices.empty()) return;
  auto draw_state = std::make_shared<raster::DrawState>();
  draw_state->clip_from_object = clip_from_object(state);
  draw_state->viewport = {0, 0, width(), height(), 0, 1};
  draw_state->depth.test = state.depth_test;
  if (state.texturing) {
    const auto found = views_.find(state.image);
    if (found != views_.end()) draw_state->texture.view = found->second;
  }

  const Vertex& first = geometry.vertices.front();
  raster::DrawPacket packet;
  packet.state = std::move(draw_state);
  packet.primitive = raster_primitive(geometry.primitive);
  packet.batch.position = {&first.position, sizeof(Vertex), 4};
  packet.batch.color = {&first.color, sizeof(Vertex), 4};
  packet.batch.tex_coord = {&first.tex_coord, sizeof(Vertex), 2};
  packet.batch.count = static_cast<uint32_t>(geometry.vertices.size());
  packet.indices = geometry.indices.data();
  packet.index_count = static_cast<uint32_t>(geometry.indices.size());
  device_.draw(packet);
}

class RasterBackend final : public Backend {
 public:
  explicit RasterBackend(const BackendOptions& options) : renderer_(options.width, options.height) {}
  Renderer& renderer() override { return renderer_; }
  Window* window() override { return nullptr; }
  BackendStrings strings() override {
    return {"Halfspace raster (" + std::string(raster::isa_name()) + ")", "raster/api", "Halfspace"};
  }
  std::string take_errors() override { return {}; }

 private:
  RasterRenderer renderer_;
};

}  // namespace

std::unique_ptr<Backend> make_backend(const BackendOptions& options) {
  return std::make_unique<RasterBackend>(options);
}
const char* backend_name() { return "raster"; }

}  // namespace ref_app
