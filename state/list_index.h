// Vertices that a batch repeats are stored, and later shaded, once.
#pragma once

#include <cstdint>
#include <vector>

#include "state/list_batch.h"

namespace halfspace::state {

struct IndexedBuilder {
  ListBatchBuilder
      vertices;  // each once, in the order of their first use; of the builder's materials and pairs, none
  std::vector<uint32_t> indices;
};

// Fills `out` where enough vertices are repeated for the indices to pay; else returns false. May throw
// std::bad_alloc.
bool find_repeated_vertices(const ListBatchBuilder& builder, IndexedBuilder& out);

}  // namespace halfspace::state
