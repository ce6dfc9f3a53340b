#include "state/pixel_transfer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"
#include "state/pixel_value.h"

namespace halfspace::state {
namespace {

// One row of the spec's table 3.2: exactly one of the pointers is set.
struct TransferParameter {
  GLenum name;
  bool* (*flag)(PixelTransferState&);
  GLint* (*number)(PixelTransferState&);
  float* (*real)(PixelTransferState&);
};

#define FLAG(name, field)                                                  \
  {                                                                        \
    name, [](PixelTransferState& s) { return &s.field; }, nullptr, nullptr \
  }
#define NUMBER(name, field)                                                \
  {                                                                        \
    name, nullptr, [](PixelTransferState& s) { return &s.field; }, nullptr \
  }
#define REAL(name, field)                                                  \
  {                                                                        \
    name, nullptr, nullptr, [](PixelTransferState& s) { return &s.field; } \
  }
constexpr TransferParameter kParameters[] = {
    FLAG(GL_MAP_COLOR, map_color),       FLAG(GL_MAP_STENCIL, map_stencil),
    NUMBER(GL_INDEX_SHIFT, index_shift), NUMBER(GL_INDEX_OFFSET, index_offset),
    REAL(GL_RED_SCALE, scale[0]),        REAL(GL_GREEN_SCALE, scale[1]),
    REAL(GL_BLUE_SCALE, scale[2]),       REAL(GL_ALPHA_SCALE, scale[3]),
    REAL(GL_RED_BIAS, bias[0]),          REAL(GL_GREEN_BIAS, bias[1]),
    REAL(GL_BLUE_BIAS, bias[2]),         REAL(GL_ALPHA_BIAS, bias[3]),
    REAL(GL_DEPTH_SCALE, depth_scale),   REAL(GL_DEPTH_BIAS, depth_bias),
};
#undef FLAG
#undef NUMBER
#undef REAL

double read_value(const TransferParameter& parameter, const PixelTransferState& state) {
  auto& s = const_cast<PixelTransferState&>(state);  // the accessors hand out what setters write to
  if (parameter.flag) return *parameter.flag(s);
  return parameter.number ? double(*parameter.number(s)) : double(*parameter.real(s));
}

template <size_t kIndex>
void read_parameter(const Context& context, double* out) {
  *out = read_value(kParameters[kIndex], context.pixel_transfer);
}

constexpr GetKind kind_of(const TransferParameter& parameter) {
  if (parameter.flag) return GetKind::boolean;
  return parameter.number ? GetKind::integer : GetKind::real;
}

template <size_t... kIndex>
constexpr auto make_rows(std::index_sequence<kIndex...>) {
  return std::array{
      GetRow{kParameters[kIndex].name, kind_of(kParameters[kIndex]), 1, read_parameter<kIndex>}...,
      GetRow{GL_ZOOM_X, GetKind::real, 1,
             [](const Context& c, double* out) { *out = double(c.pixel_transfer.zoom_x); }},
      GetRow{GL_ZOOM_Y, GetKind::real, 1,
             [](const Context& c, double* out) { *out = double(c.pixel_transfer.zoom_y); }}};
}

GLint to_number(double v) {
  if (!(v > -2147483648.0)) return std::isnan(v) ? 0 : INT32_MIN;
  return v >= 2147483647.0 ? INT32_MAX : GLint(std::floor(v + 0.5));
}

// "Arithmetic on Components": an entry for each component in [0, 1], the nearest one.
float look_up(const PixelMap& map, float component) {
  return map.values[size_t(double(clamp_unit(component)) * double(map.size - 1) + 0.5)];
}

// Indices into maps of 2^n entries are taken modulo the size.
float look_up_index(const PixelMap& map, int64_t index) {
  return map.values[size_t(index & int64_t{map.size - 1})];
}

// "Arithmetic on Indices". Bits that leave 64 do not come back.
int64_t shift_and_offset(const PixelTransferState& state, int64_t index) {
  const GLint shift = state.index_shift;
  if (shift > 0) index = shift < 64 ? int64_t(uint64_t(index) << shift) : 0;
  if (shift < 0) index >>= std::min(-int64_t{shift}, int64_t{63});
  return int64_t(uint64_t(index) + uint64_t(int64_t{state.index_offset}));
}

}  // namespace

std::span<const GetRow> pixel_transfer_get_rows() {
  static constexpr auto kRows = make_rows(std::make_index_sequence<std::size(kParameters)>{});
  return kRows;
}

bool transfers_colors(const Context& context) {
  const PixelTransferState& state = context.pixel_transfer;
  if (state.map_color) return true;
  for (int c = 0; c < 4; ++c) {
    if (state.scale[c] != 1 || state.bias[c] != 0) return true;
  }
  return false;
}

void transfer_colors(const Context& context, float* rgba, size_t count) {
  const PixelTransferState& state = context.pixel_transfer;
  for (size_t i = 0; i < count * 4; ++i) rgba[i] = rgba[i] * state.scale[i % 4] + state.bias[i % 4];
  if (!state.map_color) return;
  const PixelMap* maps = &context.pixel_map[GL_PIXEL_MAP_R_TO_R];
  for (size_t i = 0; i < count * 4; ++i) rgba[i] = look_up(maps[i % 4], rgba[i]);
}

void transfer_color_indices(const Context& context, const int64_t* indices, size_t count, float* rgba) {
  const PixelMap* maps = &context.pixel_map[GL_PIXEL_MAP_I_TO_R];
  for (size_t i = 0; i < count; ++i) {
    const int64_t index = shift_and_offset(context.pixel_transfer, indices[i]);
    for (size_t c = 0; c < 4; ++c) rgba[4 * i + c] = look_up_index(maps[c], index);
  }
}

void transfer_stencil(const Context& context, int64_t* indices, size_t count) {
  const PixelTransferState& state = context.pixel_transfer;
  const PixelMap& map = context.pixel_map[GL_PIXEL_MAP_S_TO_S];
  for (size_t i = 0; i < count; ++i) {
    indices[i] = shift_and_offset(state, indices[i]);
    if (state.map_stencil) indices[i] = int64_t(look_up_index(map, indices[i]));
  }
}

void transfer_depths(const Context& context, double* depths, size_t count) {
  const double scale = double(context.pixel_transfer.depth_scale);
  const double bias = double(context.pixel_transfer.depth_bias);
  for (size_t i = 0; i < count; ++i) {
    const double depth = depths[i] * scale + bias;
    depths[i] = depth > 0 ? std::min(depth, 1.0) : 0.0;  // NaN: 0
  }
}

bool transfers_depths(const Context& context) {
  return context.pixel_transfer.depth_scale != 1 || context.pixel_transfer.depth_bias != 0;
}

namespace op {

// Every GLint and GLfloat is a GLdouble, so one operation serves both commands.
void pixel_transfer(Context& context, GLenum pname, GLdouble param) {
  PixelTransferState& state = context.pixel_transfer;
  for (const TransferParameter& parameter : kParameters) {
    if (parameter.name != pname) continue;
    if (parameter.flag) *parameter.flag(state) = param != 0;
    if (parameter.number) *parameter.number(state) = to_number(param);
    if (parameter.real) *parameter.real(state) = float(param);
    return;
  }
  record_error(context, GL_INVALID_ENUM);
}

void pixel_zoom(Context& context, GLfloat x, GLfloat y) {
  context.pixel_transfer.zoom_x = x;
  context.pixel_transfer.zoom_y = y;
}

}  // namespace op
}  // namespace halfspace::state
