#include "compare/bench_scenes.h"

#include <algorithm>
#include <map>

#include "compare/processor.h"

namespace halfspace::compare {
namespace {

constexpr double kStartTarget = 0.2;    // of OSMesa's time from process start to first picture
constexpr double kThreadsTarget = 1.7;  // speed-up of two threads
constexpr double kMemoryTargetMb = 25;
constexpr int kThreadScenes[] = {7, 8};

using Progress = std::function<void(const std::string&)>;

// Values gathered over the pairs, by scene.
struct Samples {
  std::map<int, std::vector<double>> scene_ms;
  std::map<int, std::string> names;
  std::string renderer, version;

  void add(const SceneResult& result) {
    for (const SceneTime& time : result.scenes) {
      scene_ms[time.scene].push_back(time.median_ms);
      names[time.scene] = time.name;
    }
    renderer = result.renderer;
    version = result.version;
  }
};

std::vector<int> chosen_scenes(const BenchOptions& options) {
  if (!options.scenes.empty()) return options.scenes;
  std::vector<int> all;
  for (int scene = 1; scene <= kSceneCount; ++scene) all.push_back(scene);
  return all;
}

SceneJob make_job(const BenchOptions& options, Renderer renderer, std::vector<int> scenes, int threads,
                  std::vector<int> cores) {
  SceneJob job;
  job.renderer = renderer;
  job.scenes = std::move(scenes);
  job.frames = options.frames;
  job.width = options.width;
  job.height = options.height;
  job.threads = threads;
  job.cores = std::move(cores);
  job.library = options.library;
  job.pictures = false;
  job.out = options.out / (renderer == Renderer::ours ? "ours" : "osmesa");
  return job;
}

BenchRow lower_is_better(std::string what, std::string unit, const std::vector<double>& ours,
                         const std::vector<double>& theirs, double target) {
  BenchRow row;
  row.what = std::move(what);
  row.unit = std::move(unit);
  row.ours = summarize(ours);
  row.theirs = summarize(theirs);
  row.ratio = paired_ratio(ours, theirs);
  row.target = target;
  row.good = row.ratio.median <= target;
  return row;
}

// One process a renderer and pair draws every scene; the pairs alternate, so that a machine that slows down
// slows both.
void measure_pairs(const BenchOptions& options, Samples& ours, Samples& theirs, const Progress& progress) {
  const std::vector<int> scenes = chosen_scenes(options);
  const std::vector<int> core{core_to_use(options.core)};
  for (int pair = 0; pair < options.pairs; ++pair) {
    progress("scenes, pair " + std::to_string(pair + 1) + " of " + std::to_string(options.pairs));
    ours.add(run_scenes(make_job(options, Renderer::ours, scenes, 1, core)));
    theirs.add(run_scenes(make_job(options, Renderer::osmesa, scenes, 1, core)));
  }
}

// A process of its own each, with one scene and one frame; `take` keeps what is measured.
using TakeValue = std::function<double(const SceneResult&)>;

void measure_processes(const BenchOptions& options, const std::string& what, SceneJob job,
                       const TakeValue& take, std::vector<double>& ours, std::vector<double>& theirs,
                       const Progress& progress) {
  job.frames = 0;  // none after the first
  for (int pair = 0; pair < options.pairs; ++pair) {
    progress(what + ", pair " + std::to_string(pair + 1) + " of " + std::to_string(options.pairs));
    job.renderer = Renderer::ours;
    ours.push_back(take(run_scenes(job)));
    job.renderer = Renderer::osmesa;
    theirs.push_back(take(run_scenes(job)));
  }
}

BenchRow start_row(const BenchOptions& options, const Progress& progress) {
  const std::string what = "process start to first picture";
  std::vector<double> ours, theirs;
  measure_processes(
      options, what, make_job(options, Renderer::ours, {1}, 1, {core_to_use(options.core)}),
      [](const SceneResult& result) { return result.first_picture_ms; }, ours, theirs, progress);
  return lower_is_better(what, "ms", ours, theirs, kStartTarget);
}

BenchRow memory_row(const BenchOptions& options, int scene, const Progress& progress) {
  const std::string what = "peak memory, scene " + std::to_string(scene);
  SceneJob job = make_job(options, Renderer::ours, {scene}, 1, {core_to_use(options.core)});
  std::vector<double> ours, theirs;
  measure_processes(
      options, what, job,
      [](const SceneResult& result) { return static_cast<double>(result.peak_kib) / 1024; }, ours, theirs,
      progress);
  BenchRow row = lower_is_better(what, "MB", ours, theirs, kMemoryTargetMb);
  row.ratio = summarize({row.ours.highest});
  row.good = row.ours.highest <= kMemoryTargetMb;
  row.remark = "MB at most";
  return row;
}

BenchRow thread_row(const BenchOptions& options, int scene, const Progress& progress) {
  const std::vector<int> cores = available_cores();
  BenchRow row;
  row.what = "two threads against one, scene " + std::to_string(scene);
  row.unit = "ms";
  row.target = kThreadsTarget;
  row.higher_is_better = true;
  row.remark = "speed-up";
  if (cores.size() < 2) {
    row.remark = "needs two cores";
    return row;
  }
  const std::vector<int> two(cores.end() - 2, cores.end());
  Samples one_thread, two_threads;
  for (int pair = 0; pair < options.pairs; ++pair) {
    progress(row.what + ", pair " + std::to_string(pair + 1) + " of " + std::to_string(options.pairs));
    two_threads.add(run_scenes(make_job(options, Renderer::ours, {scene}, 2, two)));
    one_thread.add(run_scenes(make_job(options, Renderer::ours, {scene}, 1, two)));
  }
  row.ours = summarize(two_threads.scene_ms[scene]);
  row.theirs = summarize(one_thread.scene_ms[scene]);
  row.ratio = paired_ratio(one_thread.scene_ms[scene], two_threads.scene_ms[scene]);
  row.good = row.ratio.median >= kThreadsTarget;
  return row;
}

}  // namespace

double scene_target(int scene) { return scene <= 4 ? 0.5 : scene <= 7 ? 0.25 : 0.2; }

BenchResult bench_scenes(const BenchOptions& options, const Progress& progress) {
  BenchResult result;
  result.options = options;
  result.processor = processor_name();
  Samples ours, theirs;
  measure_pairs(options, ours, theirs, progress);
  for (int scene : chosen_scenes(options))
    result.scenes.push_back(lower_is_better(std::to_string(scene) + " " + ours.names[scene], "ms",
                                            ours.scene_ms[scene], theirs.scene_ms[scene],
                                            scene_target(scene)));
  result.our_renderer = ours.renderer;
  result.our_version = ours.version;
  result.their_renderer = theirs.renderer;
  result.their_version = theirs.version;

  result.others.push_back(start_row(options, progress));
  for (int scene : kThreadScenes) result.others.push_back(thread_row(options, scene, progress));
  result.others.push_back(memory_row(options, kSceneCount, progress));
  return result;
}

bool all_good(const BenchResult& result) {
  const auto good = [](const BenchRow& row) { return row.good.value_or(true); };
  return std::all_of(result.scenes.begin(), result.scenes.end(), good) &&
         std::all_of(result.others.begin(), result.others.end(), good);
}

}  // namespace halfspace::compare
