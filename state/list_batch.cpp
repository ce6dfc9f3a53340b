#include "state/list_batch.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "state/list_index.h"
#include "state/list_memory.h"

namespace halfspace::state {
namespace {

// Compares bits: 0 and -0 are two values.
bool is_constant(const float* data, size_t size, size_t count) {
  for (size_t i = 1; i < count; ++i) {
    if (std::memcmp(data, data + i * size, size * sizeof(float)) != 0) return false;
  }
  return true;
}

// Whether component `k` is `value` in all vertices, to the bit.
bool is_all(const float* data, size_t size, size_t count, size_t k, float value) {
  for (size_t i = 0; i < count; ++i) {
    if (std::memcmp(data + i * size + k, &value, sizeof value) != 0) return false;
  }
  return true;
}

// How many components are worth storing: what is left out is read as 0, 0, 0, 1.
size_t useful_size(const float* data, size_t size, size_t count) {
  constexpr float kDefaults[4] = {0, 0, 0, 1};
  size_t useful = size;
  if (size == 4 && is_all(data, size, count, 3, 1)) {
    useful = 3;
    while (useful > 1 && is_all(data, size, count, useful - 1, kDefaults[useful - 1])) --useful;
  }
  return useful;
}

ListColumn store_column(ListMemory& memory, const float* data, size_t size, size_t count, uint32_t unset) {
  if (count == 0) return {};
  // Those without a value hold zeros, and are filled in with four components at most.
  const bool constant = unset == 0 && is_constant(data, size, count);
  const size_t stored = constant ? 1 : count;
  const size_t useful = unset == 0 ? useful_size(data, size, stored) : size;
  auto* out = static_cast<float*>(memory.allocate(stored * useful * sizeof(float)));
  for (size_t i = 0; i < stored; ++i) std::copy_n(data + i * size, useful, out + i * useful);
  return {out, unset, uint8_t(useful), constant};
}

const uint8_t* store_flags(ListMemory& memory, const std::vector<float>& flags) {
  if (flags.empty()) return nullptr;
  auto* out = static_cast<uint8_t*>(memory.allocate(flags.size()));
  std::transform(flags.begin(), flags.end(), out, [](float flag) { return uint8_t(flag != 0); });
  return out;
}

template <class T>
void move_tail(std::vector<T>& from, std::vector<T>& to, size_t start) {
  start = std::min(start, from.size());
  to.assign(from.begin() + std::ptrdiff_t(start), from.end());
  from.resize(start);
}

}  // namespace

void ListBatchBuilder::add_vertex(const float xyzw[4], const ListValues& values) {
  position.insert(position.end(), xyzw, xyzw + 4);
  for (size_t a = 0; a < kListColumns; ++a) {
    if (!values.knows(a)) continue;
    Column& column = columns[a];
    const size_t size = kListAttributeSize[a];
    if (column.data.empty()) {
      column.unset = count;
      column.data.resize(count * size);
    }
    column.data.insert(column.data.end(), values.value[a].begin(),
                       values.value[a].begin() + std::ptrdiff_t(size));
  }
  ++count;
}

void ListBatchBuilder::truncate(uint32_t new_count) {
  count = new_count;
  position.resize(size_t{4} * count);
  for (size_t a = 0; a < kListColumns; ++a) {
    Column& column = columns[a];
    if (column.unset >= count) column = {};
    column.data.resize(std::min(column.data.size(), size_t{kListAttributeSize[a]} * count));
  }
}

ListBatchBuilder ListBatchBuilder::split_last_pair() {
  ListBatchBuilder tail;
  const uint32_t start = pairs.back();
  tail.mode = mode;
  tail.count = count - start;
  tail.pairs = {0};
  move_tail(position, tail.position, size_t{4} * start);
  for (size_t a = 0; a < kListColumns; ++a) {
    move_tail(columns[a].data, tail.columns[a].data, size_t{kListAttributeSize[a]} * start);
    tail.columns[a].unset = columns[a].unset > start ? columns[a].unset - start : 0;
  }
  for (const ListMaterial& m : materials)
    tail.materials.push_back({m.vertex - start, m.face, m.pname, m.params});
  materials.clear();  // only the last pair can have any, see ListCompiler::material
  pairs.pop_back();
  truncate(start);
  return tail;
}

namespace {

void store_columns(ListMemory& memory, const ListBatchBuilder& builder, ListBatch& batch) {
  batch.count = builder.count;
  batch.position = store_column(memory, builder.position.data(), 4, builder.count, 0);
  for (size_t a = 0; a < kListColumns; ++a) {
    const ListBatchBuilder::Column& column = builder.columns[a];
    if (column.data.empty()) continue;
    batch.columns[a] =
        store_column(memory, column.data.data(), kListAttributeSize[a], builder.count, column.unset);
  }
  batch.edge_flags = store_flags(memory, builder.columns[kListEdgeFlag].data);
}

void store_indices(ListMemory& memory, const std::vector<uint32_t>& indices, ListBatch& batch) {
  batch.indices = memory.copy(indices.data(), indices.size());
  std::vector<raster::IndexRange> ranges(raster::index_stretches(indices.size()));
  raster::find_index_ranges(indices.data(), indices.size(), ranges.data());
  batch.index_ranges = memory.copy(ranges.data(), ranges.size());
}

}  // namespace

ListBatch store_batch(ListMemory& memory, const ListBatchBuilder& builder, const ListValues& last) {
  ListBatch batch;
  IndexedBuilder indexed;
  const bool repeats = find_repeated_vertices(builder, indexed);
  batch.mode = builder.mode;
  store_columns(memory, repeats ? indexed.vertices : builder, batch);
  batch.index_count = builder.count;
  if (repeats) store_indices(memory, indexed.indices, batch);
  batch.last = last;
  batch.materials = memory.copy(builder.materials.data(), builder.materials.size());
  batch.material_count = uint32_t(builder.materials.size());
  batch.pairs = memory.copy(builder.pairs.data(), builder.pairs.size());
  batch.pair_count = uint32_t(builder.pairs.size());
  return batch;
}

}  // namespace halfspace::state
