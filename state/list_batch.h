// Vertices of a display list, stored ready to draw: a column for each attribute the list sets, in the list's
// memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "raster/api/index_ranges.h"
#include "state/gl_types.h"

namespace halfspace::state {

struct Context;
class ListMemory;

enum ListAttribute : uint8_t { kListColor, kListNormal, kListTexCoord, kListEdgeFlag, kListIndex };
inline constexpr size_t kListColumns =
    4;  // vertices have no colour index: an RGBA visual draws nothing with it
inline constexpr size_t kListAttributes = 5;
inline constexpr std::array<uint8_t, kListAttributes> kListAttributeSize{4, 3, 4, 1, 1};  // floats

// Current values a list has set.
struct ListValues {
  uint8_t known = 0;  // bits 1 << ListAttribute; the values of the others are not looked at
  std::array<std::array<float, 4>, kListAttributes> value{};
  bool knows(size_t attribute) const { return known >> attribute & 1; }
};

// glMaterial between Begin and End, before vertex `vertex`.
struct ListMaterial {
  uint32_t vertex;
  GLenum face, pname;
  std::array<float, 4> params;
};

// A column: `size` floats a vertex, or one value for all. The first `unset` vertices had no value in the list
// and take the current one at the time of the call.
struct ListColumn {
  const float* data = nullptr;  // null: no vertex has a value
  uint32_t unset = 0;
  uint8_t size = 0;
  bool constant = false;
};

struct ListBatch {
  GLenum mode = GL_POINTS;
  bool unfinished = false;   // of the last pair, End is missing here
  bool from_arrays = false;  // glDrawArrays or glDrawElements: not allowed between Begin and End
  uint32_t count = 0;        // vertices in the columns
  ListColumn position;
  std::array<ListColumn, kListColumns> columns;
  const uint8_t* edge_flags = nullptr;  // the column of kListEdgeFlag, as the renderer wants it
  const uint32_t* indices = nullptr;    // null: the vertices in turn
  uint32_t index_count = 0;
  const raster::IndexRange* index_ranges = nullptr;  // as raster::DrawPacket has them
  ListValues last;  // the current values afterwards
  const ListMaterial* materials = nullptr;
  uint32_t material_count = 0;
  const uint32_t* pairs = nullptr;  // where in the drawing order each Begin/End pair starts
  uint32_t pair_count = 0;
};

// A batch in the making.
struct ListBatchBuilder {
  struct Column {
    std::vector<float> data;
    uint32_t unset = 0;
  };
  GLenum mode = GL_POINTS;
  uint32_t count = 0;
  std::vector<float> position;  // x y z w
  std::array<Column, kListColumns> columns;
  std::vector<ListMaterial> materials;
  std::vector<uint32_t> pairs;

  void add_vertex(const float xyzw[4], const ListValues& values);
  void truncate(uint32_t new_count);
  // The vertices of the last pair move to a builder of their own, and the pair with them.
  ListBatchBuilder split_last_pair();
};

// May throw std::bad_alloc.
ListBatch store_batch(ListMemory& memory, const ListBatchBuilder& builder, const ListValues& last);

// Draws the batch and sets the current values, as the calls it was made from would have done.
void play_batch(Context& context, const ListBatch& batch);
void play_values(Context& context, const ListValues& values);

}  // namespace halfspace::state
