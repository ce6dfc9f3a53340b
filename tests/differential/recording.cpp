#include "tests/differential/recording.h"

#include "ref_app/assets.h"
#include "ref_app/scenes.h"

namespace halfspace::differential {
namespace {

class Recorder final : public ref_app::Renderer {
 public:
  explicit Recorder(Recording& recording) : recording_(recording) {}

  ref_app::ImageHandle add_image(const ref_app::Image& image) override {
    recording_.images[++last_] = image;
    return last_;
  }
  // What has been drawn refers to it still.
  void remove_image(ref_app::ImageHandle) override {}

  void begin_pass(const ref_app::Pass& pass) override {
    recording_.pass = pass;
    recording_.draws.clear();
  }
  void draw(const ref_app::PipelineState& state, const ref_app::Geometry& geometry) override {
    recording_.draws.push_back({state, geometry});
  }
  void end_pass() override {}
  void read_rows(int, int, uint8_t*) override {}

  int width() const override { return recording_.width; }
  int height() const override { return recording_.height; }

 private:
  Recording& recording_;
  ref_app::ImageHandle last_ = 0;
};

size_t corners_of(const ref_app::Geometry& geometry) {
  return geometry.primitive == ref_app::Primitive::quads ? 4 : 3;
}

}  // namespace

const ref_app::Image* Recording::image_of(const Draw& draw) const {
  if (!draw.state.texturing) return nullptr;
  const auto found = images.find(draw.state.image);
  return found == images.end() ? nullptr : &found->second;
}

Recording record_scene(int number, int width, int height) {
  Recording recording;
  recording.width = width, recording.height = height;
  Recorder recorder(recording);
  const ref_app::Assets assets("", "");
  ref_app::make_scene(number, recorder, assets)->draw(recorder, {});
  return recording;
}

size_t primitive_count(const ref_app::Geometry& geometry) {
  return geometry.indices.size() / corners_of(geometry);
}

PrimitiveCorners primitive_at(const ref_app::Geometry& geometry, size_t index) {
  PrimitiveCorners corners;
  const size_t count = corners_of(geometry);
  for (size_t i = 0; i < count; ++i) corners.vertex[i] = geometry.indices[index * count + i];
  corners.count = static_cast<int>(count);
  return corners;
}

}  // namespace halfspace::differential
