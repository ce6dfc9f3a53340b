// glTexImage2D, glTexSubImage2D (spec 3.8.1, 3.8.2).
#include <vector>

#include "state/context.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"
#include "state/pixel_image.h"
#include "state/texture_format.h"

namespace halfspace::state {
namespace {

// The rows of an image in client memory as raster::Texture wants them: converted one at a time, or as they
// lie when nothing is to be converted. May throw std::bad_alloc when made, never later.
class ImageRows {
 public:
  ImageRows(ImageReader& reader, raster::BaseFormat base, GLsizei width)
      : reader_(reader), base_(base), converted_(size_t(width) * 4) {
    reader_.reserve(size_t(width));
  }

  const uint8_t* row(int y) {
    if (base_ == raster::BaseFormat::rgba) {
      if (const uint8_t* plain = reader_.plain_rgba8(y)) return plain;
    }
    const size_t width = converted_.size() / 4;
    reader_.read_rgba8(0, y, width, converted_.data());
    reduce_to_base(base_, converted_.data(), width);
    return converted_.data();
  }

  raster::Texture::RowSource source() {
    return [this](int y) { return row(y); };
  }

 private:
  ImageReader& reader_;
  raster::BaseFormat base_;
  std::vector<uint8_t> converted_;
};

void drop_view(TextureObject& object) {
  object.view.reset();  // or the texels would be copied on write for its sake
  object.view_revision = ~uint64_t{0};
}

// A null `reader` leaves the texels undefined.
void define_image(TextureObject& object, int level, const TextureImage& info, ImageReader* reader) {
  const int width = info.width - 2 * info.border, height = info.height - 2 * info.border;
  drop_view(object);
  if (info.empty()) {
    object.storage.remove_level(level);
  } else if (reader == nullptr) {
    object.storage.define_level(level, width, height, info.border, info.base_format, nullptr);
  } else {
    ImageRows rows(*reader, info.base_format, info.width);
    object.storage.define_level(level, width, height, info.border, info.base_format, rows.source());
  }
  object.images[size_t(level)] = info;
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
    ImageReader reader(context, source, context.pixel_store.unpack, width, pixels);
    define_image(object, level, info, pixels == nullptr ? nullptr : &reader);
    touch_texture(context, object);
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
    ImageReader reader(context, source, context.pixel_store.unpack, width, pixels);
    ImageRows rows(reader, info.base_format, width);
    drop_view(object);
    object.storage.update_level(level, x, y, width, height, rows.source());
    touch_texture(context, object);
  });
}

}  // namespace op
}  // namespace halfspace::state
