#include "compare/bench_workloads.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>

#include "compare/bench_limits.h"
#include "compare/dialogue.h"
#include "compare/libraries.h"
#include "compare/processor.h"

namespace halfspace::compare {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Progress = std::function<void(const std::string&)>;

constexpr const char* kLibrary = "libOSMesa.so.8";
constexpr double kLimitSeconds = 0.05;  // for each
constexpr double kBatchMs = 60;         // frames are measured in batches of about this length

// One who draws: bench/workloads with a library, an environment and cores.
class Contestant {
 public:
  Contestant(const std::string& library, std::vector<EnvironmentVariable> environment, std::vector<int> cores)
      : dialogue_(command(library, std::move(environment), std::move(cores))) {}

  Json order(const std::string& line) {
    const Json answer = Json::parse(dialogue_.ask(line));
    if (answer.contains("error")) throw std::runtime_error(line + ": " + answer["error"].get<std::string>());
    return answer;
  }

 private:
  static ChildCommand command(const std::string& library, std::vector<EnvironmentVariable> environment,
                              std::vector<int> cores) {
    ChildCommand command;
    command.arguments = {house_program("workloads").string(), "--serve", "--library", library};
    command.environment = std::move(environment);
    command.cores = std::move(cores);
    return command;
  }

  Dialogue dialogue_;
};

int chosen_core(const WorkloadOptions& options) {
  if (options.core >= 0) return options.core;
  const std::vector<int> cores = available_cores();
  return cores.empty() ? 0 : cores.back();
}

std::string our_library(const WorkloadOptions& options) {
  return (library_folder(kLibrary, options.library) / kLibrary).string();
}

// A library, the folder of one, or a build tree.
std::string library_at(const fs::path& place) {
  for (const fs::path& path : {place, place / kLibrary, place / "lib" / kLibrary})
    if (fs::is_regular_file(path)) return fs::canonical(path).string();
  throw NotFound("no " + std::string(kLibrary) + " in " + place.string());
}

std::vector<EnvironmentVariable> our_environment(int threads, bool draft) {
  return {{"HALFSPACE_THREADS", std::to_string(threads)},
          {"HALFSPACE_ACCURACY", draft ? "draft" : "standard"}};
}

std::unique_ptr<Contestant> make_ours(const WorkloadOptions& options, bool draft) {
  return std::make_unique<Contestant>(our_library(options), our_environment(1, draft),
                                      std::vector<int>{chosen_core(options)});
}

std::unique_ptr<Contestant> make_theirs(const WorkloadOptions& options, bool draft) {
  const std::vector<int> cores{chosen_core(options)};
  if (options.against)
    return std::make_unique<Contestant>(library_at(*options.against), our_environment(1, draft), cores);
  // llvmpipe counts helpers beside the calling thread: none of them is one thread.
  const std::vector<EnvironmentVariable> environment{
      {"GALLIUM_DRIVER", options.softpipe ? "softpipe" : "llvmpipe"}, {"LP_NUM_THREADS", "0"}};
  // By name: the dynamic linker's, which is the system's.
  return std::make_unique<Contestant>(kLibrary, environment, cores);
}

struct Workload {
  std::string name, what;
  double target;
  bool draft;
  std::map<std::string, double> work;  // amounts by the names of limits
};

// The program knows them; it is asked without drawing anything.
std::vector<Workload> workloads(const WorkloadOptions& options) {
  Contestant lister(our_library(options), {}, {});
  std::vector<Workload> chosen;
  const Json list = lister.order("list");
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

struct Samples {
  std::vector<double> cpu_ms, wall_ms;

  void add(const Json& answer, int frames) {
    cpu_ms.push_back(answer.at("cpu_ms").get<double>() / frames);
    wall_ms.push_back(answer.at("wall_ms").get<double>() / frames);
  }
  FrameTime summary() const { return {summarize(cpu_ms), summarize(wall_ms)}; }
};

struct Turns {
  FrameTime first, second;
};

// How many frames make a batch, after one frame that fills the caches and lets llvmpipe compile.
int batch_of(Contestant& contestant) {
  contestant.order("run 1");
  const double frame_ms = contestant.order("run 1").at("wall_ms");
  return std::clamp(static_cast<int>(kBatchMs / std::max(frame_ms, 0.01)), 1, 2000);
}

// In turns, so that a machine that slows down slows both; each is first as often as second.
Turns take_turns(Contestant& first, Contestant& second, int rounds) {
  const int first_frames = batch_of(first), second_frames = batch_of(second);
  Samples first_times, second_times;
  const auto run_first = [&] {
    first_times.add(first.order("run " + std::to_string(first_frames)), first_frames);
  };
  const auto run_second = [&] {
    second_times.add(second.order("run " + std::to_string(second_frames)), second_frames);
  };
  for (int round = 0; round < rounds; ++round) {
    if (round % 2 == 0) run_first();
    run_second();
    if (round % 2 != 0) run_first();
  }
  return {first_times.summary(), second_times.summary()};
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
    limits_ = bench_limits(chosen_core(options_), kLimitSeconds);
  }

  void measure(const Workload& workload) {
    WorkloadRow row;
    row.name = workload.name;
    row.what = workload.what;
    row.draft = workload.draft;
    // What has been measured before shall leave nothing behind, memory above all.
    const auto ours = make_ours(options_, workload.draft), theirs = make_theirs(options_, workload.draft);
    open(workload, *ours, *theirs);
    const Turns times = take_turns(*ours, *theirs, options_.rounds);
    row.ours = times.first;
    row.theirs = times.second;
    row.ratio = row.ours.cpu_ms.median > 0 ? row.theirs.cpu_ms.median / row.ours.cpu_ms.median : 0;
    row.target = options_.against ? 1 / (1 + options_.slower_percent / 100) : workload.target;
    if (limits_ && !workload.work.empty()) row.limit_ms = milliseconds(*limits_, workload.work);
    compare_pictures(workload, *ours, *theirs, row);
    if (options_.threads && !options_.against && row.ours.wall_ms.median > kThreadsFromMs)
      measure_threads(row);
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
    std::snprintf(text, sizeof text, "%.2f of %.3g", row.ratio, row.target);
    return text;
  }

  void open(const Workload& workload, Contestant& ours, Contestant& theirs) {
    const Json us = ours.order("open " + workload.name), them = theirs.order("open " + workload.name);
    result_.our_renderer = us.at("renderer");
    result_.our_version = us.at("version");
    result_.their_renderer = them.at("renderer");
    result_.their_version = them.at("version");
    if (!result_.our_renderer.starts_with("Halfspace"))
      throw std::runtime_error("asked for Halfspace, but \"" + result_.our_renderer + "\" drew");
    if (!options_.against && result_.their_renderer.starts_with("Halfspace"))
      throw std::runtime_error("asked for Mesa, but \"" + result_.their_renderer +
                               "\" drew; is an LD_LIBRARY_PATH in the way?");
  }

  // On the last two cores, the picture not looked at: that it is the same is tested elsewhere, to the bit.
  void measure_threads(WorkloadRow& row) {
    const std::vector<int> cores = available_cores();
    if (cores.size() < 2) return;
    const std::vector<int> two(cores.end() - 2, cores.end());
    Contestant with_one(our_library(options_), our_environment(1, row.draft), two);
    Contestant with_two(our_library(options_), our_environment(2, row.draft), two);
    with_one.order("open " + row.name);
    with_two.order("open " + row.name);
    const Turns times = take_turns(with_one, with_two, options_.rounds);
    row.one_thread = times.first;
    row.two_threads = times.second;
    row.speed_up = row.one_thread.wall_ms.median / row.two_threads.wall_ms.median;
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
