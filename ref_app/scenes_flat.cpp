// Scenes 1 and 2: identity matrices, so that vertices are clip coordinates.
#include "ref_app/scene_parts.h"

namespace ref_app {
namespace {

Vertex colored(float x, float y, const glm::vec3& color) {
  return {{x, y, 0.0F, 1.0F}, {color, 1.0F}, {0, 0}};
}
Vertex white(float x, float y) { return colored(x, y, glm::vec3(1.0F)); }

class TriangleScene final : public ItemScene {
 public:
  explicit TriangleScene(Renderer& renderer) : ItemScene(renderer) {
    perspective_ = false;
    auto mesh = std::make_shared<Geometry>();
    mesh->vertices = {colored(-0.8F, -0.7F, {1, 0, 0}), colored(0.8F, -0.7F, {0, 1, 0}),
                      colored(0, 0.8F, {0, 0, 1})};
    mesh->indices = {0, 1, 2};
    items_ = {{std::move(mesh)}};
  }
};

class WhiteShapesScene final : public ItemScene {
 public:
  explicit WhiteShapesScene(Renderer& renderer) : ItemScene(renderer) {
    perspective_ = false;
    background_ = {levels(26, 31, 41), 1.0F};
    // Two that share a corner, and one alone.
    auto triangles = std::make_shared<Geometry>();
    triangles->vertices = {white(-0.92F, 0.12F), white(-0.4F, 0.1F),  white(-0.75F, 0.9F),
                           white(0.05F, 0.25F),  white(-0.2F, 0.92F), white(0.2F, 0.15F),
                           white(0.95F, 0.4F),   white(0.35F, 0.93F)};
    triangles->indices = {0, 1, 2, 1, 3, 4, 5, 6, 7};
    auto quads = std::make_shared<Geometry>();
    quads->primitive = Primitive::quads;
    quads->vertices = {white(-0.85F, -0.85F), white(-0.15F, -0.85F), white(-0.15F, -0.15F),
                       white(-0.85F, -0.15F), white(0.5F, -0.95F),   white(0.92F, -0.45F),
                       white(0.48F, -0.08F),  white(0.08F, -0.52F)};
    quads->indices = {0, 1, 2, 3, 4, 5, 6, 7};
    items_ = {{std::move(triangles)}, {std::move(quads)}};
  }
};

}  // namespace

std::unique_ptr<Scene> make_triangle_scene(Renderer& renderer) {
  return std::make_unique<TriangleScene>(renderer);
}
std::unique_ptr<Scene> make_white_shapes_scene(Renderer& renderer) {
  return std::make_unique<WhiteShapesScene>(renderer);
}

}  // namespace ref_app
