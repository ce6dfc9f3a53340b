#include "bench/runner.h"

#include <fstream>
#include <istream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "bench/gl.h"
#include "bench/memory.h"
#include "bench/scales.h"

namespace halfspace::bench {

using Json = nlohmann::json;

Json list_of_workloads() {
  Json list = Json::array();
  for (const Workload& workload : all_workloads())
    list.push_back({{"name", workload.name},
                    {"target", workload.target},
                    {"draft_target", workload.draft_target},
                    {"what", workload.what},
                    {"work", work_of(workload.name)}});
  return list;
}

Json list_of_scales() {
  Json list = Json::array();
  for (const Scale& scale : all_scales())
    list.push_back({{"name", scale.name}, {"what", scale.what}, {"amounts", scale.amounts}});
  return list;
}

Run::Run(const Library& library, const Prepare& prepare, Screen screen)
    : screen_(screen),
      before_kib_(memory_now().resident_kib),
      context_(library, screen),
      context_kib_(memory_now().resident_kib - before_kib_),
      frame_(prepare(screen)) {}

Times Run::frames(int count) {
  const Times start = now();
  for (int i = 0; i < count; ++i) frame_();
  const Times time = now() - start;
  if (const GLenum error = gl.GetError(); error != GL_NO_ERROR)
    throw std::runtime_error("GL recorded error " + std::to_string(error));
  return time;
}

void Run::save_picture(const std::filesystem::path& path) const {
  const auto width = static_cast<size_t>(screen_.width), height = static_cast<size_t>(screen_.height);
  std::string text = "P6\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
  for (size_t row = height; row-- > 0;)
    for (size_t column = 0; column < width; ++column) {
      const uint32_t pixel = context_.pixels()[row * width + column];
      for (const unsigned shift : {0u, 8u, 16u}) text += static_cast<char>(pixel >> shift & 255u);
    }
  std::ofstream file(path, std::ios::binary);
  if (!(file << text).flush()) throw std::runtime_error(path.string() + ": cannot be written");
}

namespace {

std::string gl_string(GLenum name) { return reinterpret_cast<const char*>(gl.GetString(name)); }

class Servant {
 public:
  Servant(const Library& library, Screen screen, long unloaded_kib)
      : library_(library), screen_(screen), unloaded_kib_(unloaded_kib) {}

  Json answer(const std::string& line) {
    std::istringstream words(line);
    std::string order, argument;
    words >> order;
    std::getline(words >> std::ws, argument);
    if (order == "list") return {{"workloads", list_of_workloads()}, {"scales", list_of_scales()}};
    if (order == "open") return open(workload_named(argument).prepare, screen_);
    if (order == "scale") return open_scale(argument);
    if (order == "empty") return open([](Screen) -> Frame { return [] { gl.Finish(); }; }, screen_);
    if (order == "memory") return memory();
    if (!run_) throw std::runtime_error(order + ": nothing is open");
    if (order == "run") return run(std::stoi(argument));
    if (order == "picture") run_->save_picture(argument);
    if (order == "close") run_.reset();
    return Json::object();
  }

 private:
  Json open(const Run::Prepare& prepare, Screen screen) {
    run_.reset();  // one context at a time
    run_ = std::make_unique<Run>(library_, prepare, screen);
    return {{"renderer", gl_string(GL_RENDERER)}, {"version", gl_string(GL_VERSION)}};
  }
  Json open_scale(const std::string& argument) {
    std::istringstream words(argument);
    std::string name;
    int amount = 0;
    if (!(words >> name >> amount)) throw std::runtime_error("scale needs a name and an amount");
    const Scale& scale = scale_named(name);
    return open([&](Screen screen) { return scale.prepare(amount, screen); },
                screen_of(scale, amount, screen_));
  }
  Json run(int count) {
    const Times time = run_->frames(count);
    return {{"cpu_ms", time.cpu_ms}, {"wall_ms", time.wall_ms}};
  }

  Json memory() const {
    const Memory memory = memory_now();
    forget_peak();
    return {{"resident_kib", memory.resident_kib},
            {"peak_kib", memory.peak_kib},
            {"context_kib", run_ ? run_->context_kib() : 0},
            {"unloaded_kib", unloaded_kib_}};
  }

  const Library& library_;
  Screen screen_;
  long unloaded_kib_;
  std::unique_ptr<Run> run_;
};

}  // namespace

void serve(const Library& library, Screen screen, long unloaded_kib, std::istream& in, std::ostream& out) {
  Servant servant(library, screen, unloaded_kib);
  for (std::string line; std::getline(in, line);) {
    Json answer;
    try {
      answer = servant.answer(line);
    } catch (const std::exception& error) {
      answer = {{"error", error.what()}};
    }
    out << answer.dump() << std::endl;
  }
}

}  // namespace halfspace::bench
