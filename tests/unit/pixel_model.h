// What the specification says about pixels in client memory, written down once more: slowly, in long double,
// byte by byte, and without a line of state/pixel_*.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "state/gl_types.h"

namespace pixel_model {

using Real = long double;
using Rgba = std::array<Real, 4>;
using Bytes = std::vector<std::byte>;

struct FormatRow {
  GLenum format;
  std::string components;  // of RGBAL, in memory order
};
// Spec tables 3.6 (1.1) and 3.6 (1.2, for BGR and BGRA).
inline const std::vector<FormatRow> kFormats = {
    {GL_RED, "R"},     {GL_GREEN, "G"}, {GL_BLUE, "B"},    {GL_ALPHA, "A"},     {GL_RGB, "RGB"},
    {GL_RGBA, "RGBA"}, {GL_BGR, "BGR"}, {GL_BGRA, "BGRA"}, {GL_LUMINANCE, "L"}, {GL_LUMINANCE_ALPHA, "LA"},
};

struct TypeRow {
  GLenum type;
  int bits;
  bool is_signed;
  bool is_float = false;
};
inline const std::vector<TypeRow> kTypes = {
    {GL_UNSIGNED_BYTE, 8, false}, {GL_BYTE, 8, true}, {GL_UNSIGNED_SHORT, 16, false}, {GL_SHORT, 16, true},
    {GL_UNSIGNED_INT, 32, false}, {GL_INT, 32, true}, {GL_FLOAT, 32, true, true},
};

struct PackedRow {
  GLenum type;
  std::vector<int> widths;  // as in the name, from the highest bits down
  bool reversed;            // the first component is the last width
};
inline const std::vector<PackedRow> kPackedTypes = {
    {GL_UNSIGNED_BYTE_3_3_2, {3, 3, 2}, false},
    {GL_UNSIGNED_BYTE_2_3_3_REV, {2, 3, 3}, true},
    {GL_UNSIGNED_SHORT_5_6_5, {5, 6, 5}, false},
    {GL_UNSIGNED_SHORT_5_6_5_REV, {5, 6, 5}, true},
    {GL_UNSIGNED_SHORT_4_4_4_4, {4, 4, 4, 4}, false},
    {GL_UNSIGNED_SHORT_4_4_4_4_REV, {4, 4, 4, 4}, true},
    {GL_UNSIGNED_SHORT_5_5_5_1, {5, 5, 5, 1}, false},
    {GL_UNSIGNED_SHORT_1_5_5_5_REV, {1, 5, 5, 5}, true},
    {GL_UNSIGNED_INT_8_8_8_8, {8, 8, 8, 8}, false},
    {GL_UNSIGNED_INT_8_8_8_8_REV, {8, 8, 8, 8}, true},
    {GL_UNSIGNED_INT_10_10_10_2, {10, 10, 10, 2}, false},
    {GL_UNSIGNED_INT_2_10_10_10_REV, {2, 10, 10, 10}, true},
};

inline Real power_of_two_less_one(int bits) { return std::ldexp(Real{1}, bits) - 1; }
inline Real clamp01(Real v) { return v >= 0 ? (v <= 1 ? v : 1) : 0; }
inline Real round_half_up(Real v) { return std::floor(v + Real(0.5)); }

// An element of `size` bytes as a number, in the machine's byte order or, swapped, in the other one.
inline uint64_t read_element(const std::byte* p, size_t size, bool swapped) {
  const bool low_first = (std::endian::native == std::endian::little) != swapped;
  uint64_t v = 0;
  for (size_t i = 0; i < size; ++i) v = v * 256 + std::to_integer<uint64_t>(p[low_first ? size - 1 - i : i]);
  return v;
}

// Table 2.9: what the element means.
inline Real component_value(const TypeRow& type, uint64_t bits) {
  if (type.is_float) {
    const float f = std::bit_cast<float>(uint32_t(bits));
    return std::isnan(f) ? 0 : Real(f);
  }
  const Real max = power_of_two_less_one(type.bits);
  if (!type.is_signed) return Real(bits) / max;
  const Real half = std::ldexp(Real{1}, type.bits - 1);
  const Real c = Real(bits) >= half ? Real(bits) - 2 * half : Real(bits);
  return (2 * c + 1) / max;
}

// Spec 3.6.4, "Conversion to RGB" and "Final expansion to RGBA".
inline Rgba expand(const std::string& components, const std::vector<Real>& values) {
  Rgba out = {0, 0, 0, 1};
  for (size_t i = 0; i < components.size(); ++i) {
    switch (components[i]) {
      case 'R':
        out[0] = values[i];
        break;
      case 'G':
        out[1] = values[i];
        break;
      case 'B':
        out[2] = values[i];
        break;
      case 'A':
        out[3] = values[i];
        break;
      default:
        out[0] = out[1] = out[2] = values[i];
    }
  }
  return out;
}

inline std::vector<Real> unpack_word(const PackedRow& type, uint64_t word) {
  std::vector<Real> values;
  int low = 0;
  for (auto width = type.widths.rbegin(); width != type.widths.rend(); ++width) {
    const uint64_t field = word >> low & ((uint64_t{1} << *width) - 1);
    values.insert(type.reversed ? values.end() : values.begin(), Real(field) / power_of_two_less_one(*width));
    low += *width;
  }
  return values;
}

inline int packed_bits(const PackedRow& type) {
  int bits = 0;
  for (int width : type.widths) bits += width;
  return bits;
}

// Spec 4.3.2: what component `c` of a read pixel is, R, G, B, A in [0, 1] given.
inline Real picked(char c, const Rgba& rgba) {
  switch (c) {
    case 'R':
      return rgba[0];
    case 'G':
      return rgba[1];
    case 'B':
      return rgba[2];
    case 'A':
      return rgba[3];
    default:
      return clamp01(rgba[0] + rgba[1] + rgba[2]);
  }
}

// Table 4.7 applied to numerator / denominator, so that no quotient is rounded before it has to be. Two's
// complement.
inline uint64_t element_of(const TypeRow& type, Real numerator, Real denominator) {
  if (type.is_float) return std::bit_cast<uint32_t>(float(numerator / denominator));
  const Real scaled = power_of_two_less_one(type.bits) * numerator / denominator;
  const Real v = type.is_signed ? round_half_up((scaled - 1) / 2) : round_half_up(scaled);
  return uint64_t(int64_t(v)) & uint64_t(power_of_two_less_one(type.bits));
}

}  // namespace pixel_model
