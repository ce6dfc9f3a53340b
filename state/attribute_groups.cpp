#include "state/attribute_groups.h"

#include <mutex>

namespace halfspace::state {
namespace {

void save_binding(const std::shared_ptr<TextureObject>& bound,
                  const std::shared_ptr<TextureObject>& of_name_0, SavedTextures::Binding& out) {
  const std::lock_guard lock(bound->mutex);
  out.object = bound;
  out.parameters = bound->parameters;
  out.is_default = bound == of_name_0;
}

void restore_parameters(Context& context, TextureObject& object, const TextureParameters& parameters) {
  const std::lock_guard lock(object.mutex);
  if (object.parameters == parameters) return;
  object.parameters = parameters;
  touch_texture(context, object);
}

// The object to bind again; an object deleted since then is gone for good, and name 0 takes its place. Null:
// another context's names, of which this one knows nothing.
std::shared_ptr<TextureObject> restored_object(const SavedTextures::Binding& saved, bool same_names,
                                               const std::shared_ptr<TextureObject>& of_name_0) {
  if (saved.is_default) return of_name_0;
  if (!same_names) return nullptr;
  return saved.object->deleted.load(std::memory_order_relaxed) ? of_name_0 : saved.object;
}

void restore_binding(Context& context, const SavedTextures::Binding& saved, bool same_names,
                     const std::shared_ptr<TextureObject>& of_name_0,
                     std::shared_ptr<TextureObject>& binding) {
  std::shared_ptr<TextureObject> object = restored_object(saved, same_names, of_name_0);
  if (!object) return;
  const bool was_deleted = object == of_name_0 && !saved.is_default;
  if (!was_deleted) restore_parameters(context, *object, saved.parameters);
  binding = std::move(object);
}

}  // namespace

void SavedColorBuffer::restore(Context& context) const {
  // What was drawn to a visible buffer comes to light now: later flushes are about the other one.
  if (value.draw_buffer != context.color_buffer.draw_buffer) execute_drawing(context);
  const GLenum read_buffer = context.color_buffer.read_buffer;
  context.color_buffer = value;
  context.color_buffer.read_buffer = read_buffer;
}

void SavedEnables::save(const Context& context) {
  size_t i = 0;
  for (const Capability& capability : all_capabilities())
    value[i++] = capability_enabled(context, capability);
}

void SavedEnables::restore(Context& context) const {
  size_t i = 0;
  for (const Capability& capability : all_capabilities()) {
    if (capability.bit) {
      *capability.bit(context) = value[i];
    } else {
      context.capability.idle[i] = value[i];
    }
    ++i;
  }
}

void SavedTextures::save(const Context& context) {
  const TextureState& texture = context.texture;
  enabled_1d = texture.enabled_1d;
  enabled_2d = texture.enabled_2d;
  env_mode = texture.env_mode;
  env_color = texture.env_color;
  names = texture.names;
  save_binding(texture.bound_1d, texture.default_1d, bound_1d);
  save_binding(texture.bound_2d, texture.default_2d, bound_2d);
}

void SavedTextures::restore(Context& context) const {
  TextureState& texture = context.texture;
  texture.enabled_1d = enabled_1d;
  texture.enabled_2d = enabled_2d;
  texture.env_mode = env_mode;
  texture.env_color = env_color;
  const bool same_names = names == texture.names;
  restore_binding(context, bound_1d, same_names, texture.default_1d, texture.bound_1d);
  restore_binding(context, bound_2d, same_names, texture.default_2d, texture.bound_2d);
  touch_texture_unit(context);
}

}  // namespace halfspace::state
