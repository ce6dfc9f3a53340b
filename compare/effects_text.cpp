// The result of `halfspace cost --effects` as a table, JSON and SVG.
#include <algorithm>
#include <cmath>

#include "compare/chart_axis.h"
#include "compare/effects.h"
#include "compare/formatted.h"
#include "compare/svg.h"

namespace halfspace::compare {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string instructions_cell(const EffectStep& step) {
  return step.instructions ? formatted("%9.3f M", *step.instructions / 1e6) : formatted("%11s", "-");
}

std::string text_row(const EffectStep& step, double more, double more_mesa) {
  return formatted("%-12s %8.3f %5.1f %% %+8.3f  %8.3f %+8.3f  ", step.name.c_str(), step.ours.median,
                   100 * step.ours.spread, more, step.mesa.median, more_mesa) +
         instructions_cell(step) +
         formatted(" %8llu  ", static_cast<unsigned long long>(step.statistics.fragments)) +
         joined(step.stages) + "\n";
}

nlohmann::json json_of(const EffectStep& step) {
  nlohmann::json stages = nlohmann::json::object();
  for (const StageUse& stage : step.statistics.stages) stages[stage.name] = stage.fragments;
  nlohmann::json json{{"name", step.name},
                      {"what", step.description},
                      {"ms", step.ours.median},
                      {"spread", step.ours.spread},
                      {"llvmpipe_ms", step.mesa.median},
                      {"fragments", step.statistics.fragments},
                      {"lit_vertices", step.statistics.lit_vertices},
                      {"stages_of_the_effect", step.stages},
                      {"fragments_by_stage", stages}};
  if (step.instructions) json["instructions"] = *step.instructions;
  return json;
}

// Bars that each begin where the one before ended.
class Waterfall {
 public:
  static constexpr double kLeft = 130, kRight = 640, kTop = 78, kRow = 34, kBar = 11;

  Waterfall(Svg& svg, double longest) : svg_(svg), longest_(longest) {}

  void grid(double bottom) {
    const double step = tick_step();
    for (double ms = 0; ms <= longest_; ms += step) {
      svg_.line(place(ms), kTop - 6, place(ms), bottom, ink::kGrid);
      svg_.text(place(ms), bottom + 16, tick_label(ms) + " ms", {"middle", ink::kSoft, 11});
    }
  }

  void row(size_t index, const EffectStep& step, const EffectStep* before) {
    const double y = kTop + kRow * static_cast<double>(index);
    svg_.text(kLeft - 10, y + 16, (before ? "+ " : "") + step.name, {"end", ink::kText, 13});
    bar(before ? before->ours.median : 0, step.ours.median, y + 1, ink::kOurs, step.name);
    bar(before ? before->mesa.median : 0, step.mesa.median, y + 1 + kBar, ink::kTheirs, step.name);
    svg_.text(kRight + 16, y + 11, sum_of(step.ours, before ? &before->ours : nullptr),
              {"start", ink::kOurs, 11});
    svg_.text(kRight + 16, y + 24, sum_of(step.mesa, before ? &before->mesa : nullptr),
              {"start", ink::kTheirs, 11});
  }

 private:
  double place(double ms) const { return std::lerp(kLeft, kRight, ms / longest_); }
  double tick_step() const {
    const double rough = longest_ / 6, power = std::pow(10, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 5.0})
      if (factor * power >= rough) return factor * power;
    return 10 * power;
  }
  static std::string sum_of(const Summary& now, const Summary* before) {
    return formatted("%.2f ms", now.median) +
           (before ? formatted("  (%+.2f)", now.median - before->median) : "");
  }

  void bar(double from, double to, double y, const char* color, const std::string& title) {
    const double left = place(std::min(from, to)), right = place(std::max(from, to));
    svg_.rect(left, y, std::max(right - left, 1.0), kBar, color, title);
    svg_.line(place(to), y, place(to), y + kRow, color, 0.5);
  }

  Svg& svg_;
  double longest_;
};

}  // namespace

std::string to_text(const EffectsResult& result) {
  std::string text = "ours:   " + result.our_renderer + ", " + result.our_version + "\ntheirs: Mesa, " +
                     result.mesa_version + "\n\n";
  text += formatted("%-12s %8s %7s %8s  %8s %8s  %11s %8s  %s\n", "with", "ms", "+-", "more", "llvmpipe",
                    "more", "instr.", "fragments", "stages of its own");
  const EffectStep* before = nullptr;
  for (const EffectStep& step : result.steps) {
    text += text_row(step, before ? step.ours.median - before->ours.median : 0,
                     before ? step.mesa.median - before->mesa.median : 0);
    before = &step;
  }
  text += text_row(result.idle, result.idle.ours.median - result.steps.front().ours.median,
                   result.idle.mesa.median - result.steps.front().mesa.median);
  text += formatted(
      "\nidle is flat with everything else set up and switched off: %.3f of flat's time, +- %.1f %%\n",
      result.idle_ratio.median, 100 * result.idle_ratio.spread);
  if (result.idle.instructions && result.steps.front().instructions)
    text += formatted("instructions of such a frame beyond flat's: %.0f of %.0f\n",
                      *result.idle.instructions - *result.steps.front().instructions,
                      *result.steps.front().instructions);
  return text + formatted("fragments and vertices that stages touched whose effect was off: %llu\n",
                          static_cast<unsigned long long>(result.done_while_off));
}

nlohmann::json to_json(const EffectsResult& result) {
  nlohmann::json steps = nlohmann::json::array();
  for (const EffectStep& step : result.steps) steps.push_back(json_of(step));
  return {{"processor", result.processor},
          {"ours", {{"renderer", result.our_renderer}, {"version", result.our_version}}},
          {"mesa_version", result.mesa_version},
          {"width", result.width},
          {"height", result.height},
          {"rounds", result.rounds},
          {"steps", steps},
          {"idle", json_of(result.idle)},
          {"idle_ratio", result.idle_ratio.median},
          {"idle_ratio_spread", result.idle_ratio.spread},
          {"done_while_off", result.done_while_off}};
}

std::string effects_chart(const EffectsResult& result) {
  double longest = 0;
  for (const EffectStep& step : result.steps)
    longest = std::max({longest, step.ours.median, step.mesa.median});
  const double bottom = Waterfall::kTop + Waterfall::kRow * static_cast<double>(result.steps.size());
  Svg svg(780, bottom + 34);
  svg.text(16, 26, "What each effect adds to a frame's processor time", {"start", ink::kText, 16, true});
  svg.text(
      16, 46,
      "Every row has the effects of the rows above, too. Blue: ours; brown: Mesa's llvmpipe; one thread each",
      {"start", ink::kSoft, 12});
  Waterfall waterfall(svg, longest * 1.03);
  waterfall.grid(bottom);
  for (size_t i = 0; i < result.steps.size(); ++i)
    waterfall.row(i, result.steps[i], i > 0 ? &result.steps[i - 1] : nullptr);
  return svg.str();
}

}  // namespace halfspace::compare
