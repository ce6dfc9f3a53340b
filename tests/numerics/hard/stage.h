// What a hard case is made of: a function that draws with plain OpenGL calls, and what it claims of the
// picture.
#pragma once

#include <GL/gl.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tests/support/random.h"

namespace halfspace::hard {

using test::Random;

// What came out, row 0 the lowest; depth is 0 .. 2^24 - 1.
struct Picture {
  int width = 0, height = 0;
  std::vector<uint8_t> rgba;
  std::vector<uint32_t> depth;

  size_t index(int x, int y) const { return size_t(y) * size_t(width) + size_t(x); }
  const uint8_t* pixel(int x, int y) const { return &rgba[4 * index(x, y)]; }
};

struct Rgb {
  int r, g, b;
  bool operator==(const Rgb&) const = default;
};

// One drawing of a case. The context is new: all state is initial, the buffers are cleared.
class Stage {
 public:
  Stage(int width_of, int height_of, bool with_sweeps, bool for_show)
      : width(width_of), height(height_of), sweep(with_sweeps), show(for_show) {}

  const int width, height;
  const bool sweep;  // do what one picture cannot show, too
  const bool show;   // for people: triangles in colours instead of counted fragments; nothing is claimed

  // A claim that did not hold; the first few are kept.
  void complain(const std::string& text);
  const std::vector<std::string>& complaints() const { return complaints_; }

  // Looks at what has been drawn.
  Picture read() const;
  // The colour every pixel has to have; pixels for which `want` returns nothing are free.
  void expect(const Picture& picture, const std::function<std::vector<Rgb>(int x, int y)>& want);
  void expect_all(const Rgb& want);

 private:
  std::vector<std::string> complaints_;
};

struct Case {
  const char* name;
  const char* level;  // the least accuracy at which the claim holds
  const char* hazard;
  const char* claim;
  void (*draw)(Stage&);
};

const std::vector<Case>& cases();

// One unit is a pixel, the origin the lower left corner. Sizes that are powers of two keep 1/256 px exact.
void pixel_view(const Stage& stage);
// 90 degrees wide and high, from the origin along -z.
void square_view(double near, double far);

// Fragments add up: produced once, a pixel has kOnce in every channel; twice, twice that.
inline constexpr int kOnce = 80;
void count_fragments(const Stage& stage);

// Of an angle in turns, |turns| <= 1/2. libm's differ from machine to machine, and pictures are hashed.
struct SineCosine {
  double sine, cosine;
};
SineCosine sine_cosine(double turns);

void rectangle(float x0, float y0, float x1, float y1, float z = 0);

// width x height texels of noise, the same everywhere.
std::vector<uint8_t> noise(uint64_t seed, int width, int height);
// Binds a new RGBA texture with these texels and parameters.
void bind_texture(const std::vector<uint8_t>& rgba, int width, int height, GLint filter, GLint wrap,
                  int border = 0);

}  // namespace halfspace::hard
