// halfspace compare A B: how far two pictures, or two folders of pictures, lie apart.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "compare/commands.h"
#include "compare/compare_report.h"
#include "compare/difference_text.h"

namespace halfspace::compare {
namespace {

struct CompareOptions {
  std::string a, b, mask, html, json;
  Limits limits;
  double edge_threshold = kDefaultEdgeThreshold;
  double gain = 16;
  bool quiet = false;
};

ComparedPair compare_pair(const PicturePair& paths, const CompareOptions& options) {
  ComparedPair pair{paths, {}, {}, {}};
  if (paths.a.empty() || paths.b.empty()) {
    pair.problem = "missing in " + (paths.a.empty() ? options.a : options.b);
    return pair;
  }
  try {
    const Image a = load_image(paths.a), b = load_image(paths.b);
    const EdgeMask edges = options.mask.empty() ? find_edges(a, options.edge_threshold)
                                                : edges_from_mask(load_image(options.mask));
    pair.difference = compare_images(a, b, edges);
    pair.broken = broken_limits(pair.difference, options.limits);
  } catch (const ImageError& error) {
    pair.problem = error.what();
  }
  return pair;
}

int status_of(const std::vector<ComparedPair>& pairs) {
  int status = kGood;
  for (const ComparedPair& pair : pairs) {
    if (!pair.problem.empty()) return kCouldNotTell;
    if (!pair.broken.empty()) status = kLimitBroken;
  }
  return status;
}

void print(const std::vector<ComparedPair>& pairs) {
  for (const ComparedPair& pair : pairs) {
    if (!pair.problem.empty()) {
      std::fprintf(stderr, "%s: %s\n", pair.paths.name.c_str(), pair.problem.c_str());
      continue;
    }
    std::printf("%s\n%s", pair.paths.name.c_str(), describe(pair.difference).c_str());
    for (const std::string& broken : pair.broken) std::printf("  too much: %s\n", broken.c_str());
  }
}

nlohmann::json to_json(const std::vector<ComparedPair>& pairs) {
  nlohmann::json list = nlohmann::json::array();
  for (const ComparedPair& pair : pairs) {
    nlohmann::json entry{
        {"name", pair.paths.name}, {"a", pair.paths.a.string()}, {"b", pair.paths.b.string()}};
    if (pair.problem.empty()) {
      entry["difference"] = to_json(pair.difference);
      entry["broken_limits"] = pair.broken;
    } else {
      entry["problem"] = pair.problem;
    }
    list.push_back(entry);
  }
  return {{"pictures", list}, {"status", status_of(pairs)}};
}

int compare(const CompareOptions& options) {
  std::vector<ComparedPair> pairs;
  for (const PicturePair& paths : pair_pictures(options.a, options.b))
    pairs.push_back(compare_pair(paths, options));
  if (!options.quiet) print(pairs);
  if (!options.json.empty()) write_text(options.json, to_json(pairs).dump(2) + "\n");
  if (!options.html.empty()) write_text(options.html, compare_report(pairs, options.gain));
  return status_of(pairs);
}

int compare_or_explain(const CompareOptions& options) {
  try {
    return compare(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "halfspace compare: %s\n", error.what());
    return kCouldNotTell;
  }
}

void add_limits(CLI::App& command, Limits& limits) {
  command.add_option("--max-differing", limits.differing_percent, "Most pixels that may differ, in percent")
      ->check(CLI::Range(0.0, 100.0))
      ->type_name("PERCENT");
  command
      .add_option("--max-difference", limits.difference_levels,
                  "Largest difference allowed, in levels of 255")
      ->check(CLI::NonNegativeNumber)
      ->type_name("LEVELS");
  command.add_option("--max-interior", limits.interior_levels, "Largest difference allowed off the edges")
      ->check(CLI::NonNegativeNumber)
      ->type_name("LEVELS");
}

}  // namespace

void add_compare_command(CLI::App& app, int& status) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command = app.add_subcommand("compare", "Compare two pictures, or two folders of pictures");
  command->footer(
      "Without a limit any difference is too much; with some stated, only these count.\n"
      "Exit status: 0 within the limits, 1 beyond them, 2 could not be compared.");
  command->add_option("A", options->a, "Picture or folder; edges are looked for in A")->required();
  command->add_option("B", options->b, "Picture or folder")->required();
  add_limits(*command, options->limits);
  command
      ->add_option("--edge-threshold", options->edge_threshold,
                   "A larger jump between neighbours in A is an edge, in levels")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command->add_option("--mask", options->mask, "Picture that says where the edges are (not black), instead");
  command->add_option("--html", options->html, "Write a report with the pictures in it");
  command->add_option("--gain", options->gain, "How much the report amplifies differences")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->add_option("--json", options->json, "Write the numbers");
  command->add_flag("-q,--quiet", options->quiet, "Print nothing but errors");
  command->callback([options, &status] { status = compare_or_explain(*options); });
}

}  // namespace halfspace::compare
