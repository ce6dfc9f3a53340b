// glArrayElement, glDrawArrays, glDrawElements (spec 2.8).
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

#include "state/context.h"
#include "state/operations.gen.h"
#include "state/report.h"
#include "state/vertex_fetch.h"

namespace halfspace::state {
namespace {

constexpr size_t kPageBytes = 4096;

// Whether the byte at `address` can be read. GL cannot know how long an array is; this catches the index that
// points out of all memory before it ends the program. A page once found readable is not asked for again.
[[gnu::noinline]] bool system_can_read(const std::byte* address) {
  std::byte value;
  const iovec local{&value, 1}, remote{const_cast<std::byte*>(address), 1};
  // Where the system refuses to look on our behalf, nothing was learned, and the array is taken as it is.
  return process_vm_readv(getpid(), &local, 1, &remote, 1, 0) >= 0 || errno != EFAULT;
}

bool is_readable(VertexArrayState& arrays, const std::byte* address) {
  const uintptr_t page = reinterpret_cast<uintptr_t>(address) / kPageBytes;
  uintptr_t& known = arrays.readable_pages[page % arrays.readable_pages.size()];
  if (known == page) return page != 0;
  if (!system_can_read(address)) return false;
  known = page;
  return true;
}

}  // namespace

bool elements_are_readable(VertexArrayState& arrays, const ClientArray& array, size_t first, size_t last) {
  if (!array.pointer) return false;
  const auto* base = static_cast<const std::byte*>(array.pointer);
  const size_t stride = stride_bytes(array);
  return is_readable(arrays, base + first * stride) &&
         is_readable(arrays, base + last * stride + element_bytes(array) - 1);
}

namespace {

// Null arrays and elements out of memory: GL leaves open what happens; here nothing is drawn.
bool arrays_are_readable(Context& context, const VertexNeeds& needs, size_t first, size_t last) {
  VertexArrayState& arrays = context.vertex_array;
  const auto readable_if = [&](bool needed, const ClientArray& array) {
    return !needed || !array.enabled || elements_are_readable(arrays, array, first, last);
  };
  const bool readable = readable_if(true, arrays.vertex) && readable_if(true, arrays.color) &&
                        readable_if(needs.tex_coord, arrays.tex_coord) &&
                        readable_if(needs.normal, arrays.normal) &&
                        readable_if(needs.edge_flag, arrays.edge_flag);
  if (!readable && !arrays.bad_memory_reported) {
    arrays.bad_memory_reported = true;
    report(
        "an enabled vertex array is null, or elements %zu to %zu of it are not in memory; nothing is drawn",
        first, last);
  }
  return readable;
}

// Fills the batch: `fetch(array, conversion, scratch)` for enabled arrays, the current value for the others.
template <class Fetch>
void fill_batch(Context& context, const VertexNeeds& needs, raster::VertexBatch& batch, size_t count,
                Fetch&& fetch) {
  VertexArrayState& arrays = context.vertex_array;
  batch.count = uint32_t(count);
  batch.position = fetch(arrays.vertex, Conversion::plain, arrays.position_scratch);
  batch.color = arrays.color.enabled ? fetch(arrays.color, Conversion::normalized, arrays.color_scratch)
                                     : raster::AttributeStream{context.current.color, 0, 4};
  if (needs.tex_coord) {
    batch.tex_coord = arrays.tex_coord.enabled
                          ? fetch(arrays.tex_coord, Conversion::plain, arrays.tex_coord_scratch)
                          : raster::AttributeStream{context.current.tex_coord, 0, 4};
  }
  if (needs.normal) {
    batch.normal = arrays.normal.enabled ? fetch(arrays.normal, Conversion::normalized, arrays.normal_scratch)
                                         : raster::AttributeStream{context.current.normal, 0, 3};
  }
}

// The edge flags of `count` vertices; place(i) is where in the array vertex i stands.
template <class Place>
void fill_edge_flags(Context& context, raster::VertexBatch& batch, size_t count, Place&& place) {
  VertexArrayState& arrays = context.vertex_array;
  const ClientArray& array = arrays.edge_flag;
  if (!array.enabled && context.current.edge_flag) return;  // all edges, as without an array
  if (arrays.edge_flag_scratch.size() < count) arrays.edge_flag_scratch.resize(count);
  const auto* flags = static_cast<const GLubyte*>(array.pointer);
  const size_t stride = stride_bytes(array);
  for (size_t i = 0; i < count; ++i) {
    arrays.edge_flag_scratch[i] = array.enabled && flags[place(i) * stride] != GL_FALSE;
  }
  batch.edge_flag = arrays.edge_flag_scratch.data();
}

void fill_batch_range(Context& context, const VertexNeeds& needs, raster::VertexBatch& batch, size_t first,
                      size_t count) {
  fill_batch(context, needs, batch, count,
             [=](const ClientArray& array, Conversion conversion, std::vector<float>& scratch) {
               return fetch_range(array, conversion, first, count, scratch);
             });
  if (needs.edge_flag) fill_edge_flags(context, batch, count, [=](size_t i) { return first + i; });
}

void fill_batch_indexed(Context& context, const VertexNeeds& needs, raster::VertexBatch& batch,
                        const uint32_t* indices, size_t count) {
  fill_batch(context, needs, batch, count,
             [=](const ClientArray& array, Conversion conversion, std::vector<float>& scratch) {
               return fetch_indexed(array, conversion, indices, count, scratch);
             });
  if (needs.edge_flag) fill_edge_flags(context, batch, count, [=](size_t i) { return size_t{indices[i]}; });
}

using raster::IndexRange;

// Of all indices; of those that the device takes as they are, of each stretch in the scratch, too.
template <class T>
IndexRange find_range(VertexArrayState& arrays, const T* indices, size_t count) {
  if constexpr (sizeof(T) == sizeof(uint32_t)) {
    const size_t stretches = raster::index_stretches(count);
    if (arrays.range_scratch.size() < stretches) arrays.range_scratch.resize(stretches);
    raster::find_index_ranges(indices, count, arrays.range_scratch.data());
    return raster::joined_range(arrays.range_scratch.data(), stretches);
  }
  T lowest = indices[0], highest = indices[0];
  for (size_t i = 1; i < count; ++i) {
    lowest = std::min(lowest, indices[i]);
    highest = std::max(highest, indices[i]);
  }
  return {lowest, highest};
}

// The indices less `base` as aligned 32-bit words in the scratch.
template <class T>
const uint32_t* rebase(VertexArrayState& arrays, const T* indices, size_t count, uint32_t base) {
  if (arrays.index_scratch.size() < count) arrays.index_scratch.resize(count);
  uint32_t* out = arrays.index_scratch.data();
  for (size_t i = 0; i < count; ++i) out[i] = uint32_t(indices[i]) - base;
  return out;
}

// Few indices far apart: the vertices are fetched one by one, in order, and the draw needs no indices.
bool is_sparse(IndexRange range, size_t count) { return range.highest - range.lowest > 16 * count + 1024; }

template <class T>
void draw_indexed(Context& context, raster::DrawPacket& packet, const T* indices, size_t count) {
  VertexArrayState& arrays = context.vertex_array;
  const IndexRange range = find_range(arrays, indices, count);
  const VertexNeeds needs = vertex_needs(context, GLenum(packet.primitive));
  if (!arrays_are_readable(context, needs, range.lowest, range.highest)) return;
  packet.index_count = uint32_t(count);
  if (is_sparse(range, count)) {
    const uint32_t* wide = rebase(arrays, indices, count, 0);
    fill_batch_indexed(context, needs, packet.batch, wide, count);
    return submit(context, packet);
  }
  // Moving the indices down costs a pass over them; narrow ones are copied anyway. What lies below the lowest
  // index is not worth that when it is little.
  const bool move = sizeof(T) < sizeof(uint32_t) || range.lowest > count / 8;
  const uint32_t base = move ? range.lowest : 0;
  fill_batch_range(context, needs, packet.batch, base, size_t{range.highest} - base + 1);
  if constexpr (sizeof(T) == sizeof(uint32_t)) {
    packet.indices = move ? rebase(arrays, indices, count, base) : indices;
    if (!move) packet.index_ranges = arrays.range_scratch.data();
  } else {
    packet.indices = rebase(arrays, indices, count, base);
  }
  submit(context, packet);
}

// Indices may stand at any address; words that do not are copied first.
template <class T>
void draw_elements_of(Context& context, raster::DrawPacket& packet, const void* indices, size_t count) {
  if (reinterpret_cast<uintptr_t>(indices) % alignof(T) == 0) {
    return draw_indexed(context, packet, static_cast<const T*>(indices), count);
  }
  std::vector<T> aligned(count);
  std::memcpy(aligned.data(), indices, count * sizeof(T));
  draw_indexed(context, packet, aligned.data(), count);
}

bool indices_are_readable(Context& context, const void* indices, size_t bytes) {
  const auto* base = static_cast<const std::byte*>(indices);
  VertexArrayState& arrays = context.vertex_array;
  if (base && is_readable(arrays, base) && is_readable(arrays, base + bytes - 1)) return true;
  if (!arrays.bad_memory_reported) report("glDrawElements: the indices are not in memory; nothing is drawn");
  arrays.bad_memory_reported = true;
  return false;
}

// Vertices that are to be drawn, that is: something to do.
bool has_work(const Context& context, GLsizei count) {
  return count > 0 && context.vertex_array.vertex.enabled;
}

}  // namespace

namespace op {

void array_element(Context& context, GLint i) {
  if (i < 0) return record_error(context, GL_INVALID_VALUE);
  VertexArrayState& arrays = context.vertex_array;
  const size_t index = size_t(i);
  const auto usable = [&](const ClientArray& array) {
    return array.enabled && elements_are_readable(arrays, array, index, index);
  };
  if (usable(arrays.edge_flag)) {
    const auto* flags = static_cast<const GLubyte*>(arrays.edge_flag.pointer);
    edge_flag(context, flags[index * stride_bytes(arrays.edge_flag)]);
  }
  if (usable(arrays.tex_coord)) {
    float v[4] = {0, 0, 0, 1};
    fetch_element(arrays.tex_coord, Conversion::plain, index, v);
    tex_coord(context, v[0], v[1], v[2], v[3]);
  }
  if (usable(arrays.index)) {
    float v[4] = {};
    fetch_element(arrays.index, Conversion::plain, index, v);
    op::index(context, v[0]);
  }
  if (usable(arrays.color)) {
    float v[4] = {0, 0, 0, 1};
    fetch_element(arrays.color, Conversion::normalized, index, v);
    color(context, v[0], v[1], v[2], v[3]);
  }
  if (usable(arrays.normal)) {
    float v[4] = {};
    fetch_element(arrays.normal, Conversion::normalized, index, v);
    normal(context, v[0], v[1], v[2]);
  }
  if (usable(arrays.vertex)) {
    float v[4] = {0, 0, 0, 1};
    fetch_element(arrays.vertex, Conversion::plain, index, v);
    vertex(context, v[0], v[1], v[2], v[3]);
  }
}

void draw_arrays(Context& context, GLenum mode, GLint first, GLsizei count) try {
  if (mode > GL_POLYGON) return record_error(context, GL_INVALID_ENUM);
  if (first < 0 || count < 0) return record_error(context, GL_INVALID_VALUE);
  if (!has_work(context, count)) return;
  const size_t start = size_t(first), length = size_t(count);
  const VertexNeeds needs = vertex_needs(context, mode);
  if (!arrays_are_readable(context, needs, start, start + length - 1)) return;
  raster::DrawPacket packet;
  packet.primitive = primitive_of(mode);
  packet.index_count = uint32_t(length);
  fill_batch_range(context, needs, packet.batch, start, length);
  submit(context, packet);
} catch (const std::bad_alloc&) {
  record_error(context, GL_OUT_OF_MEMORY, "draw_arrays");
}

void draw_elements(Context& context, GLenum mode, GLsizei count, GLenum type, const GLvoid* indices) try {
  const bool known_type = type == GL_UNSIGNED_BYTE || type == GL_UNSIGNED_SHORT || type == GL_UNSIGNED_INT;
  if (mode > GL_POLYGON || !known_type) return record_error(context, GL_INVALID_ENUM);
  if (count < 0) return record_error(context, GL_INVALID_VALUE);
  if (!has_work(context, count)) return;
  const size_t length = size_t(count);
  if (!indices_are_readable(context, indices, length * type_bytes(type))) return;
  raster::DrawPacket packet;
  packet.primitive = primitive_of(mode);
  switch (type) {
    case GL_UNSIGNED_BYTE:
      return draw_elements_of<GLubyte>(context, packet, indices, length);
    case GL_UNSIGNED_SHORT:
      return draw_elements_of<GLushort>(context, packet, indices, length);
    default:
      return draw_elements_of<GLuint>(context, packet, indices, length);
  }
} catch (const std::bad_alloc&) {
  record_error(context, GL_OUT_OF_MEMORY, "draw_elements");
}

}  // namespace op
}  // namespace halfspace::state
