#pragma once

#include <string>
#include <vector>

#include "ref_app/backend.h"

namespace ref_app {

struct SceneResult {
  int scene = 0;
  std::string name;
  size_t triangles = 0;
  double first_ms = 0;               // the first frame
  std::vector<double> frame_ms;      // the ones after it: clear, draw, finish
  std::vector<double> frame_cpu_ms;  // processor time of those, over all threads
  bool opaque = true;                // every pixel read back with alpha 255
  long peak_kib = 0;                 // peak memory so far, before any image file was touched
  std::string picture;               // file name, empty when none was saved

  double median_ms() const;
  double fastest_ms() const;
};

struct Report {
  std::string backend;
  BackendStrings strings;
  int width = 0, height = 0;
  double start_to_first_picture_ms = 0;
  long peak_kib = 0;  // of drawing; loading OpenImageIO to save the pictures is not in it
  std::vector<SceneResult> scenes;
};

void print_header(const Report& report);
void print_scene(const SceneResult& result);
void print_summary(const Report& report);
// Throws std::runtime_error when the file cannot be written.
void write_json(const Report& report, const std::string& path);

}  // namespace ref_app
