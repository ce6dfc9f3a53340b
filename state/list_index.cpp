#include "state/list_index.h"

#include <bit>
#include <cstring>

namespace halfspace::state {
namespace {

constexpr uint32_t kFewestVertices = 24;  // shorter batches are shaded at once anyway
constexpr uint32_t kNone = ~uint32_t{0};

// The numbers of one vertex, side by side.
class VertexWords {
 public:
  explicit VertexWords(const ListBatchBuilder& builder) : builder_(builder) {}

  uint64_t hash(uint32_t i) const {
    uint64_t h = 0;
    visit(i, [&](const float* v, size_t size) {
      for (size_t k = 0; k < size; ++k)
        h = (std::rotl(h, 23) ^ std::bit_cast<uint32_t>(v[k])) * 0x9e3779b97f4a7c15u;
    });
    return h ^ h >> 32;
  }

  // Compares bits: 0 and -0 are two values.
  bool same(uint32_t a, uint32_t b) const {
    if (std::memcmp(&builder_.position[size_t{4} * a], &builder_.position[size_t{4} * b],
                    4 * sizeof(float)) != 0)
      return false;
    for (size_t c = 0; c < kListColumns; ++c) {
      const std::vector<float>& data = builder_.columns[c].data;
      const size_t size = kListAttributeSize[c];
      if (!data.empty() && std::memcmp(&data[size * a], &data[size * b], size * sizeof(float)) != 0)
        return false;
    }
    return true;
  }

 private:
  template <class Visit>
  void visit(uint32_t i, Visit&& take) const {
    take(&builder_.position[size_t{4} * i], 4);
    for (size_t c = 0; c < kListColumns; ++c) {
      const std::vector<float>& data = builder_.columns[c].data;
      if (!data.empty()) take(&data[size_t{kListAttributeSize[c]} * i], kListAttributeSize[c]);
    }
  }

  const ListBatchBuilder& builder_;
};

// An open hash table of vertices seen; `indices` gets a number for each vertex, `first` the vertex of each
// number.
void number_vertices(const ListBatchBuilder& builder, std::vector<uint32_t>& indices,
                     std::vector<uint32_t>& first) {
  const VertexWords words(builder);
  const size_t mask = std::bit_ceil(size_t{2} * builder.count) - 1;
  std::vector<uint32_t> table(mask + 1, kNone);
  indices.reserve(builder.count);
  for (uint32_t i = 0; i < builder.count; ++i) {
    size_t slot = words.hash(i) & mask;
    while (table[slot] != kNone && !words.same(first[table[slot]], i)) slot = (slot + 1) & mask;
    if (table[slot] == kNone) {
      table[slot] = uint32_t(first.size());
      first.push_back(i);
    }
    indices.push_back(table[slot]);
  }
}

void pick(const std::vector<float>& from, size_t size, const std::vector<uint32_t>& vertices,
          std::vector<float>& to) {
  if (from.empty()) return;
  to.reserve(size * vertices.size());
  for (uint32_t v : vertices) {
    const auto start = from.begin() + std::ptrdiff_t(size * v);
    to.insert(to.end(), start, start + std::ptrdiff_t(size));
  }
}

bool worth_trying(const ListBatchBuilder& builder) {
  if (builder.count < kFewestVertices) return false;
  for (const ListBatchBuilder::Column& column : builder.columns) {
    if (column.unset > 0) return false;  // filled in vertex by vertex when the list is played
  }
  return true;
}

}  // namespace

bool find_repeated_vertices(const ListBatchBuilder& builder, IndexedBuilder& out) {
  if (!worth_trying(builder)) return false;
  std::vector<uint32_t> first;
  number_vertices(builder, out.indices, first);
  if (first.size() > builder.count - builder.count / 4) return false;
  out.vertices.mode = builder.mode;
  out.vertices.count = uint32_t(first.size());
  pick(builder.position, 4, first, out.vertices.position);
  for (size_t c = 0; c < kListColumns; ++c) {
    pick(builder.columns[c].data, kListAttributeSize[c], first, out.vertices.columns[c].data);
  }
  return true;
}

}  // namespace halfspace::state
