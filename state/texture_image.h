// Texture images: what glTexImage, glTexSubImage and their Copy forms have in common (spec 3.8.1, 3.8.2).
#pragma once

#include "raster/api/texture.h"
#include "state/texture.h"

namespace halfspace::state {

// An image as a command asks for it. Width and height include the border; in one dimension the height is 1.
struct ImageRequest {
  GLenum target;  // may be a proxy
  GLint level;
  GLint internal_format;
  GLsizei width, height;
  GLint border;
  bool one_dimensional() const { return target == GL_TEXTURE_1D || target == GL_PROXY_TEXTURE_1D; }
};

// Texels of an image that a command writes, counted from -border. In one dimension y is 0 and the height 1.
struct SubImageRequest {
  GLenum target;
  GLint level;
  GLint x, y;
  GLsizei width, height;
};

bool level_exists(GLint level);

// What is an error for proxies as well: level, border, negative sides. Internal formats are the callers'
// affair.
GLenum check_image(const ImageRequest& request);
// Whether the size is one that an image can have; if not, a proxy gets the null image and a texture the error
// GL_INVALID_VALUE.
bool image_fits(const ImageRequest& request);
// What glGetTexLevelParameter will say of it. The internal format is a legal one.
TextureImage image_info(const ImageRequest& request);

// The texels of a request have to lie in the image: GL_INVALID_OPERATION without one, else GL_INVALID_VALUE.
GLenum check_sub_image(const TextureImage& image, const SubImageRequest& request);

// rows(n) gives row n of the image (or of the part), border included, as raster::Texture takes it: all base
// formats have their components filled in. Null rows leave zeros. The caller holds the object's mutex. May
// throw std::bad_alloc, and the old image stands.
using TexelRows = raster::Texture::RowSource;
void define_image(TextureObject& object, GLint level, const TextureImage& info, const TexelRows& rows);
void update_image(TextureObject& object, const SubImageRequest& request, const TexelRows& rows);

}  // namespace halfspace::state
