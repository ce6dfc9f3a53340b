// What `halfspace bench` measures: bench/workloads, drawn by our libOSMesa and by others, in turns.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/contest.h"
#include "compare/difference.h"

namespace halfspace::compare {

struct WorkloadOptions {
  std::vector<std::string> only;       // empty: all
  int rounds = 15;                     // ours, theirs; theirs, ours; ...
  int core = -1;                       // the core both are pinned to; -1: the last one we may use
  bool threads = true;                 // two threads against one, too
  bool softpipe = false;               // Mesa's plain renderer instead of llvmpipe
  std::optional<std::string> library;  // folder of our libOSMesa.so.8
  std::optional<std::string>
      against;                // another build of ours instead of Mesa: a library, its folder, a build tree
  double slower_percent = 5;  // allowed against another build
  std::filesystem::path out = "out/bench";
};

struct WorkloadRow {
  std::string name, what;
  bool draft = false;  // HALFSPACE_ACCURACY=draft
  FrameTime ours, theirs;
  Summary ratio;  // their process time / ours, of neighbours
  double target = 0;
  std::optional<Difference> pictures;
  bool same_picture = true;           // within the limit, or to the bit against another build
  FrameTime one_thread, two_threads;  // on two cores; not measured when the count is 0
  double speed_up = 0;                // wall time of one / of two, the median of neighbours
  double core_distance_ns = 0;        // of those cores, before and after: the longer
  std::optional<double> limit_ms;     // what this core could do at best

  bool fast() const { return ratio.median >= target; }
  bool good() const { return fast() && same_picture; }
};

struct WorkloadResult {
  std::string our_renderer, their_renderer, our_version, their_version, processor;
  WorkloadOptions options;
  std::vector<WorkloadRow> rows;
};

constexpr double kTwoThreadsTarget = 1.8;  // for frames that take longer than kThreadsFromMs
constexpr double kThreadsFromMs = 2;
// Pictures count as the same when at most this share of the pixels is further than 8 levels from the other's,
// and all together are no further than this many on average. Lines, texel borders and ties are drawn
// differently by others.
constexpr double kPicturePercent = 1;
constexpr double kPictureMeanLevels = 1;

// `progress` is told what is being measured. Throws NotFound, StartError, and std::runtime_error when a
// library fails or another one drew than was asked for.
WorkloadResult bench_workloads(const WorkloadOptions& options,
                               const std::function<void(const std::string&)>& progress);

bool all_good(const WorkloadResult& result);
std::string to_text(const WorkloadResult& result);
nlohmann::json to_json(const WorkloadResult& result);
// How many times as fast, as bars.
std::string to_svg(const WorkloadResult& result);

}  // namespace halfspace::compare
