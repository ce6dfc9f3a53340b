// Scenes 6 and 7: teapots.
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "ref_app/scene_parts.h"
#include "ref_app/shapes.h"
#include "ref_app/teapot.h"

namespace ref_app {
namespace {

// `v` as the teapot sees it that is turned by `degrees` about y.
glm::vec3 turned_back(const glm::vec3& v, float degrees) {
  return glm::vec3(glm::rotate(glm::mat4(1.0F), glm::radians(-degrees), glm::vec3(0, 1, 0)) *
                   glm::vec4(v, 0.0F));
}

class TeapotSceneBase : public ItemScene {
 protected:
  using ItemScene::ItemScene;

  void add_plane(Geometry plane, ImageHandle image) {
    items_.push_back({std::make_shared<const Geometry>(std::move(plane)), glm::mat4(1.0F), true, image});
  }
  // The light is baked in for the place the teapot stands at.
  void add_teapot(const Assets& assets, const glm::vec3& position, float degrees, float scale,
                  const glm::vec3& color, ImageHandle image = kImageNeverAdded) {
    const TeapotLook look{color, turned_back(light_direction(), degrees),
                          turned_back(glm::normalize(camera_.eye - position), degrees)};
    glm::mat4 world = glm::translate(glm::mat4(1.0F), position);
    world = glm::rotate(world, glm::radians(degrees), glm::vec3(0, 1, 0));
    world = glm::scale(world, glm::vec3(scale));
    items_.push_back({std::make_shared<const Geometry>(assets.teapot(look)), world, image != kImageNeverAdded,
                      image, 0.5F});
  }
};

class TeapotScene final : public TeapotSceneBase {
 public:
  TeapotScene(Renderer& renderer, const Assets& assets) : TeapotSceneBase(renderer) {
    camera_ = {{0, 4.4F, 8.6F}, {0, 1.1F, 0}};
    background_ = {levels(87, 102, 122), 1.0F};
    Geometry plane = make_plane({9, 3, 14});
    darken(plane, -0.4F, -0.4F, 4.4F, 0.1F);
    add_plane(std::move(plane), images_.add(assets.wood()));
    add_teapot(assets, {-0.15F, 0, 0}, 28, 1.0F, levels(237, 230, 219));
  }
};

class NineTeapotsScene final : public TeapotSceneBase {
 public:
  NineTeapotsScene(Renderer& renderer, const Assets& assets) : TeapotSceneBase(renderer) {
    camera_ = {{0, 13.6F, 18.8F}, {0, -0.4F, 1.0F}};
    background_ = {levels(51, 61, 76), 1.0F};
    const ImageHandle checker = images_.add(assets.checker());
    const ImageHandle marble = images_.add(assets.marble());
    constexpr float kSpacing = 5.0F;  // between the teapots' axes
    static const glm::vec3 kColors[9] = {levels(217, 84, 71),   levels(245, 245, 245), levels(76, 140, 204),
                                         levels(237, 194, 76),  levels(235, 230, 219), levels(107, 173, 112),
                                         levels(158, 112, 184), levels(255, 250, 240), levels(230, 133, 61)};
    Geometry plane = make_plane({14, 4, 20});
    for (int i = 0; i < 9; ++i)
      darken(plane, place(i, kSpacing).x - 0.3F, place(i, kSpacing).z - 0.35F, 3.0F, 0.1F);
    add_plane(std::move(plane), checker);
    for (int i = 0; i < 9; ++i) {
      const bool textured = i == 4;
      add_teapot(assets, place(i, kSpacing), static_cast<float>(30 + 41 * i), 0.78F, kColors[i],
                 textured ? marble : kImageNeverAdded);
    }
  }

 private:
  static glm::vec3 place(int i, float spacing) {
    return {static_cast<float>(i % 3 - 1) * spacing, 0.0F, static_cast<float>(i / 3 - 1) * spacing};
  }
};

}  // namespace

std::unique_ptr<Scene> make_teapot_scene(Renderer& renderer, const Assets& assets) {
  return std::make_unique<TeapotScene>(renderer, assets);
}
std::unique_ptr<Scene> make_nine_teapots_scene(Renderer& renderer, const Assets& assets) {
  return std::make_unique<NineTeapotsScene>(renderer, assets);
}

}  // namespace ref_app
