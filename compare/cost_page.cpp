#include "compare/cost_page.h"

#include <algorithm>

#include "compare/cost_scenes.h"
#include "compare/formatted.h"

namespace halfspace::compare {
namespace {

// "0", "0.0010", "9.4"
std::string percent(double value) {
  if (value == 0) return "0";
  return formatted(value < 0.01 ? "%.5f" : value < 1 ? "%.3f" : "%.1f", value);
}

std::string times(double ratio) { return formatted(ratio < 10 ? "%.2f" : "%.0f", ratio); }

const CostPoint* point_of(const CostScene& scene, const std::string& setting) {
  for (const CostPoint& point : scene.points)
    if (point.setting.name == setting) return &point;
  return nullptr;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return text;
}

std::string table_row(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) row += " " + cell + " |";
  return row + "\n";
}

std::string table_head(const std::vector<std::string>& cells) {
  std::string rule = "|---|";
  for (size_t i = 1; i < cells.size(); ++i) rule += "--:|";
  return table_row(cells) + rule + "\n";
}

bool costs(const CostPoint& point) { return point.ratio.median > 1 + std::max(0.03, point.ratio.spread); }
bool saves(const CostPoint& point) { return point.ratio.median < 1 - std::max(0.03, point.ratio.spread); }

// The axes whose turn to `level` makes no measurable difference in time, and those where it does.
struct AxesByCost {
  std::vector<std::string> free, not_free;
};
AxesByCost axes_by_cost(const CostScene& scene, const std::string& level) {
  AxesByCost axes;
  for (const CostPoint& point : scene.points) {
    if (point.setting.axis.empty() || point.setting.level != level) continue;
    const bool differs = level == "exact" ? costs(point) : saves(point);
    (differs ? axes.not_free : axes.free).push_back(point.setting.axis);
  }
  return axes;
}

std::string in_words(const CostPoint& point) {
  return formatted("%s %% of the pixels miss the nearest byte and %llu are owned by a wrong primitive",
                   percent(point.error->wrong_percent()).c_str(),
                   static_cast<unsigned long long>(point.error->coverage));
}

// Three sentences.
std::string meaning(const CostScene& all, const CostScene& everything) {
  const CostPoint &standard = *point_of(all, "standard"), &exact = *point_of(all, "exact"),
                  &draft = *point_of(all, "draft");
  std::string text = "At standard " + in_words(standard);
  if (const CostPoint* llvmpipe = point_of(all, "llvmpipe"))
    text += "; with Mesa's llvmpipe, which takes " + times(llvmpipe->ratio.median) + " times as long, " +
            in_words(*llvmpipe);
  text += ". ";
  text += formatted(
      "The exact level takes %s times standard's time and leaves %s %%; the draft level takes %s times "
      "and leaves %s %%, ",
      times(exact.ratio.median).c_str(), percent(exact.error->wrong_percent()).c_str(),
      times(draft.ratio.median).c_str(), percent(draft.error->wrong_percent()).c_str());
  text += saves(draft) ? "so it is a trade. " : "so it buys nothing here: standard's accuracy is free. ";
  const AxesByCost at_exact = axes_by_cost(everything, "exact"), at_draft = axes_by_cost(everything, "draft");
  text += "With every effect on, ";
  text += at_exact.free.empty() ? "no axis is exact for nothing"
                                : joined(at_exact.free) + " can be exact for nothing that could be measured";
  if (!at_exact.not_free.empty()) text += ", while " + joined(at_exact.not_free) + " cost time";
  text += at_draft.not_free.empty()
              ? "; turning any one axis to draft saves nothing.\n"
              : "; of the axes turned to draft alone, only " + joined(at_draft.not_free) + " saved time.\n";
  return text;
}

std::string level_table(const CostScene& all) {
  std::string text = table_head({"all scenes", "time", "not the nearest byte", "off by more than 1",
                                 "more than 2", "more than 8", "max", "mean", "other owner", "texels off"});
  for (const CostPoint& point : all.points) {
    if (!point.setting.axis.empty() || !point.error) continue;
    const TruthError& error = *point.error;
    const auto beyond = [&error](double limit) {
      uint64_t count = 0;
      for (size_t bin = 0; bin < error.histogram.size(); ++bin)
        if (bin == kErrorBins.size() || kErrorBins[bin] > limit) count += error.histogram[bin];
      return percent(100.0 * static_cast<double>(count) / static_cast<double>(error.pixels)) + " %";
    };
    text += table_row(
        {point.setting.name, times(point.ratio.median) + "x", percent(error.wrong_percent()) + " %",
         beyond(1), beyond(2), beyond(8), formatted("%.3f", error.max), formatted("%.4f", error.mean),
         std::to_string(error.coverage), error.texels ? formatted("%.3f", error.texels->max) : "-"});
  }
  return text;
}

std::string axes_table(const CostScene& scene) {
  std::string text =
      table_head({"axis", "time at draft", "at exact", "not the nearest byte at draft", "at exact"});
  for (const CostPoint& point : scene.points) {
    if (point.setting.level != "draft" || point.setting.axis.empty()) continue;
    const CostPoint* exact = point_of(scene, point.setting.axis + " exact");
    if (!exact || !point.error || !exact->error) continue;
    text += table_row({point.setting.axis, times(point.ratio.median) + "x", times(exact->ratio.median) + "x",
                       percent(point.error->wrong_percent()) + " %",
                       percent(exact->error->wrong_percent()) + " %"});
  }
  return text;
}

std::string cases_table(const CostResult& cases) {
  if (cases.scenes.empty()) return "";
  std::vector<std::string> head{"hard case"};
  for (const CostPoint& point : cases.scenes.front().points) head.push_back(point.setting.name);
  std::string text = table_head(head);
  for (const CostScene& scene : cases.scenes) {
    std::vector<std::string> cells{scene.name};
    for (const CostPoint& point : scene.points)
      cells.push_back(point.error ? percent(point.error->wrong_percent()) + " %" : "-");
    text += table_row(cells);
  }
  return text;
}

std::string effects_table(const EffectsResult& result) {
  std::string text = table_head({"effect", "ms", "more", "llvmpipe, ms", "more",
                                 "instructions of a smaller frame", "fragments", "stages of its own"});
  const auto row = [&](const std::string& name, const EffectStep& step, const EffectStep* before) {
    std::string stages;
    for (const std::string& stage : step.stages) stages += (stages.empty() ? "`" : ", `") + stage + "`";
    const auto more = [](double now, double then) { return formatted("%+.2f", now - then); };
    text += table_row(
        {name, formatted("%.2f", step.ours.median), before ? more(step.ours.median, before->ours.median) : "",
         formatted("%.2f", step.mesa.median), before ? more(step.mesa.median, before->mesa.median) : "",
         step.instructions ? formatted("%.2f M", *step.instructions / 1e6) : "-",
         std::to_string(step.statistics.fragments), stages});
  };
  for (size_t i = 0; i < result.steps.size(); ++i)
    row((i ? "+ " : "") + result.steps[i].name, result.steps[i], i ? &result.steps[i - 1] : nullptr);
  row("idle: flat, all others set up and off", result.idle, &result.steps.front());
  return text;
}

std::string idle_in_words(const EffectsResult& result) {
  std::string text = formatted(
      "The last row is the first one's frame after every other effect has been given its values and switched "
      "off: its "
      "time is %.3f of flat's (+- %.1f %% from run to run)",
      result.idle_ratio.median, 100 * std::max(result.idle_ratio.spread, result.steps.front().ours.spread));
  if (result.idle.instructions && result.steps.front().instructions)
    text += formatted(", and it takes %.0f instructions more of %.0f",
                      *result.idle.instructions - *result.steps.front().instructions,
                      *result.steps.front().instructions);
  return text +
         formatted(
             ". Over all rows, %llu fragments and vertices went through a stage of an effect that was off: "
             "the stage is not there.\n",
             static_cast<unsigned long long>(result.done_while_off));
}

std::string size_of(const CostOptions& options) {
  return std::to_string(options.width) + "x" + std::to_string(options.height);
}

}  // namespace

CostScene scene_for_axes(const CostResult& result) {
  for (const CostScene& scene : result.scenes)
    if (scene.name == "everything") return scene;
  return result.scenes.size() == 1 ? result.scenes.front() : all_scenes(result);
}

std::string accuracy_page(const AccuracyMeasured& measured) {
  const CostResult& result = measured.scenes;
  const CostScene all = all_scenes(result), everything = scene_for_axes(result);
  std::string page =
      "# What accuracy costs\n\n"
      "<!-- Made by ./halfspace cost --docs; change compare/cost_page.cpp instead. -->\n\n" +
      meaning(all, everything) +
      "\nThis page is made again by `./halfspace cost --docs`. Every renderer draws the same scenes, in "
      "turns, on one "
      "core and one thread (" +
      result.processor + "; pictures of " + size_of(result.options) + ", " +
      std::to_string(result.options.rounds) + " rounds of " + std::to_string(result.options.frames) +
      " frames); the truth is drawn by the oracle (`tests/oracle`), which rounds nothing before the last "
      "write of a "
      "pixel. A pixel counts as wrong when one of its bytes is not the nearest to the truth. The scenes are "
      "ref_app's eight and `everything`: lit, fogged, trilinear, blended, with a stencil count.\n\n"
      "![Time over error](accuracy/cost.svg)\n\n" +
      level_table(all) +
      "\nTime is processor time of a frame as a multiple of standard's, the geometric mean over the scenes. "
      "The errors are "
      "in levels of 255, max where the owner is right; 0.5 and a mean of 0.25 are what rounding to bytes "
      "alone comes "
      "to. *Other owner* counts the pixels that another primitive owns than should (the scenes are drawn "
      "again with "
      "every primitive in a colour of its own). *Texels off* is the farthest that a texture was read from "
      "the right "
      "place (drawn again with textures that spell their own coordinates). Where layers are blended, a layer "
      "that "
      "lies between two bytes may be rounded to the other one, and the layers above carry that on: so "
      "standard can be "
      "more than 0.55 off there.\n\n"
      "## One axis at a time\n\n"
      "![Each axis of the dial alone](accuracy/axes.svg)\n\n" +
      axes_table(everything) + "\nOn `" + everything.name +
      "`, where every axis has something to do but coverage, which is about smooth points, lines and "
      "polygons. "
      "Coverage and depth of everything else are exact at every level.\n\n"
      "![Scene by scene](accuracy/scenes.svg)\n\n"
      "## The hard cases\n\nPixels that are not the nearest bytes, at " +
      size_of(measured.cases.options) + "; [hard-cases.md](hard-cases.md) says what each one is about.\n\n" +
      cases_table(measured.cases) +
      "\n## What effects cost\n\n"
      "![What each effect adds](accuracy/effects.svg)\n\n" +
      effects_table(measured.effects) + "\n" + idle_in_words(measured.effects) +
      "\nEvery row has the effects of the rows above it, too. Instructions are counted by valgrind on a "
      "frame of "
      "256x256 at AVX2. Multisampling has no row: OpenGL 1.1 has none, and there is no stage for it.\n";
  return page;
}

}  // namespace halfspace::compare
