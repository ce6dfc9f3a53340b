#include "state/pixel_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"
#include "state/pixel_value.h"

namespace halfspace::state {
namespace {

constexpr GLenum kFirstMap = GL_PIXEL_MAP_I_TO_I, kLastMap = GL_PIXEL_MAP_A_TO_A;
constexpr size_t kMapCount = kLastMap - kFirstMap + 1;

bool is_map(GLenum name) { return name >= kFirstMap && name <= kLastMap; }
// What is looked up is an index, or what is found is one (spec table 3.3).
bool has_index_domain(GLenum name) { return name <= GL_PIXEL_MAP_I_TO_A; }
bool has_index_range(GLenum name) { return name <= GL_PIXEL_MAP_S_TO_S; }

bool is_power_of_two(GLsizei v) { return (v & (v - 1)) == 0; }

// A value as it comes: integers are components of table 2.6 or indices, floats are taken as they are.
template <class T>
float map_value(GLenum name, T v) {
  if (has_index_range(name)) {
    return std::is_floating_point_v<T> ? float(std::floor(double(v) + 0.5)) : float(v);
  }
  return std::is_floating_point_v<T> ? clamp_unit(float(v))
                                     : float(double(v) / double(std::numeric_limits<T>::max()));
}

// The inverse, for glGetPixelMap.
template <class T>
T returned_value(GLenum name, float v) {
  if constexpr (std::is_floating_point_v<T>) {
    return v;
  } else {
    constexpr double kMax = double(std::numeric_limits<T>::max());
    const double scaled = has_index_range(name) ? double(v) : double(v) * kMax;
    return T(std::clamp(std::floor(scaled + 0.5), 0.0, kMax));
  }
}

template <class T>
void set_map(Context& context, GLenum name, GLsizei size, const T* values, const char* operation) {
  if (!is_map(name)) return record_error(context, GL_INVALID_ENUM, operation);
  const bool fits = size >= 1 && size <= kMaxPixelMapSize;
  if (!fits || (has_index_domain(name) && !is_power_of_two(size))) {
    return record_error(context, GL_INVALID_VALUE, operation);
  }
  PixelMap& map = context.pixel_map.maps[name - kFirstMap];
  map.size = size;
  for (GLsizei i = 0; i < size; ++i) map.values[size_t(i)] = map_value(name, values[i]);
}

template <class T>
void get_map(Context& context, GLenum name, T* values, const char* operation) {
  if (!is_map(name)) return record_error(context, GL_INVALID_ENUM, operation);
  const PixelMap& map = context.pixel_map[name];
  for (GLsizei i = 0; i < map.size; ++i) values[i] = returned_value<T>(name, map.values[size_t(i)]);
}

template <size_t kIndex>
void read_size(const Context& context, double* out) {
  *out = context.pixel_map.maps[kIndex].size;
}

template <size_t... kIndex>
constexpr auto size_rows(std::index_sequence<kIndex...>) {
  return std::array{
      GetRow{GL_PIXEL_MAP_I_TO_I_SIZE + GLenum{kIndex}, GetKind::integer, 1, read_size<kIndex>}...,
      GetRow{GL_MAX_PIXEL_MAP_TABLE, GetKind::integer, 1,
             [](const Context&, double* out) { *out = kMaxPixelMapSize; }}};
}

}  // namespace

std::span<const GetRow> pixel_map_get_rows() {
  static constexpr auto kRows = size_rows(std::make_index_sequence<kMapCount>{});
  return kRows;
}

namespace op {

void pixel_mapfv(Context& context, GLenum map, GLsizei size, const GLfloat* values) {
  set_map(context, map, size, values, __func__);
}
void pixel_mapuiv(Context& context, GLenum map, GLsizei size, const GLuint* values) {
  set_map(context, map, size, values, __func__);
}
void pixel_mapusv(Context& context, GLenum map, GLsizei size, const GLushort* values) {
  set_map(context, map, size, values, __func__);
}
void get_pixel_mapfv(Context& context, GLenum map, GLfloat* values) {
  get_map(context, map, values, __func__);
}
void get_pixel_mapuiv(Context& context, GLenum map, GLuint* values) {
  get_map(context, map, values, __func__);
}
void get_pixel_mapusv(Context& context, GLenum map, GLushort* values) {
  get_map(context, map, values, __func__);
}

}  // namespace op
}  // namespace halfspace::state
