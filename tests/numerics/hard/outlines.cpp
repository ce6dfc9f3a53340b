// Lines and points at every sub-pixel phase.
#include <array>
#include <cmath>
#include <utility>

#include "cases.h"

namespace halfspace::hard {
namespace {

// Cell (i, j) of 16 x 16; its lower left corner, in whole pixels.
struct Cell {
  int i, j, x, y;
};

template <typename Draw>
void each_cell(const Stage& stage, const Draw& draw) {
  for (int j = 0; j < 16; ++j)
    for (int i = 0; i < 16; ++i) draw(Cell{i, j, stage.width * i / 16, stage.height * j / 16});
}

}  // namespace

void line_phases(Stage& stage) {
  pixel_view(stage);
  // The start moves through a pixel by sixteenths; the direction turns from cell to cell. Each line is drawn
  // in two parts, which meet in the middle: no pixel may be produced twice (spec 3.4.1).
  count_fragments(stage);
  each_cell(stage, [&](const Cell& c) {
    const float x = float(c.x) + 7 + float(c.i) / 16, y = float(c.y) + 7 + float(c.j) / 16;
    const int turn = (5 * c.i + 11 * c.j) % 32;
    const float dx = float(turn % 8 - 4) * 1.5f, dy = float(turn / 8 * 3 - 4) * 1.25f;
    glBegin(GL_LINES);
    glVertex2f(x, y), glVertex2f(x + dx / 2, y + dy / 2);
    glVertex2f(x + dx / 2, y + dy / 2), glVertex2f(x + dx, y + dy);
    glEnd();
  });
  if (stage.width < 256 || stage.height < 256) return;  // cells run into each other
  stage.expect(stage.read(), [](int, int) { return std::vector<Rgb>{{0, 0, 0}, {kOnce, kOnce, kOnce}}; });
}

void line_loops(Stage& stage) {
  pixel_view(stage);
  // Rectangles and diamonds around a pixel's centre, sides axis-aligned or diagonal, so that no two of them
  // meet but in a corner. There the next side goes on where the last one ended (spec 3.4.1, corollary 16 of
  // appendix B).
  count_fragments(stage);
  const auto corners = [](const Cell& c) {
    const int x = c.x + 7, y = c.y + 7, rx = 1 + c.i % 6, ry = 1 + c.j % 6;
    using Corners = std::array<std::pair<int, int>, 4>;
    if ((c.i + c.j) % 2)
      return Corners{{{x + rx, y + ry}, {x - rx, y + ry}, {x - rx, y - ry}, {x + rx, y - ry}}};
    return Corners{{{x + rx, y}, {x, y + rx}, {x - rx, y}, {x, y - rx}}};
  };
  each_cell(stage, [&](const Cell& c) {
    glBegin(GL_LINE_LOOP);
    for (const auto& [x, y] : corners(c)) glVertex2f(float(x) + 0.5f, float(y) + 0.5f);
    glEnd();
  });
  const Picture picture = stage.read();
  if (stage.width < 256 || stage.height < 256) return;
  stage.expect(picture, [](int, int) { return std::vector<Rgb>{{0, 0, 0}, {kOnce, kOnce, kOnce}}; });
  each_cell(stage, [&](const Cell& c) {
    for (const auto& [x, y] : corners(c))
      if (picture.pixel(x, y)[0] != kOnce)
        stage.complain("the corner (" + std::to_string(x) + ", " + std::to_string(y) +
                       ") of a loop is missing");
  });
}

void point_phases(Stage& stage) {
  pixel_view(stage);
  glColor3f(1, 0.8f, 0.2f);
  each_cell(stage, [&](const Cell& c) {
    glPointSize(float(1 + (c.i + c.j) % 8));
    glBegin(GL_POINTS);
    glVertex2f(float(c.x) + 7 + float(c.i) / 16, float(c.y) + 7 + float(c.j) / 16);
    glEnd();
  });
  if (stage.width < 256 || stage.height < 256) return;
  // Spec 3.3: a square around the centre that is nearest, of a pixel when the size is odd, of a corner when
  // it is even; half-way between, either.
  const Picture picture = stage.read();
  each_cell(stage, [&](const Cell& c) {
    const int size = 1 + (c.i + c.j) % 8;
    int rows = 0, columns = 0, all = 0;
    for (int y = 0; y < 16; ++y) {
      int row = 0, column = 0;
      for (int x = 0; x < 16; ++x) {
        row += picture.pixel(c.x + x, c.y + y)[0] == 255;
        column += picture.pixel(c.x + y, c.y + x)[0] == 255;
      }
      rows += row > 0, columns += column > 0, all += row;
    }
    if (rows != size || columns != size || all != size * size)
      stage.complain("a point of size " + std::to_string(size) + " covers " + std::to_string(columns) +
                     " x " + std::to_string(rows) + " pixels, " + std::to_string(all) + " in all");
    const double x = c.i / 16.0, y = c.j / 16.0;
    const auto first = [&](double at) {
      return size % 2 ? 7 - (size - 1) / 2 : int(std::floor(7.5 + at)) - size / 2;
    };
    const auto lit = [&](int more) {
      return picture.pixel(c.x + first(x) + more, c.y + first(y) + more)[0] == 255;
    };
    if (!lit(0) || !lit(size - 1))
      stage.complain("a point of size " + std::to_string(size) + " at phase " + std::to_string(c.i) + ", " +
                     std::to_string(c.j) + " is in the wrong place");
  });
}

}  // namespace halfspace::hard
