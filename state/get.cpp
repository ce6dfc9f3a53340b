#include "state/get.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "state/context.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace {

std::vector<GetRow> collect_rows() {
  std::vector<GetRow> rows;
  for (auto group : {
           capability_get_rows(),       //
           current_get_rows(),          //
           transform_get_rows(),        //
           viewport_get_rows(),         //
           scissor_get_rows(),          //
           point_get_rows(),            //
           line_get_rows(),             //
           polygon_get_rows(),          //
           lighting_get_rows(),         //
           depth_buffer_get_rows(),     //
           stencil_get_rows(),          //
           color_buffer_get_rows(),     //
           accum_get_rows(),            //
           fog_get_rows(),              //
           hint_get_rows(),             //
           vertex_array_get_rows(),     //
           texture_get_rows(),          //
           pixel_store_get_rows(),      //
           pixel_transfer_get_rows(),   //
           pixel_map_get_rows(),        //
           raster_position_get_rows(),  //
           attribute_stack_get_rows(),  //
           list_get_rows(),             //
           evaluator_get_rows(),        //
           render_mode_get_rows(),      //
           selection_get_rows(),        //
           feedback_get_rows(),         //
           limits_get_rows()            //
       }) {
    rows.insert(rows.end(), group.begin(), group.end());
  }
  const auto by_name = [](const GetRow& a, const GetRow& b) { return a.name < b.name; };
  const auto same_name = [](const GetRow& a, const GetRow& b) { return a.name == b.name; };
  // limits_get_rows comes last: where a group has a living value, the fixed one gives way.
  std::stable_sort(rows.begin(), rows.end(), by_name);
  rows.erase(std::unique(rows.begin(), rows.end(), same_name), rows.end());
  return rows;
}

// `v` is finite or not; saturates, NaN becomes 0.
GLint round_to_integer(double v) {
  const double rounded = std::floor(v + 0.5);
  if (!(rounded > -2147483648.0)) return std::isnan(v) ? 0 : INT32_MIN;
  return rounded >= 2147483647.0 ? INT32_MAX : GLint(rounded);
}

// One body for glGet{Boolean,Integer,Float,Double}v: `convert` turns a double of the row's kind into a T.
template <class T, class Convert>
void get_values(Context& context, GLenum pname, T* params, const char* operation, Convert&& convert) {
  const GetRow* row = find_get_row(pname);
  if (!row) return record_error(context, GL_INVALID_ENUM, operation);
  double values[kMaxGetValues];
  row->read(context, values);
  for (int i = 0; i < row->count; ++i) params[i] = convert(values[i], row->kind);
}

}  // namespace

std::span<const GetRow> all_get_rows() {
  static const std::vector<GetRow> rows = collect_rows();
  return rows;
}

const GetRow* find_get_row(GLenum name) {
  const std::span<const GetRow> rows = all_get_rows();
  const auto row = std::lower_bound(rows.begin(), rows.end(), name,
                                    [](const GetRow& r, GLenum wanted) { return r.name < wanted; });
  return row != rows.end() && row->name == name ? &*row : nullptr;
}

GLboolean to_boolean(double value) { return value != 0 ? GL_TRUE : GL_FALSE; }

GLint to_integer(double value, GetKind kind) {
  // The inverse of table 2.6's signed map: 1.0 -> 2^31 - 1, -1.0 -> -2^31.
  if (kind == GetKind::normalized) return round_to_integer((4294967295.0 * value - 1) / 2);
  // A mask of all ones is -1, as a GLint has it.
  if (kind == GetKind::integer) return GLint(uint32_t(int64_t(value)));
  return round_to_integer(value);
}

GLfloat to_float(double value) { return GLfloat(value); }

namespace op {

void get_booleanv(Context& context, GLenum pname, GLboolean* params) {
  get_values(context, pname, params, "get_booleanv", [](double v, GetKind) { return to_boolean(v); });
}

void get_integerv(Context& context, GLenum pname, GLint* params) {
  get_values(context, pname, params, "get_integerv", to_integer);
}

void get_floatv(Context& context, GLenum pname, GLfloat* params) {
  get_values(context, pname, params, "get_floatv", [](double v, GetKind) { return to_float(v); });
}

void get_doublev(Context& context, GLenum pname, GLdouble* params) {
  get_values(context, pname, params, "get_doublev", [](double v, GetKind) { return v; });
}

}  // namespace op
}  // namespace halfspace::state
