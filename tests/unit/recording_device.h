// Stands in for raster::Device at link time: keeps what it was asked to draw, vertex by vertex. To be
// included once, by a test that does not link the real one.
#pragma once

#include <array>
#include <cstring>
#include <new>
#include <vector>

#include "raster/api/device.h"

namespace halfspace::raster {

struct RecordedVertex {
  std::array<float, 4> position, color, tex_coord;
  std::array<float, 4> normal{0, 0, 1, 1};
  bool edge_flag = true;
  Material material{};  // front
  bool operator==(const RecordedVertex&) const = default;
};

struct RecordedDraw {
  Framebuffer* target;
  std::shared_ptr<const DrawState> state;
  Primitive primitive;
  uint32_t batch_count;
  bool constant_color, has_tex_coord, has_normal, has_edge_flags, continues;
  const void* position_data;
  std::vector<RecordedVertex> vertices;  // in drawing order
};

inline std::vector<RecordedDraw> recorded_draws;
inline bool fail_next_draw = false;

inline std::array<float, 4> read_attribute(const AttributeStream& stream, uint32_t index,
                                           std::array<float, 4> value) {
  if (stream.data == nullptr) return value;
  float v[4] = {value[0], value[1], value[2], value[3]};
  read_element(stream, index, v);
  return {v[0], v[1], v[2], v[3]};
}

struct Device::Impl {
  Framebuffer* target = nullptr;
  DeviceStatistics statistics;
};

Device::Device(const DeviceOptions&) : impl_(std::make_unique<Impl>()) {}
Device::~Device() = default;
void Device::begin_pass(Framebuffer* target) { impl_->target = target; }
void Device::clear(const ClearCommand&) {}
void Device::finish(const LinearImage*, ColorPlane) {}
void Device::read_color(const Rect&, uint8_t*, ColorPlane) {}
void Device::read_color_float(const Rect&, float*, ColorPlane) {}
void Device::read_depth(const Rect&, uint32_t*) {}
void Device::read_stencil(const Rect&, uint8_t*) {}
void Device::copy_plane(ColorPlane, ColorPlane, const Rect&) {}
void Device::draw_pixels(const PixelPacket&) {}
void Device::accumulate(const AccumCommand&) {}
ShadedPoint Device::shade_point(const DrawState&, const VertexBatch&) { return {}; }
void Device::feedback(const DrawPacket&, FeedbackSink&) {}
const DeviceStatistics& Device::statistics() const { return impl_->statistics; }

void Device::draw(const DrawPacket& packet) {
  if (fail_next_draw) {
    fail_next_draw = false;
    throw std::bad_alloc();
  }
  const VertexBatch& batch = packet.batch;
  RecordedDraw draw{impl_->target,
                    packet.state,
                    packet.primitive,
                    batch.count,
                    !batch.color.stride,
                    batch.tex_coord.data != nullptr,
                    batch.normal.data != nullptr,
                    batch.edge_flag != nullptr,
                    packet.continues,
                    batch.position.data,
                    {}};
  for (uint32_t i = 0; i < packet.index_count; ++i) {
    const uint32_t index = packet.indices ? packet.indices[i] : i;
    if (index >= batch.count) std::abort();  // the contract: every index below the batch's count
    draw.vertices.push_back({read_attribute(batch.position, index, {0, 0, 0, 1}),
                             read_attribute(batch.color, index,
                                            batch.color.data ? std::array<float, 4>{0, 0, 0, 1}
                                                             : std::array<float, 4>{1, 1, 1, 1}),
                             read_attribute(batch.tex_coord, index, {0, 0, 0, 1}),
                             read_attribute(batch.normal, index, {0, 0, 1, 1}),
                             !batch.edge_flag || batch.edge_flag[index],
                             batch.material_index ? packet.materials[batch.material_index[index]].front
                                                  : packet.state->lighting.material.front});
  }
  recorded_draws.push_back(std::move(draw));
}

}  // namespace halfspace::raster
