// Texture objects, bindings, environment (spec 3.8). Texels live in raster::Texture at 8 bits a component;
// here is what GL remembers about them.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>

#include "raster/api/texture.h"
#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

// GL 1.1 wants every side, less its borders, to be a power of two. The rasteriser does not mind.
inline constexpr bool kRequirePowerOfTwo = true;

// What glGetTexLevelParameter reports of one image. Width and height as given, border included; no image: 0.
// One-dimensional images have height 1, border or not.
struct TextureImage {
  GLint internal_format = 1;
  GLsizei width = 0, height = 0;
  GLint border = 0;
  raster::BaseFormat base_format = raster::BaseFormat::luminance;
  bool empty() const { return width == 0 || height == 0; }
  // Without the border. A two-dimensional image with a border is at least three texels high.
  GLsizei inner_width() const { return width - 2 * border; }
  GLsizei inner_height() const { return height == 1 ? 1 : height - 2 * border; }
};

using TextureImages = std::array<TextureImage, raster::kMaxTextureLevels>;

// glTexParameter's values.
struct TextureParameters {
  GLenum min_filter = GL_NEAREST_MIPMAP_LINEAR, mag_filter = GL_LINEAR;
  GLenum wrap_s = GL_REPEAT, wrap_t = GL_REPEAT;
  raster::Color border_color;  // in [0, 1]
  float priority = 1;          // in [0, 1]
  bool operator==(const TextureParameters&) const = default;
};

// One texture object. Contexts that share may reach it at the same time: `mutex` guards all that follows it.
struct TextureObject {
  TextureObject(GLuint object_name, GLenum object_target) : name(object_name), target(object_target) {}
  const GLuint name;
  const GLenum target;                // GL_TEXTURE_1D or GL_TEXTURE_2D, fixed by the first bind
  std::atomic<bool> deleted = false;  // its name is free again; bindings keep it alive
  std::atomic<uint64_t> revision{0};  // a new stamp with each change, see texture_revision

  std::mutex mutex;
  TextureParameters parameters;
  TextureImages images;
  raster::Texture storage;
  std::shared_ptr<const raster::TextureView> view;  // of view_revision
  uint64_t view_revision = ~uint64_t{0};
};

// The names that contexts made with `share` have in common. A null object: generated, not yet bound.
struct TextureNamespace {
  std::mutex mutex;
  std::unordered_map<GLuint, std::shared_ptr<TextureObject>> objects;
  GLuint next_name = 1;
};

struct TextureState {
  // `share`: whose names to use too, or null. The objects of name 0 are each context's own.
  explicit TextureState(const TextureState* share = nullptr);

  bool enabled_1d = false, enabled_2d = false;
  std::shared_ptr<TextureNamespace> names;
  std::shared_ptr<TextureObject> default_1d, default_2d;
  std::shared_ptr<TextureObject> bound_1d, bound_2d;  // never null
  GLenum env_mode = GL_MODULATE;
  raster::Color env_color;               // in [0, 1]
  std::array<TextureImages, 2> proxies;  // 1D, 2D
  uint64_t revision = 0;                 // of the bindings and the environment
};

// Changes whenever current_texture_view or the environment may have, also by another context that shares.
uint64_t texture_revision(const Context& context);

// What the unit samples, or null when it is off: not enabled, no image, or not complete (spec 3.8.10).
// GL_TEXTURE_2D wins over GL_TEXTURE_1D. May throw std::bad_alloc.
std::shared_ptr<const raster::TextureView> current_texture_view(Context& context);

// The environment as the raster room has it.
raster::EnvMode texture_env_mode(const Context& context);
raster::Color texture_env_color(const Context& context);

// --- within the texture files

// The object bound to GL_TEXTURE_1D or GL_TEXTURE_2D; null for any other target.
TextureObject* bound_texture(Context& context, GLenum target);
// The image of `level`, which exists, of a target or a proxy target; nothing for any other target.
std::optional<TextureImage> find_image(Context& context, GLenum target, GLint level);
// Call after any change: what was derived from the object or the unit is out of date.
void touch_texture(Context& context, TextureObject& object);
void touch_texture_unit(Context& context);

// How many levels the sampler may use: 0 incomplete, 1 when `min_filter` needs no mipmaps.
int complete_level_count(const TextureImages& images, GLenum min_filter);

}  // namespace halfspace::state
