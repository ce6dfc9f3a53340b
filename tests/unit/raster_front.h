// For tests of the front half: a few vertices through the vertex stage and assembly, and a slow coverage to
// judge what comes out.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "raster/api/texture.h"
#include "raster/fragment/program.h"
#include "raster/primitive/assembly.h"
#include "raster/vertex/vertex_stage.h"

namespace halfspace::raster::test {

struct Front {
  std::shared_ptr<DrawState> state = std::make_shared<DrawState>();
  std::vector<float> positions;   // x, y, z, w in turn
  std::vector<float> tex_coords;  // s, t in turn, or none
  std::vector<uint32_t> indices;  // or none
  Sampler sampler;                // of the texture that there then is
  DrawRecord record;
  PipelineProgram program;
  std::vector<uint64_t> storage;
  Segment segment;

  explicit Front(int width = 256, int height = 256) {
    sampler.wrap_s = sampler.wrap_t = Wrap::clamp_to_edge;
    state->viewport = {0, 0, width, height, 0, 1};
    record.bounds = {0, 0, width, height};
  }

  uint32_t vertex_count() const { return uint32_t(positions.size() / 4); }
  void add(float x, float y, float z = 0, float w = 1) { positions.insert(positions.end(), {x, y, z, w}); }
  // A vertex at a window position of a viewport at (0, 0): exact for multiples of 1/256 in a power of two.
  void add_window(double x, double y) {
    add(float(x / state->viewport.width * 2 - 1), float(y / state->viewport.height * 2 - 1));
  }

  void shade() {
    VertexBatch batch;
    batch.position = {positions.data(), 4 * sizeof(float), 4};
    batch.count = vertex_count();
    if (!tex_coords.empty()) {
      batch.tex_coord = {tex_coords.data(), 2 * sizeof(float), 2};
      const uint8_t white[4] = {255, 255, 255, 255};
      Texture texture;
      texture.define_level(0, 1, 1, 0, BaseFormat::rgba, white, sizeof white);
      state->texture.view = texture.view(sampler, 1);
    }
    record.state = state;
    ShadedVertices& v = record.vertices;
    v.layout = choose_layout(*state, batch);
    CodeCache codes;
    build_program(*state, v.layout, ColorFormat::rgba8, true, codes, program);
    record.program = &program;
    v.count = batch.count;
    storage.assign(v.layout.stride() / 8 * batch.count, 0);
    v.records = reinterpret_cast<std::byte*>(storage.data());
    v.outcodes.resize(batch.count);
    v.clip = {batch.position, *state};
    shade_vertices(*state, batch, 0, batch.count, v);
  }

  void run(Primitive mode) {
    shade();
    segment.reset((record.bounds.x1 + kTileSize - 1) / kTileSize,
                  (record.bounds.y1 + kTileSize - 1) / kTileSize);
    const uint32_t count = indices.empty() ? vertex_count() : uint32_t(indices.size());
    const uint32_t* list = indices.empty() ? nullptr : indices.data();
    assemble(record, mode, list, count, 0, primitive_count(mode, count), segment);
  }

  // The three corners of an assembled triangle, 16.8.
  void corners(const PrimitiveRef& ref, int32_t (&x)[3], int32_t (&y)[3]) const {
    for (int i = 0; i < 3; ++i) {
      if (ref.cut) {
        x[i] = segment.cut_triangles[ref.v[0]].x[i];
        y[i] = segment.cut_triangles[ref.v[0]].y[i];
      } else {
        x[i] = record.vertices.head(ref.v[i]).x;
        y[i] = record.vertices.head(ref.v[i]).y;
      }
    }
  }
};

// Is the pixel's centre in the triangle, by the top-left rule (y up: an edge owns its points when the inside
// is below it, or to the right of it)?
inline bool covers(const int32_t (&x)[3], const int32_t (&y)[3], int px, int py) {
  const int64_t cx = px * 256 + 128, cy = py * 256 + 128;
  const int64_t area =
      (int64_t{x[1]} - x[0]) * (int64_t{y[2]} - y[0]) - (int64_t{x[2]} - x[0]) * (int64_t{y[1]} - y[0]);
  if (area == 0) return false;
  for (int i = 0; i < 3; ++i) {
    const int from = area > 0 ? i : (i + 1) % 3, to = area > 0 ? (i + 1) % 3 : i;
    const int64_t dx = int64_t{x[to]} - x[from], dy = int64_t{y[to]} - y[from];
    const int64_t e = dx * (cy - y[from]) - dy * (cx - x[from]);
    const bool owns = dy < 0 || (dy == 0 && dx < 0);
    if (e < 0 || (e == 0 && !owns)) return false;
  }
  return true;
}

}  // namespace halfspace::raster::test
