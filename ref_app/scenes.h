// The eight scenes. Depth test on, culling and lighting off, GL_LINEAR filters, default wrap and environment;
// perspective is 45 degrees vertical, near 0.1, far 100.
#pragma once

#include <memory>
#include <string>

#include "ref_app/assets.h"
#include "ref_app/gapi.h"

namespace ref_app {

inline constexpr int kSceneCount = 8;

// Turns of the viewer, and time; all zero in the still pictures.
struct Motion {
  float yaw = 0, pitch = 0;  // radians, about the middle of the scene
  float seconds = 0;         // what moves by itself has moved this long

  bool still() const { return yaw == 0.0F && pitch == 0.0F; }
};

class Scene {
 public:
  virtual ~Scene() = default;
  // One frame: clear, draw, finish.
  virtual void draw(Renderer& renderer, const Motion& motion) = 0;
  virtual size_t triangle_count() const = 0;
};

// number: 1 .. kSceneCount. Adds the scene's images to `renderer`, which must outlive the scene; the scene
// removes them when it goes.
std::unique_ptr<Scene> make_scene(int number, Renderer& renderer, const Assets& assets);
const char* scene_name(int number);

}  // namespace ref_app
