// Measurements as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "compare/statistics.h"

namespace halfspace::compare {

// median, lowest and highest in the unit measured; spread as a share of the median; count.
nlohmann::json to_json(const Summary& summary);

}  // namespace halfspace::compare
