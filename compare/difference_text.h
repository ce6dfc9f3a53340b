// A Difference in words and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "compare/difference.h"

namespace halfspace::compare {

// At most four significant digits after the point, no trailing zeros: 0.0312, 2, 17.5.
std::string short_number(double value);
// "37 of 1048576 (0.0035 %)".
std::string count_of(uint64_t count, uint64_t total);

// Several lines for a terminal, each ended by a newline.
std::string describe(const Difference& difference);
// One line: "37 pixels differ (0.0035 %), max 2, inside 1".
std::string describe_in_a_line(const Difference& difference);
// Levels and counts as numbers; psnr is null for equal pictures.
nlohmann::json to_json(const Difference& difference);

}  // namespace halfspace::compare
