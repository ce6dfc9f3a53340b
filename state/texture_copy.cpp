// glCopyTexImage, glCopyTexSubImage: images from the buffer that glReadBuffer names (spec 3.8.2).
#include <algorithm>
#include <vector>

#include "state/context.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"
#include "state/pixel_transfer.h"
#include "state/pixel_value.h"
#include "state/texture_format.h"
#include "state/texture_image.h"

namespace halfspace::state {
namespace {

// A rectangle of window pixels; sides may reach beyond the buffer, and x + width beyond an int.
struct WindowRect {
  GLint x, y;
  GLsizei width, height;
};

raster::Rect clip_to(const raster::Framebuffer& buffer, const WindowRect& rect) {
  const auto clip = [](int64_t v, int limit) { return int(std::clamp<int64_t>(v, 0, limit)); };
  return {clip(rect.x, buffer.width()), clip(rect.y, buffer.height()),
          clip(int64_t{rect.x} + rect.width, buffer.width()),
          clip(int64_t{rect.y} + rect.height, buffer.height())};
}

// Rows of the read buffer as raster::Texture takes them. Where there is no buffer the spec leaves the values
// undefined: zero here. May throw std::bad_alloc when made, never later.
class BufferRows {
 public:
  BufferRows(Context& context, const WindowRect& rect, raster::BaseFormat base)
      : rect_(rect), base_(base), row_(size_t(rect.width) * 4) {
    raster::Framebuffer* buffer = read_framebuffer(context);
    if (buffer == nullptr) return;
    found_ = clip_to(*buffer, rect);
    if (found_.empty()) return;
    pixels_.resize(found_width() * size_t(found_.y1 - found_.y0) * 4);
    context.device.begin_pass(buffer);
    if (transfers_colors(context)) {
      read_transferred(context);
    } else {
      context.device.read_color(found_, pixels_.data(), read_plane(context));
      if (context.visual.alpha_bits == 0) set_alpha(pixels_, uint8_t{255});  // reads as 1
    }
    reduce_to_base(base, pixels_.data(), pixels_.size() / 4);
  }

  const uint8_t* row(int j) {
    const int64_t y = int64_t{rect_.y} + j;
    if (found_.empty() || y < found_.y0 || y >= found_.y1) return missing_row();
    const uint8_t* pixels = &pixels_[size_t(y - found_.y0) * found_width() * 4];
    if (found_width() == size_t(rect_.width)) return pixels;
    missing_row();
    std::copy_n(pixels, found_width() * 4, &row_[size_t(found_.x0 - int64_t{rect_.x}) * 4]);
    return row_.data();
  }

  TexelRows source() {
    return [this](int j) { return row(j); };
  }

 private:
  template <class T>
  static void set_alpha(std::vector<T>& rgba, T one) {
    for (size_t i = 3; i < rgba.size(); i += 4) rgba[i] = one;
  }
  void read_transferred(Context& context) {
    std::vector<float> colors(pixels_.size());
    context.device.read_color_float(found_, colors.data(), read_plane(context));
    if (context.visual.alpha_bits == 0) set_alpha(colors, 1.0f);
    transfer_colors(context, colors.data(), colors.size() / 4);
    std::transform(colors.begin(), colors.end(), pixels_.begin(), [](float c) { return to_byte(c); });
  }
  size_t found_width() const { return size_t(found_.x1 - found_.x0); }
  const uint8_t* missing_row() {
    std::fill(row_.begin(), row_.end(), uint8_t{0});
    reduce_to_base(base_, row_.data(), row_.size() / 4);
    return row_.data();
  }

  WindowRect rect_;
  raster::BaseFormat base_;
  raster::Rect found_;           // what of `rect_` exists
  std::vector<uint8_t> pixels_;  // of `found_`, reduced to the base format
  std::vector<uint8_t> row_;     // of `rect_`, where it is not all there
};

// Internal formats 1 to 4 are glTexImage's alone.
GLenum check_copy_format(GLint internal_format) {
  const bool legal = internal_format > 4 && base_format_of(internal_format);
  return legal ? GL_NO_ERROR : GL_INVALID_ENUM;
}

void copy_image(Context& context, const ImageRequest& request, GLint x, GLint y, const char* operation) {
  GLenum error = check_copy_format(request.internal_format);
  if (error == GL_NO_ERROR) error = check_image(request);
  if (error == GL_NO_ERROR && !image_fits(request)) error = GL_INVALID_VALUE;
  if (error != GL_NO_ERROR) return record_error(context, error, operation);

  TextureObject& object = *bound_texture(context, request.target);
  const TextureImage info = image_info(request);
  guard_memory(
      context,
      [&] {
        BufferRows rows(context, {x, y, info.width, info.height}, info.base_format);
        const std::lock_guard lock(object.mutex);
        define_image(object, request.level, info, rows.source());
        touch_texture(context, object);
      },
      operation);
}

// Leaves out the texels whose pixels the buffer does not have: they keep what they hold.
SubImageRequest clip_to_buffer(Context& context, SubImageRequest request, WindowRect& rect) {
  const raster::Framebuffer* buffer = read_framebuffer(context);
  const raster::Rect found = buffer == nullptr ? raster::Rect{} : clip_to(*buffer, rect);
  if (found.empty()) {
    request.width = request.height = 0;
    return request;
  }
  request.x += GLint(int64_t{found.x0} - rect.x);
  request.y += GLint(int64_t{found.y0} - rect.y);
  request.width = found.x1 - found.x0;
  request.height = found.y1 - found.y0;
  rect = {found.x0, found.y0, request.width, request.height};
  return request;
}

void copy_sub_image(Context& context, const SubImageRequest& request, GLint x, GLint y,
                    const char* operation) {
  if (!level_exists(request.level) || request.width < 0 || request.height < 0)
    return record_error(context, GL_INVALID_VALUE, operation);
  flush_vertices(context);  // draws look at the texture, which is locked from here on
  TextureObject& object = *bound_texture(context, request.target);
  const std::lock_guard lock(object.mutex);
  const TextureImage& info = object.images[size_t(request.level)];
  const GLenum error = check_sub_image(info, request);
  if (error != GL_NO_ERROR) return record_error(context, error, operation);
  if (request.width == 0 || request.height == 0) return;
  guard_memory(
      context,
      [&] {
        WindowRect rect{x, y, request.width, request.height};
        const SubImageRequest clipped = clip_to_buffer(context, request, rect);
        if (clipped.width == 0) return;
        BufferRows rows(context, rect, info.base_format);
        update_image(object, clipped, rows.source());
        touch_texture(context, object);
      },
      operation);
}

}  // namespace

namespace op {

void copy_tex_image_1d(Context& context, GLenum target, GLint level, GLenum internal_format, GLint x, GLint y,
                       GLsizei width, GLint border) {
  if (target != GL_TEXTURE_1D) return record_error(context, GL_INVALID_ENUM);
  copy_image(context, {target, level, GLint(internal_format), width, 1, border}, x, y, __func__);
}

void copy_tex_image_2d(Context& context, GLenum target, GLint level, GLenum internal_format, GLint x, GLint y,
                       GLsizei width, GLsizei height, GLint border) {
  if (target != GL_TEXTURE_2D) return record_error(context, GL_INVALID_ENUM);
  copy_image(context, {target, level, GLint(internal_format), width, height, border}, x, y, __func__);
}

void copy_tex_sub_image_1d(Context& context, GLenum target, GLint level, GLint texel_x, GLint x, GLint y,
                           GLsizei width) {
  if (target != GL_TEXTURE_1D) return record_error(context, GL_INVALID_ENUM);
  copy_sub_image(context, {target, level, texel_x, 0, width, 1}, x, y, __func__);
}

void copy_tex_sub_image_2d(Context& context, GLenum target, GLint level, GLint texel_x, GLint texel_y,
                           GLint x, GLint y, GLsizei width, GLsizei height) {
  if (target != GL_TEXTURE_2D) return record_error(context, GL_INVALID_ENUM);
  copy_sub_image(context, {target, level, texel_x, texel_y, width, height}, x, y, __func__);
}

}  // namespace op
}  // namespace halfspace::state
