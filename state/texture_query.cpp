// glGetTexLevelParameter, glGetTexImage (spec 6.1.3, 6.1.4), and the group's rows of the query table.
#include <optional>
#include <vector>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"
#include "state/pixel_format.h"
#include "state/texture_format.h"
#include "state/texture_image.h"

namespace halfspace::state {
namespace {

// The value of a level parameter; nothing when there is no such parameter.
std::optional<GLint> level_parameter(const TextureImage& image, GLenum pname) {
  const auto bits = [&](TextureComponent component) -> GLint {
    return image.empty() ? 0 : component_bits(image.base_format)[component];
  };
  switch (pname) {
    case GL_TEXTURE_WIDTH:
      return image.width;
    case GL_TEXTURE_HEIGHT:
      return image.height;
    case GL_TEXTURE_BORDER:
      return image.border;
    case GL_TEXTURE_INTERNAL_FORMAT:
      return image.internal_format;  // GL_TEXTURE_COMPONENTS is the same number
    case GL_TEXTURE_RED_SIZE:
      return bits(kRedBits);
    case GL_TEXTURE_GREEN_SIZE:
      return bits(kGreenBits);
    case GL_TEXTURE_BLUE_SIZE:
      return bits(kBlueBits);
    case GL_TEXTURE_ALPHA_SIZE:
      return bits(kAlphaBits);
    case GL_TEXTURE_LUMINANCE_SIZE:
      return bits(kLuminanceBits);
    case GL_TEXTURE_INTENSITY_SIZE:
      return bits(kIntensityBits);
    // Later versions' names. Programs ask for all components of an image in a row; no image of ours has
    // these.
    case GL_TEXTURE_DEPTH_SIZE:
    case GL_TEXTURE_STENCIL_SIZE:
      return 0;
    default:
      return std::nullopt;
  }
}

template <class T>
void get_level_parameter(Context& context, GLenum target, GLint level, GLenum pname, T* params,
                         const char* operation) {
  const bool exists = level_exists(level);
  const auto image = find_image(context, target, exists ? level : 0);
  if (!image) return record_error(context, GL_INVALID_ENUM, operation);
  if (!exists) return record_error(context, GL_INVALID_VALUE, operation);
  const auto value = level_parameter(*image, pname);
  if (!value) return record_error(context, GL_INVALID_ENUM, operation);
  *params = T(*value);
}

void write_image(TextureObject& object, GLint level, const PixelFormat& format, const PixelStore& store,
                 std::byte* pixels) {
  const TextureImage& image = object.images[size_t(level)];
  const size_t width = size_t(image.width), height = size_t(image.height);
  const size_t stored_height = size_t(image.inner_height() + 2 * image.border);
  std::vector<uint8_t> stored(width * stored_height * 4);
  object.storage.read_level(level, stored.data(), width * 4);
  // In one dimension the rows of the border are only there for the sampler.
  uint8_t* texels = &stored[(stored_height - height) / 2 * width * 4];
  expand_from_base(image.base_format, texels, width * height);
  if (format.format == GL_LUMINANCE || format.format == GL_LUMINANCE_ALPHA) {
    // L is R here, not the sum that glReadPixels takes: what came in as R goes out as L.
    for (size_t i = 0; i < width * height; ++i) texels[4 * i + 1] = texels[4 * i + 2] = 0;
  }
  const ClientLayout layout = client_layout(store, image.width, format.pixel_bytes);
  for (size_t y = 0; y < height; ++y) {
    encode_pixels(format, store.swap_bytes, &texels[y * width * 4], width,
                  pixels + layout.offset + y * layout.row_bytes);
  }
}

constexpr GetRow kGetRows[] = {
    {GL_TEXTURE_BINDING_1D, GetKind::integer, 1,
     [](const Context& context, double* out) { out[0] = context.texture.bound_1d->name; }},
    {GL_TEXTURE_BINDING_2D, GetKind::integer, 1,
     [](const Context& context, double* out) { out[0] = context.texture.bound_2d->name; }},
};

}  // namespace

std::span<const GetRow> texture_get_rows() { return kGetRows; }

namespace op {

void get_tex_level_parameterfv(Context& context, GLenum target, GLint level, GLenum pname, GLfloat* params) {
  get_level_parameter(context, target, level, pname, params, __func__);
}

void get_tex_level_parameteriv(Context& context, GLenum target, GLint level, GLenum pname, GLint* params) {
  get_level_parameter(context, target, level, pname, params, __func__);
}

void get_tex_image(Context& context, GLenum target, GLint level, GLenum format, GLenum type, GLvoid* pixels) {
  TextureObject* object = bound_texture(context, target);
  if (object == nullptr || !is_color_format(format)) return record_error(context, GL_INVALID_ENUM);
  if (!level_exists(level)) return record_error(context, GL_INVALID_VALUE);
  PixelFormat out;
  const GLenum error = describe_pixels(format, type, out);
  if (error != GL_NO_ERROR) return record_error(context, error);
  guard_memory(context, [&] {
    const std::lock_guard lock(object->mutex);
    if (object->images[size_t(level)].empty() || pixels == nullptr) return;
    write_image(*object, level, out, context.pixel_store.pack, static_cast<std::byte*>(pixels));
  });
}

}  // namespace op
}  // namespace halfspace::state
