// stream_truth --player P --ours LIBRARY --oracle LIBRARY: the fuzzer's random streams on our renderer and on
// the oracle. Every byte has to be one that the truth allows: off by at most 0.05 levels before it is rounded
// or blended. Pixels over which rounding may decide (a depth test within a step, a texel's very edge) are
// counted, not judged.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "tests/differential/true_frame.h"
#include "tests/fuzz/maker.h"
#include "tests/fuzz/renderer.h"
#include "tests/fuzz/shrink.h"
#include "tests/support/temporary_folder.h"

namespace halfspace::differential {
namespace {

struct Options {
  std::string player, ours, oracle, groups;
  uint64_t first = 1, count = 100;
  int most_tries = 300;
  double most_doubtful = 0.05;  // of all pixels
  double depth = 1;             // steps of the 24-bit buffer
};

struct Judged {
  std::string trouble;
  int wrong = 0, doubtful = 0, x = 0, y = 0;  // the first wrong one
};

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  for (size_t from = 0; from < text.size();) {
    const size_t to = std::min(text.find(',', from), text.size());
    parts.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return parts;
}

class Checker {
 public:
  Checker(const Options& options, const std::string& directory)
      : options_(options),
        directory_(directory),
        ours_(options.player, options.ours, ""),
        oracle_(options.player, options.oracle, ""),
        // Selection and feedback draw nothing, and what smooth points and lines cover is exact at one level
        // only.
        groups_(fuzz::groups_without(split(options.groups), {"selection", "feedback", "smooth"})) {
    setenv("HALFSPACE_TRUTH", directory.c_str(), 1);  // of the oracle's player: ours does not know it
  }

  bool run() {
    uint64_t failures = 0, doubtful = 0;
    for (uint64_t seed = options_.first; seed < options_.first + options_.count; ++seed) {
      const fuzz::Stream stream = fuzz::make_stream(seed, groups_);
      const Judged judged = judge(stream);
      doubtful += static_cast<uint64_t>(judged.doubtful);
      if (judged.trouble.empty() && judged.wrong == 0) continue;
      ++failures;
      report(seed, stream);
    }
    const double part =
        static_cast<double>(doubtful) / (static_cast<double>(options_.count) * fuzz::kWidth * fuzz::kHeight);
    std::printf("%llu streams, %llu failures, %.3f %% of the pixels not judged\n",
                static_cast<unsigned long long>(options_.count), static_cast<unsigned long long>(failures),
                100 * part);
    return failures == 0 && part <= options_.most_doubtful;
  }

 private:
  Judged judge(const fuzz::Stream& stream) {
    Judged judged;
    const fuzz::Outcome ours = ours_.render(stream, fuzz::kWidth, fuzz::kHeight);
    const fuzz::Outcome oracle = oracle_.render(stream, fuzz::kWidth, fuzz::kHeight);
    judged.trouble = ours.trouble + oracle.trouble;
    if (!judged.trouble.empty()) return judged;
    frame_ = read_last_frame(directory_);
    remove_frames(directory_);
    picture_ = ours.picture;
    for (int y = 0; y < frame_.height; ++y) {
      for (int x = 0; x < frame_.width; ++x) {
        const TruePixel& truth = frame_.at(x, y);
        if (truth.doubtful)
          ++judged.doubtful;
        else if ((!allows(truth, byte_at(x, y)) || !is_depth(truth, depth_at(x, y))) && judged.wrong++ == 0)
          judged.x = x, judged.y = y;
      }
    }
    return judged;
  }

  static bool allows(const TruePixel& truth, const uint8_t* byte) {
    for (size_t k = 0; k < 4; ++k)
      if (byte[k] < truth.low[k] || byte[k] > truth.high[k]) return false;
    return true;
  }
  bool is_depth(const TruePixel& truth, uint32_t depth) const {
    return std::fabs(static_cast<double>(depth) - truth.depth) <= options_.depth;
  }
  uint32_t depth_at(int x, int y) const {
    return picture_.depth[static_cast<size_t>(y * picture_.width + x)];
  }
  const uint8_t* byte_at(int x, int y) const {
    return &picture_.rgba[4 * static_cast<size_t>(y * picture_.width + x)];
  }

  void report(uint64_t seed, const fuzz::Stream& stream) {
    const auto fails = [&](const fuzz::Stream& candidate) {
      const Judged judged = judge(candidate);
      return !judged.trouble.empty() || judged.wrong != 0;
    };
    const fuzz::Stream cut = options_.most_tries ? fuzz::shrink(stream, fails, options_.most_tries) : stream;
    const Judged judged = judge(cut);
    std::printf("seed %llu, cut down from %zu calls to %zu: ", static_cast<unsigned long long>(seed),
                stream.size(), cut.size());
    if (!judged.trouble.empty()) {
      std::printf("%s\n", judged.trouble.c_str());
    } else {
      const TruePixel& truth = frame_.at(judged.x, judged.y);
      const uint8_t* byte = byte_at(judged.x, judged.y);
      std::printf(
          "%d pixels wrong, (%d, %d) of primitive %u shows %d %d %d %d, true is %.4f %.4f %.4f %.4f\n",
          judged.wrong, judged.x, judged.y, truth.owner, byte[0], byte[1], byte[2], byte[3],
          static_cast<double>(truth.level[0]), static_cast<double>(truth.level[1]),
          static_cast<double>(truth.level[2]), static_cast<double>(truth.level[3]));
    }
    for (const fuzz::Call& call : cut) std::printf("    %s\n", fuzz::print_call(call).c_str());
    std::fflush(stdout);
  }

  const Options& options_;
  const std::string directory_;
  fuzz::Renderer ours_, oracle_;
  std::vector<std::string> groups_;
  TrueFrame frame_;
  fuzz::Picture picture_;
};

int run(int argc, char** argv) {
  Options options;
  CLI::App app("Random streams of GL calls on our renderer and on the oracle.");
  app.add_option("--player", options.player, "The fuzzer's player")->required();
  app.add_option("--ours", options.ours, "Our libOSMesa")->required();
  app.add_option("--oracle", options.oracle, "The oracle's")->required();
  app.add_option("--first", options.first, "The first seed");
  app.add_option("--seeds", options.count, "How many");
  app.add_option("--depth", options.depth,
                 "Steps that a depth may be off: standard promises 1, exact rounding's half");
  app.add_option("--groups", options.groups, "Only these groups of calls, separated by commas");
  app.add_option("--tries", options.most_tries,
                 "Streams to try while one is cut down; 0: it is printed whole");
  CLI11_PARSE(app, argc, argv);
  const test::TemporaryFolder folder;
  return Checker(options, folder.path().string()).run() ? 0 : 1;
}

}  // namespace
}  // namespace halfspace::differential

int main(int argc, char** argv) {
  try {
    return halfspace::differential::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stream_truth: %s\n", error.what());
    return 2;
  }
}
