// Reading client arrays: elements of any type and stride become floats (spec 2.8, table 2.6).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "raster/api/draw_packet.h"
#include "state/vertex_array.h"

namespace halfspace::state {

// plain: the number itself. normalized: the largest integer is 1.0.
enum class Conversion : bool { plain, normalized };

size_t type_bytes(GLenum type);
// Inline, and floats first: a draw of a few vertices asks several times.
inline size_t element_bytes(const ClientArray& array) {
  return size_t(array.size) * (array.type == GL_FLOAT ? sizeof(float) : type_bytes(array.type));
}
inline size_t stride_bytes(const ClientArray& array) {
  return array.stride ? size_t(array.stride) : element_bytes(array);
}
inline const std::byte* address_of(const ClientArray& array, size_t index) {
  return static_cast<const std::byte*>(array.pointer) + index * stride_bytes(array);
}

// Of any type but GL_FLOAT; see fetch_range.
raster::AttributeStream convert_range(const ClientArray& array, Conversion conversion, size_t first,
                                      size_t count, std::vector<float>& scratch);

// Elements first .. first+count-1. Floats, and colours of four bytes, are passed on where they are; other
// types are converted into `scratch`.
inline raster::AttributeStream fetch_range(const ClientArray& array, Conversion conversion, size_t first,
                                           size_t count, std::vector<float>& scratch) {
  if (array.type != GL_FLOAT) return convert_range(array, conversion, first, count, scratch);
  return {address_of(array, first), stride_bytes(array), uint8_t(array.size)};
}

// Elements indices[0 .. count-1], in that order, packed into `scratch`.
raster::AttributeStream fetch_indexed(const ClientArray& array, Conversion conversion,
                                      const uint32_t* indices, size_t count, std::vector<float>& scratch);

// Whether elements first .. last are in memory. What was found there once is not looked at again.
bool elements_are_readable(VertexArrayState& arrays, const ClientArray& array, size_t first, size_t last);

// One element; `out` gets array.size floats, the rest of its four stay.
void fetch_element(const ClientArray& array, Conversion conversion, size_t index, float out[4]);

}  // namespace halfspace::state
