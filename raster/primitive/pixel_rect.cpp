#include "raster/primitive/pixel_rect.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "raster/surface/framebuffer.h"
#include "raster/vertex/vertex_kernels.h"

namespace halfspace::raster {
namespace {

constexpr size_t kSmallBytes = 16384;  // of an image that waits with the draws around it

// Elements along one axis: element i covers the pixels whose centres lie between edge(i) and edge(i + 1), the
// lower edge in.
struct ElementAxis {
  double origin, zoom;
  int64_t first, count;

  double edge(int64_t i) const { return origin + zoom * static_cast<double>(i); }
  bool holds(int64_t i, double center) const {
    const double a = edge(i), b = edge(i + 1);
    return zoom > 0 ? a <= center && center < b : b <= center && center < a;
  }
  // Of a center between the first and the last edge; the quotient may miss it by its rounding.
  int64_t element_at(double center) const {
    const double guess = std::floor((center - origin) / zoom);
    int64_t i = static_cast<int64_t>(
        std::clamp(guess, static_cast<double>(first), static_cast<double>(first + count - 1)));
    while (!holds(i, center)) {
      const bool beyond = zoom > 0 ? center >= edge(i + 1) : center < edge(i + 1);
      if (beyond ? i + 1 == first + count : i == first) break;
      i += beyond ? 1 : -1;
    }
    return i;
  }
};

// The least pixel of [low, high] whose centre is not below `edge`; high if there is none.
int first_center(double edge, int low, int high) {
  if (!(edge - 0.5 > low)) return low;
  return edge - 0.5 >= high ? high : static_cast<int>(std::ceil(edge - 0.5));
}

// Pixels [begin, end) along one axis, and each one's element relative to the first.
struct PixelSpan {
  int begin = 0, end = 0;
  int32_t* element = nullptr;
  int size() const { return end - begin; }
};

PixelSpan lay_out_axis(const ElementAxis& axis, int low, int high, Arena& arena) {
  const double a = axis.edge(axis.first), b = axis.edge(axis.first + axis.count);
  if (!(a < b || b < a)) return {};  // a zoom of 0, or one that is no number
  PixelSpan span{first_center(std::min(a, b), low, high), first_center(std::max(a, b), low, high)};
  if (span.begin >= span.end) return {};
  span.element =
      reinterpret_cast<int32_t*>(arena.allocate(static_cast<size_t>(span.size()) * sizeof(int32_t)));
  for (int p = span.begin; p < span.end; ++p)
    span.element[p - span.begin] = static_cast<int32_t>(axis.element_at(p + 0.5) - axis.first);
  return span;
}

// Replaces elements by places in a list of those in use; returns the list's length. Neighbours are in order.
size_t compact(const PixelSpan& span, int32_t* used) {
  size_t count = 0;
  for (int i = 0; i < span.size(); ++i) {
    if (count == 0 || used[count - 1] != span.element[i]) used[count++] = span.element[i];
    span.element[i] = static_cast<int32_t>(count - 1);
  }
  return count;
}

int32_t* allocate_list(const PixelSpan& span, Arena& arena) {
  return reinterpret_cast<int32_t*>(arena.allocate(static_cast<size_t>(span.size()) * sizeof(int32_t)));
}

struct UsedElements {
  const int32_t *column, *row;
  size_t columns, rows;
};

// A copy of the elements in use, `values` numbers each.
template <class T>
const T* copy_elements(const T* from, size_t row_elements, size_t values, const UsedElements& used,
                       Arena& arena) {
  if (from == nullptr) return nullptr;
  T* copy = reinterpret_cast<T*>(arena.allocate(used.columns * used.rows * values * sizeof(T)));
  T* out = copy;
  for (size_t y = 0; y < used.rows; ++y) {
    const T* row = from + static_cast<size_t>(used.row[y]) * row_elements * values;
    for (size_t x = 0; x < used.columns; ++x, out += values)
      std::memcpy(out, row + static_cast<size_t>(used.column[x]) * values, values * sizeof(T));
  }
  return copy;
}

const uint8_t* copy_bits(const PixelPacket& packet, const UsedElements& used, size_t row_bytes,
                         Arena& arena) {
  auto* copy = reinterpret_cast<uint8_t*>(arena.allocate(used.rows * row_bytes));
  std::memset(copy, 0, used.rows * row_bytes);
  for (size_t y = 0; y < used.rows; ++y) {
    const uint8_t* row = packet.bits + static_cast<size_t>(used.row[y]) * packet.row_bytes;
    for (size_t x = 0; x < used.columns; ++x) {
      const int32_t at = used.column[x];
      const unsigned bit = row[at / 8] >> (7 - at % 8) & 1u;
      copy[y * row_bytes + x / 8] = static_cast<uint8_t>(copy[y * row_bytes + x / 8] | bit << (7 - x % 8));
    }
  }
  return copy;
}

void keep_elements(const PixelPacket& packet, const PixelSpan& columns, const PixelSpan& rows, Arena& arena,
                   PixelImage& image) {
  int32_t *used_columns = allocate_list(columns, arena), *used_rows = allocate_list(rows, arena);
  UsedElements used{used_columns, used_rows, 0, 0};
  used.columns = compact(columns, used_columns);
  used.rows = compact(rows, used_rows);
  image.row_elements = used.columns;
  image.row_bytes = (used.columns + 7) / 8;
  image.color = copy_elements(packet.color, packet.row_elements, 4, used, arena);
  image.depth = copy_elements(packet.depth, packet.row_elements, 1, used, arena);
  image.stencil = copy_elements(packet.stencil, packet.row_elements, 1, used, arena);
  image.bits = packet.bits == nullptr ? nullptr : copy_bits(packet, used, image.row_bytes, arena);
}

// A coordinate that all fragments share. What comes off with REPEAT comes off before anything becomes float.
double shared_coord(double coord, double q, Wrap wrap) {
  const double value = std::clamp(q == 0 ? 0.0 : coord / q, static_cast<double>(-kMaxTexCoord),
                                  static_cast<double>(kMaxTexCoord));
  return wrap == Wrap::repeat ? value - std::floor(value) : value;
}

void set_planes(const PixelPacket& packet, const VertexLayout& layout, PixelImage& image) {
  image.planes[0] = packet.raster_depth * static_cast<double>(kDepthMax) + 0.5;
  image.planes[1] = 1;
  if (layout.fog >= 0) image.planes[2 + layout.fog] = packet.raster_distance;
  if (layout.tex_coord < 0) return;
  const Sampler& sampler = packet.state->texture.view->sampler;
  double* coord = image.planes + 2 + layout.tex_coord;
  coord[0] = shared_coord(packet.raster_tex_coord[0], packet.raster_tex_coord[3], sampler.wrap_s);
  coord[1] = shared_coord(packet.raster_tex_coord[1], packet.raster_tex_coord[3], sampler.wrap_t);
}

Color clamped(const Color& c) {
  auto one = [](float v) { return v > 0 ? std::min(v, 1.0f) : 0.0f; };
  return {one(c.r), one(c.g), one(c.b), one(c.a)};
}

}  // namespace

VertexLayout pixel_layout(const PixelPacket& packet) {
  VertexLayout layout;
  layout.constant_color = clamped(packet.raster_color);
  layout.given_color = packet.kind == PixelKind::color;
  layout.given_depth = packet.kind == PixelKind::depth;
  if (packet.state->texture.view != nullptr) {
    layout.tex_coord = layout.attribute_count;
    layout.attribute_count += 2;
  }
  if (packet.state->fog.enabled) layout.fog = layout.attribute_count++;
  return layout;
}

bool is_small(const PixelPacket& packet) {
  const size_t elements = static_cast<size_t>(packet.width) * static_cast<size_t>(packet.height);
  switch (packet.kind) {
    case PixelKind::color:
      return elements * 4 * sizeof(float) <= kSmallBytes;
    case PixelKind::depth:
      return elements * sizeof(uint32_t) <= kSmallBytes;
    case PixelKind::stencil:
      return elements <= kSmallBytes;
    case PixelKind::bitmap:
      break;
  }
  return elements / 8 <= kSmallBytes;
}

bool lay_out_pixels(const PixelPacket& packet, const VertexLayout& layout, const Rect& limit, bool keep,
                    Arena& arena, PixelImage& image) {
  if (packet.width <= 0 || packet.height <= 0 || limit.empty()) return false;
  const PixelSpan columns =
      lay_out_axis({packet.x, packet.zoom_x, packet.first_column, packet.width}, limit.x0, limit.x1, arena);
  const PixelSpan rows =
      lay_out_axis({packet.y, packet.zoom_y, packet.first_row, packet.height}, limit.y0, limit.y1, arena);
  if (columns.size() == 0 || rows.size() == 0) return false;
  image.kind = packet.kind;
  image.bounds = {columns.begin, rows.begin, columns.end, rows.end};
  image.column = columns.element;
  image.row = rows.element;
  image.color = packet.color;
  image.depth = packet.depth;
  image.stencil = packet.stencil;
  image.bits = packet.bits;
  image.row_elements = packet.row_elements;
  image.row_bytes = packet.row_bytes;
  image.stencil_mask = packet.stencil_mask;
  set_planes(packet, layout, image);
  if (keep) keep_elements(packet, columns, rows, arena, image);
  return true;
}

}  // namespace halfspace::raster
