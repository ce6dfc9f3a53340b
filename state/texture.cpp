// Texture objects and their names (spec 3.8.11).
#include "state/texture.h"

#include <algorithm>
#include <vector>

#include "state/context.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"
#include "state/pixel_value.h"

namespace halfspace::state {
namespace {

// Stamps are unique in the process and rise, so that the highest of several tells whether any of them
// changed.
uint64_t next_stamp() {
  static std::atomic<uint64_t> last{0};
  return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

std::shared_ptr<TextureObject>* binding_of(TextureState& texture, GLenum target) {
  switch (target) {
    case GL_TEXTURE_1D:
      return &texture.bound_1d;
    case GL_TEXTURE_2D:
      return &texture.bound_2d;
    default:
      return nullptr;
  }
}

const std::shared_ptr<TextureObject>& default_of(const TextureState& texture, GLenum target) {
  return target == GL_TEXTURE_1D ? texture.default_1d : texture.default_2d;
}

void set_binding(Context& context, std::shared_ptr<TextureObject> object) {
  auto& binding = *binding_of(context.texture, object->target);
  if (binding == object) return;
  binding = std::move(object);
  touch_texture_unit(context);
}

// The object of `name` (not 0), made if this is its first bind. May throw std::bad_alloc.
std::shared_ptr<TextureObject> find_or_create(TextureNamespace& names, GLuint name, GLenum target) {
  const std::lock_guard lock(names.mutex);
  const auto [entry, inserted] = names.objects.try_emplace(name);
  if (entry->second == nullptr) {
    try {
      entry->second = std::make_shared<TextureObject>(name, target);
    } catch (...) {
      if (inserted) names.objects.erase(entry);
      throw;
    }
  }
  return entry->second;
}

// Null: 0, or no texture, be it that the name was generated but never bound.
std::shared_ptr<TextureObject> find_texture(TextureNamespace& names, GLuint name) {
  const std::lock_guard lock(names.mutex);
  const auto entry = names.objects.find(name);
  return entry == names.objects.end() ? nullptr : entry->second;
}

void release_names(TextureNamespace& names, const std::vector<GLuint>& released) {
  for (GLuint name : released) names.objects.erase(name);
}

// Reserves `n` names that are not in use. May throw std::bad_alloc and then reserves none.
std::vector<GLuint> reserve_names(TextureNamespace& names, size_t n) {
  const std::lock_guard lock(names.mutex);
  std::vector<GLuint> reserved;
  reserved.reserve(n);
  try {
    while (reserved.size() < n) {
      const GLuint name = names.next_name++;
      if (name != 0 && names.objects.try_emplace(name).second) reserved.push_back(name);
    }
  } catch (...) {
    release_names(names, reserved);
    throw;
  }
  return reserved;
}

void delete_texture(Context& context, GLuint name) {
  TextureState& texture = context.texture;
  std::shared_ptr<TextureObject> object;
  {
    const std::lock_guard lock(texture.names->mutex);
    const auto entry = texture.names->objects.find(name);
    if (entry == texture.names->objects.end()) return;
    object = std::move(entry->second);
    texture.names->objects.erase(entry);
  }
  if (object == nullptr) return;  // reserved, never bound
  object->deleted.store(true, std::memory_order_relaxed);
  if (*binding_of(texture, object->target) == object)
    set_binding(context, default_of(texture, object->target));
}

}  // namespace

TextureState::TextureState(const TextureState* share)
    : names(share != nullptr ? share->names : std::make_shared<TextureNamespace>()),
      default_1d(std::make_shared<TextureObject>(0, GL_TEXTURE_1D)),
      default_2d(std::make_shared<TextureObject>(0, GL_TEXTURE_2D)),
      bound_1d(default_1d),
      bound_2d(default_2d) {}

TextureObject* bound_texture(Context& context, GLenum target) {
  const auto* binding = binding_of(context.texture, target);
  return binding == nullptr ? nullptr : binding->get();
}

void touch_texture(Context& context, TextureObject& object) {
  object.revision.store(next_stamp(), std::memory_order_relaxed);
  mark_dirty(context, kDirtyTexture);
}

void touch_texture_unit(Context& context) {
  context.texture.revision = next_stamp();
  mark_dirty(context, kDirtyTexture);
}

uint64_t texture_revision(const Context& context) {
  const TextureState& texture = context.texture;
  return std::max({texture.revision, texture.bound_1d->revision.load(std::memory_order_relaxed),
                   texture.bound_2d->revision.load(std::memory_order_relaxed)});
}

namespace op {

void gen_textures(Context& context, GLsizei n, GLuint* names) {
  if (n < 0) return record_error(context, GL_INVALID_VALUE);
  if (names == nullptr) return;
  guard_memory(context, [&] {
    const std::vector<GLuint> reserved = reserve_names(*context.texture.names, size_t(n));
    std::copy(reserved.begin(), reserved.end(), names);
  });
}

void delete_textures(Context& context, GLsizei n, const GLuint* names) {
  if (n < 0) return record_error(context, GL_INVALID_VALUE);
  if (names == nullptr) return;
  for (GLsizei i = 0; i < n; ++i) {
    if (names[i] != 0) delete_texture(context, names[i]);
  }
}

void bind_texture(Context& context, GLenum target, GLuint name) {
  const auto* binding = binding_of(context.texture, target);
  if (binding == nullptr) return record_error(context, GL_INVALID_ENUM);
  if (name == 0) return set_binding(context, default_of(context.texture, target));
  // Bound again: nothing to look up, unless the name was deleted by someone who shares it.
  const TextureObject& bound = **binding;
  if (bound.name == name && !bound.deleted.load(std::memory_order_relaxed)) return;
  guard_memory(context, [&] {
    auto object = find_or_create(*context.texture.names, name, target);
    if (object->target != target) return record_error(context, GL_INVALID_OPERATION, "glBindTexture");
    set_binding(context, std::move(object));
  });
}

GLboolean is_texture(Context& context, GLuint name) {
  return find_texture(*context.texture.names, name) != nullptr ? GL_TRUE : GL_FALSE;
}

// Name 0 and names of no texture are passed over (spec 3.8.11).
void prioritize_textures(Context& context, GLsizei n, const GLuint* names, const GLclampf* priorities) {
  if (n < 0) return record_error(context, GL_INVALID_VALUE);
  if (names == nullptr || priorities == nullptr) return;
  for (GLsizei i = 0; i < n; ++i) {
    const auto object = find_texture(*context.texture.names, names[i]);
    if (object == nullptr) continue;
    const std::lock_guard lock(object->mutex);
    object->parameters.priority = clamp_unit(priorities[i]);
  }
}

// All textures are resident, and then `residences` is left alone; what is asked for has to be a texture.
GLboolean are_textures_resident(Context& context, GLsizei n, const GLuint* names, GLboolean*) {
  bool legal = n >= 0;
  for (GLsizei i = 0; legal && names != nullptr && i < n; ++i)
    legal = find_texture(*context.texture.names, names[i]) != nullptr;
  if (!legal) record_error(context, GL_INVALID_VALUE);
  return legal ? GL_TRUE : GL_FALSE;
}

}  // namespace op
}  // namespace halfspace::state
