// The vertex stage: object coordinates to snapped window coordinates, SIMD over vertices.
#pragma once

#include <span>

#include "raster/api/draw_packet.h"
#include "raster/vertex/shaded_vertices.h"
#include "raster/vertex/vertex_kernels.h"

namespace halfspace::raster {

// The vertices [first, first + count) of a batch, as one of their own.
VertexBatch part_of(VertexBatch batch, uint32_t first, uint32_t count);

// The layout `batch` needs under `state`: colour only if it varies, texture coordinates only if a texture is
// on, q only if it can differ from 1.
VertexLayout choose_layout(const DrawState& state, const VertexBatch& batch);

// Shades vertices [first, first + count) of the batch into out.records / outcodes (sized by the caller to
// batch.count). Ranges may be shaded by different threads at once. materials: DrawPacket::materials.
void shade_vertices(const DrawState& state, const VertexBatch& batch, std::span<const MaterialPair> materials,
                    uint32_t first, uint32_t count, ShadedVertices& out);
inline void shade_vertices(const DrawState& state, const VertexBatch& batch, uint32_t first, uint32_t count,
                           ShadedVertices& out) {
  shade_vertices(state, batch, {}, first, count, out);
}
// The same, with the 16 values at clip_from_object in place of the state's; at less than the exact level.
void shade_vertices(const DrawState& state, const double* clip_from_object, const VertexBatch& batch,
                    std::span<const MaterialPair> materials, uint32_t first, uint32_t count,
                    ShadedVertices& out);

// Shades vertices [first, first + count) of the batch, each a point of one pixel, right into their tiles'
// packets. For draws without lighting, textures and fog, at less than the exact level.
void place_points(const DrawState& state, const VertexBatch& batch, const VertexLayout& layout,
                  const PointJob& points, uint32_t first, uint32_t count);

// Shades the ends of separate lines into columns, of the same draws.
class LineEndShader {
 public:
  LineEndShader(const DrawState& state, const VertexBatch& batch, const VertexLayout& layout);
  // Vertices [first, first + 2 * lines) of the batch; of up to EndColumns::kMost lines.
  void shade(uint32_t first, uint32_t lines, EndColumns& out) const { run_(job_, first, lines, out); }

 private:
  ShadeJob job_;
  void (*run_)(const ShadeJob& job, uint32_t first, uint32_t lines, EndColumns& out);
};

// A vertex's attributes, whatever the draw state would ask for (raster position, feedback; spec 2.13, 5.3).
struct VertexAttributes {
  Color color, back_color;  // lit if lighting is on; in [0, 1]
  float tex_coord[4];       // s t r q, generated and through the texture matrix
  float eye_distance;       // |z_e|
};
// Of vertices 0 .. out.size() - 1. materials: DrawPacket::materials.
void shade_attributes(const DrawState& state, const VertexBatch& batch,
                      std::span<const MaterialPair> materials, std::span<VertexAttributes> out);

}  // namespace halfspace::raster
