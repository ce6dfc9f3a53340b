#include "compare/cost.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "compare/cost_program.h"
#include "compare/cost_scenes.h"
#include "compare/cost_truth.h"
#include "compare/processor.h"

namespace halfspace::compare {
namespace {

namespace fs = std::filesystem;

std::string folder_name(const std::string& name) {
  std::string folder = name;
  std::replace_if(
      folder.begin(), folder.end(), [](char c) { return c == ' ' || c == ',' || c == '/'; }, '_');
  return folder;
}

// Values of one scene and setting, one a round; ratios to standard in the same round.
struct Times {
  std::vector<double> ms, ratio;
};

class CostRun {
 public:
  CostRun(const CostOptions& options, const Progress& progress)
      : options_(options), progress_(progress), settings_(chosen_settings(options)) {}

  void measure(const SceneGroup& group, CostResult& result) {
    const size_t first = result.scenes.size();
    for (const std::string& label : group.labels) result.scenes.push_back({label, empty_points()});
    time(group, result, first);
    judge(group, result, first);
  }

 private:
  std::vector<CostPoint> empty_points() const {
    std::vector<CostPoint> points;
    for (const Setting& setting : settings_) points.push_back({setting, {}, {}, {}});
    return points;
  }

  DrawJob job_of(const SceneGroup& group, const Setting& setting, const std::string& what) const {
    DrawJob job;
    job.program = group.program;
    job.setting = setting;
    job.folders = options_.folders;
    job.scenes = group.arguments;
    job.width = options_.width;
    job.height = options_.height;
    job.cores = {core_to_use(options_.core)};
    job.out = options_.out / what / group.program.name / folder_name(setting.name);
    return job;
  }

  // Every setting once a round, each time another one first: what disturbs the machine disturbs all alike.
  void time(const SceneGroup& group, CostResult& result, size_t first) {
    std::vector<std::vector<Times>> times(group.arguments.size(), std::vector<Times>(settings_.size()));
    for (int round = 0; round < options_.rounds; ++round) {
      progress_(group.program.name + ": time, round " + std::to_string(round + 1) + " of " +
                std::to_string(options_.rounds));
      for (size_t turn = 0; turn < settings_.size(); ++turn)
        time_once(group, (turn + static_cast<size_t>(round) * 5) % settings_.size(), times, result);
      for (auto& scene : times) add_ratios(scene);
    }
    for (size_t i = 0; i < times.size(); ++i)
      for (size_t k = 0; k < settings_.size(); ++k) {
        result.scenes[first + i].points[k].ms = summarize(times[i][k].ms);
        result.scenes[first + i].points[k].ratio = summarize(times[i][k].ratio);
      }
  }

  void time_once(const SceneGroup& group, size_t k, std::vector<std::vector<Times>>& times,
                 CostResult& result) {
    DrawJob job = job_of(group, settings_[k], "time");
    job.frames = options_.frames;
    const DrawnScenes drawn = draw_scenes(job);
    for (size_t i = 0; i < drawn.scenes.size(); ++i)
      times[i][k].ms.push_back(summarize(drawn.scenes[i].cpu_ms).median);
    if (settings_[k].library == Library::mesa) result.mesa_version = drawn.version;
    if (settings_[k].library == Library::ours)
      result.our_renderer = drawn.renderer, result.our_version = drawn.version;
  }

  void add_ratios(std::vector<Times>& scene) const {
    const size_t standard = standard_index(settings_);
    const double one = scene[standard].ms.back();
    if (one <= 0) return;
    for (Times& times : scene) times.ratio.push_back(times.ms.back() / one);
  }

  // The pictures of each setting in each paint the program knows, against the truth of that paint.
  void judge(const SceneGroup& group, CostResult& result, size_t first) {
    std::map<std::string, std::vector<DrawnScenes>> pictures;  // by paint; by setting; by scene
    for (const std::string& paint : paints_of(group.program)) {
      progress_(group.program.name + ": pictures (" + paint + ")");
      for (const Setting& setting : settings_) pictures[paint].push_back(draw_painted(group, setting, paint));
    }
    for (size_t i = 0; i < group.arguments.size(); ++i) {
      const PaintedTruths truths(options_, group, i, progress_);
      result.oracle = truths.renderer();
      for (size_t k = 0; k < settings_.size(); ++k) {
        std::map<std::string, fs::path> files;
        for (const auto& [paint, drawn] : pictures) files[paint] = drawn[k].scenes[i].picture;
        result.scenes[first + i].points[k].error = truths.error_of(files);
      }
    }
  }

  DrawnScenes draw_painted(const SceneGroup& group, const Setting& setting, const std::string& paint) {
    DrawJob job = job_of(group, setting, "pictures_" + paint);
    job.paint = paint;
    job.pictures = true;
    return draw_scenes(job);
  }

  const CostOptions& options_;
  const Progress& progress_;
  const std::vector<Setting> settings_;
};

bool is_complete(const CostPoint& point) { return point.error && point.ratio.median > 0; }

// Times that are nearer to each other than this share are the same.
double noise(const CostPoint& a, const CostPoint& b) {
  constexpr double kLeast = 0.02;
  return std::max(kLeast, a.ratio.spread + b.ratio.spread);
}

bool is_faster(const CostPoint& a, const CostPoint& b) {
  return a.ratio.median < b.ratio.median * (1 - noise(a, b));
}

// Standard, then the whole dial or another renderer, then one axis alone.
int rank(const Setting& setting) {
  return setting.name == standard_setting().name ? 0 : setting.axis.empty() ? 1 : 2;
}

bool is_simpler(const CostPoint& a, const CostPoint& b) { return rank(a.setting) < rank(b.setting); }

Summary geometric_mean(const std::vector<Summary>& ratios) {
  Summary mean;
  double sum = 0;
  for (const Summary& ratio : ratios) {
    if (ratio.median <= 0) return {};
    sum += std::log(ratio.median);
    mean.spread = std::max(mean.spread, ratio.spread);
    mean.count += ratio.count;
  }
  mean.median = std::exp(sum / static_cast<double>(ratios.size()));
  mean.lowest = mean.highest = mean.median;
  return mean;
}

CostPoint over_all_scenes(const CostResult& result, size_t k) {
  CostPoint all;
  all.setting = result.scenes.front().points[k].setting;
  std::vector<Summary> ratios;
  std::vector<TruthError> errors;
  for (const CostScene& scene : result.scenes) {
    const CostPoint& point = scene.points[k];
    ratios.push_back(point.ratio);
    all.ms.median += point.ms.median;
    if (point.error) errors.push_back(*point.error);
  }
  all.ratio = geometric_mean(ratios);
  if (errors.size() == result.scenes.size()) all.error = pooled(errors);
  return all;
}

}  // namespace

CostResult measure_cost(const CostOptions& options, const Progress& progress) {
  CostResult result;
  result.options = options;
  result.processor = processor_name();
  if (!options.program.empty()) {
    measure_program(options, progress, result);
    return result;
  }
  CostRun run(options, progress);
  for (const SceneGroup& group : chosen_groups(options)) run.measure(group, result);
  return result;
}

CostScene all_scenes(const CostResult& result) {
  CostScene all{"all scenes", {}};
  if (result.scenes.empty()) return all;
  for (size_t k = 0; k < result.scenes.front().points.size(); ++k)
    all.points.push_back(over_all_scenes(result, k));
  return all;
}

std::vector<const CostPoint*> pareto_front(const CostScene& scene) {
  std::vector<const CostPoint*> points;
  for (const CostPoint& point : scene.points)
    if (is_complete(point)) points.push_back(&point);
  // The fewest errors first; of equal errors the fastest, and the simpler setting before one that is no
  // slower.
  std::stable_sort(points.begin(), points.end(), [](const CostPoint* a, const CostPoint* b) {
    return a->error->wrong != b->error->wrong ? a->error->wrong < b->error->wrong : is_simpler(*a, *b);
  });
  std::vector<const CostPoint*> front;
  for (const CostPoint* point : points) {
    if (!front.empty() && !is_faster(*point, *front.back())) continue;
    // The same error in less time.
    if (!front.empty() && front.back()->error->wrong == point->error->wrong) front.pop_back();
    front.push_back(point);
  }
  std::reverse(front.begin(), front.end());
  return front;
}

}  // namespace halfspace::compare
