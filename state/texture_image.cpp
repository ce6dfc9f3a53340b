// glTexImage2D, glTexSubImage2D (spec 3.8.1, 3.8.2).
#include <algorithm>
#include <vector>

#include "state/context.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"
#include "state/pixel_format.h"
#include "state/texture_format.h"

namespace halfspace::state {
namespace {

// Texels converted at a time: an image is never held twice.
constexpr size_t kStripTexels = 1 << 16;

struct ClientImage {
  PixelFormat format;
  const PixelStore& store;
  const void* pixels;
};

// A rectangle of a level, in the coordinates of raster::Texture: the border starts at -border.
struct TexelRect {
  int x, y;
  GLsizei width, height;
};

// Writes a rectangle of a defined level, strip by strip. May throw std::bad_alloc before the first texel.
void write_texels(raster::Texture& storage, int level, raster::BaseFormat base, const TexelRect& rect,
                  const ClientImage& image) {
  const ClientLayout layout = client_layout(image.store, rect.width, image.format.pixel_bytes);
  const std::byte* row = static_cast<const std::byte*>(image.pixels) + layout.offset;
  const size_t row_texels = size_t(rect.width);
  const GLsizei strip_rows = GLsizei(std::clamp<size_t>(kStripTexels / row_texels, 1, size_t(rect.height)));
  std::vector<uint8_t> strip(row_texels * 4 * size_t(strip_rows));
  for (GLsizei y = 0; y < rect.height; y += strip_rows) {
    const GLsizei rows = std::min(strip_rows, rect.height - y);
    for (GLsizei i = 0; i < rows; ++i, row += layout.row_bytes) {
      decode_pixels(image.format, image.store.swap_bytes, row, row_texels,
                    &strip[row_texels * 4 * size_t(i)]);
    }
    reduce_to_base(base, strip.data(), row_texels * size_t(rows));
    storage.update_level(level, rect.x, rect.y + y, rect.width, rows, strip.data(), row_texels * 4);
  }
}

// Client memory that is already what raster::Texture wants: nothing is copied twice.
bool is_stored_form(raster::BaseFormat base, const ClientImage& image) {
  return base == raster::BaseFormat::rgba && is_plain_rgba8(image.format, image.store.swap_bytes);
}

const uint8_t* first_byte(const ClientImage& image, const ClientLayout& layout) {
  return static_cast<const uint8_t*>(image.pixels) + layout.offset;
}

void define_image(TextureObject& object, int level, const TextureImage& info, const ClientImage& image) {
  raster::Texture& storage = object.storage;
  object.view.reset();  // or the texels would be copied on write for its sake
  object.view_revision = ~uint64_t{0};
  if (info.empty()) {
    storage.remove_level(level);
    object.images[size_t(level)] = info;
    return;
  }
  const int width = info.width - 2 * info.border, height = info.height - 2 * info.border;
  const ClientLayout layout = client_layout(image.store, info.width, image.format.pixel_bytes);
  const bool direct = image.pixels != nullptr && is_stored_form(info.base_format, image);
  storage.define_level(level, width, height, info.border, info.base_format,
                       direct ? first_byte(image, layout) : nullptr, layout.row_bytes);
  object.images[size_t(level)] = info;
  if (direct || image.pixels == nullptr) return;
  write_texels(storage, level, info.base_format, {-info.border, -info.border, info.width, info.height},
               image);
}

bool is_power_of_two(GLsizei v) { return v > 0 && (v & (v - 1)) == 0; }

// One side of an image: whether GL 1.1 and the level allow it. 0 is the null image, which has no border.
bool side_fits(GLsizei side, GLint border, GLint level) {
  if (side == 0) return border == 0;
  const GLsizei inner = side - 2 * border;
  if (inner < 1 || inner > raster::kMaxTextureSize >> level) return false;
  return !kRequirePowerOfTwo || is_power_of_two(inner);
}

// Formats that texture images are made of: colours and colour indices. Otherwise as describe_pixels.
GLenum check_source(GLenum format, GLenum type, PixelFormat& out) {
  if (!is_color_format(format) && format != GL_COLOR_INDEX) return GL_INVALID_ENUM;
  return describe_pixels(format, type, out);
}

bool level_exists(GLint level) { return level >= 0 && level < raster::kMaxTextureLevels; }

// Everything of glTexImage2D that is an error for proxies as well.
GLenum check_image(GLint level, GLint internal_format, GLsizei width, GLsizei height, GLint border) {
  if (!level_exists(level) || (border != 0 && border != 1)) return GL_INVALID_VALUE;
  if (width < 0 || height < 0 || !base_format_of(internal_format)) return GL_INVALID_VALUE;
  return GL_NO_ERROR;
}

// Whether [offset, offset + size) lies in a side of `total` texels that starts at -border.
bool inside(GLint offset, GLsizei size, GLsizei total, GLint border) {
  return offset >= -border && int64_t{offset} + size <= int64_t{total} - border;
}

}  // namespace

const TextureImages* target_images(Context& context, GLenum target) {
  switch (target) {
    case GL_PROXY_TEXTURE_1D:
      return &context.texture.proxies[0];
    case GL_PROXY_TEXTURE_2D:
      return &context.texture.proxies[1];
    default: {
      const TextureObject* object = bound_texture(context, target);
      return object == nullptr ? nullptr : &object->images;
    }
  }
}

namespace op {

void tex_image_2d(Context& context, GLenum target, GLint level, GLint internal_format, GLsizei width,
                  GLsizei height, GLint border, GLenum format, GLenum type, const GLvoid* pixels) {
  const bool proxy = target == GL_PROXY_TEXTURE_2D;
  if (!proxy && target != GL_TEXTURE_2D) return record_error(context, GL_INVALID_ENUM);
  GLenum error = check_image(level, internal_format, width, height, border);
  if (error != GL_NO_ERROR) return record_error(context, error);
  PixelFormat source;
  error = check_source(format, type, source);
  if (error != GL_NO_ERROR) return record_error(context, error);

  const bool fits = side_fits(width, border, level) && side_fits(height, border, level);
  const TextureImage info{internal_format, width, height, border, *base_format_of(internal_format)};
  if (proxy) {  // asks; the answer "no" is a zero image, never an error (spec 3.8.1)
    context.texture.proxies[1][size_t(level)] = fits ? info : TextureImage{.internal_format = 0};
    return;
  }
  if (!fits) return record_error(context, GL_INVALID_VALUE);
  TextureObject& object = *context.texture.bound_2d;
  guard_memory(context, [&] {
    const std::lock_guard lock(object.mutex);
    touch_texture(context, object);
    define_image(object, level, info, {source, context.pixel_store.unpack, pixels});
  });
}

void tex_sub_image_2d(Context& context, GLenum target, GLint level, GLint x, GLint y, GLsizei width,
                      GLsizei height, GLenum format, GLenum type, const GLvoid* pixels) {
  if (target != GL_TEXTURE_2D) return record_error(context, GL_INVALID_ENUM);
  if (!level_exists(level) || width < 0 || height < 0) return record_error(context, GL_INVALID_VALUE);
  PixelFormat source;
  const GLenum error = check_source(format, type, source);
  if (error != GL_NO_ERROR) return record_error(context, error);

  TextureObject& object = *context.texture.bound_2d;
  const std::lock_guard lock(object.mutex);
  const TextureImage& info = object.images[size_t(level)];
  if (info.empty()) return record_error(context, GL_INVALID_OPERATION);
  if (!inside(x, width, info.width, info.border) || !inside(y, height, info.height, info.border)) {
    return record_error(context, GL_INVALID_VALUE);
  }
  if (width == 0 || height == 0 || pixels == nullptr) return;
  guard_memory(context, [&] {
    const ClientImage image{source, context.pixel_store.unpack, pixels};
    touch_texture(context, object);
    object.view.reset();
    object.view_revision = ~uint64_t{0};
    if (is_stored_form(info.base_format, image)) {
      const ClientLayout layout = client_layout(image.store, width, source.pixel_bytes);
      object.storage.update_level(level, x, y, width, height, first_byte(image, layout), layout.row_bytes);
    } else {
      write_texels(object.storage, level, info.base_format, {x, y, width, height}, image);
    }
  });
}

}  // namespace op
}  // namespace halfspace::state
