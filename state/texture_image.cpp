#include "state/texture_image.h"

#include "state/context.h"
#include "state/texture_format.h"

namespace halfspace::state {
namespace {

bool is_power_of_two(GLsizei v) { return v > 0 && (v & (v - 1)) == 0; }

// One side of an image: whether GL 1.1 and the level allow it. 0 is the null image, which has no border.
bool side_fits(GLsizei side, GLint border, GLint level) {
  if (side == 0) return border == 0;
  const GLsizei inner = side - 2 * border;
  if (inner < 1 || inner > raster::kMaxTextureSize >> level) return false;
  return !kRequirePowerOfTwo || is_power_of_two(inner);
}

// Whether [offset, offset + size) lies in a side of `total` texels that starts at -border.
bool inside(GLint offset, GLsizei size, GLsizei total, GLint border) {
  return offset >= -border && int64_t{offset} + size <= int64_t{total} - border;
}

void drop_view(TextureObject& object) {
  object.view.reset();  // or the texels would be copied on write for its sake
  object.view_revision = ~uint64_t{0};
}

bool is_one_dimensional(const TextureObject& object) { return object.target == GL_TEXTURE_1D; }

// In one dimension the rows of the border are the row itself (raster::Texture).
TexelRows rows_of(const TextureObject& object, const TexelRows& rows) {
  if (!rows || !is_one_dimensional(object)) return rows;
  return [&rows](int) { return rows(0); };
}

}  // namespace

bool level_exists(GLint level) { return level >= 0 && level < raster::kMaxTextureLevels; }

GLenum check_image(const ImageRequest& request) {
  const bool legal = level_exists(request.level) && (request.border == 0 || request.border == 1) &&
                     request.width >= 0 && request.height >= 0;
  return legal ? GL_NO_ERROR : GL_INVALID_VALUE;
}

bool image_fits(const ImageRequest& request) {
  return side_fits(request.width, request.border, request.level) &&
         (request.one_dimensional() || side_fits(request.height, request.border, request.level));
}

TextureImage image_info(const ImageRequest& request) {
  return {.internal_format = request.internal_format,
          .width = request.width,
          .height = request.height,
          .border = request.border,
          .base_format = *base_format_of(request.internal_format)};
}

GLenum check_sub_image(const TextureImage& image, const SubImageRequest& request) {
  if (image.empty()) return GL_INVALID_OPERATION;
  const bool fits =
      inside(request.x, request.width, image.width, image.border) &&
      (request.target == GL_TEXTURE_1D || inside(request.y, request.height, image.height, image.border));
  return fits ? GL_NO_ERROR : GL_INVALID_VALUE;
}

void define_image(TextureObject& object, GLint level, const TextureImage& info, const TexelRows& rows) {
  drop_view(object);
  if (info.empty()) {
    object.storage.remove_level(level);
  } else {
    object.storage.define_level(level, info.inner_width(), info.inner_height(), info.border, info.base_format,
                                rows_of(object, rows));
  }
  object.images[size_t(level)] = info;
}

void update_image(TextureObject& object, const SubImageRequest& request, const TexelRows& rows) {
  drop_view(object);
  int y = request.y, height = request.height;
  if (is_one_dimensional(object)) {
    const GLint border = object.images[size_t(request.level)].border;
    y = -border;
    height = 1 + 2 * border;
  }
  object.storage.update_level(request.level, request.x, y, request.width, height, rows_of(object, rows));
}

std::optional<TextureImage> find_image(Context& context, GLenum target, GLint level) {
  const TextureState& texture = context.texture;
  if (target == GL_PROXY_TEXTURE_1D) return texture.proxies[0][size_t(level)];
  if (target == GL_PROXY_TEXTURE_2D) return texture.proxies[1][size_t(level)];
  TextureObject* object = bound_texture(context, target);
  if (object == nullptr) return std::nullopt;
  const std::lock_guard lock(object->mutex);
  return object->images[size_t(level)];
}

}  // namespace halfspace::state
