// Draws the hard cases with whichever libOSMesa it finds, and lets each say whether its claim holds.
#include <GL/osmesa.h>
#include <time.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "stage.h"
#include "truth.h"

namespace halfspace::hard {
namespace {

namespace fs = std::filesystem;

struct Options {
  bool list = false, hash = false, judge = false, sweep = false, show = false;
  std::vector<std::string> names;
  std::string library, out, truth, json, size = "256x256";
  int frames = 0;
  int width = 256, height = 256;
};

// A context for one case; all its state is initial.
class Context {
 public:
  Context(int width, int height)
      : pixels_(size_t(width) * size_t(height)),
        context_(OSMesaCreateContextExt(OSMESA_RGBA, 24, 8, 0, nullptr)) {
    if (!context_ || !OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, width, height))
      throw std::runtime_error("there is no context of this size");
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  }
  ~Context() { OSMesaDestroyContext(context_); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

 private:
  std::vector<uint32_t> pixels_;
  OSMesaContext context_;
};

struct Outcome {
  Picture picture;
  std::vector<std::string> complaints;
  std::string renderer, version;
  double cpu_ms = 0;  // processor time of drawing, the making of the triangles included
};

double processor_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return double(time.tv_sec) * 1e3 + double(time.tv_nsec) * 1e-6;
}

Outcome perform(const Case& hard_case, const Options& options) {
  Context context(options.width, options.height);
  Stage stage(options.width, options.height, options.sweep, options.show);
  const double before = processor_ms();
  hard_case.draw(stage);
  glFinish();
  Outcome outcome;
  outcome.cpu_ms = processor_ms() - before;
  outcome.picture = stage.read();
  outcome.complaints = stage.complaints();
  outcome.renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  outcome.version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
  return outcome;
}

// FNV-1a over colour and depth.
uint64_t hash(const Picture& picture) {
  uint64_t h = 14695981039346656037u;
  const auto add = [&h](uint32_t byte) { h = (h ^ (byte & 255)) * 1099511628211u; };
  for (uint8_t byte : picture.rgba) add(byte);
  for (uint32_t depth : picture.depth)
    for (int shift = 0; shift < 32; shift += 8) add(depth >> shift);
  return h;
}

void save_ppm(const Picture& picture, const fs::path& path) {
  std::ofstream file(path, std::ios::binary);
  file << "P6\n" << picture.width << " " << picture.height << "\n255\n";
  for (int y = picture.height - 1; y >= 0; --y)
    for (int x = 0; x < picture.width; ++x) file.write(reinterpret_cast<const char*>(picture.pixel(x, y)), 3);
  if (!file.flush()) throw std::runtime_error(path.string() + " cannot be written");
}

// "halfspace-picture 1 WIDTH HEIGHT\n", then bytes r, g, b, a and depth in 32 bits of every pixel, lowest row
// first.
void save_picture(const Picture& picture, const fs::path& path) {
  std::ofstream file(path, std::ios::binary);
  file << "halfspace-picture 1 " << picture.width << " " << picture.height << "\n";
  for (size_t i = 0; i < picture.depth.size(); ++i) {
    file.write(reinterpret_cast<const char*>(&picture.rgba[4 * i]), 4);
    file.write(reinterpret_cast<const char*>(&picture.depth[i]), 4);
  }
  if (!file.flush()) throw std::runtime_error(path.string() + " cannot be written");
}

std::vector<const Case*> chosen(const Options& options) {
  std::vector<const Case*> list;
  const bool all = options.names.empty() || options.names.front() == "all";
  for (const Case& c : cases())
    if (all || std::find(options.names.begin(), options.names.end(), c.name) != options.names.end())
      list.push_back(&c);
  if (!all && list.size() != options.names.size())
    throw std::runtime_error("no case of that name; see --list");
  return list;
}

// The oracle numbers its frames from nought or from one: whichever file is there first is the first case's.
fs::path truth_file(const std::string& folder, size_t number) {
  const auto name = [&](size_t n) {
    char text[40];
    std::snprintf(text, sizeof text, "frame_%05zu.truth", n);
    return fs::path(folder) / text;
  };
  return fs::exists(name(0)) ? name(number) : name(number + 1);
}

void compare_with_truth(const Case& c, const Picture& picture, const fs::path& file) {
  const Error e = measure(picture, read_truth(file.string()));
  std::printf("%-22s colour %8.4f  depth %10.4f  in %7zu interior pixels, %zu wrong at edges\n", c.name,
              e.color, e.depth, e.interior, e.edge_wrong);
}

// What ref_app's --json says, as far as there is an answer here.
class Report {
 public:
  void add(const Case& c, const Outcome& outcome, const Options& options) {
    renderer_ = outcome.renderer, version_ = outcome.version;
    scenes_ +=
        std::string(scenes_.empty() ? "" : ",\n") + "{\"name\": \"" + c.name + "\", \"frame_cpu_ms\": [";
    for (int frame = 0; frame < options.frames; ++frame)
      scenes_ += (frame ? ", " : "") + std::to_string(perform(c, options).cpu_ms);
    scenes_ += "], \"picture\": ";
    scenes_ += options.out.empty() ? "null}" : "\"" + std::string(c.name) + ".ppm\"}";
  }
  void save(const std::string& path) const {
    std::ofstream file(path);
    file << "{\"gl_renderer\": \"" << renderer_ << "\", \"gl_version\": \"" << version_
         << "\", \"scenes\": [\n"
         << scenes_ << "\n]}\n";
    if (!file.flush()) throw std::runtime_error(path + " cannot be written");
  }

 private:
  std::string renderer_, version_, scenes_;
};

int run(const Options& options) {
  const std::vector<const Case*> list = chosen(options);
  Report report;
  int status = 0;
  for (size_t i = 0; i < list.size(); ++i) {
    const Case& c = *list[i];
    const Outcome outcome = perform(c, options);
    if (options.hash) {
      std::printf("%s %016llx\n", c.name, static_cast<unsigned long long>(hash(outcome.picture)));
    }
    if (options.judge) {
      std::printf("%-22s %s\n", c.name, outcome.complaints.empty() ? "holds" : "FAILS");
      for (const std::string& text : outcome.complaints) std::printf("  %s\n", text.c_str());
      if (!outcome.complaints.empty()) status = 1;
    }
    if (!options.out.empty()) {
      fs::create_directories(options.out);
      save_ppm(outcome.picture, fs::path(options.out) / (std::string(c.name) + ".ppm"));
      save_picture(outcome.picture, fs::path(options.out) / (std::string(c.name) + ".picture"));
    }
    if (!options.truth.empty()) compare_with_truth(c, outcome.picture, truth_file(options.truth, i));
    if (!options.json.empty()) report.add(c, outcome, options);
    if (i == 0) std::fprintf(stderr, "drawn by %s\n", outcome.renderer.c_str());
    std::fflush(stdout);
  }
  if (!options.json.empty()) report.save(options.json);
  return status;
}

// The loader reads LD_LIBRARY_PATH at the start of a program only, so this one starts again.
void start_again_with(const Options& options, char** argv) {
  const std::string folder = fs::absolute(options.library).parent_path().string();
  const char* now = std::getenv("LD_LIBRARY_PATH");
  if (now && std::string(now).starts_with(folder + ":")) return;
  setenv("LD_LIBRARY_PATH", (folder + ":" + (now ? now : "")).c_str(), 1);
  execv("/proc/self/exe", argv);
  throw std::runtime_error("cannot start again with " + options.library);
}

void list_cases() {
  for (const Case& c : cases()) std::printf("%s\t%s\t%s\t%s\n", c.name, c.level, c.hazard, c.claim);
}

}  // namespace
}  // namespace halfspace::hard

int main(int argc, char** argv) {
  using namespace halfspace::hard;
  Options options;
  CLI::App app("The hard cases of rasterisation, drawn by any libOSMesa");
  app.add_flag("--list", options.list, "names, least accuracy, hazards and claims, a case a line");
  bool draw = false;
  app.add_flag("--draw", draw, "draw the cases named, or all");
  app.add_flag("--hash", options.hash, "draw them and print a hash of colour and depth");
  app.add_flag("--judge", options.judge,
               "draw them and say whether each one's claim holds; exit status 1 if not");
  app.add_flag("--sweep", options.sweep, "do what one picture cannot show as well: all 2^24 blends");
  app.add_flag("--show", options.show, "for people: triangles in colours where fragments are counted");
  app.add_option("names", options.names, "cases, or all");
  app.add_option("--library", options.library, "the libOSMesa.so.8 to draw with")->check(CLI::ExistingFile);
  app.add_option("--size", options.size, "of the picture, WIDTHxHEIGHT");
  app.add_option("--out", options.out, "folder for NAME.ppm and NAME.picture");
  app.add_option("--json", options.json, "write what drew, and the times, to this file");
  app.add_option("--frames", options.frames, "times each case is drawn once more, for --json")
      ->check(CLI::Range(0, 10000));
  app.add_option("--truth", options.truth,
                 "compare with the frames the oracle left here, drawing the same cases");
  CLI11_PARSE(app, argc, argv);
  try {
    if (std::sscanf(options.size.c_str(), "%dx%d", &options.width, &options.height) != 2 ||
        options.width < 1 || options.height < 1)
      throw std::runtime_error("a size is written 256x256");
    if (options.list) return list_cases(), 0;
    if (!draw && !options.hash && !options.judge) throw std::runtime_error("nothing to do; see --help");
    if (!options.library.empty()) start_again_with(options, argv);
    return run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hard_cases: %s\n", error.what());
    return 2;
  }
}
