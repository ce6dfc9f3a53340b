// glTexImage, glTexSubImage: images from client memory (spec 3.8.1, 3.8.2).
#include <vector>

#include "state/context.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"
#include "state/pixel_format.h"
#include "state/pixel_image.h"
#include "state/texture_format.h"
#include "state/texture_image.h"

namespace halfspace::state {
namespace {

// The rows of an image in client memory as raster::Texture wants them: converted one at a time, or as they
// lie when nothing is to be converted. May throw std::bad_alloc when made, never later.
class ClientRows {
 public:
  ClientRows(const Context& context, const PixelFormat& format, GLsizei width, const void* pixels,
             raster::BaseFormat base)
      : reader_(context, format, context.pixel_store.unpack, width, pixels),
        base_(base),
        converted_(size_t(width) * 4) {
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

  TexelRows source() {
    return [this](int y) { return row(y); };
  }

 private:
  ImageReader reader_;
  raster::BaseFormat base_;
  std::vector<uint8_t> converted_;
};

// Formats that texture images are made of: colours and colour indices. A format and a type that do not go
// together at all are an error before that.
GLenum check_source(GLenum format, GLenum type, PixelFormat& out) {
  const GLenum error = describe_pixels(format, type, out);
  if (error != GL_NO_ERROR) return error;
  return is_color_format(format) || format == GL_COLOR_INDEX ? GL_NO_ERROR : GL_INVALID_ENUM;
}

void upload(Context& context, const ImageRequest& request, const PixelFormat& format, const void* pixels,
            const char* operation) {
  TextureObject& object = *bound_texture(context, request.target);
  const TextureImage info = image_info(request);
  guard_memory(
      context,
      [&] {
        forget_state(context);
        const std::lock_guard lock(object.mutex);
        if (pixels == nullptr || info.empty()) {
          define_image(object, request.level, info, nullptr);
        } else {
          ClientRows rows(context, format, info.width, pixels, info.base_format);
          define_image(object, request.level, info, rows.source());
        }
        touch_texture(context, object);
      },
      operation);
}

// `proxy`: the command's own proxy target.
void tex_image(Context& context, const ImageRequest& request, bool proxy, GLenum format, GLenum type,
               const void* pixels, const char* operation) {
  GLenum error = check_image(request);
  if (error == GL_NO_ERROR && !base_format_of(request.internal_format)) error = GL_INVALID_VALUE;
  PixelFormat source;
  if (error == GL_NO_ERROR) error = check_source(format, type, source);
  if (error != GL_NO_ERROR) return record_error(context, error, operation);

  const bool fits = image_fits(request);
  if (proxy) {  // asks; the answer "no" is a zero image, never an error (spec 3.8.1)
    TextureImage& answer = context.texture.proxies[request.one_dimensional() ? 0 : 1][size_t(request.level)];
    answer = fits ? image_info(request) : TextureImage{.internal_format = 0};
    return;
  }
  if (!fits) return record_error(context, GL_INVALID_VALUE, operation);
  upload(context, request, source, pixels, operation);
}

void tex_sub_image(Context& context, const SubImageRequest& request, GLenum format, GLenum type,
                   const void* pixels, const char* operation) {
  if (!level_exists(request.level) || request.width < 0 || request.height < 0)
    return record_error(context, GL_INVALID_VALUE, operation);
  PixelFormat source;
  GLenum error = check_source(format, type, source);
  if (error != GL_NO_ERROR) return record_error(context, error, operation);

  TextureObject& object = *bound_texture(context, request.target);
  const std::lock_guard lock(object.mutex);
  const TextureImage& info = object.images[size_t(request.level)];
  error = check_sub_image(info, request);
  if (error != GL_NO_ERROR) return record_error(context, error, operation);
  if (request.width == 0 || request.height == 0 || pixels == nullptr) return;
  guard_memory(
      context,
      [&] {
        ClientRows rows(context, source, request.width, pixels, info.base_format);
        update_image(object, request, rows.source());
        touch_texture(context, object);
      },
      operation);
}

}  // namespace

namespace op {

void tex_image_1d(Context& context, GLenum target, GLint level, GLint internal_format, GLsizei width,
                  GLint border, GLenum format, GLenum type, const GLvoid* pixels) {
  const bool proxy = target == GL_PROXY_TEXTURE_1D;
  if (!proxy && target != GL_TEXTURE_1D) return record_error(context, GL_INVALID_ENUM);
  tex_image(context, {target, level, internal_format, width, 1, border}, proxy, format, type, pixels,
            __func__);
}

void tex_image_2d(Context& context, GLenum target, GLint level, GLint internal_format, GLsizei width,
                  GLsizei height, GLint border, GLenum format, GLenum type, const GLvoid* pixels) {
  const bool proxy = target == GL_PROXY_TEXTURE_2D;
  if (!proxy && target != GL_TEXTURE_2D) return record_error(context, GL_INVALID_ENUM);
  tex_image(context, {target, level, internal_format, width, height, border}, proxy, format, type, pixels,
            __func__);
}

void tex_sub_image_1d(Context& context, GLenum target, GLint level, GLint x, GLsizei width, GLenum format,
                      GLenum type, const GLvoid* pixels) {
  if (target != GL_TEXTURE_1D) return record_error(context, GL_INVALID_ENUM);
  tex_sub_image(context, {target, level, x, 0, width, 1}, format, type, pixels, __func__);
}

void tex_sub_image_2d(Context& context, GLenum target, GLint level, GLint x, GLint y, GLsizei width,
                      GLsizei height, GLenum format, GLenum type, const GLvoid* pixels) {
  if (target != GL_TEXTURE_2D) return record_error(context, GL_INVALID_ENUM);
  tex_sub_image(context, {target, level, x, y, width, height}, format, type, pixels, __func__);
}

}  // namespace op
}  // namespace halfspace::state
