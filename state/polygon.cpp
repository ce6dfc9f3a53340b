#include "state/polygon.h"

#include <cstddef>
#include <cstdint>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace {

bool is_face(GLenum face) { return face == GL_FRONT || face == GL_BACK || face == GL_FRONT_AND_BACK; }

// A stipple in client memory: 32 x 32 elements of GL_BITMAP as the pixel store says (spec 3.6.4, 3.5.2).
struct StippleLayout {
  size_t row_bytes, first_byte;
  unsigned first_bit;
  bool lsb_first;

  explicit StippleLayout(const PixelStore& store) : lsb_first(store.lsb_first) {
    const size_t alignment = size_t(store.alignment),
                 bits = store.row_length > 0 ? size_t(store.row_length) : 32;
    row_bytes = (bits + 8 * alignment - 1) / (8 * alignment) * alignment;
    first_byte = size_t(store.skip_rows) * row_bytes + size_t(store.skip_pixels) / 8;
    first_bit = unsigned(store.skip_pixels) % 8;
  }
  size_t byte(unsigned x, size_t y) const { return first_byte + y * row_bytes + (first_bit + x) / 8; }
  unsigned mask(unsigned x) const {
    const unsigned bit = (first_bit + x) % 8;
    return lsb_first ? 1u << bit : 0x80u >> bit;
  }
};

}  // namespace

namespace op {

void cull_face(Context& context, GLenum mode) {
  if (!is_face(mode)) return record_error(context, GL_INVALID_ENUM);
  context.polygon.cull_face = mode;
  mark_dirty(context, kDirtyRaster);
}

void front_face(Context& context, GLenum mode) {
  if (mode != GL_CW && mode != GL_CCW) return record_error(context, GL_INVALID_ENUM);
  context.polygon.front_face = mode;
  mark_dirty(context, kDirtyRaster);
}

void polygon_mode(Context& context, GLenum face, GLenum mode) {
  const bool known = mode == GL_POINT || mode == GL_LINE || mode == GL_FILL;
  if (!is_face(face) || !known) return record_error(context, GL_INVALID_ENUM);
  if (face != GL_BACK) context.polygon.mode[0] = mode;
  if (face != GL_FRONT) context.polygon.mode[1] = mode;
  mark_dirty(context, kDirtyRaster);
}

void polygon_offset(Context& context, GLfloat factor, GLfloat units) {
  context.polygon.offset_factor = factor;
  context.polygon.offset_units = units;
  mark_dirty(context, kDirtyRaster);
}

void polygon_stipple(Context& context, const GLvoid* mask) {
  if (!mask) return;
  const StippleLayout layout(context.pixel_store.unpack);
  const auto* bytes = static_cast<const GLubyte*>(mask);
  for (size_t y = 0; y < 32; ++y) {
    uint32_t row = 0;
    for (unsigned x = 0; x < 32; ++x) {
      if (bytes[layout.byte(x, y)] & layout.mask(x)) row |= 0x80000000u >> x;
    }
    context.polygon_stipple.pattern[y] = row;
  }
  mark_dirty(context, kDirtyRaster);
}

// Bits of the rows' bytes that are not the stipple's stay as they are.
void get_polygon_stipple(Context& context, GLubyte* mask) {
  if (!mask) return;
  const StippleLayout layout(context.pixel_store.pack);
  for (size_t y = 0; y < 32; ++y) {
    for (unsigned x = 0; x < 32; ++x) {
      GLubyte& byte = mask[layout.byte(x, y)];
      const bool set = context.polygon_stipple.pattern[y] & (0x80000000u >> x);
      byte = GLubyte(set ? byte | layout.mask(x) : byte & ~layout.mask(x));
    }
  }
}

}  // namespace op

std::span<const GetRow> polygon_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_CULL_FACE_MODE, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.polygon.cull_face; }},
      {GL_FRONT_FACE, GetKind::enumeration, 1,
       [](const Context& c, double* out) { *out = c.polygon.front_face; }},
      {GL_POLYGON_MODE, GetKind::enumeration, 2,
       [](const Context& c, double* out) {
         out[0] = c.polygon.mode[0];
         out[1] = c.polygon.mode[1];
       }},
      {GL_POLYGON_OFFSET_FACTOR, GetKind::real, 1,
       [](const Context& c, double* out) { *out = double(c.polygon.offset_factor); }},
      {GL_POLYGON_OFFSET_UNITS, GetKind::real, 1,
       [](const Context& c, double* out) { *out = double(c.polygon.offset_units); }},
  };
  return kRows;
}

}  // namespace halfspace::state
