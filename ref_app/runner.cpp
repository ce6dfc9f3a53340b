#include "ref_app/runner.h"

#include <malloc.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "ref_app/image_file.h"
#include "ref_app/input_error.h"
#include "ref_app/paint.h"
#include "ref_app/picture_spool.h"
#include "ref_app/process_clock.h"
#include "ref_app/report.h"
#include "ref_app/scenes.h"

namespace ref_app {
namespace {

namespace fs = std::filesystem;

constexpr float kFrameSeconds = 1.0F / 30;  // between two frames of an animation

Motion motion_at(int frame, bool animate) {
  Motion motion;
  if (animate) motion.seconds = kFrameSeconds * static_cast<float>(frame);
  if (animate) motion.yaw = 0.3F * motion.seconds;
  return motion;
}

struct FrameTime {
  double ms = 0, cpu_ms = 0;
};

// Clear, draw and finish.
FrameTime time_frame(Scene& scene, Renderer& renderer, const Motion& motion) {
  using Clock = std::chrono::steady_clock;
  const double cpu_begin = processor_milliseconds();
  const Clock::time_point begin = Clock::now();
  scene.draw(renderer, motion);
  const std::chrono::duration<double, std::milli> wall = Clock::now() - begin;
  return {wall.count(), processor_milliseconds() - cpu_begin};
}

class Run {
 public:
  Run(Backend& backend, const Options& options, const std::vector<SceneSource>& scenes)
      : backend_(backend), options_(options), scenes_(scenes), assets_(options.assets, options.model) {
    if (const Paint paint = paint_of(options.paint); paint != Paint::scene)
      painted_.emplace(backend.renderer(), paint);
    report_.backend = backend_name();
    report_.strings = backend.strings();
    report_.width = options.width, report_.height = options.height;
  }

  int all() {
    if (options_.pictures) make_out_folder();
    print_header(report_);
    for (const SceneSource& source : scenes_) {
      report_.scenes.push_back(draw_scene(source));
      print_scene(report_.scenes.back());
      complain(source);
    }
    report_.peak_kib = peak_memory_kib();
    print_summary(report_);
    if (options_.pictures) save_pictures();
    if (!options_.json.empty()) write_json(report_, options_.json);
    return failed_ ? 1 : 0;
  }

 private:
  void make_out_folder() {
    std::error_code failure;
    fs::create_directories(options_.out, failure);
    if (failure) throw InputError("cannot make the folder " + options_.out + ": " + failure.message());
  }

  SceneResult draw_scene(const SceneSource& source) {
    Renderer& renderer = painted_ ? *painted_ : backend_.renderer();
    SceneResult result;
    result.scene = source.number;
    result.name = source.name;
    {
      const std::unique_ptr<Scene> scene = source.make(renderer, assets_);
      malloc_trim(0);  // the images' own pixels have been handed over by now
      result.triangles = scene->triangle_count();
      result.first_ms = time_frame(*scene, renderer, motion_at(0, options_.animate)).ms;
      if (report_.scenes.empty()) report_.start_to_first_picture_ms = milliseconds_since_process_start();
      for (int frame = 1; frame <= options_.frames; ++frame) {
        const FrameTime time = time_frame(*scene, renderer, motion_at(frame, options_.animate));
        result.frame_ms.push_back(time.ms);
        result.frame_cpu_ms.push_back(time.cpu_ms);
      }
    }
    malloc_trim(0);
    if (options_.pictures) result.opaque = spool_.store(renderer);
    result.peak_kib = peak_memory_kib();
    return result;
  }

  void complain(const SceneSource& source) {
    const std::string errors = backend_.take_errors();
    if (errors.empty()) return;
    std::fprintf(stderr, "ref_app: scene %s: %s\n", source.name.c_str(), errors.c_str());
    failed_ = true;
  }

  void save_pictures() {
    for (size_t i = 0; i < report_.scenes.size(); ++i) {
      SceneResult& result = report_.scenes[i];
      const std::string name = scenes_[i].file + "." + options_.format;
      result.picture = (fs::path(options_.out) / name).string();
      save_image(result.picture, spool_.fetch(i));
    }
    std::printf("pictures are in %s\n", options_.out.c_str());
  }

  Backend& backend_;
  const Options& options_;
  const std::vector<SceneSource>& scenes_;
  Assets assets_;
  std::optional<PaintedRenderer> painted_;
  PictureSpool spool_;
  Report report_;
  bool failed_ = false;
};

}  // namespace

std::vector<SceneSource> reference_scenes(const std::vector<int>& numbers) {
  std::vector<SceneSource> sources;
  for (const int number : numbers) {
    sources.push_back({number, scene_name(number), "scene_" + std::to_string(number),
                       [number](Renderer& renderer, const Assets& assets) {
                         return make_scene(number, renderer, assets);
                       }});
  }
  return sources;
}

int run_scenes(Backend& backend, const Options& options, const std::vector<SceneSource>& scenes) {
  return Run(backend, options, scenes).all();
}

}  // namespace ref_app
