#include "raster/primitive/window_box.h"

namespace halfspace::raster {
namespace {

// One edge as a function that is >= 0 inside, evaluated at the pixel centre of a tile where it is greatest,
// and what it gains from tile to tile. With corners in the guard band every value fits 50 bits.
struct TileEdge {
  int64_t row, value, step_x, step_y;

  TileEdge(const int32_t x[3], const int32_t y[3], int i, bool clockwise, const TileBox& box) {
    const int from = clockwise ? (i + 1) % 3 : i, to = clockwise ? i : (i + 1) % 3;
    const int64_t a = int64_t{y[from]} - y[to], b = int64_t{x[to]} - x[from];
    constexpr int64_t kStep = int64_t{kTileSize} * kSubpixelScale;
    constexpr int64_t kFirst = kSubpixelScale / 2,
                      kLast = kStep - kSubpixelScale / 2;  // centres of the end pixels
    const int64_t best_x = box.x0 * kStep + (a > 0 ? kLast : kFirst);
    const int64_t best_y = box.y0 * kStep + (b > 0 ? kLast : kFirst);
    row = a * (best_x - x[from]) + b * (best_y - y[from]);
    value = row;
    step_x = a * kStep;
    step_y = b * kStep;
  }
  void next_row() { value = row += step_y; }
};

}  // namespace

void bin_triangle(Segment& segment, const TileBox& box, const int32_t x[3], const int32_t y[3],
                  uint32_t primitive) {
  if (box.x0 == box.x1 || box.y0 == box.y1) return bin_box(segment, box, primitive);
  const int64_t area =
      (int64_t{x[1]} - x[0]) * (int64_t{y[2]} - y[0]) - (int64_t{x[2]} - x[0]) * (int64_t{y[1]} - y[0]);
  TileEdge e0(x, y, 0, area < 0, box), e1(x, y, 1, area < 0, box), e2(x, y, 2, area < 0, box);
  for (int ty = box.y0; ty <= box.y1; ++ty) {
    for (int tx = box.x0; tx <= box.x1; ++tx) {
      if ((e0.value | e1.value | e2.value) >= 0) push_to_bin(segment, tx, ty, primitive);
      e0.value += e0.step_x, e1.value += e1.step_x, e2.value += e2.step_x;
    }
    e0.next_row(), e1.next_row(), e2.next_row();
  }
}

}  // namespace halfspace::raster
