// State queries (spec 6.1): a table, one row a name, and one set of conversions for all of
// glGet{Boolean,...}v.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

// How a value becomes another type (spec 6.1.2). To boolean: anything but zero is true, always.
enum class GetKind : uint8_t {
  boolean,      // 0 or 1
  integer,      // as it is; also bit masks
  enumeration,  // as it is
  real,         // to integer: to the nearest
  normalized,   // colours, depths, normals, clear values: to integer by table 4.9's map, 1.0 -> 2^31 - 1
};

inline constexpr int kMaxGetValues = 16;  // a matrix

struct GetRow {
  GLenum name;
  GetKind kind;
  uint8_t count;                                      // values the query yields, at most kMaxGetValues
  void (*read)(const Context& context, double* out);  // a double holds every value of every kind exactly
};

// The row of `name`, or null when there is none. The table is the union of all groups' rows.
const GetRow* find_get_row(GLenum name);
std::span<const GetRow> all_get_rows();  // sorted by name

// The conversions, one value at a time; also what the glGetTex* family uses.
GLboolean to_boolean(double value);
GLint to_integer(double value, GetKind kind);
GLfloat to_float(double value);

// The groups' rows. Each group's .cpp defines its own.
std::span<const GetRow> capability_get_rows();
std::span<const GetRow> current_get_rows();
std::span<const GetRow> transform_get_rows();
std::span<const GetRow> viewport_get_rows();
std::span<const GetRow> scissor_get_rows();
std::span<const GetRow> point_get_rows();
std::span<const GetRow> line_get_rows();
std::span<const GetRow> polygon_get_rows();
std::span<const GetRow> lighting_get_rows();
std::span<const GetRow> depth_buffer_get_rows();
std::span<const GetRow> stencil_get_rows();
std::span<const GetRow> fog_get_rows();
std::span<const GetRow> accum_get_rows();
std::span<const GetRow> color_buffer_get_rows();
std::span<const GetRow> hint_get_rows();
std::span<const GetRow> vertex_array_get_rows();
std::span<const GetRow> limits_get_rows();
std::span<const GetRow> list_get_rows();
std::span<const GetRow> evaluator_get_rows();
std::span<const GetRow> texture_get_rows();
std::span<const GetRow> pixel_store_get_rows();
std::span<const GetRow> attribute_stack_get_rows();
std::span<const GetRow> pixel_transfer_get_rows();
std::span<const GetRow> pixel_map_get_rows();
std::span<const GetRow> render_mode_get_rows();
std::span<const GetRow> selection_get_rows();
std::span<const GetRow> feedback_get_rows();
std::span<const GetRow> raster_position_get_rows();

}  // namespace halfspace::state
