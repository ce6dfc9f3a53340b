// Scenes 3 to 5: pyramids and cubes.
#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include "ref_app/scene_parts.h"
#include "ref_app/shapes.h"

namespace ref_app {
namespace {

const glm::vec3 kXAxis(1, 0, 0), kYAxis(0, 1, 0);

glm::mat4 placed(const glm::vec3& position, float degrees, float scale) {
  const glm::mat4 moved = glm::translate(glm::mat4(1.0F), position);
  return glm::scale(glm::rotate(moved, glm::radians(degrees), kYAxis), glm::vec3(scale));
}

std::shared_ptr<const Geometry> share(Geometry mesh) {
  return std::make_shared<const Geometry>(std::move(mesh));
}

class ColoredSolidsScene final : public ItemScene {
 public:
  explicit ColoredSolidsScene(Renderer& renderer) : ItemScene(renderer) {
    camera_ = {{0, 1.2F, 6.3F}, {0, 0.1F, 0}};
    background_ = {levels(20, 23, 31), 1.0F};
    const auto pyramid = share(make_pyramid({{levels(255, 255, 255), levels(255, 26, 26), levels(26, 230, 51),
                                              levels(26, 76, 255), levels(255, 217, 26)}}));
    const auto cube = share(make_cube({{levels(230, 64, 51), levels(51, 166, 217), levels(242, 204, 64),
                                        levels(140, 89, 191), levels(64, 178, 89), levels(230, 128, 38)}}));
    items_ = {{pyramid, placed({-1.3F, 0, 0}, 25, 1.0F), false, kImageNeverAdded, 0.9F},
              {cube, glm::rotate(placed({1.3F, -0.05F, 0}, 35, 0.75F), glm::radians(20.0F), kXAxis), false,
               kImageNeverAdded, -0.7F}};
  }
};

class TexturedCubeScene final : public ItemScene {
 public:
  TexturedCubeScene(Renderer& renderer, const Assets& assets) : ItemScene(renderer) {
    camera_ = {{0, 2.0F, 4.5F}, {0, -0.05F, 0}};
    background_ = {levels(51, 61, 76), 1.0F};
    const ImageHandle brick = images_.add(assets.brick());
    items_ = {{share(make_cube(shaded_faces())), placed({0, 0, 0}, -32, 1), true, brick, 0.6F}};
  }
};

class SolidsOnPlaneScene final : public ItemScene {
 public:
  SolidsOnPlaneScene(Renderer& renderer, const Assets& assets) : ItemScene(renderer) {
    camera_ = {{0, 5.4F, 13.0F}, {0, 0.6F, 0}};
    background_ = {levels(140, 173, 209), 1.0F};
    const ImageHandle brick = images_.add(assets.brick());
    const ImageHandle wood = images_.add(assets.wood());
    const ImageHandle marble = images_.add(assets.marble());
    const ImageHandle checker = images_.add(assets.checker());
    items_.push_back({share(make_plane({17, 8, 1})), glm::mat4(1.0F), true, checker});

    const auto cube = share(make_cube(shaded_faces()));
    const auto add_cube = [&](float x, float z, float degrees, float scale, ImageHandle image) {
      items_.push_back({cube, placed({x, scale, z}, degrees, scale), true, image, 0.4F});
    };
    add_cube(-3.4F, 2.2F, 20, 0.8F, brick);
    add_cube(0.0F, 2.6F, 40, 0.75F, wood);
    add_cube(3.4F, 2.2F, -25, 0.8F, marble);
    add_cube(-4.6F, -3.0F, -15, 1.1F, marble);
    add_cube(0.2F, -3.6F, 12, 1.2F, brick);
    add_cube(4.7F, -3.0F, 33, 1.1F, wood);

    // Texturing is on and the name has no image, so the pyramids show their colours.
    const auto pyramid =
        share(make_pyramid({{levels(255, 245, 217), levels(242, 140, 64), levels(217, 64, 76),
                             levels(89, 64, 153), levels(64, 140, 191)}}));
    const auto add_pyramid = [&](float x, float z, float degrees, float scale) {
      items_.push_back({pyramid, placed({x, scale, z}, degrees, scale), true, kImageNeverAdded, -0.5F});
    };
    add_pyramid(-1.8F, 0.4F, 15, 0.9F);
    add_pyramid(1.9F, 0.3F, 50, 0.9F);
    add_pyramid(-2.5F, -6.2F, 30, 1.3F);
    add_pyramid(3.0F, -6.4F, 70, 1.3F);
    add_pyramid(0.0F, -8.5F, 5, 1.9F);
  }
};

}  // namespace

std::unique_ptr<Scene> make_colored_solids_scene(Renderer& renderer) {
  return std::make_unique<ColoredSolidsScene>(renderer);
}
std::unique_ptr<Scene> make_textured_cube_scene(Renderer& renderer, const Assets& assets) {
  return std::make_unique<TexturedCubeScene>(renderer, assets);
}
std::unique_ptr<Scene> make_solids_on_plane_scene(Renderer& renderer, const Assets& assets) {
  return std::make_unique<SolidsOnPlaneScene>(renderer, assets);
}

}  // namespace ref_app
