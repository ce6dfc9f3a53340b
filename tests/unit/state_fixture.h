// A context on a drawable of its own, and a picture of all state that can be asked for.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <memory>
#include <vector>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"

namespace halfspace::state {

class MemoryDrawable : public Drawable {
 public:
  MemoryDrawable(const VisualConfig& config, int width, int height)
      : config_(config),
        framebuffer_(width, height, raster::ColorFormat::rgba8, config.double_buffered ? 2 : 1) {}
  const VisualConfig& visual() const override { return config_; }
  int width() const override { return framebuffer_.width(); }
  int height() const override { return framebuffer_.height(); }
  raster::Framebuffer& framebuffer(uint8_t planes) override {
    asked = uint8_t(asked | planes);
    return framebuffer_;
  }
  void finish(raster::Device& device, uint8_t planes) override {
    device.finish();
    finished.push_back(planes);
  }

  std::vector<int> finished;  // the planes each finish was about
  uint8_t asked = 0;          // all planes that were ever wanted

 private:
  VisualConfig config_;
  raster::Framebuffer framebuffer_;
};

inline VisualConfig double_buffered() {
  VisualConfig config;
  config.double_buffered = true;
  return config;
}

// Everything a refused call must leave alone.
struct Snapshot {
  std::map<GLenum, std::vector<double>> rows;
  std::vector<MaterialState> material;
  std::vector<const void*> pointers;
  std::vector<Matrix> matrices;
  bool operator==(const Snapshot& other) const {
    return rows == other.rows && pointers == other.pointers && matrices == other.matrices &&
           std::memcmp(material.data(), other.material.data(), 2 * sizeof(MaterialState)) == 0;
  }
};

inline Snapshot take_snapshot(const Context& context) {
  Snapshot snapshot;
  for (const GetRow& row : all_get_rows()) {
    std::vector<double> values(kMaxGetValues);
    row.read(context, values.data());
    values.resize(row.count);
    snapshot.rows[row.name] = values;
  }
  for (GLenum coord = GL_S; coord <= GL_Q; ++coord) {
    for (GLenum pname : std::initializer_list<GLenum>{GL_TEXTURE_GEN_MODE, GL_OBJECT_PLANE, GL_EYE_PLANE}) {
      double values[4] = {};
      op::get_tex_gendv(const_cast<Context&>(context), coord, pname, values);
      snapshot.rows[coord << 16 | pname].assign(values, values + 4);
    }
  }
  // Lights have no rows of their own.
  for (int i = 0; i < raster::kMaxLights; ++i) {
    for (GLenum pname = GL_AMBIENT; pname <= GL_QUADRATIC_ATTENUATION; ++pname) {
      float values[4] = {};
      op::get_lightfv(const_cast<Context&>(context), GL_LIGHT0 + GLenum(i), pname, values);
      snapshot.rows[GLenum(i) << 16 | pname].assign(values, values + 4);
    }
  }
  snapshot.material = {context.lighting.material[0], context.lighting.material[1]};
  const VertexArrayState& arrays = context.vertex_array;
  for (const ClientArray* a :
       {&arrays.vertex, &arrays.color, &arrays.tex_coord, &arrays.normal, &arrays.edge_flag, &arrays.index}) {
    snapshot.pointers.push_back(a->pointer);
  }
  for (const Matrix& m : context.transform.modelview.matrices) snapshot.matrices.push_back(m);
  for (const Matrix& m : context.transform.projection.matrices) snapshot.matrices.push_back(m);
  for (const Matrix& m : context.transform.texture.matrices) snapshot.matrices.push_back(m);
  return snapshot;
}

class StateTest : public ::testing::Test {
 protected:
  explicit StateTest(const VisualConfig& config = {}, int width = 64, int height = 48)
      : drawable(config, width, height), context(std::make_unique<Context>(config, nullptr)) {
    make_current(context.get(), &drawable);
  }
  ~StateTest() override { make_current(nullptr, nullptr); }

  MemoryDrawable drawable;
  std::unique_ptr<Context> context;
};

}  // namespace halfspace::state
