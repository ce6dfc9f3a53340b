#include "state/hint.h"

#include <iterator>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace {

GLenum* hint_of(HintState& hint, GLenum target) {
  switch (target) {
    case GL_PERSPECTIVE_CORRECTION_HINT:
      return &hint.perspective_correction;
    case GL_POINT_SMOOTH_HINT:
      return &hint.point_smooth;
    case GL_LINE_SMOOTH_HINT:
      return &hint.line_smooth;
    case GL_POLYGON_SMOOTH_HINT:
      return &hint.polygon_smooth;
    case GL_FOG_HINT:
      return &hint.fog;
    default:
      return nullptr;
  }
}

// The rows of the axes, one after another.
template <size_t kAxis>
void read_axis(const Context& context, double* out) {
  *out = kFirstLevel + static_cast<GLenum>(context.hint.accuracy.*raster::kAccuracyAxes[kAxis].level);
}
template <size_t kAxis>
constexpr GetRow kAxisRow{kFirstAxis + kAxis, GetKind::enumeration, 1, read_axis<kAxis>};

}  // namespace

raster::Level hinted_level(GLenum hint, raster::Level level) {
  if (hint == GL_FASTEST) return raster::Level::draft;
  return hint == GL_NICEST ? raster::Level::exact : level;
}

raster::Accuracy hinted_accuracy(const HintState& hint) {
  raster::Accuracy accuracy = hint.accuracy;
  accuracy.perspective = hinted_level(hint.perspective_correction, accuracy.perspective);
  accuracy.fog = hinted_level(hint.fog, accuracy.fog);
  return accuracy;
}

void set_accuracy(Context& context, GLenum axis, GLenum level) {
  constexpr const char* kName = "glAccuracyHALFSPACE";
  if (context.immediate.inside) return record_error(context, GL_INVALID_OPERATION, kName);
  const bool all = axis == kAllAxes;
  const bool known = all || (axis >= kFirstAxis && axis < kFirstAxis + std::size(raster::kAccuracyAxes));
  if (!known || level < kFirstLevel || level >= kFirstLevel + std::size(raster::kLevelNames))
    return record_error(context, GL_INVALID_ENUM, kName);
  const auto value = raster::Level(level - kFirstLevel);
  if (all)
    context.hint.accuracy = raster::Accuracy::all(value);
  else
    context.hint.accuracy.*raster::kAccuracyAxes[axis - kFirstAxis].level = value;
  mark_dirty(context, kDirtyRaster);
}

namespace op {

void hint(Context& context, GLenum target, GLenum mode) {
  GLenum* value = hint_of(context.hint, target);
  const bool known = mode == GL_FASTEST || mode == GL_NICEST || mode == GL_DONT_CARE;
  if (!value || !known) return record_error(context, GL_INVALID_ENUM);
  *value = mode;
  mark_dirty(context, kDirtyRaster);
}

}  // namespace op

std::span<const GetRow> hint_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_PERSPECTIVE_CORRECTION_HINT, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.hint.perspective_correction; }},
      {GL_POINT_SMOOTH_HINT, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.hint.point_smooth; }},
      {GL_LINE_SMOOTH_HINT, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.hint.line_smooth; }},
      {GL_POLYGON_SMOOTH_HINT, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.hint.polygon_smooth; }},
      {GL_FOG_HINT, GetKind::enumeration, 1, [](const Context& c, double* out) { *out = c.hint.fog; }},
      kAxisRow<0>,
      kAxisRow<1>,
      kAxisRow<2>,
      kAxisRow<3>,
      kAxisRow<4>,
      kAxisRow<5>,
      kAxisRow<6>,
      kAxisRow<7>,
  };
  static_assert(std::size(raster::kAccuracyAxes) == 8);
  return kRows;
}

}  // namespace halfspace::state
