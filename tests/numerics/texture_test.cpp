// Texture lookup without mipmaps: which texel, and how exactly two are mixed.
#include <gtest/gtest.h>

#include "tests/oracle/fragment.h"
#include "tests/oracle/triangle.h"
#include "tests/support/canvas.h"
#include "tests/support/textures.h"

namespace halfspace::test {
namespace {

using namespace raster;

constexpr int kSize = 64;
constexpr double kBilinearTolerance = 0.55;  // levels, NUMERICS: standard accuracy

DrawState replace_state(int size, std::shared_ptr<const TextureView> view) {
  DrawState state = plain_state(size, size);
  state.texture.view = std::move(view);
  state.texture.env = EnvMode::replace;
  return state;
}

std::array<int, 4> bytes_at(const Picture& picture, int x, int y) {
  const uint8_t* p = picture.pixel(x, y);
  return {p[0], p[1], p[2], p[3]};
}

std::array<int, 4> texel_bytes(const oracle::Level& level, int i, int j) {
  std::array<int, 4> bytes;
  for (size_t c = 0; c < 4; ++c) bytes[c] = int(std::lround(level.texel(i, j)[c] * 255));
  return bytes;
}

const int kWidths[] = {1, 2, 3, 5, 7, 8, 16, 64, 100, 255, 256};

// u = k / N is the left edge of texel k, whether k / N is a float or not.
TEST(TextureNearest, TexelEdgesPickTheTexelAboveThem) {
  Random random(1);
  for (Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::clamp_to_edge}) {
    for (int width : kWidths) {
      TestTexture texture;
      texture.add_noise(random, width, 3);
      const Sampler sampler = sampler_of(Filter::nearest, wrap);
      const oracle::Texture reference = texture.reference(sampler);
      const DrawState state = replace_state(kSize, texture.view(sampler));
      Canvas canvas(kSize, kSize);
      for (int k = 0; k < width; ++k) {
        std::vector<Vertex> point = snapped_quad(256 * (k % 16), 0, 256 * (k % 16) + 256, 256, kSize);
        for (Vertex& v : point) v.s = float(k) / float(width), v.t = 1.0f / 3;
        canvas.draw(state, Primitive::quads, point);
        ASSERT_EQ(bytes_at(canvas.read({k % 16, 0, k % 16 + 1, 1}), 0, 0),
                  texel_bytes(reference.levels[0], k, 1))
            << "texel " << k << " of " << width << ", wrap " << int(wrap);
      }
    }
  }
}

// The same along an interpolated coordinate: s runs from 0 to 1 over N px, taken at k + 1/2 px from an origin
// half a pixel to the right, hence exactly k / N.
TEST(TextureNearest, InterpolatedEdgesPickTheTexelAboveThem) {
  Random random(2);
  for (int width : kWidths) {
    if (width == 1) continue;
    TestTexture texture;
    texture.add_noise(random, width, 1);
    const Sampler sampler = sampler_of(Filter::nearest, Wrap::repeat);
    const oracle::Texture reference = texture.reference(sampler);
    Canvas canvas(512, 4);
    std::vector<Vertex> quad = snapped_quad(128, 0, 256 * width + 128, 4 * 256, 512);
    quad[1].s = quad[2].s = 1;
    canvas.draw(replace_state(512, texture.view(sampler)), Primitive::quads, quad);
    const Picture picture = canvas.read();
    for (int k = 0; k < width; ++k) {
      ASSERT_EQ(bytes_at(picture, k, 2), texel_bytes(reference.levels[0], k, 0))
          << "texel " << k << " of " << width;
    }
  }
}

// Texels as large as pixels: every filter shows the texture itself.
TEST(TextureFilter, TexelForPixelIsACopy) {
  Random random(3);
  for (Filter filter : {Filter::nearest, Filter::linear}) {
    for (Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::clamp_to_edge}) {
      for (int width : kWidths) {
        const int height = 37;
        TestTexture texture;
        texture.add_noise(random, width, height);
        const Sampler sampler = sampler_of(filter, wrap);
        const oracle::Texture reference = texture.reference(sampler);
        Canvas canvas(256, 64);
        std::vector<Vertex> quad = snapped_quad(0, 0, 256 * width, 256 * height, 256);
        quad[1].s = quad[2].s = quad[2].t = quad[3].t = 1;
        canvas.draw(replace_state(256, texture.view(sampler)), Primitive::quads, quad);
        const Picture picture = canvas.read();
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) {
            ASSERT_EQ(bytes_at(picture, x, y), texel_bytes(reference.levels[0], x, y))
                << "filter " << int(filter) << ", wrap " << int(wrap) << ", width " << width << ", texel "
                << x << ", " << y;
          }
        }
      }
    }
  }
}

struct Case {
  Filter filter;
  Wrap wrap_s, wrap_t;
  int width, height, border;
  bool perspective, projective;
  Accuracy accuracy = {};
};

std::string describe(const Case& c) {
  return "filter " + std::to_string(int(c.filter)) + ", wrap " + std::to_string(int(c.wrap_s)) +
         std::to_string(int(c.wrap_t)) + ", " + std::to_string(c.width) + "x" + std::to_string(c.height) +
         ", border " + std::to_string(c.border) + (c.perspective ? ", perspective" : "") +
         (c.projective ? ", q" : "");
}

struct TexturedTriangle {
  std::vector<Vertex> vertices = std::vector<Vertex>(3);
  std::array<oracle::ClipPoint, 3> clip;
  std::array<long double, 3> s, t, q;
};

TexturedTriangle random_triangle(Random& random, const Case& c) {
  TexturedTriangle triangle;
  for (size_t i = 0; i < 3; ++i) {
    Vertex& v = triangle.vertices[i];
    v.w = c.perspective ? random.real(0.5f, 6) : 1;
    v.x = v.w * random.real(-1.5f, 1.5f);
    v.y = v.w * random.real(-1.5f, 1.5f);
    v.q = c.projective ? random.real(0.5f, 2) : 1;
    // Some repeats, and texels from a quarter of a pixel to a few pixels.
    const float scale = float(kSize) / float(c.width) * 0.8f;
    v.s = random.real(-scale, scale);
    v.t = random.real(-scale, scale);
    triangle.clip[i] = {double(v.x), double(v.y), double(v.z), double(v.w)};
    triangle.s[i] = static_cast<long double>(v.s);
    triangle.t[i] = static_cast<long double>(v.t);
    triangle.q[i] = static_cast<long double>(v.q);
  }
  return triangle;
}

// Nearest: the texel of the exact coordinate; on an edge (within the 1/256 texel that coordinates are snapped
// to) the neighbour will do.
bool nearest_matches(const oracle::Texture& texture, const std::array<int, 4>& is, long double s,
                     long double t) {
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const oracle::Rgba texel =
          oracle::sample_level(texture, 0, Filter::nearest, s + dx / 256.0L / texture.levels[0].width,
                               t + dy / 256.0L / texture.levels[0].height);
      bool equal = true;
      for (size_t k = 0; k < 4; ++k) equal = equal && std::lround(texel[k] * 255) == is[k];
      if (equal) return true;
    }
  }
  return false;
}

void expect_textured(const Case& c, uint64_t seed, double tolerance) {
  Random random(seed);
  TestTexture texture;
  texture.add_noise(random, c.width, c.height, c.border);
  Sampler sampler = sampler_of(c.filter, c.wrap_s);
  sampler.wrap_t = c.wrap_t;
  sampler.border_color = {0.2f, 0.4f, 0.8f, 0.6f};  // whole levels
  const oracle::Texture reference = texture.reference(sampler);
  DrawState state = replace_state(kSize, texture.view(sampler));
  state.accuracy = c.accuracy;
  for (int round = 0; round < (long_tests() ? 40 : 2); ++round) {
    const TexturedTriangle textured = random_triangle(random, c);
    const oracle::Triangle triangle(state.viewport, textured.clip);
    Canvas canvas(kSize, kSize);
    canvas.draw(state, Primitive::triangles, textured.vertices);
    const Picture picture = canvas.read();
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        if (!triangle.covers(x, y)) continue;
        const auto s = triangle.projected(textured.s, textured.q, x, y).value;
        const auto t = triangle.projected(textured.t, textured.q, x, y).value;
        const std::array<int, 4> is = bytes_at(picture, x, y);
        if (c.filter == Filter::nearest) {
          ASSERT_TRUE(nearest_matches(reference, is, s, t))
              << describe(c) << ", pixel " << x << ", " << y << ", s " << double(s) << ", t " << double(t);
          continue;
        }
        const oracle::Rgba exact = oracle::sample_level(reference, 0, c.filter, s, t);
        for (size_t k = 0; k < 4; ++k) {
          ASSERT_LE(std::fabs(double(exact[k] * 255) - is[k]), tolerance)
              << describe(c) << ", triangle " << round << ", pixel " << x << ", " << y << ", component " << k
              << ", s " << double(s) << ", t " << double(t) << ": exact " << double(exact[k] * 255) << ", is "
              << is[k];
        }
      }
    }
  }
}

void expect_textured_for_all(Filter filter, int border, uint64_t seed) {
  const int sizes[][2] = {{16, 8}, {3, 5}, {7, 255}, {1, 64}};
  for (const auto& size : sizes) {
    for (Wrap wrap_s : {Wrap::repeat, Wrap::clamp, Wrap::clamp_to_edge}) {
      for (Wrap wrap_t : {Wrap::repeat, Wrap::clamp, Wrap::clamp_to_edge}) {
        for (int view = 0; view < 3 && !testing::Test::HasFatalFailure(); ++view) {
          // A repeated texture's border is never looked at by the rasteriser's contract; GL leaves it to us.
          const int used_border = wrap_s == Wrap::repeat || wrap_t == Wrap::repeat ? 0 : border;
          expect_textured({filter, wrap_s, wrap_t, size[0], size[1], used_border, view > 0, view > 1}, seed++,
                          kBilinearTolerance);
        }
      }
    }
  }
}

TEST(TextureNearest, TexelOfTheExactCoordinate) { expect_textured_for_all(Filter::nearest, 0, 100); }
TEST(TextureLinear, WithinHalfALevel) { expect_textured_for_all(Filter::linear, 0, 200); }
TEST(TextureLinear, BorderTexels) { expect_textured_for_all(Filter::linear, 1, 300); }

TEST(TextureLinear, ExactAccuracyRoundsOnce) {
  for (Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::clamp_to_edge}) {
    expect_textured({Filter::linear, wrap, wrap, 16, 8, 0, true, true, Accuracy::all(Level::exact)}, 400, 0.5 + 1e-4);
  }
}

// Triangles as wide as a large window: float is taken only as far as it reaches.
TEST(TextureLinear, WideTrianglesStayWithinHalfALevel) {
  Random random(8);
  constexpr int kWide = 1024;
  TestTexture texture;
  texture.add_noise(random, 256, 256);
  const Sampler sampler = sampler_of(Filter::linear, Wrap::repeat);
  const oracle::Texture reference = texture.reference(sampler);
  const DrawState state = replace_state(kWide, texture.view(sampler));
  Canvas canvas(kWide, kWide, 2);
  for (int round = 0; round < (long_tests() ? 40 : 4); ++round) {
    const Case c{Filter::linear, Wrap::repeat, Wrap::repeat, 8, 8, 0, round % 2 == 1, false};
    const TexturedTriangle textured = random_triangle(random, c);
    const oracle::Triangle triangle(state.viewport, textured.clip);
    canvas.clear();
    canvas.draw(state, Primitive::triangles, textured.vertices);
    const Picture picture = canvas.read();
    for (int i = 0; i < 4000; ++i) {
      const int x = int(random.integer(0, kWide - 1)), y = int(random.integer(0, kWide - 1));
      if (!triangle.covers(x, y)) continue;
      const auto s = triangle.attribute(textured.s, x, y).value,
                 t = triangle.attribute(textured.t, x, y).value;
      const oracle::Rgba exact = oracle::sample_level(reference, 0, Filter::linear, s, t);
      const std::array<int, 4> is = bytes_at(picture, x, y);
      for (size_t k = 0; k < 4; ++k) {
        ASSERT_LE(std::fabs(double(exact[k] * 255) - is[k]), kBilinearTolerance)
            << "triangle " << round << ", pixel " << x << ", " << y << ", s " << double(s) << ", t "
            << double(t) << ": exact " << double(exact[k] * 255) << ", is " << is[k];
      }
    }
  }
}

// A floor to the horizon, w from 1 to 10^4, texture coordinates up to 10^4 repeats: double on demand.
TEST(TextureLinear, HorizonStaysWithinHalfALevel) {
  Random random(5);
  TestTexture texture;
  texture.add_noise(random, 64, 64);
  const Sampler sampler = sampler_of(Filter::linear, Wrap::repeat);
  const oracle::Texture reference = texture.reference(sampler);
  const DrawState state = replace_state(kSize, texture.view(sampler));
  TexturedTriangle floor;
  for (size_t i = 0; i < 3; ++i) {
    Vertex& v = floor.vertices[i];
    v.w = i < 2 ? 1 : 10000;
    v.x = (i == 0 ? -4.0f : i == 1 ? 4.0f : 0.0f) * v.w;
    v.y = i < 2 ? -1 : 0.5f * v.w;
    v.s = i == 1 ? 8 : 0;
    v.t = i < 2 ? 0 : 10000;
    floor.clip[i] = {double(v.x), double(v.y), 0, double(v.w)};
    floor.s[i] = static_cast<long double>(v.s), floor.t[i] = static_cast<long double>(v.t);
  }
  const oracle::Triangle triangle(state.viewport, floor.clip);
  Canvas canvas(kSize, kSize);
  canvas.draw(state, Primitive::triangles, floor.vertices);
  const Picture picture = canvas.read();
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      if (!triangle.covers(x, y)) continue;
      const auto s = triangle.attribute(floor.s, x, y), t = triangle.attribute(floor.t, x, y);
      const oracle::Rgba exact = oracle::sample_level(reference, 0, Filter::linear, s.value, t.value);
      for (size_t k = 0; k < 4; ++k) {
        ASSERT_LE(std::fabs(double(exact[k] * 255) - picture.pixel(x, y)[k]), kBilinearTolerance)
            << "pixel " << x << ", " << y << ", s " << double(s.value) << ", t " << double(t.value)
            << ", exact " << double(exact[k] * 255) << ", is " << int(picture.pixel(x, y)[k]);
      }
    }
  }
}

// The double path is taken where it is called for, and nowhere else.
TEST(TextureLinear, DoubleIsPaidForOnlyWhereFloatWouldNotDo) {
  Random random(7);
  TestTexture texture;
  texture.add_noise(random, 64, 64);
  const DrawState state = replace_state(kSize, texture.view(sampler_of(Filter::linear, Wrap::repeat)));
  std::vector<Vertex> triangle{snapped_vertex(0, 0, kSize), snapped_vertex(16000, 0, kSize),
                               snapped_vertex(0, 16000, kSize)};
  triangle[1].s = triangle[2].t = 1;
  Canvas canvas(kSize, kSize);
  canvas.draw(state, Primitive::triangles, triangle);
  canvas.device().finish();
  EXPECT_GT(canvas.device().statistics().fragments, 1900u);
  EXPECT_EQ(canvas.device().statistics().double_fragments, 0u);
  triangle[2].x *= 1e6f, triangle[2].y *= 1e6f, triangle[2].w = 1e6f;
  triangle[2].t = 1e6f;
  canvas.draw(state, Primitive::triangles, triangle);
  canvas.device().finish();
  EXPECT_GT(canvas.device().statistics().double_fragments, 1900u);
}

// Whole repeats added to s and t change nothing, flat or in perspective, whole or cut by the near plane.
TEST(TextureRepeat, WholeRepeatsChangeNothing) {
  Random random(6);
  for (Filter filter : {Filter::nearest, Filter::linear}) {
    for (MipMode mip : {MipMode::none, MipMode::linear}) {
      for (int view = 0; view < 3; ++view) {
        TestTexture texture;
        for (int size = 32; size > 0; size /= 2) texture.add_noise(random, size, size);
        const DrawState state = replace_state(kSize, texture.view(sampler_of(filter, Wrap::repeat, mip)));
        std::vector<Vertex> quad = snapped_quad(3 * 256 + 77, 256, 61 * 256, 60 * 256 + 5, kSize);
        for (size_t i = 0; i < 4; ++i) {
          Vertex& v = quad[i];
          v.s = i == 1 || i == 2 ? 3 : 0;
          v.t = i < 2 ? 0 : 2;
          const float w = view == 0 || i < 2 ? 1 : 5;
          v.x *= w, v.y *= w, v.w = w;
          if (view == 2 && i < 2) v.z = -3;
        }
        Canvas canvas(kSize, kSize);
        canvas.draw(state, Primitive::quads, quad);
        const Picture before = canvas.read();
        for (float offset : {1.0f, -1.0f, 0x1p10f, 0x1p15f, 0x1p20f, -0x1p20f}) {
          std::vector<Vertex> moved = quad;
          for (Vertex& v : moved) v.s += offset, v.t -= offset;
          canvas.clear();
          canvas.draw(state, Primitive::quads, moved);
          EXPECT_EQ(first_difference(before, canvas.read()), "")
              << "offset " << offset << ", filter " << int(filter) << ", mip " << int(mip) << ", view "
              << view;
        }
      }
    }
  }
}

// Texels are copied when a view is held: a draw shows the texture as it was when the view was taken.
// With a q at every corner nothing is taken off before the divide: negative coordinates repeat all the same.
TEST(TextureRepeat, NegativeQuotientsRepeat) {
  Random random(7);
  for (Filter filter : {Filter::nearest, Filter::linear}) {
    TestTexture texture;
    texture.add_noise(random, 16, 16);
    const DrawState state = replace_state(kSize, texture.view(sampler_of(filter, Wrap::repeat)));
    const auto drawn = [&](float offset) {
      std::vector<Vertex> quad = snapped_quad(0, 0, 64 * 256, 64 * 256, kSize);
      for (size_t i = 0; i < 4; ++i) {
        Vertex& v = quad[i];
        v.q = i == 1 || i == 2 ? 2.0f : 1.0f;
        v.s = v.q * (offset + (i == 1 || i == 2 ? 2.25f : 0.125f));
        v.t = v.q * (offset + (i < 2 ? 0.25f : 1.5f));
      }
      Canvas canvas(kSize, kSize);
      canvas.draw(state, Primitive::quads, quad);
      return canvas.read();
    };
    EXPECT_EQ(first_difference(drawn(0), drawn(-4)), "") << "filter " << int(filter);
  }
}

// Snapping takes an edge to a pixel's centre from just beside it: there the coordinate is just below nought, which is the
// last texel's place.
TEST(TextureRepeat, JustBelowNoughtIsTheLastTexel) {
  constexpr int kTexels = 256, kAcross = 16;
  Random random(8);
  TestTexture texture;
  texture.add_noise(random, kTexels, 1);
  std::vector<Vertex> quad = snapped_quad(128, 0, 128 + 256 * kAcross, 4 * 256, kSize);
  for (Vertex& v : quad) v.x += float(2 * 0.0015 / kSize);  // pixels, less than half a sub-pixel
  quad[1].s = quad[2].s = 1;
  // Repeated both ways, and one way only.
  for (Wrap wrap_t : {Wrap::repeat, Wrap::clamp_to_edge}) {
    Sampler sampler = sampler_of(Filter::nearest, Wrap::repeat);
    sampler.wrap_t = wrap_t;
    const oracle::Texture reference = texture.reference(sampler);
    Canvas canvas(kSize, 4);
    canvas.draw(replace_state(kSize, texture.view(sampler)), Primitive::quads, quad);
    // Sixteen texels a pixel: 0.024 of one to the left of it.
    EXPECT_EQ(bytes_at(canvas.read(), 0, 1), texel_bytes(reference.levels[0], kTexels - 1, 0));
    EXPECT_EQ(bytes_at(canvas.read(), 1, 1), texel_bytes(reference.levels[0], kTexels / kAcross - 1, 0));
  }
}

TEST(TextureView, KeepsItsTexels) {
  std::vector<uint8_t> texels(4 * 4 * 4, 200);
  Texture texture;
  texture.define_level(0, 4, 4, 0, BaseFormat::rgba, texels.data(), 16);
  const auto before = texture.view(sampler_of(Filter::linear, Wrap::repeat), 1);
  Canvas canvas(kSize, kSize);
  const std::vector<Vertex> quad = snapped_quad(0, 0, 256 * kSize, 256 * kSize, kSize);
  canvas.draw(replace_state(kSize, before), Primitive::quads, quad);
  const uint8_t dark[4] = {1, 2, 3, 4};
  texture.update_level(0, 0, 0, 1, 1, dark, 4);
  EXPECT_EQ(bytes_at(canvas.read(), 2, 2), (std::array<int, 4>{200, 200, 200, 200}));
  canvas.draw(replace_state(kSize, texture.view(sampler_of(Filter::nearest, Wrap::repeat), 1)),
              Primitive::quads, quad);
  EXPECT_EQ(bytes_at(canvas.read(), 2, 2), (std::array<int, 4>{1, 2, 3, 4}));
}

// Drawing with a new texture each time and deleting it at once: what draws hold back stays bounded.
TEST(TextureView, PendingDrawsLetGoOfOldTextures) {
  constexpr int kTextures = 200, kTexels = 512;  // 1 MB each
  const std::vector<Vertex> quad = snapped_quad(0, 0, 256 * kSize, 256 * kSize, kSize);
  std::vector<std::weak_ptr<const TextureView>> views;
  Canvas canvas(kSize, kSize);
  for (int i = 0; i < kTextures; ++i) {
    const std::vector<uint8_t> texels(size_t{kTexels} * kTexels * 4, uint8_t(i));
    Texture texture;
    texture.define_level(0, kTexels, kTexels, 0, BaseFormat::rgba, texels.data(), kTexels * 4);
    const auto view = texture.view(sampler_of(Filter::nearest, Wrap::repeat), 1);
    views.push_back(view);
    canvas.draw(replace_state(kSize, view), Primitive::quads, quad);
  }
  int alive = 0;
  for (const auto& view : views) alive += !view.expired();
  EXPECT_LT(alive, 140);
  EXPECT_GT(alive, 0);
  const int last = kTextures - 1;
  EXPECT_EQ(bytes_at(canvas.read(), 2, 2), (std::array<int, 4>{last, last, last, last}));
}

}  // namespace
}  // namespace halfspace::test
