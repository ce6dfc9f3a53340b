// fuzz --player P --ours LIBRARY [...]: streams from seeds on our renderer and on Mesa's two; what differs is
// cut down and printed as C.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "maker.h"
#include "renderer.h"
#include "shrink.h"
#include "verdict.h"

namespace {

using namespace halfspace::fuzz;

struct Options {
  std::string player, ours, theirs = "libOSMesa.so.8", out;
  uint64_t first = 1, count = 100;
  std::vector<std::string> groups, left_out;
  Limits limits;
  int most_tries = 400;
  bool print_only = false, sabotage = false;
};

[[noreturn]] void usage() {
  std::fprintf(
      stderr,
      "usage: fuzz --player PROGRAM --ours LIBRARY [--theirs LIBRARY] [--first SEED] [--seeds COUNT]\n"
      "            [--groups a,b,...] [--without a,b,...] [--levels N] [--pixels N] [--out DIR] [--print] "
      "[--no-shrink]\n"
      "            [--sabotage]   ours is not told of the last glBegin ... glEnd: this has to be found out\n"
      "groups:");
  for (const std::string& group : all_groups()) std::fprintf(stderr, " %s", group.c_str());
  std::fprintf(stderr, "\n");
  std::exit(2);
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  for (char c : text) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

Options parse(int count, char** words) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const auto value = [&]() -> std::string {
      if (++i >= count) usage();
      return words[i];
    };
    if (word == "--player")
      options.player = value();
    else if (word == "--ours")
      options.ours = value();
    else if (word == "--theirs")
      options.theirs = value();
    else if (word == "--first")
      options.first = std::stoull(value());
    else if (word == "--seeds")
      options.count = std::stoull(value());
    else if (word == "--groups")
      options.groups = split(value());
    else if (word == "--without")
      options.left_out = split(value());
    else if (word == "--levels")
      options.limits.levels = std::stoi(value());
    else if (word == "--pixels")
      options.limits.pixels = std::stoi(value());
    else if (word == "--out")
      options.out = value();
    else if (word == "--print")
      options.print_only = true;
    else if (word == "--no-shrink")
      options.most_tries = 0;
    else if (word == "--sabotage")
      options.sabotage = true;
    else
      usage();
  }
  if (!options.left_out.empty()) options.groups = groups_without(options.groups, options.left_out);
  if (!options.print_only && (options.player.empty() || options.ours.empty())) usage();
  return options;
}

// Without the last Begin and End, so that something is missing in the picture.
Stream sabotaged(Stream stream) {
  size_t end = stream.size();
  while (end > 0 && stream[end - 1].command != Command::glEnd) --end;
  size_t begin = end;
  while (begin > 0 && stream[begin].command != Command::glBegin) --begin;
  stream.erase(stream.begin() + static_cast<std::ptrdiff_t>(begin),
               stream.begin() + static_cast<std::ptrdiff_t>(end));
  return stream;
}

void write_ppm(const std::string& path, const Picture& picture) {
  std::ofstream file(path, std::ios::binary);
  file << "P6 " << picture.width << " " << picture.height << " 255\n";
  for (int y = picture.height; y-- > 0;) {
    for (int x = 0; x < picture.width; ++x)
      file.write(
          reinterpret_cast<const char*>(&picture.rgba[static_cast<size_t>((y * picture.width + x) * 4)]), 3);
  }
}

constexpr int kRepetitions = 6;

class Fuzzer {
 public:
  explicit Fuzzer(const Options& options)
      : options_(options),
        ours_(options.player, options.ours, ""),
        softpipe_(options.player, options.theirs, "softpipe"),
        llvmpipe_(options.player, options.theirs, "llvmpipe") {}

  // The number of streams that fail.
  uint64_t run() {
    uint64_t failures = 0;
    for (uint64_t seed = options_.first; seed < options_.first + options_.count; ++seed) {
      const Stream stream = make_stream(seed, options_.groups);
      const Verdict verdict = judge_stream(stream);
      if (!first_.trouble.empty()) {
        ++without_reference_;
        std::printf("seed %llu: Mesa %s\n", static_cast<unsigned long long>(seed), first_.trouble.c_str());
      }
      if (verdict.agrees) continue;
      ++failures;
      std::printf("seed %llu: %s, %zu calls\n", static_cast<unsigned long long>(seed), verdict.reason.c_str(),
                  stream.size());
      report(seed, options_.most_tries ? cut_down(stream) : stream);
    }
    return failures;
  }
  uint64_t without_reference() const { return without_reference_; }

 private:
  Verdict judge_stream(const Stream& stream) {
    outcome_ = ours_.render(options_.sabotage ? sabotaged(stream) : stream, kWidth, kHeight);
    const Limits limits = widened(options_.limits, stream);
    // llvmpipe, which compiles, is asked only when it matters.
    first_ = softpipe_.render(stream, kWidth, kHeight);
    if (judge(outcome_, first_, first_, limits).agrees) return {};
    second_ = llvmpipe_.render(stream, kWidth, kHeight);
    Verdict verdict = judge(outcome_, first_, second_, limits);
    if (!verdict.agrees && !is_steady(stream)) {
      first_.trouble = "does not draw the same twice";
      verdict = {};
    }
    return verdict;
  }

  // What a renderer draws in one way now and in another then is no reference.
  bool is_steady(const Stream& stream) {
    for (int i = 0; i < kRepetitions; ++i) {
      if (!same(softpipe_.render(stream, kWidth, kHeight), first_)) return false;
      if (!same(llvmpipe_.render(stream, kWidth, kHeight), second_)) return false;
    }
    return true;
  }
  static bool same(const Outcome& a, const Outcome& b) {
    return a.trouble == b.trouble && a.picture.rgba == b.picture.rgba && a.depth == b.depth &&
           a.stencil == b.stencil && a.errors == b.errors;
  }

  Stream cut_down(const Stream& stream) {
    return shrink(
        stream, [&](const Stream& candidate) { return !judge_stream(candidate).agrees; },
        options_.most_tries);
  }

  void report(uint64_t seed, const Stream& stream) {
    const Verdict verdict = judge_stream(stream);
    std::printf("  cut down to %zu calls: %s, first at (%d, %d)\n", stream.size(), verdict.reason.c_str(),
                verdict.first_x, verdict.first_y);
    for (const Call& call : stream) std::printf("    %s\n", print_call(call).c_str());
    std::fflush(stdout);
    if (options_.out.empty()) return;
    const std::string stem = options_.out + "/seed_" + std::to_string(seed);
    std::ofstream(stem + ".c") << print_program(stream, kWidth, kHeight);
    write_ppm(stem + "_ours.ppm", outcome_.picture);
    write_ppm(stem + "_softpipe.ppm", first_.picture);
    write_ppm(stem + "_llvmpipe.ppm", second_.picture);
  }

  const Options& options_;
  Renderer ours_, softpipe_, llvmpipe_;
  Outcome outcome_, first_, second_;
  uint64_t without_reference_ = 0;
};

}  // namespace

int main(int count, char** words) {
  const Options options = parse(count, words);
  if (options.print_only) {
    std::printf("%s", print_program(make_stream(options.first, options.groups), kWidth, kHeight).c_str());
    return 0;
  }
  Fuzzer fuzzer(options);
  const uint64_t failures = fuzzer.run();
  std::printf("%llu streams, %llu failures, %llu without a reference\n",
              static_cast<unsigned long long>(options.count), static_cast<unsigned long long>(failures),
              static_cast<unsigned long long>(fuzzer.without_reference()));
  // Most streams have to be compared with something, or the test says nothing.
  return failures || fuzzer.without_reference() * 20 > options.count ? 1 : 0;
}
