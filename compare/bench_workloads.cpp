#include "compare/bench_workloads.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>

#include "compare/bench_limits.h"
#include "compare/core_distance.h"
#include "compare/processor.h"

namespace halfspace::compare {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Progress = std::function<void(const std::string&)>;

constexpr double kLimitSeconds = 0.05;  // for each

struct Workload {
  std::string name, what;
  double target;
  bool draft;
  std::map<std::string, double> work;  // amounts by the names of limits
};

// The program knows them; it is asked without drawing anything.
std::vector<Workload> workloads(const WorkloadOptions& options) {
  const Json list = start_halfspace(HalfspaceSetting{options.library}, {})->order("list");
  std::vector<Workload> chosen;
  for (const Json& entry : list.at("workloads")) {
    const Workload workload{entry.at("name"), entry.at("what"), entry.at("target"), false, entry.at("work")};
    const double draft_target = entry.at("draft_target");
    if (!options.only.empty() &&
        std::find(options.only.begin(), options.only.end(), workload.name) == options.only.end())
      continue;
    chosen.push_back(workload);
    if (draft_target > 0) chosen.push_back({workload.name, workload.what, draft_target, true, workload.work});
  }
  for (const std::string& name : options.only)
    if (std::none_of(chosen.begin(), chosen.end(), [&](const Workload& w) { return w.name == name; }))
      throw std::runtime_error("there is no workload " + name);
  return chosen;
}

class Bench {
 public:
  Bench(const WorkloadOptions& options, const Progress& progress) : options_(options), progress_(progress) {
    result_.options = options;
    result_.processor = processor_name();
  }

  WorkloadResult run() {
    measure_limits();
    for (const Workload& workload : workloads(options_)) measure(workload);
    return std::move(result_);
  }

 private:
  void measure_limits() {
    if (options_.against) return;
    progress_("limits of this core");
    limits_ = bench_limits(core_to_use(options_.core), kLimitSeconds);
  }

  void measure(const Workload& workload) {
    WorkloadRow row;
    row.name = workload.name;
    row.what = workload.what;
    row.draft = workload.draft;
    // What has been measured before shall leave nothing behind, memory above all.
    const std::vector<int> core{core_to_use(options_.core)};
    const auto ours = start_halfspace(HalfspaceSetting{options_.library, 1, workload.draft}, core);
    const auto theirs = options_.against ? start_other_build(*options_.against, workload.draft, core)
                                         : start_mesa(options_.softpipe, core);
    open(workload, *ours, *theirs);
    const Turns times = take_turns(*ours, *theirs, options_.rounds);
    row.ours = times.first;
    row.theirs = times.second;
    row.ratio = times.cpu_ratio;
    row.target = options_.against ? 1 / (1 + options_.slower_percent / 100) : workload.target;
    if (limits_ && !workload.work.empty()) row.limit_ms = milliseconds(*limits_, workload.work);
    compare_pictures(workload, *ours, *theirs, row);
    if (wants_threads(row)) measure_threads(row);
    progress_(row.name + (row.draft ? " at draft: " : ": ") + short_text(row));
    result_.rows.push_back(std::move(row));
  }

  // Starting a process is not work to be shared.
  bool wants_threads(const WorkloadRow& row) const {
    return options_.threads && !options_.against && row.name != "startup" &&
           row.ours.wall_ms.median > kThreadsFromMs;
  }

  static std::string short_text(const WorkloadRow& row) {
    char text[80];
    std::snprintf(text, sizeof text, "%.2f of %.3g", row.ratio.median, row.target);
    return text;
  }

  void open(const Workload& workload, Contestant& ours, Contestant& theirs) {
    const Json us = ours.order("open " + workload.name), them = theirs.order("open " + workload.name);
    const Drawer our = require_halfspace(us),
                 their = options_.against ? require_halfspace(them) : require_mesa(them);
    result_.our_renderer = our.renderer;
    result_.our_version = our.version;
    result_.their_renderer = their.renderer;
    result_.their_version = their.version;
  }

  // On the last two cores, the picture not looked at: that it is the same is tested elsewhere, to the bit.
  void measure_threads(WorkloadRow& row) {
    const std::vector<int> cores = available_cores();
    if (cores.size() < 2) return;
    const std::vector<int> two(cores.end() - 2, cores.end());
    const auto with_one = start_halfspace(HalfspaceSetting{options_.library, 1, row.draft}, two);
    const auto with_two = start_halfspace(HalfspaceSetting{options_.library, 2, row.draft}, two);
    with_one->order("open " + row.name);
    with_two->order("open " + row.name);
    const double before = core_distance(two[0], two[1]);
    const Turns times = take_turns(*with_two, *with_one, options_.rounds);
    row.core_distance_ns = std::max(before, core_distance(two[0], two[1]));
    row.two_threads = times.first;
    row.one_thread = times.second;
    row.speed_up = times.wall_ratio.median;
  }

  Image picture(Contestant& contestant, const std::string& folder, const WorkloadRow& row) {
    const fs::path place = fs::absolute(options_.out) / folder;
    fs::create_directories(place);
    const std::string name = row.name + (row.draft ? "_draft" : "");
    const fs::path raw = place / (name + ".ppm");
    contestant.order("picture " + raw.string());
    Image image = load_image(raw);
    fs::remove(raw);
    save_image(image, place / (name + ".png"));
    return image;
  }

  void compare_pictures(const Workload& workload, Contestant& ours, Contestant& theirs, WorkloadRow& row) {
    // `clear` draws another colour each frame.
    if (workload.name == "clear") return;
    const Image us = picture(ours, "ours", row), them = picture(theirs, "theirs", row);
    row.pictures = compare_images(us, them, find_edges(us));
    const double far_off = 100 * static_cast<double>(row.pictures->above_8) /
                           static_cast<double>(std::max<uint64_t>(row.pictures->pixels, 1));
    row.same_picture = options_.against
                           ? row.pictures->differing == 0
                           : far_off <= kPicturePercent && row.pictures->mean <= kPictureMeanLevels;
  }

  WorkloadOptions options_;
  Progress progress_;
  std::optional<LimitsResult> limits_;
  WorkloadResult result_;
};

}  // namespace

WorkloadResult bench_workloads(const WorkloadOptions& options, const Progress& progress) {
  return Bench(options, progress).run();
}

bool all_good(const WorkloadResult& result) {
  return std::all_of(result.rows.begin(), result.rows.end(), [](const WorkloadRow& row) {
    return row.good() && (row.speed_up == 0 || row.speed_up >= kTwoThreadsTarget);
  });
}

}  // namespace halfspace::compare
