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

std::string row(int scene, const char* who, const Standing& standing) {
  const Judgement &s = standing.snapped, &i = standing.ideal;
  return format("%-5d %-21s %8.4f %% %8.4f %8.4f %9zu   %8.4f %% %8.4f %8.4f\n", scene, who,
                s.wrong_percent(), s.worst_interior.levels, s.worst.levels, s.misplaced.size(),
                i.wrong_percent(), i.worst_interior.levels, i.worst.levels);
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
  const auto number = [](uint64_t n) { return static_cast<unsigned long long>(n); };
  return format("%-5d %-31s %8.4f %% %7.0f %7.0f %10llu %8llu %8llu %8llu\n", scene, what,
                100.0 * static_cast<double>(d.differing) / static_cast<double>(pixels), d.max_interior, d.max,
                number(d.misplaced), number(d.corners), number(d.theirs_wrong), number(d.ours_wrong));
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

nlohmann::json to_json(const Standing& standing) {
  return {{"snapped", to_json(standing.snapped)}, {"ideal", to_json(standing.ideal)}};
}

nlohmann::json to_json(const Disagreement& d, uint64_t pixels) {
  return {{"differing", d.differing},
          {"differing_percent", 100.0 * static_cast<double>(d.differing) / static_cast<double>(pixels)},
          {"max", d.max},
          {"max_interior", d.max_interior},
          {"misplaced", d.misplaced},
          {"corners", d.corners},
          {"theirs_wrong", d.theirs_wrong},
          {"ours_wrong", d.ours_wrong}};
}

nlohmann::json to_json(const SceneVerdict& v) {
  nlohmann::json json = {{"scene", v.scene},
                         {"name", ref_app::scene_name(v.scene)},
                         {"truth_seconds", v.truth_seconds},
                         {"pixels", v.pixels()},
                         {"interior_pixels", v.ours.snapped.interior_pixels},
                         {"ours", to_json(v.ours)},
                         {"ours_draft", to_json(v.ours_draft)},
                         {"broken", v.broken()}};
  if (v.osmesa) json["osmesa"] = to_json(*v.osmesa);
  if (v.osmesa_float) json["osmesa_float"] = to_json(*v.osmesa_float);
  if (v.standard_to_float) json["standard_to_osmesa_float"] = to_json(*v.standard_to_float, v.pixels());
  if (v.draft_to_default) json["draft_to_osmesa"] = to_json(*v.draft_to_default, v.pixels());
  return json;
}

}  // namespace

std::vector<std::string> SceneVerdict::broken() const {
  std::vector<std::string> broken;
  const WorstColor& inside = ours.contract().worst_interior;
  if (!(inside.levels <= kMostInteriorLevels))
    broken.push_back(format("scene %d: pixel (%d, %d) is %.4f levels off the truth, %.2f at most", scene,
                            inside.x, inside.y, inside.levels, kMostInteriorLevels));
  const auto ask = [&](const char* level, const Judgement& judgement, double most) {
    if (!(judgement.wrong_percent() <= most))
      broken.push_back(
          format("scene %d, %s: %.4f %% of the pixels are not the rounded truth, %.2f %% at most", scene,
                 level, judgement.wrong_percent(), most));
    if (!judgement.misplaced.empty())
      broken.push_back(format("scene %d, %s: %zu pixels show what they should not; ", scene, level,
                              judgement.misplaced.size()) +
                       in_words(judgement.misplaced[0]));
  };
  ask("standard", ours.contract(), kMostWrongPercent);
  ask("draft", ours_draft.contract(), kMostDraftWrongPercent);
  return broken;
}

std::string to_text(const std::vector<SceneVerdict>& verdicts) {
  std::string text =
      "Against the truth. Snapped: what a triangle carries belongs to its corners where they were\n"
      "snapped to 1/256 px. Ideal: to its corners as they are; llvmpipe does so. ";
  text += kContract == Positions::snapped ? "We promise snapped.\n" : "We promise ideal.\n";
  text += "The draft level and OSMesa's default are held to the truth by their own 8-bit filter.\n\n";
  text += format("%-27s %38s   %28s\n", "", "snapped", "ideal");
  text += format("%-5s %-21s %10s %8s %8s %9s   %10s %8s %8s\n", "scene", "drawn by", "wrong px", "inside",
                 "max", "misplaced", "wrong px", "inside", "max");
  for (const SceneVerdict& v : verdicts) {
    text += row(v.scene, "Halfspace", v.ours);
    if (v.osmesa_float) text += row(v.scene, "OSMesa, float filter", *v.osmesa_float);
    text += row(v.scene, "Halfspace, draft", v.ours_draft);
    if (v.osmesa) text += row(v.scene, "OSMesa", *v.osmesa);
  }
  if (!verdicts.empty() && verdicts[0].standard_to_float) {
    text +=
        "\nAgainst each other, and why pixels differ: one shows another primitive than it should; both are\n"
        "right, by corners of their own; OSMesa is neither truth; we are not what we promise.\n\n";
    text += format("%-5s %-31s %10s %7s %7s %10s %8s %8s %8s\n", "scene", "", "differing", "inside", "max",
                   "misplaced", "corners", "OSMesa", "we");
  }
  for (const SceneVerdict& v : verdicts) {
    if (v.standard_to_float)
      text += row(v.scene, "Halfspace, OSMesa float filter", *v.standard_to_float, v.pixels());
    if (v.draft_to_default) text += row(v.scene, "Halfspace draft, OSMesa", *v.draft_to_default, v.pixels());
  }
  std::string pixels;
  for (const SceneVerdict& v : verdicts) {
    pixels += named("Halfspace", v.scene, v.ours.contract()) +
              named("Halfspace, draft", v.scene, v.ours_draft.contract());
    if (v.osmesa) pixels += named("OSMesa", v.scene, v.osmesa->contract());
  }
  return text + (pixels.empty() ? "" : "\nMisplaced pixels, y up:\n" + pixels);
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
          {"most_draft_wrong_percent", kMostDraftWrongPercent},
          {"contract", kContract == Positions::snapped ? "snapped" : "ideal"},
          {"good", good},
          {"scenes", scenes}};
}

}  // namespace halfspace::differential
