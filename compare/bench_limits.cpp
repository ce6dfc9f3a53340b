#include "compare/bench_limits.h"

#include <array>
#include <cstdio>

#include "compare/bar_chart.h"
#include "compare/dialogue.h"
#include "compare/libraries.h"
#include "compare/processor.h"

namespace halfspace::compare {
namespace {

ChildCommand limits_command(int core, double seconds) {
  char time[60];
  std::snprintf(time, sizeof time, "--benchmark_min_time=%g", seconds);
  ChildCommand command;
  command.arguments = {house_program("limits").string(), "--benchmark_format=json", time};
  command.cores = {core};
  return command;
}

bool is_of_memory(const Limit& limit) { return limit.name.starts_with("bytes_"); }

// "262144" KiB: "256 MiB".
std::string size_text(const std::string& kib) {
  const int size = std::stoi(kib);
  return size < 1024 ? kib + " KiB" : std::to_string(size / 1024) + " MiB";
}

std::string label(const Limit& limit) {
  const size_t slash = limit.name.find('/');
  std::string text = limit.name.substr(0, slash);
  for (char& letter : text)
    if (letter == '_') letter = ' ';
  return slash == std::string::npos ? text : text + ", " + size_text(limit.name.substr(slash + 1));
}

}  // namespace

LimitsResult bench_limits(int core, double seconds) {
  Dialogue dialogue(limits_command(core, seconds));
  const nlohmann::json report = nlohmann::json::parse(dialogue.rest());
  LimitsResult result;
  result.processor = processor_name();
  result.core = core;
  for (const nlohmann::json& entry : report.at("benchmarks"))
    result.limits.push_back({entry.at("name"), entry.at("items_per_second")});
  return result;
}

double milliseconds(const LimitsResult& limits, const std::map<std::string, double>& work) {
  double seconds = 0;
  for (const auto& [name, amount] : work) {
    double per_second = 0;
    for (const Limit& limit : limits.limits)
      if (limit.name == name) per_second = limit.per_second;
    if (per_second <= 0) throw std::runtime_error("no limit is called " + name);
    seconds += amount / per_second;
  }
  return seconds * 1e3;
}

std::string to_text(const LimitsResult& result) {
  std::string text = "one core of " + result.processor + ", at best\n\n";
  for (const Limit& limit : result.limits) {
    std::array<char, 200> line{};
    std::snprintf(line.data(), line.size(), "%-32s %9.2f %s %9.3f ns each\n", label(limit).c_str(),
                  limit.per_second * 1e-9, is_of_memory(limit) ? "GB/s" : "G/s ", 1e9 / limit.per_second);
    text += line.data();
  }
  return text;
}

nlohmann::json to_json(const LimitsResult& result) {
  nlohmann::json limits = nlohmann::json::object();
  for (const Limit& limit : result.limits) limits[limit.name] = limit.per_second;
  return {{"processor", result.processor}, {"core", result.core}, {"per_second", limits}};
}

std::string to_svg(const LimitsResult& result) {
  BarChart chart{"What one core does at best, 10^9 a second (memory: see the table)", "", 0, "", {}};
  for (const Limit& limit : result.limits)
    if (!is_of_memory(limit)) chart.bars.push_back({label(limit), limit.per_second * 1e-9, 0, true});
  return to_svg(chart);
}

}  // namespace halfspace::compare
