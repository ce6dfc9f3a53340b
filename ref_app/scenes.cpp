#include "ref_app/scenes.h"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <stdexcept>

#include "ref_app/scene_parts.h"

namespace ref_app {
namespace {

constexpr float kFieldOfView = 45.0F;  // degrees, vertical
constexpr float kNear = 0.1F, kFar = 100.0F;

glm::mat4 view_matrix(const Camera& camera, const Motion& motion) {
  glm::mat4 view = glm::lookAt(camera.eye, camera.target, glm::vec3(0, 1, 0));
  if (motion.still()) return view;
  view = glm::translate(view, camera.target);
  const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(0, 1, 0)));
  view = glm::rotate(view, motion.pitch, right);
  view = glm::rotate(view, motion.yaw, glm::vec3(0, 1, 0));
  return glm::translate(view, -camera.target);
}

}  // namespace

void ItemScene::draw(Renderer& renderer, const Motion& motion) {
  PipelineState state;
  glm::mat4 view(1.0F);
  if (perspective_) {
    const float aspect = static_cast<float>(renderer.width()) / static_cast<float>(renderer.height());
    state.projection = glm::perspective(glm::radians(kFieldOfView), aspect, kNear, kFar);
    view = view_matrix(camera_, motion);
  } else if (!motion.still()) {
    view = glm::rotate(view, motion.yaw, glm::vec3(0, 1, 0));
    view = glm::rotate(view, motion.pitch, glm::vec3(1, 0, 0));
  }

  Pass pass;
  pass.clear_color = background_;
  renderer.begin_pass(pass);
  for (const Item& item : items_) {
    state.model_view = view * item.world;
    const float angle = item.spin * motion.seconds;
    if (angle != 0.0F) state.model_view = glm::rotate(state.model_view, angle, glm::vec3(0, 1, 0));
    state.texturing = item.texturing;
    state.image = item.image;
    renderer.draw(state, *item.mesh);
  }
  renderer.end_pass();
}

size_t ItemScene::triangle_count() const {
  size_t count = 0;
  for (const Item& item : items_) count += item.mesh->triangle_count();
  return count;
}

std::unique_ptr<Scene> make_scene(int number, Renderer& renderer, const Assets& assets) {
  switch (number) {
    case 1:
      return make_triangle_scene(renderer);
    case 2:
      return make_white_shapes_scene(renderer);
    case 3:
      return make_colored_solids_scene(renderer);
    case 4:
      return make_textured_cube_scene(renderer, assets);
    case 5:
      return make_solids_on_plane_scene(renderer, assets);
    case 6:
      return make_teapot_scene(renderer, assets);
    case 7:
      return make_nine_teapots_scene(renderer, assets);
    case 8:
      return make_terrain_scene(renderer, assets);
    default:
      throw std::out_of_range("there is no such scene");
  }
}

const char* scene_name(int number) {
  static constexpr const char* kNames[kSceneCount] = {
      "triangle",          "white shapes", "coloured solids", "textured cube",
      "solids on a plane", "teapot",       "nine teapots",    "terrain"};
  return number >= 1 && number <= kSceneCount ? kNames[number - 1] : "none";
}

}  // namespace ref_app
