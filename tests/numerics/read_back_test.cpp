// Colours on their way out: runs of cleared tiles, whole tiles and cut ones, at any place, are the pixels
// that were drawn. Expected values come from what was drawn, not from another read.
#include <gtest/gtest.h>

#include "tests/support/canvas.h"
#include "tests/support/random.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kWidth = 300, kHeight = 150;

ClearCommand clear_of(const Rect& box, const Color& color) {
  ClearCommand command;
  command.color = command.scissor_test = true;
  command.color_value = color;
  command.scissor = box;
  return command;
}

// Boxes of one colour over a cleared screen, some of them cleared themselves; and the same painted here.
class Boxes {
 public:
  explicit Boxes(uint64_t seed)
      : random_(seed), canvas_(kWidth, kHeight), expected_(size_t{kWidth} * kHeight) {
    clear({0, 0, kWidth, kHeight});
    for (int i = 0; i < 12; ++i) {
      const Rect box = any_rect();
      if (random_.integer(0, 1) != 0)
        clear(box);
      else
        draw(box);
    }
  }

  Random& random() { return random_; }
  Canvas& canvas() { return canvas_; }
  uint32_t expected(int x, int y) const { return expected_[size_t(y) * kWidth + size_t(x)]; }

  // Often on the edges of blocks and tiles.
  Rect any_rect() {
    const int64_t unit = random_.integer(0, 2) == 0 ? 1 : (random_.integer(0, 1) != 0 ? 8 : 64);
    const auto pick = [&](int size) { return int(random_.integer(0, size / unit - 1) * unit); };
    const int x = pick(kWidth), y = pick(kHeight);
    return {x, y, int(random_.integer(x + 1, kWidth)), int(random_.integer(y + 1, kHeight))};
  }

 private:
  Color any_color(uint32_t& rgba) {
    rgba = uint32_t(random_.bits());
    const auto channel = [&](int k) { return float(rgba >> (8 * k) & 255) / 255; };
    return {channel(0), channel(1), channel(2), channel(3)};
  }
  void paint(const Rect& box, uint32_t rgba) {
    for (int y = box.y0; y < box.y1; ++y)
      for (int x = box.x0; x < box.x1; ++x) expected_[size_t(y) * kWidth + size_t(x)] = rgba;
  }
  void clear(const Rect& box) {
    uint32_t rgba = 0;
    canvas_.device().clear(clear_of(box, any_color(rgba)));
    paint(box, rgba);
  }
  void draw(const Rect& box) {
    uint32_t rgba = 0;
    const Color color = any_color(rgba);
    const auto quad = snapped_quad(box.x0 * 256, box.y0 * 256, box.x1 * 256, box.y1 * 256, 512, 0, color);
    canvas_.draw_plain(plain_state(512, 512), Primitive::quads, quad, color);
    paint(box, rgba);
  }

  Random random_;
  Canvas canvas_;
  std::vector<uint32_t> expected_;
};

TEST(ReadBack, AnyPartIsWhatWasDrawn) {
  for (const std::string& isa : isa_levels()) {
    const IsaScope scope(isa);
    for (uint64_t seed = 1; seed <= 20; ++seed) {
      Boxes boxes(seed);
      for (int i = 0; i < 10; ++i) {
        const Rect rect = i == 0 ? Rect{0, 0, kWidth, kHeight} : boxes.any_rect();
        const int width = rect.x1 - rect.x0;
        std::vector<uint32_t> out(size_t(width) * size_t(rect.y1 - rect.y0) + 1, 0xabcdefu);
        boxes.canvas().device().read_color(rect, reinterpret_cast<uint8_t*>(out.data()), kBackPlane);
        for (int y = rect.y0; y < rect.y1; ++y)
          for (int x = rect.x0; x < rect.x1; ++x)
            ASSERT_EQ(out[size_t(y - rect.y0) * size_t(width) + size_t(x - rect.x0)], boxes.expected(x, y))
                << isa << ", seed " << seed << " at " << x << ", " << y;
        ASSERT_EQ(out.back(), 0xabcdefu);
      }
    }
  }
}

// Onto an image that is larger or smaller than the framebuffer, upside down or not, with gaps between rows.
TEST(ReadBack, FinishShowsWhatWasDrawn) {
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    Boxes boxes(seed);
    Random& random = boxes.random();
    LinearImage image;
    image.width = int(random.integer(1, 400));
    image.height = int(random.integer(1, 200));
    image.y_up = random.integer(0, 1) != 0;
    image.opaque = random.integer(0, 3) == 0;
    const auto row = size_t(image.width) + size_t(random.integer(0, 9));
    std::vector<uint32_t> out(row * size_t(image.height), 0xabcdefu);
    image.row_bytes = ptrdiff_t(row * sizeof(uint32_t));
    image.data = out.data();
    boxes.canvas().device().finish(&image);
    for (int y = 0; y < image.height; ++y) {
      for (size_t x = 0; x < row; ++x) {
        const bool inside = x < size_t(std::min(image.width, kWidth)) && y < kHeight;
        const uint32_t drawn =
            inside ? boxes.expected(int(x), y) | (image.opaque ? 0xff000000u : 0) : 0xabcdefu;
        const size_t line = size_t(image.y_up ? y : image.height - 1 - y);
        ASSERT_EQ(out[line * row + x], drawn) << "seed " << seed << " at " << x << ", " << y;
      }
    }
  }
}

// Things of a few blocks and longer ones on a screen of one colour, read from any column on.
TEST(ReadBack, NarrowAndWideThingsOnOneColour) {
  constexpr int kWide = 500, kRows = 70;
  for (const std::string& isa : isa_levels()) {
    const IsaScope scope(isa);
    Random random(7);
    for (int round = 0; round < 12; ++round) {
      Canvas canvas(kWide, kRows);
      const Color ground{0, 0, 1, 1}, color{1, 0, 0, 1};
      canvas.device().clear(clear_of({0, 0, kWide, kRows}, ground));
      std::vector<bool> drawn(kWide);
      for (int x = int(random.integer(0, 60)); x < kWide;) {
        const int end = std::min(kWide, x + int(random.integer(1, round % 2 == 0 ? 40 : 200)));
        const auto quad = snapped_quad(x * 256, 0, end * 256, kRows * 256, 512, 0, color);
        canvas.draw_plain(plain_state(512, 512), Primitive::quads, quad, color);
        std::fill(drawn.begin() + x, drawn.begin() + end, true);
        x = end + int(random.integer(1, 60));
      }
      const Rect rect{int(random.integer(0, 90)), 0, int(random.integer(400, kWide)), kRows};
      const int width = rect.x1 - rect.x0;
      std::vector<uint32_t> out(size_t(width) * kRows);
      canvas.device().read_color(rect, reinterpret_cast<uint8_t*>(out.data()), kBackPlane);
      for (int y = 0; y < kRows; ++y)
        for (int x = rect.x0; x < rect.x1; ++x)
          ASSERT_EQ(out[size_t(y) * size_t(width) + size_t(x - rect.x0)],
                    drawn[size_t(x)] ? 0xff0000ffu : 0xffff0000u)
              << isa << ", round " << round << " at " << x << ", " << y;
    }
  }
}

// A row of tiles wider than are written at once, whose blocks are cleared and written to in turn.
TEST(ReadBack, WideRowsChangeAtEachBlock) {
  constexpr int kWide = 4500, kRows = 20;
  for (const std::string& isa : isa_levels()) {
    const IsaScope scope(isa);
    Canvas canvas(kWide, kRows);
    const auto color = [](int block) { return Color{float(block % 256) / 255, float(block / 256) / 255, 0.2f, 1}; };
    for (int x = 0, block = 0; x < kWide; x += 8, ++block) {
      // A clear that leaves out a row is written to memory.
      canvas.device().clear(clear_of({x, block % 2, x + 8, kRows}, color(block)));
    }
    std::vector<uint32_t> out(size_t{kWide} * kRows);
    canvas.device().read_color({0, 0, kWide, kRows}, reinterpret_cast<uint8_t*>(out.data()), kBackPlane);
    for (int y = 1; y < kRows; ++y)
      for (int x = 0; x < kWide; ++x) {
        const int block = x / 8;
        ASSERT_EQ(out[size_t(y) * kWide + size_t(x)], 0xff330000u + uint32_t(block % 256) + uint32_t(block / 256) * 256)
            << isa << " at " << x << ", " << y;
      }
  }
}

}  // namespace
}  // namespace halfspace::test
