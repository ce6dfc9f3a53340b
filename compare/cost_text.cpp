// The result of `halfspace cost` as a table, CSV and JSON.

#include "compare/cost.h"
#include "compare/difference_text.h"
#include "compare/formatted.h"

namespace halfspace::compare {
namespace {

std::string error_columns(const std::optional<TruthError>& error) {
  if (!error) return formatted("%10s %9s %8s %8s %8s\n", "-", "-", "-", "-", "-");
  const std::string texels = error->texels ? formatted("%.3f", error->texels->max) : "-";
  return formatted("%9.4f%% %9.3f %8.4f %8llu %8s\n", error->wrong_percent(), error->max, error->mean,
                   static_cast<unsigned long long>(error->coverage), texels.c_str());
}

std::string text_of(const CostScene& scene) {
  std::string text = formatted("\n%-24s %9s %7s %7s %10s %9s %8s %8s %8s\n", scene.name.c_str(), "ms", "+-",
                               "of std", "wrong", "max", "mean", "coverage", "texels");
  for (const CostPoint& point : scene.points) {
    text += formatted("  %-22s %9.3f %5.1f %% %6.3fx ", point.setting.name.c_str(), point.ms.median,
                      100 * point.ratio.spread, point.ratio.median);
    text += error_columns(point.error);
  }
  text += "  not beaten in both time and error:";
  for (const CostPoint* point : pareto_front(scene)) text += " [" + point->setting.name + "]";
  return text + "\n";
}

std::string bin_name(size_t bin) {
  return bin < kErrorBins.size() ? "up_to_" + short_number(kErrorBins[bin]) : "beyond";
}

std::string quoted(const std::string& text) { return "\"" + text + "\""; }

std::string csv_row(const CostScene& scene, const CostPoint& point) {
  std::string row = quoted(scene.name) + "," + quoted(point.setting.name) +
                    formatted(",%.6g,%.4g,%.6g", point.ms.median, point.ratio.spread, point.ratio.median);
  if (!point.error) return row + "\n";
  const TruthError& error = *point.error;
  row += formatted(",%llu,%llu,%.6g,%.6g,%llu,%s", static_cast<unsigned long long>(error.pixels),
                   static_cast<unsigned long long>(error.wrong), error.max, error.mean,
                   static_cast<unsigned long long>(error.coverage),
                   error.coverage_is_inferred ? "inferred" : "seen");
  row += error.texels ? formatted(",%.6g,%.6g", error.texels->max, error.texels->mean) : ",,";
  for (const uint64_t count : error.histogram)
    row += formatted(",%llu", static_cast<unsigned long long>(count));
  return row + "\n";
}

nlohmann::json json_of(const Summary& summary) {
  return {{"median", summary.median}, {"spread", summary.spread}, {"count", summary.count}};
}

nlohmann::json json_of(const TruthError& error) {
  nlohmann::json histogram;
  for (size_t bin = 0; bin < error.histogram.size(); ++bin) histogram[bin_name(bin)] = error.histogram[bin];
  nlohmann::json json{{"pixels", error.pixels},
                      {"wrong", error.wrong},
                      {"wrong_percent", error.wrong_percent()},
                      {"max_levels", error.max},
                      {"mean_levels", error.mean},
                      {"coverage", error.coverage},
                      {"coverage_is_inferred", error.coverage_is_inferred},
                      {"histogram", histogram}};
  if (error.texels)
    json["texels"] = {
        {"pixels", error.texels->pixels}, {"max", error.texels->max}, {"mean", error.texels->mean}};
  return json;
}

nlohmann::json json_of(const CostScene& scene) {
  nlohmann::json points = nlohmann::json::array();
  for (const CostPoint& point : scene.points) {
    nlohmann::json json{{"setting", point.setting.name},
                        {"ms", json_of(point.ms)},
                        {"ratio_to_standard", json_of(point.ratio)}};
    if (point.error) json["error"] = json_of(*point.error);
    points.push_back(json);
  }
  nlohmann::json front = nlohmann::json::array();
  for (const CostPoint* point : pareto_front(scene)) front.push_back(point->setting.name);
  return {{"scene", scene.name}, {"points", points}, {"pareto_front", front}};
}

}  // namespace

std::string to_text(const CostResult& result) {
  std::string text;
  if (result.options.program.empty())  // which says nothing of the library it found
    text = "ours:   " + result.our_renderer + ", " + result.our_version + "\ntheirs: Mesa, " + result.mesa_version +
           "\ntruth:  " + result.oracle + "\n";
  for (const CostScene& scene : result.scenes) text += text_of(scene);
  if (result.scenes.size() > 1) text += text_of(all_scenes(result));
  return text + "\nms: processor time of a frame" + (result.options.program.empty() ? "" : " (here: of the whole run)") +
         "; of std: to standard in the same round. wrong: pixels with a byte\n"
         "that is not the nearest to the truth. max, mean: levels off the truth, max where the owner is right; 0.25\n"
         "is the mean that rounding to bytes comes to. coverage: pixels another primitive owns. texels: the\n"
         "farthest a texture was read from where it should have been.\n";
}

std::string to_csv(const CostResult& result) {
  std::string text =
      "scene,setting,ms,spread,ratio_to_standard,pixels,wrong,max_levels,mean_levels,coverage,coverage_is,"
      "texels_max,texels_mean";
  for (size_t bin = 0; bin <= kErrorBins.size(); ++bin) text += "," + bin_name(bin);
  text += "\n";
  for (const CostScene& scene : result.scenes)
    for (const CostPoint& point : scene.points) text += csv_row(scene, point);
  return text;
}

nlohmann::json to_json(const CostResult& result) {
  nlohmann::json scenes = nlohmann::json::array();
  for (const CostScene& scene : result.scenes) scenes.push_back(json_of(scene));
  nlohmann::json json{{"processor", result.processor},
                      {"ours", {{"renderer", result.our_renderer}, {"version", result.our_version}}},
                      {"mesa_version", result.mesa_version},
                      {"oracle", result.oracle},
                      {"width", result.options.width},
                      {"height", result.options.height},
                      {"rounds", result.options.rounds},
                      {"frames", result.options.frames},
                      {"scenes", scenes}};
  if (result.scenes.size() > 1) json["all"] = json_of(all_scenes(result));
  return json;
}

}  // namespace halfspace::compare
