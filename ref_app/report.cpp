#include "ref_app/report.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "ref_app/process_clock.h"

namespace ref_app {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned>(c));
      out += escape;
    } else {
      out += c;
    }
  }
  return out + "\"";
}

void write_numbers(std::ostream& out, const std::vector<double>& numbers) {
  for (size_t i = 0; i < numbers.size(); ++i) out << (i ? ", " : "") << numbers[i];
}

void write_scene(std::ostream& out, const SceneResult& result) {
  out << "    {\"scene\": " << result.scene << ", \"name\": " << quoted(result.name)
      << ", \"triangles\": " << result.triangles << ",\n     \"first_ms\": " << result.first_ms
      << ", \"median_ms\": " << result.median_ms() << ", \"fastest_ms\": " << result.fastest_ms()
      << ", \"frame_ms\": [";
  write_numbers(out, result.frame_ms);
  out << "],\n     \"frame_cpu_ms\": [";
  write_numbers(out, result.frame_cpu_ms);
  out << "],\n     \"opaque\": " << (result.opaque ? "true" : "false")
      << ", \"peak_rss_kib\": " << result.peak_kib
      << ", \"picture\": " << (result.picture.empty() ? "null" : quoted(result.picture)) << "}";
}

}  // namespace

double SceneResult::median_ms() const {
  if (frame_ms.empty()) return first_ms;
  std::vector<double> sorted = frame_ms;
  std::sort(sorted.begin(), sorted.end());
  const size_t middle = sorted.size() / 2;
  return sorted.size() % 2 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
}

double SceneResult::fastest_ms() const {
  return frame_ms.empty() ? first_ms : *std::min_element(frame_ms.begin(), frame_ms.end());
}

void print_header(const Report& report) {
  std::printf("backend      %s\nGL_RENDERER  %s\nGL_VERSION   %s\npictures     %d x %d\n\n",
              report.backend.c_str(), report.strings.renderer.c_str(), report.strings.version.c_str(),
              report.width, report.height);
  std::printf("%-5s %-18s %9s %10s %10s\n", "scene", "", "triangles", "first ms", "median ms");
  std::fflush(stdout);
}

void print_scene(const SceneResult& result) {
  std::printf("%-5d %-18s %9zu %10.3f %10.3f\n", result.scene, result.name.c_str(), result.triangles,
              result.first_ms, result.median_ms());
  std::fflush(stdout);
}

void print_summary(const Report& report) {
  std::printf("\nprocess start to first picture %.1f ms (start: %s); peak memory %.1f MiB\n",
              report.start_to_first_picture_ms, process_start_source().c_str(),
              static_cast<double>(report.peak_kib) / 1024.0);
}

void write_json(const Report& report, const std::string& path) {
  std::ostringstream out;
  out.precision(9);
  out << "{\n  \"program\": \"ref_app\", \"backend\": " << quoted(report.backend)
      << ",\n  \"gl_renderer\": " << quoted(report.strings.renderer)
      << ",\n  \"gl_version\": " << quoted(report.strings.version)
      << ",\n  \"gl_vendor\": " << quoted(report.strings.vendor) << ",\n  \"width\": " << report.width
      << ", \"height\": " << report.height
      << ",\n  \"start_to_first_picture_ms\": " << report.start_to_first_picture_ms
      << ", \"start_source\": " << quoted(process_start_source())
      << ",\n  \"peak_rss_kib\": " << report.peak_kib << ",\n  \"scenes\": [\n";
  for (size_t i = 0; i < report.scenes.size(); ++i) {
    write_scene(out, report.scenes[i]);
    out << (i + 1 < report.scenes.size() ? ",\n" : "\n");
  }
  out << "  ]\n}\n";
  std::ofstream file(path);
  file << out.str();
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path);
}

}  // namespace ref_app
