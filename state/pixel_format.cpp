#include "state/pixel_format.h"

#include "state/pixel_value.h"

namespace halfspace::state {
namespace {

// Spec 1.2, table 3.8 and figures 3.5 to 3.7: the first component is in the highest bits, with _REV in the
// lowest.
constexpr PackedLayout kPackedLayouts[] = {
    {GL_UNSIGNED_BYTE_3_3_2, 1, 3, {5, 2, 0}, {3, 3, 2}},
    {GL_UNSIGNED_BYTE_2_3_3_REV, 1, 3, {0, 3, 6}, {3, 3, 2}},
    {GL_UNSIGNED_SHORT_5_6_5, 2, 3, {11, 5, 0}, {5, 6, 5}},
    {GL_UNSIGNED_SHORT_5_6_5_REV, 2, 3, {0, 5, 11}, {5, 6, 5}},
    {GL_UNSIGNED_SHORT_4_4_4_4, 2, 4, {12, 8, 4, 0}, {4, 4, 4, 4}},
    {GL_UNSIGNED_SHORT_4_4_4_4_REV, 2, 4, {0, 4, 8, 12}, {4, 4, 4, 4}},
    {GL_UNSIGNED_SHORT_5_5_5_1, 2, 4, {11, 6, 1, 0}, {5, 5, 5, 1}},
    {GL_UNSIGNED_SHORT_1_5_5_5_REV, 2, 4, {0, 5, 10, 15}, {5, 5, 5, 1}},
    {GL_UNSIGNED_INT_8_8_8_8, 4, 4, {24, 16, 8, 0}, {8, 8, 8, 8}},
    {GL_UNSIGNED_INT_8_8_8_8_REV, 4, 4, {0, 8, 16, 24}, {8, 8, 8, 8}},
    {GL_UNSIGNED_INT_10_10_10_2, 4, 4, {22, 12, 2, 0}, {10, 10, 10, 2}},
    {GL_UNSIGNED_INT_2_10_10_10_REV, 4, 4, {0, 10, 20, 30}, {10, 10, 10, 2}},
};

size_t type_bytes(GLenum type) {
  size_t bytes = 0;
  visit_type(type, [&](auto zero) { bytes = sizeof zero; });
  return bytes;
}

GLenum describe_packed(const PackedLayout& layout, PixelFormat& out) {
  const bool fits =
      layout.components == 3 ? out.format == GL_RGB : out.format == GL_RGBA || out.format == GL_BGRA;
  if (!fits) return GL_INVALID_OPERATION;
  out.components = layout.components;
  out.element_bytes = out.pixel_bytes = layout.bytes;
  out.packed = true;
  return GL_NO_ERROR;
}

}  // namespace

const PackedLayout* find_packed_layout(GLenum type) {
  for (const PackedLayout& layout : kPackedLayouts) {
    if (layout.type == type) return &layout;
  }
  return nullptr;
}

ComponentOrder component_order(GLenum format) {
  switch (format) {
    case GL_RED:
      return {1, {0}};
    case GL_GREEN:
      return {1, {1}};
    case GL_BLUE:
      return {1, {2}};
    case GL_ALPHA:
      return {1, {3}};
    case GL_RGB:
      return {3, {0, 1, 2}};
    case GL_BGR:
      return {3, {2, 1, 0}};
    case GL_RGBA:
      return {4, {0, 1, 2, 3}};
    case GL_BGRA:
      return {4, {2, 1, 0, 3}};
    case GL_LUMINANCE:
      return {1, {kLuminance}};
    case GL_LUMINANCE_ALPHA:
      return {2, {kLuminance, 3}};
    default:
      return {0, {}};
  }
}

bool is_index_format(GLenum format) { return format == GL_COLOR_INDEX || format == GL_STENCIL_INDEX; }

bool is_color_format(GLenum format) { return component_order(format).count != 0; }

GLenum describe_pixels(GLenum format, GLenum type, PixelFormat& out) {
  const ComponentOrder order = component_order(format);
  if (order.count == 0 && !is_index_format(format) && format != GL_DEPTH_COMPONENT) return GL_INVALID_ENUM;
  out = {.format = format, .type = type};
  if (const PackedLayout* layout = find_packed_layout(type)) return describe_packed(*layout, out);
  out.components = order.count == 0 ? uint8_t{1} : order.count;
  if (type == GL_BITMAP) {
    out.pixel_bytes = 0;
    return is_index_format(format) ? GL_NO_ERROR : GL_INVALID_ENUM;
  }
  out.element_bytes = uint8_t(type_bytes(type));
  out.pixel_bytes = uint8_t(out.components * out.element_bytes);
  return out.element_bytes == 0 ? GL_INVALID_ENUM : GL_NO_ERROR;
}

bool is_plain_rgba8(const PixelFormat& format, bool swap_bytes) {
  if (format.format != GL_RGBA) return false;
  if (format.type == GL_UNSIGNED_BYTE) return true;
  const bool low_byte_first = (std::endian::native == std::endian::little) != swap_bytes;
  return format.type ==
         (low_byte_first ? GLenum{GL_UNSIGNED_INT_8_8_8_8_REV} : GLenum{GL_UNSIGNED_INT_8_8_8_8});
}

}  // namespace halfspace::state
