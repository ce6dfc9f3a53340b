#include "state/vertex_fetch.h"

#include <cstring>
#include <limits>
#include <type_traits>

namespace halfspace::state {
namespace {

template <class T>
T load(const std::byte* p) {
  T v;
  std::memcpy(&v, p, sizeof v);  // client arrays need not be aligned
  return v;
}

// Table 2.6. Up to 16 bits the numerator and divisor are exact in float, so one rounding happens; wider ones
// go through double.
template <class T, Conversion kConversion>
float convert(T v) {
  if constexpr (kConversion == Conversion::plain || std::is_floating_point_v<T>) {
    return float(v);
  } else {
    using Wide = std::conditional_t<sizeof(T) <= 2, float, double>;
    constexpr Wide kDivisor = Wide(std::numeric_limits<std::make_unsigned_t<T>>::max());
    const Wide numerator = std::is_signed_v<T> ? 2 * Wide(v) + 1 : Wide(v);
    return float(numerator / kDivisor);
  }
}

template <class T, Conversion kConversion>
void convert_elements(const std::byte* source, size_t stride, size_t size, size_t count, float* out) {
  if (stride == size * sizeof(T)) {
    for (size_t i = 0; i < size * count; ++i)
      out[i] = convert<T, kConversion>(load<T>(source + i * sizeof(T)));
    return;
  }
  for (size_t i = 0; i < count; ++i, source += stride, out += size) {
    for (size_t k = 0; k < size; ++k) out[k] = convert<T, kConversion>(load<T>(source + k * sizeof(T)));
  }
}

using Converter = void (*)(const std::byte* source, size_t stride, size_t size, size_t count, float* out);

template <class T>
Converter converter_of(Conversion conversion) {
  return conversion == Conversion::normalized ? convert_elements<T, Conversion::normalized>
                                              : convert_elements<T, Conversion::plain>;
}

Converter find_converter(GLenum type, Conversion conversion) {
  switch (type) {
    case GL_BYTE:
      return converter_of<GLbyte>(conversion);
    case GL_UNSIGNED_BYTE:
      return converter_of<GLubyte>(conversion);
    case GL_SHORT:
      return converter_of<GLshort>(conversion);
    case GL_UNSIGNED_SHORT:
      return converter_of<GLushort>(conversion);
    case GL_INT:
      return converter_of<GLint>(conversion);
    case GL_UNSIGNED_INT:
      return converter_of<GLuint>(conversion);
    case GL_DOUBLE:
      return converter_of<GLdouble>(conversion);
    default:
      return converter_of<GLfloat>(conversion);
  }
}

}  // namespace

size_t type_bytes(GLenum type) {
  switch (type) {
    case GL_BYTE:
    case GL_UNSIGNED_BYTE:
      return 1;
    case GL_SHORT:
    case GL_UNSIGNED_SHORT:
      return 2;
    case GL_DOUBLE:
      return 8;
    default:
      return 4;
  }
}

raster::AttributeStream convert_range(const ClientArray& array, Conversion conversion, size_t first,
                                      size_t count, std::vector<float>& scratch) {
  const std::byte* source = address_of(array, first);
  const bool color_bytes =
      array.type == GL_UNSIGNED_BYTE && array.size == 4 && conversion == Conversion::normalized;
  if (color_bytes) return {source, stride_bytes(array), 4, true};
  const size_t size = size_t(array.size);
  if (scratch.size() < size * count) scratch.resize(size * count);
  find_converter(array.type, conversion)(source, stride_bytes(array), size, count, scratch.data());
  return {scratch.data(), size * sizeof(float), uint8_t(array.size)};
}

raster::AttributeStream fetch_indexed(const ClientArray& array, Conversion conversion,
                                      const uint32_t* indices, size_t count, std::vector<float>& scratch) {
  const size_t size = size_t(array.size);
  if (scratch.size() < size * count) scratch.resize(size * count);
  const Converter converter = find_converter(array.type, conversion);
  const size_t stride = stride_bytes(array);
  for (size_t i = 0; i < count; ++i) {
    converter(address_of(array, indices[i]), stride, size, 1, scratch.data() + i * size);
  }
  return {scratch.data(), size * sizeof(float), uint8_t(array.size)};
}

void fetch_element(const ClientArray& array, Conversion conversion, size_t index, float out[4]) {
  find_converter(array.type, conversion)(address_of(array, index), stride_bytes(array), size_t(array.size), 1,
                                         out);
}

}  // namespace halfspace::state
