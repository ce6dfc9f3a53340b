// What the scenes share: images that go with them, things to draw, cameras.
#pragma once

#include <memory>
#include <vector>

#include "ref_app/scenes.h"

namespace ref_app {

// Images a scene has added; removes them at the end.
class SceneImages {
 public:
  explicit SceneImages(Renderer& renderer) : renderer_(renderer) {}
  ~SceneImages() {
    for (const ImageHandle handle : handles_) renderer_.remove_image(handle);
  }
  SceneImages(const SceneImages&) = delete;
  SceneImages& operator=(const SceneImages&) = delete;

  // The pixels may go once this has returned.
  ImageHandle add(const Image& image) {
    handles_.push_back(renderer_.add_image(image));
    return handles_.back();
  }

 private:
  Renderer& renderer_;
  std::vector<ImageHandle> handles_;
};

// A mesh in its place; many items may share one mesh.
struct Item {
  std::shared_ptr<const Geometry> mesh;
  glm::mat4 world{1.0F};
  bool texturing = false;
  ImageHandle image = kImageNeverAdded;
  float spin = 0;  // radians a second about the item's own y axis
};

struct Camera {
  glm::vec3 eye{0, 0, 5}, target{0, 0, 0};
};

// A scene that is a list of items in front of one camera.
class ItemScene : public Scene {
 public:
  explicit ItemScene(Renderer& renderer) : images_(renderer) {}
  void draw(Renderer& renderer, const Motion& motion) override;
  size_t triangle_count() const override;

 protected:
  SceneImages images_;
  std::vector<Item> items_;
  Camera camera_;
  bool perspective_ = true;  // false: identity matrices, window coordinates straight from the vertices
  glm::vec4 background_{0.0F, 0.0F, 0.0F, 1.0F};
};

std::unique_ptr<Scene> make_triangle_scene(Renderer& renderer);
std::unique_ptr<Scene> make_white_shapes_scene(Renderer& renderer);
std::unique_ptr<Scene> make_colored_solids_scene(Renderer& renderer);
std::unique_ptr<Scene> make_textured_cube_scene(Renderer& renderer, const Assets& assets);
std::unique_ptr<Scene> make_solids_on_plane_scene(Renderer& renderer, const Assets& assets);
std::unique_ptr<Scene> make_teapot_scene(Renderer& renderer, const Assets& assets);
std::unique_ptr<Scene> make_nine_teapots_scene(Renderer& renderer, const Assets& assets);
std::unique_ptr<Scene> make_terrain_scene(Renderer& renderer, const Assets& assets);

}  // namespace ref_app
