// Scene 8: a landscape of 131,072 triangles.
#include <glm/ext/matrix_transform.hpp>

#include "ref_app/scene_parts.h"
#include "ref_app/terrain.h"

namespace ref_app {
namespace {

class TerrainScene final : public ItemScene {
 public:
  TerrainScene(Renderer& renderer, const Assets& assets) : ItemScene(renderer) {
    camera_ = {{0.0F, 8.0F, 11.0F}, {0, 0.0F, 1.2F}};
    background_ = {levels(158, 189, 219), 1.0F};
    const Image heights = assets.height_map();
    const ImageHandle dress = images_.add(assets.terrain_texture(heights));
    constexpr float kHalfSize = 8.0F;
    const glm::mat4 world = glm::scale(glm::mat4(1.0F), glm::vec3(kHalfSize, 1.0F, kHalfSize));
    items_ = {{std::make_shared<const Geometry>(make_terrain(heights, 3.0F)), world, true, dress}};
  }
};

}  // namespace

std::unique_ptr<Scene> make_terrain_scene(Renderer& renderer, const Assets& assets) {
  return std::make_unique<TerrainScene>(renderer, assets);
}

}  // namespace ref_app
