// What the texture unit samples: completeness (spec 3.8.10) and the sampler.
#include <algorithm>

#include "state/context.h"
#include "state/texture_format.h"

namespace halfspace::state {
namespace {

raster::Wrap to_wrap(GLenum wrap) {
  switch (wrap) {
    case GL_CLAMP:
      return raster::Wrap::clamp;
    case GL_CLAMP_TO_EDGE:
      return raster::Wrap::clamp_to_edge;
    default:
      return raster::Wrap::repeat;
  }
}

raster::Filter to_filter(GLenum filter) {
  const bool linear =
      filter == GL_LINEAR || filter == GL_LINEAR_MIPMAP_NEAREST || filter == GL_LINEAR_MIPMAP_LINEAR;
  return linear ? raster::Filter::linear : raster::Filter::nearest;
}

raster::MipMode to_mip_mode(GLenum filter) {
  switch (filter) {
    case GL_NEAREST_MIPMAP_NEAREST:
    case GL_LINEAR_MIPMAP_NEAREST:
      return raster::MipMode::nearest;
    case GL_NEAREST_MIPMAP_LINEAR:
    case GL_LINEAR_MIPMAP_LINEAR:
      return raster::MipMode::linear;
    default:
      return raster::MipMode::none;
  }
}

// Nothing depends on t in one dimension: all rows that a lookup may touch are the same one.
raster::Sampler to_sampler(const TextureParameters& parameters, bool one_dimensional) {
  return {.mag = to_filter(parameters.mag_filter),
          .min = to_filter(parameters.min_filter),
          .mip = to_mip_mode(parameters.min_filter),
          .wrap_s = to_wrap(parameters.wrap_s),
          .wrap_t = one_dimensional ? raster::Wrap::repeat : to_wrap(parameters.wrap_t),
          .border_color = parameters.border_color,
          .one_dimensional = one_dimensional};
}

bool fits_above(const TextureImage& image, const TextureImage& base, GLsizei inner_width,
                GLsizei inner_height) {
  return image.inner_width() == inner_width && image.inner_height() == inner_height &&
         image.border == base.border &&
         canonical_format(image.internal_format) == canonical_format(base.internal_format);
}

std::shared_ptr<const raster::TextureView> view_of(TextureObject& object) {
  const std::lock_guard lock(object.mutex);
  const uint64_t revision = object.revision.load(std::memory_order_relaxed);
  if (object.view_revision == revision) return object.view;
  const int levels = complete_level_count(object.images, object.parameters.min_filter);
  object.view = levels == 0 ? nullptr
                            : object.storage.view(
                                  to_sampler(object.parameters, object.target == GL_TEXTURE_1D), levels);
  object.view_revision = revision;
  return object.view;
}

}  // namespace

int complete_level_count(const TextureImages& images, GLenum min_filter) {
  const TextureImage& base = images[0];
  if (base.empty()) return 0;
  if (to_mip_mode(min_filter) == raster::MipMode::none) return 1;
  GLsizei width = base.inner_width(), height = base.inner_height();
  int levels = 1;
  while (width > 1 || height > 1) {
    width = std::max(width / 2, 1);
    height = std::max(height / 2, 1);
    if (!fits_above(images[size_t(levels)], base, width, height)) return 0;
    ++levels;
  }
  return levels;
}

std::shared_ptr<const raster::TextureView> current_texture_view(Context& context) {
  const TextureState& texture = context.texture;
  if (texture.enabled_2d) return view_of(*texture.bound_2d);
  if (texture.enabled_1d) return view_of(*texture.bound_1d);
  return nullptr;
}

}  // namespace halfspace::state
