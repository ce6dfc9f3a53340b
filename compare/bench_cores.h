// What `halfspace bench cores` shows: where a frame's work can be shared, and what that would give on more
// cores than this machine may have.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace halfspace::compare {

struct CoresOptions {
  std::vector<std::string> only;  // empty: all but those with little to share
  std::vector<int> cores{1, 2, 4, 8, 16, 32, 64};
  int frames = 8;
  double wake_us = 5;  // measured: a thread that waits for work looks at it some microseconds later
  std::optional<std::string> library;
  std::filesystem::path out = "out/bench";
};

struct CoresRow {
  std::string name;
  double one_ms = 0;             // a frame on one thread, measured
  std::vector<double> frame_ms;  // simulated, for each number of cores
  std::vector<double> work_ms;   // of all cores together
  std::vector<double> serial_share;
};

struct CoresResult {
  std::string renderer, processor;
  CoresOptions options;
  std::vector<CoresRow> rows;
};

CoresResult bench_cores(const CoresOptions& options, const std::function<void(const std::string&)>& progress);

std::string to_text(const CoresResult& result);
nlohmann::json to_json(const CoresResult& result);
std::string to_svg(const CoresResult& result);
inline bool all_good(const CoresResult&) { return true; }

}  // namespace halfspace::compare
