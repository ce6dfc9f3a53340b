#include "tests/differential/scene_verdict.h"

#include <cstdarg>
#include <cstdio>

#include "ref_app/scenes.h"

namespace halfspace::differential {
namespace {

constexpr size_t kMostNamed = 8;  // misplaced pixels printed in full

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...) {
  char text[400];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  return text;
}

std::string primitive(Owner owner) {
  return owner == 0 ? "the background" : "primitive " + std::to_string(owner);
}

std::string in_words(const Misplaced& pixel) {
  return format("(%d, %d) shows %s, the truth is %s, whose edge is %.6f px away", pixel.x, pixel.y,
                primitive(pixel.drawn).c_str(), primitive(pixel.truth).c_str(), pixel.edge_distance);
}

std::string row(int scene, const char* who, const Judgement& j, bool with_coverage) {
  const std::string coverage = with_coverage ? std::to_string(j.misplaced.size()) : "-";
  return format("%-5d %-22s %9llu %9.4f %10.4f %10.4f %9s\n", scene, who,
                static_cast<unsigned long long>(j.wrong_bytes), j.wrong_percent(), j.worst_interior.levels,
                j.worst.levels, coverage.c_str());
}

std::string named(const char* who, int scene, const Judgement& j) {
  std::string text;
  for (size_t i = 0; i < j.misplaced.size() && i < kMostNamed; ++i)
    text += format("  scene %d, %s: ", scene, who) + in_words(j.misplaced[i]) + "\n";
  if (j.misplaced.size() > kMostNamed)
    text += format("  scene %d, %s: and %zu more\n", scene, who, j.misplaced.size() - kMostNamed);
  return text;
}

std::string row(int scene, const char* what, const Disagreement& d, uint64_t pixels) {
  return format("%-5d %-34s %9.4f %% %8.0f %8.0f %9llu %9llu\n", scene, what,
                100.0 * static_cast<double>(d.differing) / static_cast<double>(pixels), d.max_interior, d.max,
                static_cast<unsigned long long>(d.first_right),
                static_cast<unsigned long long>(d.second_right));
}

nlohmann::json to_json(const WorstColor& worst) {
  return {{"x", worst.x}, {"y", worst.y}, {"levels", worst.levels}};
}

nlohmann::json to_json(const Judgement& j) {
  nlohmann::json misplaced = nlohmann::json::array();
  for (const Misplaced& pixel : j.misplaced) {
    misplaced.push_back({{"x", pixel.x},
                         {"y", pixel.y},
                         {"drawn", pixel.drawn},
                         {"truth", pixel.truth},
                         {"edge_distance", pixel.edge_distance}});
  }
  return {{"wrong_pixels", j.wrong_pixels},
          {"wrong_percent", j.wrong_percent()},
          {"wrong_bytes", j.wrong_bytes},
          {"worst", to_json(j.worst)},
          {"worst_interior", to_json(j.worst_interior)},
          {"misplaced", misplaced}};
}

nlohmann::json to_json(const Disagreement& d, uint64_t pixels) {
  return {{"differing", d.differing},
          {"differing_percent", 100.0 * static_cast<double>(d.differing) / static_cast<double>(pixels)},
          {"max", d.max},
          {"max_interior", d.max_interior},
          {"first_right", d.first_right},
          {"second_right", d.second_right}};
}

nlohmann::json to_json(const SceneVerdict& v) {
  nlohmann::json json = {{"scene", v.scene},
                         {"name", ref_app::scene_name(v.scene)},
                         {"truth_seconds", v.truth_seconds},
                         {"pixels", v.ours.pixels},
                         {"interior_pixels", v.ours.interior_pixels},
                         {"owned_pixels", v.owned},
                         {"ours", to_json(v.ours)},
                         {"ours_draft", to_json(v.ours_draft)},
                         {"broken", v.broken()}};
  if (v.osmesa) json["osmesa"] = to_json(*v.osmesa);
  if (v.osmesa_float) json["osmesa_float"] = to_json(*v.osmesa_float);
  if (v.standard_to_float) json["standard_to_osmesa_float"] = to_json(*v.standard_to_float, v.ours.pixels);
  if (v.draft_to_default) json["draft_to_osmesa"] = to_json(*v.draft_to_default, v.ours.pixels);
  return json;
}

}  // namespace

std::vector<std::string> SceneVerdict::broken() const {
  std::vector<std::string> broken;
  const WorstColor& inside = ours.worst_interior;
  if (!(inside.levels <= kMostInteriorLevels))
    broken.push_back(format("scene %d: pixel (%d, %d) is %.4f levels off the truth, %.2f at most", scene,
                            inside.x, inside.y, inside.levels, kMostInteriorLevels));
  if (!(ours.wrong_percent() <= kMostWrongPercent))
    broken.push_back(format("scene %d: %.4f %% of the pixels are not the rounded truth, %.2f %% at most",
                            scene, ours.wrong_percent(), kMostWrongPercent));
  for (const Judgement* judgement : {&ours, &ours_draft}) {
    if (!judgement->misplaced.empty())
      broken.push_back(
          format("scene %d: %zu pixels show what they should not; ", scene, judgement->misplaced.size()) +
          in_words(judgement->misplaced[0]));
  }
  return broken;
}

std::string to_text(const std::vector<SceneVerdict>& verdicts) {
  std::string text = format("%-5s %-22s %9s %9s %10s %10s %9s\n", "scene", "against the truth", "bytes",
                            "pixels", "max level", "max level", "pixels");
  text += format("%-5s %-22s %9s %9s %10s %10s %9s\n", "", "", "wrong", "wrong %", "inside", "anywhere",
                 "misplaced");
  for (const SceneVerdict& v : verdicts) {
    text += row(v.scene, "Halfspace", v.ours, true);
    if (v.osmesa_float) text += row(v.scene, "OSMesa, float filter", *v.osmesa_float, true);
    text += row(v.scene, "Halfspace, draft", v.ours_draft, true);
    if (v.osmesa) text += row(v.scene, "OSMesa", *v.osmesa, true);
  }
  text += format("\n%-5s %-34s %11s %8s %8s %9s %9s\n", "scene", "against each other", "differing", "inside",
                 "max", "we right", "it right");
  for (const SceneVerdict& v : verdicts) {
    if (v.standard_to_float)
      text += row(v.scene, "Halfspace, OSMesa float filter", *v.standard_to_float, v.ours.pixels);
    if (v.draft_to_default)
      text += row(v.scene, "Halfspace draft, OSMesa", *v.draft_to_default, v.ours.pixels);
  }
  std::string pixels;
  for (const SceneVerdict& v : verdicts) {
    pixels += named("Halfspace", v.scene, v.ours) + named("Halfspace, draft", v.scene, v.ours_draft);
    if (v.osmesa) pixels += named("OSMesa", v.scene, *v.osmesa);
  }
  return text + (pixels.empty() ? "" : "\nmisplaced pixels:\n" + pixels);
}

nlohmann::json to_json(const std::vector<SceneVerdict>& verdicts) {
  nlohmann::json scenes = nlohmann::json::array();
  bool good = true;
  for (const SceneVerdict& v : verdicts) {
    scenes.push_back(to_json(v));
    good = good && v.broken().empty();
  }
  return {{"most_interior_levels", kMostInteriorLevels},
          {"most_wrong_percent", kMostWrongPercent},
          {"good", good},
          {"scenes", scenes}};
}

}  // namespace halfspace::differential
