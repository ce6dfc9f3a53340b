// Random scenes, the same everywhere, that between them go through all stages of the pipeline.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/support/canvas.h"

namespace halfspace::test {

struct SceneDraw {
  raster::DrawState state;
  raster::Primitive primitive = raster::Primitive::triangles;
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;  // empty: in turn
};

struct Scene {
  std::string name;
  std::vector<SceneDraw> draws;  // in order; the viewport is [0, size) x [0, size)
};

// All scenes whose vertices stay within a few viewports' distance.
std::vector<Scene> scenes(int size);
// Scenes that are cut by the guard band: by contract the cut corners depend on where the viewport lies.
std::vector<Scene> far_scenes(int size);

// Draws with viewport and scissor moved by (x, y).
void draw_scene(Canvas& canvas, const Scene& scene, int x = 0, int y = 0);

// The published hash of each scene, as tests/golden/image_hashes.txt has it: of colour and depth at 200x200.
std::map<std::string, std::string> scene_hashes(int threads = 1);

}  // namespace halfspace::test
