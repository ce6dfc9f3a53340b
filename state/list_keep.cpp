// What a display list keeps of what commands point to.
#include <algorithm>
#include <cstring>

#include "state/list_compile.h"
#include "state/pixel_format.h"

namespace halfspace::state {
namespace {

size_t list_name_bytes(GLenum type) {
  switch (type) {
    case GL_BYTE:
    case GL_UNSIGNED_BYTE:
      return 1;
    case GL_SHORT:
    case GL_UNSIGNED_SHORT:
    case GL_2_BYTES:
      return 2;
    case GL_3_BYTES:
      return 3;
    case GL_INT:
    case GL_UNSIGNED_INT:
    case GL_FLOAT:
    case GL_4_BYTES:
      return 4;
    default:
      return 0;
  }
}

// Rows of bits (spec 3.6.4): whole bytes, and a pixel's bit as LSB_FIRST says.
void keep_bitmap(const PixelStore& store, size_t width, size_t height, const std::byte* source,
                 std::byte* out) {
  const size_t pixels_a_row = store.row_length > 0 ? size_t(store.row_length) : width;
  const size_t alignment = size_t(store.alignment);
  const size_t row_bytes = (pixels_a_row + 8 * alignment - 1) / (8 * alignment) * alignment;
  const size_t out_bytes = (width + 7) / 8;
  for (size_t y = 0; y < height; ++y) {
    const std::byte* row = source + (size_t(store.skip_rows) + y) * row_bytes;
    for (size_t x = 0; x < width; ++x) {
      const size_t bit = size_t(store.skip_pixels) + x;
      const unsigned shift = unsigned(store.lsb_first ? bit % 8 : 7 - bit % 8);
      const unsigned value = std::to_integer<unsigned>(row[bit / 8]) >> shift & 1;
      out[y * out_bytes + x / 8] |= std::byte(value << (7 - x % 8));
    }
  }
}

void swap_elements(std::byte* data, size_t bytes, size_t element_bytes) {
  for (size_t i = 0; i + element_bytes <= bytes; i += element_bytes) {
    std::reverse(data + i, data + i + element_bytes);
  }
}

void keep_pixels(const PixelStore& store, const PixelFormat& format, GLsizei width, size_t height,
                 const std::byte* source, std::byte* out) {
  const ClientLayout layout = client_layout(store, width, format.pixel_bytes);
  const size_t row_bytes = size_t(width) * format.pixel_bytes;
  for (size_t y = 0; y < height; ++y) {
    std::memcpy(out + y * row_bytes, source + layout.offset + y * layout.row_bytes, row_bytes);
  }
  if (store.swap_bytes) swap_elements(out, row_bytes * height, format.element_bytes);
}

}  // namespace

const void* keep(Context& context, const void* source, size_t bytes) {
  return keep(context, static_cast<const std::byte*>(source), bytes);
}

const void* keep_image(Context& context, GLsizei width, GLsizei height, GLenum format, GLenum type,
                       const void* pixels) {
  PixelFormat pixel_format;
  if (pixels == nullptr || width <= 0 || height <= 0) return nullptr;
  if (describe_pixels(format, type, pixel_format) != GL_NO_ERROR) return nullptr;
  const bool is_bitmap = pixel_format.pixel_bytes == 0;
  const size_t rows = size_t(height);
  const size_t row_bytes = is_bitmap ? (size_t(width) + 7) / 8 : size_t(width) * pixel_format.pixel_bytes;
  if (row_bytes > SIZE_MAX / 2 / rows) throw std::bad_alloc();
  auto* out = static_cast<std::byte*>(context.lists.compiler.list->memory.allocate(rows * row_bytes));
  const auto* source = static_cast<const std::byte*>(pixels);
  const PixelStore& store = context.pixel_store.unpack;
  if (is_bitmap) {
    std::fill_n(out, rows * row_bytes, std::byte{0});
    keep_bitmap(store, size_t(width), rows, source, out);
  } else {
    keep_pixels(store, pixel_format, width, rows, source, out);
  }
  return out;
}

KeptImageStore::KeptImageStore(Context& context) : context_(context), unpack_(context.pixel_store.unpack) {
  context.pixel_store.unpack = {};
  context.pixel_store.unpack.alignment = 1;
}

KeptImageStore::~KeptImageStore() { context_.pixel_store.unpack = unpack_; }

size_t pname_values(GLenum pname) {
  switch (pname) {
    case GL_AMBIENT:
    case GL_DIFFUSE:
    case GL_SPECULAR:
    case GL_EMISSION:
    case GL_AMBIENT_AND_DIFFUSE:
    case GL_POSITION:
    case GL_LIGHT_MODEL_AMBIENT:
    case GL_FOG_COLOR:
    case GL_TEXTURE_ENV_COLOR:
    case GL_TEXTURE_BORDER_COLOR:
    case GL_OBJECT_PLANE:
    case GL_EYE_PLANE:
      return 4;
    case GL_COLOR_INDEXES:
    case GL_SPOT_DIRECTION:
      return 3;
    default:
      return 1;
  }
}

size_t call_lists_bytes(GLsizei n, GLenum type) { return n > 0 ? size_t(n) * list_name_bytes(type) : 0; }

bool is_proxy(GLenum target) { return target == GL_PROXY_TEXTURE_1D || target == GL_PROXY_TEXTURE_2D; }

}  // namespace halfspace::state
