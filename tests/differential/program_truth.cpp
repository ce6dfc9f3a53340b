// program_truth --ours FOLDER --oracle FOLDER PROGRAM [ARGUMENTS]: runs a program on our library and on the
// oracle's, and holds every frame it shows against its truth. Every byte has to be one that the truth allows;
// --equal asks for the truth's very bytes, for pictures that are numbers.
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "tests/differential/true_frame.h"
#include "tests/support/temporary_folder.h"

namespace halfspace::differential {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string ours, oracle;
  std::vector<std::string> program;
  bool equal = false;
  size_t frames = 1;  // that there have to be
};

void run_program(const Options& options, const std::string& libraries, const char* variable,
                 const fs::path& out) {
  fs::create_directories(out);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) {
    setenv("LD_LIBRARY_PATH", libraries.c_str(), 1);
    setenv(variable, out.c_str(), 1);
    std::vector<char*> words;
    for (const std::string& word : options.program) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    if (!freopen("/dev/null", "w", stdout)) _exit(126);
    execv(words[0], words.data());
    _exit(127);
  }
  int status = 0;
  if (waitpid(child, &status, 0) != child || status != 0)
    throw std::runtime_error(options.program[0] + " failed on " + libraries);
}

struct Ppm {
  int width = 0, height = 0;
  std::vector<uint8_t> rgb;  // top row first
  const uint8_t* at(int x, int y) const {
    return &rgb[3 *
                (static_cast<size_t>(height - 1 - y) * static_cast<size_t>(width) + static_cast<size_t>(x))];
  }
};

Ppm read_ppm(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic;
  Ppm picture;
  int most = 0;
  file >> magic >> picture.width >> picture.height >> most;
  file.get();
  picture.rgb.resize(size_t{3} * static_cast<size_t>(picture.width) * static_cast<size_t>(picture.height));
  file.read(reinterpret_cast<char*>(picture.rgb.data()), static_cast<std::streamsize>(picture.rgb.size()));
  if (!file || magic != "P6") throw std::runtime_error("no picture in " + path.string());
  return picture;
}

struct Judged {
  size_t pixels = 0, doubtful = 0, not_rounded = 0, wrong = 0;
  double worst = 0;  // levels from the truth before rounding
  int x = 0, y = 0;  // of the first wrong one
};

Judged judge(const TrueFrame& truth, const Ppm& picture, bool equal) {
  if (truth.width != picture.width || truth.height != picture.height)
    throw std::runtime_error("the pictures' sizes differ");
  Judged judged;
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      const TruePixel& pixel = truth.at(x, y);
      const uint8_t* byte = picture.at(x, y);
      ++judged.pixels;
      if (pixel.doubtful && !equal) {
        ++judged.doubtful;
        continue;
      }
      bool wrong = false, rounded = true;
      for (size_t k = 0; k < 3; ++k) {
        const double off = std::fabs(static_cast<double>(byte[k]) - static_cast<double>(pixel.level[k]));
        judged.worst = std::max(judged.worst, off);
        rounded = rounded && off <= 0.5;
        wrong = wrong || (equal ? off >= 0.5 : byte[k] < pixel.low[k] || byte[k] > pixel.high[k]);
      }
      judged.not_rounded += !rounded;
      if (wrong && judged.wrong++ == 0) judged.x = x, judged.y = y;
    }
  }
  return judged;
}

bool report(const std::string& name, const Judged& judged, const TrueFrame& truth, const Ppm& picture) {
  std::printf("%s  %7zu pixels, %zu not the truth rounded, worst %.4f levels; %zu not judged\n", name.c_str(),
              judged.pixels, judged.not_rounded, judged.worst, judged.doubtful);
  if (judged.wrong == 0) return true;
  const TruePixel& pixel = truth.at(judged.x, judged.y);
  const uint8_t* byte = picture.at(judged.x, judged.y);
  std::printf(
      "  WRONG in %zu pixels: (%d, %d) of primitive %u of draw %u shows %d %d %d, true is %.4f %.4f %.4f\n",
      judged.wrong, judged.x, judged.y, pixel.owner, pixel.draw, byte[0], byte[1], byte[2],
      static_cast<double>(pixel.level[0]), static_cast<double>(pixel.level[1]),
      static_cast<double>(pixel.level[2]));
  return false;
}

bool check(const Options& options, const fs::path& folder) {
  const fs::path ours = folder / "ours", oracle = folder / "oracle";
  run_program(options, options.ours, "HALFSPACE_CAPTURE", ours);
  run_program(options, options.oracle, "HALFSPACE_TRUTH", oracle);
  const std::vector<std::string> stems = frames_in(oracle.string());
  bool good = stems.size() >= options.frames;
  if (!good) std::printf("%zu frames were shown, not %zu\n", stems.size(), options.frames);
  for (const std::string& stem : stems) {
    const std::string name = fs::path(stem).filename().string();
    const TrueFrame truth = read_frame(stem);
    const Ppm picture = read_ppm(ours / (name + ".ppm"));
    good = report(name, judge(truth, picture, options.equal), truth, picture) && good;
  }
  return good;
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app("Holds every frame a program shows on our library against the oracle's.");
  app.add_option("--ours", options.ours, "Folder of our libraries")->required();
  app.add_option("--oracle", options.oracle, "Folder of the oracle's")->required();
  app.add_flag("--equal", options.equal, "The pictures are numbers: they have to be equal");
  app.add_option("--frames", options.frames, "How many frames there have to be, at least");
  app.add_option("program", options.program, "The program and its arguments")->required();
  app.positionals_at_end();
  CLI11_PARSE(app, argc, argv);
  const test::TemporaryFolder folder;
  return check(options, folder.path()) ? 0 : 1;
}

}  // namespace
}  // namespace halfspace::differential

int main(int argc, char** argv) {
  try {
    return halfspace::differential::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "program_truth: %s\n", error.what());
    return 2;
  }
}
