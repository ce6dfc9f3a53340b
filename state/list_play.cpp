// Drawing the batches of display lists.
#include <algorithm>
#include <cstring>

#include "state/context.h"
#include "state/list_batch.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"

namespace halfspace::state {
namespace {

using raster::AttributeStream;

void set_current(Context& context, const OperationTable& table, size_t attribute, const float* v) {
  switch (attribute) {
    case kListColor:
      return table.color(context, v[0], v[1], v[2], v[3]);
    case kListNormal:
      return table.normal(context, v[0], v[1], v[2]);
    case kListTexCoord:
      return table.tex_coord(context, v[0], v[1], v[2], v[3]);
    case kListIndex:
      return table.index(context, v[0]);
    default:
      return table.edge_flag(context, GLboolean(v[0] != 0));
  }
}

void set_material(Context& context, const ListMaterial& m) {
  context.table->material(context, m.face, m.pname, m.params.data());
}

// The value of vertex `i`, with the components that are not stored.
void read_column(const ListColumn& column, uint32_t i, float out[4]) {
  constexpr float kDefaults[4] = {0, 0, 0, 1};
  std::copy_n(kDefaults, 4, out);
  std::copy_n(column.data + (column.constant ? 0 : size_t{i} * column.size), column.size, out);
}

void replay_vertex(Context& context, const ListBatch& batch, uint32_t i) {
  float v[4];
  for (size_t a = 0; a < kListColumns; ++a) {
    const ListColumn& column = batch.columns[a];
    if (!column.data || i < column.unset) continue;
    read_column(column, i, v);
    set_current(context, *context.table, a, v);
  }
  read_column(batch.position, i, v);
  context.table->vertex(context, v[0], v[1], v[2], v[3]);
}

// Call by call: where a pair has to go on in, or comes from, another list, and where its vertices have
// several materials. The table changes with Begin and End, so it is looked up for each call.
void replay(Context& context, const ListBatch& batch) {
  const ListMaterial* material = batch.materials;
  const ListMaterial* const materials_end = material + batch.material_count;
  for (uint32_t pair = 0; pair < batch.pair_count; ++pair) {
    const bool is_last = pair + 1 == batch.pair_count;
    const uint32_t end = is_last ? batch.index_count : batch.pairs[pair + 1];
    context.table->begin(context, batch.mode);
    for (uint32_t n = batch.pairs[pair]; n < end; ++n) {
      while (material != materials_end && material->vertex <= n) set_material(context, *material++);
      replay_vertex(context, batch, batch.indices ? batch.indices[n] : n);
    }
    if (is_last) {
      while (material != materials_end) set_material(context, *material++);
      play_values(context, batch.last);
    }
    if (!is_last || !batch.unfinished) context.table->end(context);
  }
}

// The column with the current value where the list had none.
AttributeStream filled_stream(const ListColumn& column, const float* current, uint32_t count,
                              std::vector<float>& scratch) {
  const size_t size = column.size;
  scratch.assign(column.data, column.data + size * count);
  for (size_t i = 0; i < column.unset; ++i) std::copy_n(current, size, scratch.data() + i * size);
  return {scratch.data(), size * sizeof(float), column.size};
}

AttributeStream stream_of(const ListColumn& column, const float* current, size_t current_size, uint32_t count,
                          std::vector<float>& scratch) {
  if (!column.data) return {current, 0, uint8_t(current_size)};
  if (column.unset > 0) return filled_stream(column, current, count, scratch);
  return {column.data, column.constant ? 0 : column.size * sizeof(float), column.size};
}

// Null where every edge is a boundary.
const uint8_t* edge_flags_of(const ListBatch& batch, bool current, std::vector<uint8_t>& scratch) {
  const uint32_t unset = batch.edge_flags ? batch.columns[kListEdgeFlag].unset : batch.count;
  if (unset == 0 || (current && !batch.edge_flags)) return batch.edge_flags;
  scratch.assign(batch.count, uint8_t(current));
  if (batch.edge_flags)
    std::copy(batch.edge_flags + unset, batch.edge_flags + batch.count, scratch.begin() + unset);
  return scratch.data();
}

void draw(Context& context, const ListBatch& batch) {
  const CurrentState& current = context.current;
  const VertexNeeds needs = vertex_needs(context, batch.mode);
  ListScratch& scratch = context.lists.scratch;
  raster::DrawPacket packet;
  packet.primitive = primitive_of(batch.mode);
  packet.indices = batch.indices;
  packet.index_count = batch.index_count;
  packet.index_ranges = batch.index_ranges;
  raster::VertexBatch& out = packet.batch;
  out.count = batch.count;
  out.position = {batch.position.data, batch.position.constant ? 0 : batch.position.size * sizeof(float),
                  batch.position.size};
  out.color = stream_of(batch.columns[kListColor], current.color, 4, batch.count, scratch.color);
  if (needs.normal) {
    out.normal = stream_of(batch.columns[kListNormal], current.normal, 3, batch.count, scratch.normal);
  }
  if (needs.tex_coord) {
    out.tex_coord =
        stream_of(batch.columns[kListTexCoord], current.tex_coord, 4, batch.count, scratch.tex_coord);
  }
  if (needs.edge_flag) out.edge_flag = edge_flags_of(batch, current.edge_flag, scratch.edge_flags);
  submit(context, packet);
}

}  // namespace

void play_values(Context& context, const ListValues& values) {
  for (size_t a = 0; a < kListAttributes; ++a) {
    if (values.knows(a)) set_current(context, *context.table, a, values.value[a].data());
  }
}

void play_batch(Context& context, const ListBatch& batch) {
  const bool several_materials =
      batch.material_count > 0 && batch.materials[batch.material_count - 1].vertex > 0;
  if (context.immediate.inside && batch.from_arrays)
    return record_error(context, GL_INVALID_OPERATION, "draw_arrays");
  if (context.immediate.inside || batch.unfinished || several_materials) return replay(context, batch);
  for (uint32_t i = 0; i < batch.material_count; ++i) set_material(context, batch.materials[i]);
  if (batch.index_count > 0)
    guard_memory(
        context, [&] { draw(context, batch); }, "call_list");
  play_values(context, batch.last);
}

}  // namespace halfspace::state
