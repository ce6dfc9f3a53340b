// Client pixels to RGBA and back, every format with every type, against pixel_model.h.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include "state/pixel_format.h"
#include "tests/unit/pixel_model.h"

namespace halfspace::state {
namespace {

using namespace pixel_model;

constexpr size_t kPixels = 997;

PixelFormat describe(GLenum format, GLenum type) {
  PixelFormat out;
  EXPECT_EQ(describe_pixels(format, type, out), GLenum{GL_NO_ERROR}) << std::hex << format << " " << type;
  return out;
}

// Random elements; floats around [0, 1] with all that is awkward among them.
Bytes random_elements(const TypeRow& type, size_t count, unsigned seed) {
  std::mt19937 random(seed);
  Bytes bytes(count * size_t(type.bits) / 8);
  if (!type.is_float) {
    for (std::byte& b : bytes) b = std::byte(random() & 0xFF);
    return bytes;
  }
  const float awkward[] = {0.0f,
                           -0.0f,
                           1.0f,
                           -1.0f,
                           2.0f,
                           1e-40f,
                           1e30f,
                           0.5f / 255,
                           1.5f / 255,
                           254.5f / 255,
                           std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::infinity(),
                           -std::numeric_limits<float>::infinity()};
  std::uniform_real_distribution<float> around(-0.1f, 1.1f);
  for (size_t i = 0; i < count; ++i) {
    const float f = i % 3 == 0 ? awkward[random() % std::size(awkward)] : around(random);
    std::memcpy(&bytes[i * 4], &f, 4);
  }
  return bytes;
}

Bytes swapped(const Bytes& bytes, size_t element) {
  Bytes out(bytes.size());
  for (size_t i = 0; i < bytes.size(); ++i)
    out[i] = bytes[i / element * element + (element - 1 - i % element)];
  return out;
}

int byte_of(Real v) { return int(round_half_up(clamp01(v) * 255)); }

void expect_decoded(const std::vector<uint8_t>& actual, size_t pixel, const Rgba& expected,
                    const char* what) {
  for (size_t c = 0; c < 4; ++c) {
    ASSERT_EQ(int(actual[pixel * 4 + c]), byte_of(expected[c]))
        << what << " pixel " << pixel << " component " << c;
  }
}

TEST(PixelDecode, EveryFormatAndTypeIsRoundedOnce) {
  for (const FormatRow& format : kFormats) {
    for (const TypeRow& type : kTypes) {
      const PixelFormat described = describe(format.format, type.type);
      const size_t size = size_t(type.bits) / 8, n = format.components.size();
      ASSERT_EQ(described.pixel_bytes, size * n);
      const Bytes source = random_elements(type, kPixels * n, format.format * 31 + type.type);
      std::vector<uint8_t> rgba(kPixels * 4);
      decode_pixels(described, false, source.data(), kPixels, rgba.data());
      for (size_t i = 0; i < kPixels; ++i) {
        std::vector<Real> values;
        for (size_t c = 0; c < n; ++c) {
          values.push_back(component_value(type, read_element(&source[(i * n + c) * size], size, false)));
        }
        expect_decoded(rgba, i, expand(format.components, values), format.components.c_str());
      }
      std::vector<uint8_t> from_swapped(kPixels * 4);
      decode_pixels(described, true, swapped(source, size).data(), kPixels, from_swapped.data());
      EXPECT_EQ(from_swapped, rgba) << format.components << " swapped, type " << std::hex << type.type;
    }
  }
}

TEST(PixelDecode, EverySixteenBitValue) {
  for (GLenum type : {GLenum{GL_UNSIGNED_SHORT}, GLenum{GL_SHORT}}) {
    const TypeRow row{type, 16, type == GL_SHORT};
    std::vector<uint16_t> values(65536);
    for (size_t i = 0; i < values.size(); ++i) values[i] = uint16_t(i);
    std::vector<uint8_t> rgba(values.size() * 4);
    decode_pixels(describe(GL_GREEN, type), false, reinterpret_cast<const std::byte*>(values.data()),
                  values.size(), rgba.data());
    for (size_t i = 0; i < values.size(); ++i) {
      ASSERT_EQ(int(rgba[i * 4 + 1]), byte_of(component_value(row, i))) << i;
    }
  }
}

TEST(PixelDecode, FloatsNextToEveryRoundingBoundary) {
  std::vector<float> values;
  for (int k = 0; k < 255; ++k) {
    const float boundary = float((k + 0.5) / 255);
    values.insert(values.end(), {std::nextafter(boundary, 0.0f), boundary, std::nextafter(boundary, 1.0f)});
  }
  std::vector<uint8_t> rgba(values.size() * 4);
  decode_pixels(describe(GL_RED, GL_FLOAT), false, reinterpret_cast<const std::byte*>(values.data()),
                values.size(), rgba.data());
  for (size_t i = 0; i < values.size(); ++i)
    ASSERT_EQ(int(rgba[i * 4]), byte_of(Real(values[i]))) << values[i];
}

TEST(PixelDecode, EveryPackedType) {
  for (const PackedRow& type : kPackedTypes) {
    std::vector<FormatRow> formats = {{GL_RGBA, "RGBA"}, {GL_BGRA, "BGRA"}};
    if (type.widths.size() == 3) formats = {{GL_RGB, "RGB"}};
    for (const FormatRow& format : formats) {
      const PixelFormat described = describe(format.format, type.type);
      const size_t size = size_t(packed_bits(type)) / 8;
      ASSERT_EQ(described.pixel_bytes, size);
      const Bytes source = random_elements({type.type, packed_bits(type), false}, kPixels, type.type);
      std::vector<uint8_t> rgba(kPixels * 4), from_swapped(kPixels * 4);
      decode_pixels(described, false, source.data(), kPixels, rgba.data());
      for (size_t i = 0; i < kPixels; ++i) {
        const uint64_t word = read_element(&source[i * size], size, false);
        expect_decoded(rgba, i, expand(format.components, unpack_word(type, word)),
                       format.components.c_str());
      }
      decode_pixels(described, true, swapped(source, size).data(), kPixels, from_swapped.data());
      EXPECT_EQ(from_swapped, rgba) << std::hex << type.type;
    }
  }
}

TEST(PixelDecode, IndicesAreWholeNumbers) {
  const Bytes source(16, std::byte{0xA5});
  int64_t out[4] = {};
  decode_indices(describe(GL_COLOR_INDEX, GL_UNSIGNED_BYTE), false, source.data(), 4, out);
  EXPECT_EQ(out[3], 0xA5);
  decode_indices(describe(GL_STENCIL_INDEX, GL_SHORT), false, source.data(), 4, out);
  EXPECT_EQ(out[3], 0xA5A5 - 0x10000);
  const float floats[4] = {3.75f, -2.5f, 1e30f, std::numeric_limits<float>::quiet_NaN()};
  decode_indices(describe(GL_COLOR_INDEX, GL_FLOAT), false, reinterpret_cast<const std::byte*>(floats), 4,
                 out);
  EXPECT_EQ(out[0], 3);
  EXPECT_EQ(out[1], -2);
  EXPECT_EQ(out[2], 0);  // no index, but no undefined behaviour either
  EXPECT_EQ(out[3], 0);
}

TEST(PixelDecode, DepthsOfEveryType) {
  for (const TypeRow& type : kTypes) {
    const Bytes source = random_elements(type, kPixels, 11);
    const size_t size = size_t(type.bits) / 8;
    std::vector<double> depths(kPixels), from_swapped(kPixels);
    decode_depths(describe(GL_DEPTH_COMPONENT, type.type), false, source.data(), kPixels, depths.data());
    decode_depths(describe(GL_DEPTH_COMPONENT, type.type), true, swapped(source, size).data(), kPixels,
                  from_swapped.data());
    for (size_t i = 0; i < kPixels; ++i) {
      const Real expected = component_value(type, read_element(&source[i * size], size, false));
      if (std::isnan(depths[i])) continue;  // the model takes it for 0
      ASSERT_EQ(depths[i], double(expected)) << std::hex << type.type << " pixel " << i;
      ASSERT_EQ(depths[i], from_swapped[i]);
    }
  }
}

TEST(PixelDecode, EveryFormatAndTypeToFloats) {
  for (const FormatRow& format : kFormats) {
    for (const TypeRow& type : kTypes) {
      const size_t size = size_t(type.bits) / 8, n = format.components.size();
      const Bytes source = random_elements(type, kPixels * n, 12);
      std::vector<float> rgba(kPixels * 4);
      decode_pixels(describe(format.format, type.type), false, source.data(), kPixels, rgba.data());
      for (size_t i = 0; i < kPixels; ++i) {
        std::vector<Real> values;
        for (size_t c = 0; c < n; ++c) {
          values.push_back(component_value(type, read_element(&source[(i * n + c) * size], size, false)));
        }
        const Rgba expected = expand(format.components, values);
        for (size_t c = 0; c < 4; ++c) {
          if (std::isnan(rgba[i * 4 + c])) continue;
          ASSERT_EQ(rgba[i * 4 + c], float(expected[c])) << format.components << std::hex << type.type;
        }
      }
    }
  }
}

// R, G, B, A of `count` pixels, with sums on both sides of 1.
std::vector<uint8_t> random_colors(size_t count) {
  std::mt19937 random(77);
  std::vector<uint8_t> rgba(count * 4);
  for (size_t i = 0; i < rgba.size(); ++i) rgba[i] = uint8_t(i / 4 % 2 ? random() & 0xFF : random() % 100);
  return rgba;
}

TEST(PixelEncode, EveryFormatAndTypeFromBytes) {
  const std::vector<uint8_t> rgba = random_colors(kPixels);
  for (const FormatRow& format : kFormats) {
    for (const TypeRow& type : kTypes) {
      const size_t size = size_t(type.bits) / 8, n = format.components.size();
      Bytes out(kPixels * n * size), out_swapped(out.size());
      const PixelFormat described = describe(format.format, type.type);
      encode_pixels(described, false, rgba.data(), kPixels, out.data());
      for (size_t i = 0; i < kPixels; ++i) {
        // Numerators over 255: no quotient has to be represented.
        for (size_t c = 0; c < n; ++c) {
          const Rgba over = {Real(rgba[i * 4]), Real(rgba[i * 4 + 1]), Real(rgba[i * 4 + 2]),
                             Real(rgba[i * 4 + 3])};
          const Real sum = std::min<Real>(over[0] + over[1] + over[2], 255);
          const Real numerator = format.components[c] == 'L' ? sum : picked(format.components[c], over);
          ASSERT_EQ(read_element(&out[(i * n + c) * size], size, false), element_of(type, numerator, 255))
              << format.components << " type " << std::hex << type.type << " pixel " << i;
        }
      }
      encode_pixels(described, true, rgba.data(), kPixels, out_swapped.data());
      EXPECT_EQ(out_swapped, swapped(out, size)) << format.components << " type " << std::hex << type.type;
    }
  }
}

TEST(PixelEncode, EveryPackedTypeFromBytes) {
  const std::vector<uint8_t> rgba = random_colors(kPixels);
  for (const PackedRow& type : kPackedTypes) {
    const bool three = type.widths.size() == 3;
    const std::string components = three ? "RGB" : "BGRA";
    const size_t size = size_t(packed_bits(type)) / 8;
    Bytes out(kPixels * size);
    encode_pixels(describe(three ? GL_RGB : GL_BGRA, type.type), true, rgba.data(), kPixels, out.data());
    for (size_t i = 0; i < kPixels; ++i) {
      const std::vector<Real> fields = unpack_word(type, read_element(&out[i * size], size, true));
      for (size_t c = 0; c < components.size(); ++c) {
        const int width = type.widths[type.reversed ? type.widths.size() - 1 - c : c];
        const Real source = Real(rgba[i * 4 + std::string("RGBA").find(components[c])]);
        const Real expected = round_half_up(source * power_of_two_less_one(width) / 255);
        ASSERT_EQ(round_half_up(fields[c] * power_of_two_less_one(width)), expected)
            << std::hex << type.type << " component " << c;
      }
    }
  }
}

TEST(PixelEncode, EveryFormatAndTypeFromFloats) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> around(-0.2f, 1.2f);
  std::vector<float> rgba(kPixels * 4);
  for (float& v : rgba) v = around(random);
  rgba[0] = std::numeric_limits<float>::quiet_NaN();
  for (const FormatRow& format : kFormats) {
    for (const TypeRow& type : kTypes) {
      const size_t size = size_t(type.bits) / 8, n = format.components.size();
      Bytes out(kPixels * n * size);
      encode_pixels(describe(format.format, type.type), false, rgba.data(), kPixels, out.data());
      for (size_t i = 0; i < kPixels * n; ++i) {
        Rgba color;
        for (size_t c = 0; c < 4; ++c) color[c] = clamp01(Real(rgba[i / n * 4 + c]));
        const char component = format.components[i % n];
        const uint64_t bits = read_element(&out[i * size], size, false);
        // The sum of luminance is clamped, its terms are not; a NaN in it is a NaN.
        Real sum = 0;
        for (size_t c = 0; c < 3; ++c) sum += Real(rgba[i / n * 4 + c]);
        const Real exact = component == 'L' ? clamp01(sum) : picked(component, color);
        // The sum of luminance is rounded to float, and 32-bit integers are finer than a double product.
        const Real tolerance = (component == 'L' ? std::ldexp(Real{1}, -23) : 0) + std::ldexp(Real{1}, -32);
        const Real step = type.is_float ? std::ldexp(Real{1}, -25) : 1 / power_of_two_less_one(type.bits);
        const Real half = type.is_signed && !type.is_float ? step : step / 2;
        const Real back = component_value(type, bits);
        ASSERT_LE(std::abs(back - exact), half + tolerance)
            << format.components << " type " << std::hex << type.type << " element " << i;
      }
    }
  }
}

TEST(PixelRoundTrip, EveryByteSurvivesEveryTypeThatCanHoldIt) {
  std::vector<uint8_t> rgba(256 * 4), back(256 * 4);
  for (size_t i = 0; i < 256; ++i) {
    rgba[4 * i] = uint8_t(i), rgba[4 * i + 1] = uint8_t(255 - i), rgba[4 * i + 2] = uint8_t(i * 7);
    rgba[4 * i + 3] = uint8_t(i ^ 0x55);
  }
  // GL_BYTE has 128 values for [0, 1].
  for (GLenum type : {GLenum{GL_UNSIGNED_BYTE}, GLenum{GL_UNSIGNED_SHORT}, GLenum{GL_SHORT},
                      GLenum{GL_UNSIGNED_INT}, GLenum{GL_INT}, GLenum{GL_FLOAT},
                      GLenum{GL_UNSIGNED_INT_8_8_8_8}, GLenum{GL_UNSIGNED_INT_8_8_8_8_REV}}) {
    for (GLenum format : {GLenum{GL_RGBA}, GLenum{GL_BGRA}}) {
      for (bool swap : {false, true}) {
        const PixelFormat described = describe(format, type);
        Bytes memory(256 * described.pixel_bytes);
        encode_pixels(described, swap, rgba.data(), 256, memory.data());
        decode_pixels(described, swap, memory.data(), 256, back.data());
        EXPECT_EQ(back, rgba) << std::hex << type << " " << format << (swap ? " swapped" : "");
      }
    }
  }
}

TEST(DepthEncode, EveryTypeIsRoundedOnce) {
  constexpr uint32_t kMax = 0xFFFFFF;
  std::vector<uint32_t> depth = {0, 1, 2, 3, kMax / 2, kMax / 2 + 1, kMax - 1, kMax};
  std::mt19937 random(9);
  while (depth.size() < 20000) depth.push_back(random() & kMax);
  for (const TypeRow& type : kTypes) {
    const size_t size = size_t(type.bits) / 8;
    Bytes out(depth.size() * size), out_swapped(out.size());
    const PixelFormat described = describe(GL_DEPTH_COMPONENT, type.type);
    encode_depth(described, false, depth.data(), depth.size(), out.data());
    for (size_t i = 0; i < depth.size(); ++i) {
      ASSERT_EQ(read_element(&out[i * size], size, false), element_of(type, depth[i], kMax))
          << "depth " << depth[i] << " type " << std::hex << type.type;
    }
    encode_depth(described, true, depth.data(), depth.size(), out_swapped.data());
    EXPECT_EQ(out_swapped, swapped(out, size));
  }
}

TEST(DescribePixels, RefusesWhatTheSpecRefuses) {
  PixelFormat out;
  EXPECT_EQ(describe_pixels(GL_RGBA8, GL_UNSIGNED_BYTE, out), GLenum{GL_INVALID_ENUM});
  EXPECT_EQ(describe_pixels(GL_RGBA, GL_DOUBLE, out), GLenum{GL_INVALID_ENUM});
  EXPECT_EQ(describe_pixels(GL_RGBA, GL_BITMAP, out), GLenum{GL_INVALID_ENUM});
  EXPECT_EQ(describe_pixels(GL_DEPTH_COMPONENT, GL_BITMAP, out), GLenum{GL_INVALID_ENUM});
  EXPECT_EQ(describe_pixels(GL_COLOR_INDEX, GL_BITMAP, out), GLenum{GL_NO_ERROR});
  EXPECT_EQ(describe_pixels(GL_STENCIL_INDEX, GL_BITMAP, out), GLenum{GL_NO_ERROR});
  for (const PackedRow& type : kPackedTypes) {
    const bool three = type.widths.size() == 3;
    EXPECT_EQ(describe_pixels(three ? GL_RGBA : GL_RGB, type.type, out), GLenum{GL_INVALID_OPERATION});
    EXPECT_EQ(describe_pixels(GL_BGR, type.type, out), GLenum{GL_INVALID_OPERATION});
    EXPECT_EQ(describe_pixels(GL_LUMINANCE, type.type, out), GLenum{GL_INVALID_OPERATION});
    EXPECT_EQ(describe_pixels(GL_DEPTH_COMPONENT, type.type, out), GLenum{GL_INVALID_OPERATION});
  }
}

}  // namespace
}  // namespace halfspace::state
