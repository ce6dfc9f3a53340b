// Internal formats of textures (spec 3.8.1, tables 3.15 and 3.16), and texels as the raster room stores them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "raster/api/types.h"
#include "state/gl_types.h"

namespace halfspace::state {

// The base format of `internal_format` (1 to 4, a base or a sized format of GL 1.1); nothing for any other
// number.
std::optional<raster::BaseFormat> base_format_of(GLint internal_format);

// 1, 2, 3 and 4 are other names of GL_LUMINANCE ... GL_RGBA; every other format is its own.
GLint canonical_format(GLint internal_format);

// Bits of each component as stored, in the order R, G, B, A, L, I.
enum TextureComponent : uint8_t {
  kRedBits,
  kGreenBits,
  kBlueBits,
  kAlphaBits,
  kLuminanceBits,
  kIntensityBits
};
std::array<uint8_t, 6> component_bits(raster::BaseFormat base);

// RGBA to the stored form, in place (table 3.15): luminance and intensity come from R; components that the
// format lacks hold what raster::Texture::define_level asks for.
void reduce_to_base(raster::BaseFormat base, uint8_t* rgba, size_t count);
// The stored form to what glGetTexImage hands to pixel packing, in place (table 6.1): luminance in R alone.
void expand_from_base(raster::BaseFormat base, uint8_t* rgba, size_t count);

}  // namespace halfspace::state
