#include "compare/cost_scenes.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>

namespace halfspace::compare {
namespace {

// As ref_app names them.
constexpr std::array<const char*, 8> kReferenceNames{
    "triangle",          "white shapes", "coloured solids", "textured cube",
    "solids on a plane", "teapot",       "nine teapots",    "terrain"};
// The scene with all there is: lit, fogged, blended, trilinear.
constexpr const char* kEverything = "everything";

// "3", or -1 for what is no number.
int number_of(const std::string& text) {
  int number = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? number : -1;
}

// "3", "2-5" or "terrain" as numbers.
std::vector<int> numbers_of(const std::string& text) {
  const size_t dash = text.find('-');
  int first = number_of(text.substr(0, dash));
  int last = dash == std::string::npos ? first : number_of(text.substr(dash + 1));
  if (const auto named = std::find(kReferenceNames.begin(), kReferenceNames.end(), text);
      named != kReferenceNames.end())
    first = last = static_cast<int>(named - kReferenceNames.begin()) + 1;
  if (first < 1 || last < first || last > static_cast<int>(kReferenceNames.size()))
    throw std::runtime_error("there is no scene " + text + "; it can be 1 to 8, a range as 2-5, a name as " +
                             kReferenceNames.back() + ", or " + kEverything);
  std::vector<int> numbers;
  for (int number = first; number <= last; ++number) numbers.push_back(number);
  return numbers;
}

SceneGroup reference_group(const std::vector<std::string>& wanted) {
  SceneGroup group{reference_scenes(), {}, {}};
  for (const std::string& text : wanted)
    for (const int number : numbers_of(text)) {
      group.arguments.push_back(std::to_string(number));
      group.labels.push_back(std::to_string(number) + " " + kReferenceNames[static_cast<size_t>(number - 1)]);
    }
  return group;
}

SceneGroup case_group(const std::vector<std::string>& wanted) {
  SceneGroup group{hard_cases(), wanted, {}};
  if (wanted.size() == 1 && wanted.front() == "all") group.arguments = listed_scenes(hard_cases());
  group.labels = group.arguments;
  return group;
}

}  // namespace

const SceneProgram& reference_scenes() {
  static const SceneProgram kProgram{"ref_app_osmesa", "--scene", true};
  return kProgram;
}

const SceneProgram& hard_cases() {
  static const SceneProgram kProgram{"hard_cases", "--draw", false, false};
  return kProgram;
}

const SceneProgram& effect_scenes() {
  static const SceneProgram kProgram{"ref_app_effects", "--draw", false};
  return kProgram;
}

std::vector<SceneGroup> chosen_groups(const CostOptions& options) {
  std::vector<std::string> scenes = options.scenes;
  if (scenes.empty() && options.cases.empty()) scenes = {"1-8", kEverything};
  const auto everything = std::find(scenes.begin(), scenes.end(), kEverything);
  const bool with_everything = everything != scenes.end();
  if (with_everything) scenes.erase(everything);
  std::vector<SceneGroup> groups;
  if (!scenes.empty()) groups.push_back(reference_group(scenes));
  if (with_everything) groups.push_back({effect_scenes(), {kEverything}, {kEverything}});
  if (!options.cases.empty()) groups.push_back(case_group(options.cases));
  return groups;
}

std::vector<Setting> chosen_settings(const CostOptions& options) {
  std::vector<Setting> settings;
  for (const Setting& setting : our_settings())
    if (options.axes || setting.axis.empty()) settings.push_back(setting);
  if (options.mesa)
    for (const Setting& setting : mesa_settings()) settings.push_back(setting);
  return settings;
}

std::vector<std::string> paints_of(const SceneProgram& program) {
  if (program.paints) return {"scene", "owners", "texels"};
  return {"scene"};
}

size_t standard_index(const std::vector<Setting>& settings) {
  const auto found = std::find_if(settings.begin(), settings.end(), [](const Setting& setting) {
    return setting.name == standard_setting().name;
  });
  if (found == settings.end()) throw std::logic_error("the standard level is always measured");
  return static_cast<size_t>(found - settings.begin());
}

}  // namespace halfspace::compare
