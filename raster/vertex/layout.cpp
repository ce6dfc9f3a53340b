// Which attributes a draw calls for: what does not change over the batch is not interpolated.
#include <cstring>

#include "raster/vertex/vertex_stage.h"

namespace halfspace::raster {
namespace {

const unsigned char* element(const AttributeStream& stream, uint32_t i) {
  return static_cast<const unsigned char*>(stream.data) + size_t(i) * stream.stride;
}

// `bytes` known when it is compiled: then no element costs a call.
template <size_t bytes>
bool is_repeated(const AttributeStream& stream, uint32_t count) {
  for (uint32_t i = 1; i < count; ++i) {
    if (std::memcmp(element(stream, 0), element(stream, i), bytes) != 0) return false;
  }
  return true;
}

// Compares bits: two NaNs or zeros that differ only cost an interpolation.
bool is_constant(const AttributeStream& stream, uint32_t count) {
  if (!stream.data || stream.stride == 0) return true;
  switch (size_t(stream.size) * (stream.bytes ? 1 : sizeof(float))) {
    case 1: return is_repeated<1>(stream, count);
    case 2: return is_repeated<2>(stream, count);
    case 3: return is_repeated<3>(stream, count);
    case 4: return is_repeated<4>(stream, count);
    case 8: return is_repeated<8>(stream, count);
    case 12: return is_repeated<12>(stream, count);
    default: return is_repeated<16>(stream, count);
  }
}

float clamp01(float v) {
  if (!(v > 0)) return 0;  // NaN too
  return v < 1 ? v : 1;
}

Color first_color(const AttributeStream& stream) {
  if (!stream.data) return {1, 1, 1, 1};
  float c[4] = {0, 0, 0, 1};
  read_element(stream, 0, c);
  return {clamp01(c[0]), clamp01(c[1]), clamp01(c[2]), clamp01(c[3])};
}

// The colour of every vertex's faces under lighting, if no vertex changes it.
bool is_lit_alike(const DrawState& state, const VertexBatch& batch) {
  const LightingState& lighting = state.lighting;
  if (batch.material_index) return false;
  const bool tracks =
      lighting.color_material_front.any() || (lighting.two_sided && lighting.color_material_back.any());
  if (tracks && !is_constant(batch.color, batch.count)) return false;
  bool any_light = false;
  for (const Light& light : lighting.lights) {
    if (!light.enabled) continue;
    any_light = true;
    if (light.position[3] != 0) return false;
  }
  if (!any_light) return true;
  return !lighting.local_viewer && is_constant(batch.normal, batch.count);
}

void choose_lit_color(const DrawState& state, const VertexBatch& batch, VertexLayout& layout) {
  const bool two_sided = state.lighting.two_sided;
  if (is_lit_alike(state, batch)) {
    VertexAttributes first;
    shade_attributes(state, batch, {}, {&first, 1});
    layout.constant_color = first.color;
    if (!two_sided || first.color == first.back_color) return;
  }
  layout.color = layout.attribute_count;
  layout.attribute_count += 4;
  if (two_sided) layout.back_color = 0;  // its place is behind all the others
}

bool has_projective_q(const AttributeStream& stream, uint32_t count) {
  if (!stream.data || stream.size < 4) return false;
  const uint32_t distinct = stream.stride == 0 ? 1 : count;
  for (uint32_t i = 0; i < distinct; ++i) {
    float q;
    std::memcpy(&q, element(stream, i) + 3 * sizeof(float), sizeof q);
    if (q != 1.0f) return true;
  }
  return false;
}

bool is_projective(const DrawState& state, const AttributeStream& stream, uint32_t count) {
  const TextureUnitState& unit = state.texture;
  if (state.tex_gen.coord[3].mode != TexGenMode::off) return true;
  if (unit.matrix_is_identity) return has_projective_q(stream, count);
  const auto& m = unit.matrix;
  const bool affine = m[3] == 0 && m[7] == 0 && m[11] == 0 && m[15] == 1;
  return !affine || has_projective_q(stream, count);
}

}  // namespace

VertexBatch part_of(VertexBatch batch, uint32_t first, uint32_t count) {
  for (AttributeStream* stream : {&batch.position, &batch.color, &batch.tex_coord, &batch.normal}) {
    if (stream->data) stream->data = element(*stream, first);
  }
  if (batch.edge_flag) batch.edge_flag += first;
  if (batch.material_index) batch.material_index += first;
  batch.count = count;
  return batch;
}

VertexLayout choose_layout(const DrawState& state, const VertexBatch& batch) {
  VertexLayout layout;
  if (batch.count > 0 && state.lighting.enabled) {
    choose_lit_color(state, batch, layout);
  } else if (batch.count == 0 || is_constant(batch.color, batch.count)) {
    if (batch.count > 0) layout.constant_color = first_color(batch.color);
  } else {
    layout.color = layout.attribute_count;
    layout.attribute_count += 4;
  }
  if (state.texture.view) {
    layout.projective = is_projective(state, batch.tex_coord, batch.count);
    layout.tex_coord = layout.attribute_count;
    layout.attribute_count += layout.projective ? 3 : 2;
  }
  if (state.fog.enabled) layout.fog = layout.attribute_count++;
  if (layout.back_color >= 0) layout.back_color = layout.attribute_count;
  if (state.accuracy.transform == Level::exact) layout.low = layout.float_count();
  return layout;
}

}  // namespace halfspace::raster
