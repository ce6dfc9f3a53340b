#include "state/derive/accuracy.h"

#include <cstdlib>
#include <iterator>

#include "state/report.h"

namespace halfspace::state {
namespace {

using raster::Accuracy;
using raster::Level;

std::optional<Level> level_named(std::string_view name) {
  for (size_t i = 0; i < std::size(raster::kLevelNames); ++i) {
    if (name == raster::kLevelNames[i]) return Level(i);
  }
  return std::nullopt;
}

// One AXIS=LEVEL.
bool set_axis(std::string_view part, Accuracy& accuracy) {
  const size_t equals = part.find('=');
  if (equals == part.npos) return false;
  const std::optional<Level> level = level_named(part.substr(equals + 1));
  if (!level) return false;
  for (const raster::AccuracyAxis& axis : raster::kAccuracyAxes) {
    if (part.substr(0, equals) != axis.name) continue;
    accuracy.*axis.level = *level;
    return true;
  }
  return false;
}

}  // namespace

std::optional<Accuracy> parse_accuracy(std::string_view text) {
  Accuracy accuracy;
  for (bool first = true;; first = false) {
    const size_t comma = text.find(',');
    const std::string_view part = text.substr(0, comma);
    const std::optional<Level> level = first ? level_named(part) : std::nullopt;
    if (level)
      accuracy = Accuracy::all(*level);
    else if (!set_axis(part, accuracy))
      return std::nullopt;
    if (comma == text.npos) return accuracy;
    text.remove_prefix(comma + 1);
  }
}

Accuracy accuracy_from_environment() {
  const char* value = std::getenv("HALFSPACE_ACCURACY");
  if (!value || !*value) return {};
  const std::optional<Accuracy> accuracy = parse_accuracy(value);
  if (!accuracy) {
    report(
        "HALFSPACE_ACCURACY is '%s'; it can be draft, standard or exact, and then or instead one of "
        "perspective, "
        "interpolation, filter, lod, fog, power, transform, coverage with a level of its own, as in "
        "standard,filter=draft. Taking standard",
        value);
  }
  return accuracy.value_or(Accuracy());
}

}  // namespace halfspace::state
