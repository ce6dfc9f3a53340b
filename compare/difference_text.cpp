#include "compare/difference_text.h"

#include <cmath>
#include <cstdio>

namespace halfspace::compare {
namespace {

constexpr const char* kChannelNames[] = {"red", "green", "blue", "alpha"};

std::string coordinates(const WorstPixel& worst) {
  return "(" + std::to_string(worst.x) + ", " + std::to_string(worst.y) + ")";
}

std::string color(const Pixel& pixel, int channels) {
  std::string text;
  for (size_t c = 0; c < static_cast<size_t>(channels); ++c)
    text += (c == 0 ? "" : " ") + short_number(static_cast<double>(pixel[c]));
  return text;
}

std::string worst_line(const char* what, const std::optional<WorstPixel>& worst, int channels) {
  if (!worst) return "";
  return std::string("  ") + what + coordinates(*worst) + " by " + short_number(worst->levels) + ": " +
         color(worst->a, channels) + " | " + color(worst->b, channels) + "\n";
}

nlohmann::json to_json(const std::optional<WorstPixel>& worst) {
  if (!worst) return nullptr;
  return {{"x", worst->x}, {"y", worst->y}, {"levels", worst->levels}, {"a", worst->a}, {"b", worst->b}};
}

}  // namespace

std::string short_number(double value) {
  if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
  char text[40];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string count_of(uint64_t count, uint64_t total) {
  const double percent = total == 0 ? 0 : 100.0 * static_cast<double>(count) / static_cast<double>(total);
  return std::to_string(count) + " of " + std::to_string(total) + " (" + short_number(percent) + " %)";
}

std::string describe(const Difference& d) {
  std::string text = "  size         " + std::to_string(d.width) + "x" + std::to_string(d.height) + "\n";
  if (d.differing == 0) return text + "  equal in every pixel\n";
  text += "  differing    " + count_of(d.differing, d.pixels) + "\n";
  text += "  on edges     " + count_of(d.differing_edge, d.edge_pixels) + "\n";
  text += "  inside       " + count_of(d.differing_interior, d.pixels - d.edge_pixels) + ", largest " +
          short_number(d.max_interior) + "\n";
  text += "  by > 1, 2, 8 " + std::to_string(d.above_1) + ", " + std::to_string(d.above_2) + ", " +
          std::to_string(d.above_8) + " pixels\n";
  for (size_t c = 0; c < static_cast<size_t>(d.channel_count()); ++c) {
    char line[100];
    std::snprintf(line, sizeof line, "  %-12s max %s, mean %s levels\n", kChannelNames[c],
                  short_number(d.channels[c].max).c_str(), short_number(d.channels[c].mean).c_str());
    text += line;
  }
  text += "  PSNR         " + short_number(d.psnr()) + " dB\n";
  text += worst_line("worst at     ", d.worst, d.channel_count());
  text += worst_line("worst inside ", d.worst_interior, d.channel_count());
  return text;
}

std::string describe_in_a_line(const Difference& d) {
  if (d.differing == 0) return "equal";
  return std::to_string(d.differing) + " pixels differ (" + short_number(d.differing_percent()) +
         " %), largest " + short_number(d.max) + ", inside " + short_number(d.max_interior);
}

nlohmann::json to_json(const Difference& d) {
  nlohmann::json channels;
  for (size_t c = 0; c < static_cast<size_t>(d.channel_count()); ++c)
    channels[kChannelNames[c]] = {{"max", d.channels[c].max}, {"mean", d.channels[c].mean}};
  nlohmann::json psnr;
  if (d.differing > 0) psnr = d.psnr();
  return {{"width", d.width},
          {"height", d.height},
          {"pixels", d.pixels},
          {"differing", d.differing},
          {"differing_percent", d.differing_percent()},
          {"edge_pixels", d.edge_pixels},
          {"differing_edge", d.differing_edge},
          {"differing_interior", d.differing_interior},
          {"above_1", d.above_1},
          {"above_2", d.above_2},
          {"above_8", d.above_8},
          {"above_1_interior", d.above_1_interior},
          {"max", d.max},
          {"max_interior", d.max_interior},
          {"mean", d.mean},
          {"psnr", psnr},
          {"channels", channels},
          {"worst", to_json(d.worst)},
          {"worst_interior", to_json(d.worst_interior)}};
}

}  // namespace halfspace::compare
