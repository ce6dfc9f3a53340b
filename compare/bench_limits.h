// What one core of this machine can do at best (bench/limits, on Google Benchmark), and what that means for a
// workload.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace halfspace::compare {

struct Limit {
  std::string name;  // "pixel_stored"; those of memory with the size of it in KiB: "bytes_set/16"
  double per_second = 0;
};

struct LimitsResult {
  std::string processor;
  int core = 0;
  std::vector<Limit> limits;
};

// `seconds` for each. Throws NotFound, StartError and
// std::runtime_error.
LimitsResult bench_limits(int core, double seconds);

// The time of so much work, amounts by the names of limits. Throws std::runtime_error for a name that is
// none.
double milliseconds(const LimitsResult& limits, const std::map<std::string, double>& work);

std::string to_text(const LimitsResult& result);
nlohmann::json to_json(const LimitsResult& result);
std::string to_svg(const LimitsResult& result);
// There is nothing to miss.
inline bool all_good(const LimitsResult&) { return true; }

}  // namespace halfspace::compare
