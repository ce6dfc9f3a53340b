// One component of a pixel: between its type in client memory and an unsigned normalised integer or a float.
// Everything is exact integer arithmetic where the source is an integer. For the pixel_*.cpp files.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "state/gl_types.h"

namespace halfspace::state {

inline constexpr uint64_t kByteMax = 0xFF;
inline constexpr uint64_t kDepthMax = 0xFFFFFF;

// 2^b - 1 of an integer type of b bits, signed or not.
template <std::integral T>
inline constexpr uint64_t kTypeMax = std::numeric_limits<std::make_unsigned_t<T>>::max();

inline float clamp_unit(float v) { return v > 0 ? (v < 1 ? v : 1.0f) : 0.0f; }  // NaN: 0

// round(v / from_max * to_max). Every from_max here is odd, so there are no halves.
constexpr uint64_t rescale(uint64_t v, uint64_t from_max, uint64_t to_max) {
  return (2 * v * to_max + from_max) / (2 * from_max);
}

template <class T>
uint8_t to_byte(T c) {
  if constexpr (std::floating_point<T>) {
    return uint8_t(double(clamp_unit(c)) * 255 + 0.5);
  } else if constexpr (std::unsigned_integral<T>) {
    return uint8_t(rescale(c, kTypeMax<T>, kByteMax));
  } else {
    return c < 0 ? uint8_t{0} : uint8_t(rescale(2 * uint64_t(c) + 1, kTypeMax<T>, kByteMax));
  }
}

// v / kMax in the type T. Signed: ((2^b - 1) f - 1) / 2 (table 4.7), rounded, halves up.
template <class T, uint64_t kMax>
T from_unorm(uint64_t v) {
  if constexpr (std::floating_point<T>) {
    return T(v) / T(kMax);  // both are exact floats (24 bits at most), so this is rounded once
  } else if constexpr (std::unsigned_integral<T>) {
    return T(rescale(v, kMax, kTypeMax<T>));
  } else {
    return T(kTypeMax<T> * v / (2 * kMax));
  }
}

// `unit` in [0, 1] in the type T.
template <class T>
T from_unit(double unit) {
  if constexpr (std::floating_point<T>) {
    return T(unit);
  } else if constexpr (std::unsigned_integral<T>) {
    return T(uint64_t(unit * double(kTypeMax<T>) + 0.5));
  } else {
    return T(int64_t(unit * double(kTypeMax<T>) * 0.5));  // floor((max * f - 1) / 2 + 1/2)
  }
}

template <class T>
T from_float(float f) {
  return from_unit<T>(double(clamp_unit(f)));
}

// What an element stands for (table 2.9), rounded to float once; floats as they are.
template <class T>
float to_component(T c) {
  if constexpr (std::floating_point<T>) {
    return c;
  } else if constexpr (std::unsigned_integral<T>) {
    return float(double(c) / double(kTypeMax<T>));
  } else {
    return float((2 * double(c) + 1) / double(kTypeMax<T>));
  }
}

template <size_t kBytes>
using UnsignedOf =
    std::conditional_t<kBytes == 1, uint8_t, std::conditional_t<kBytes == 2, uint16_t, uint32_t>>;

constexpr uint8_t swap_order(uint8_t v) { return v; }
constexpr uint16_t swap_order(uint16_t v) { return uint16_t(v << 8 | v >> 8); }
constexpr uint32_t swap_order(uint32_t v) {
  return v << 24 | (v & 0xFF00) << 8 | (v >> 8 & 0xFF00) | v >> 24;
}

// Client pointers may have any alignment.
template <class T>
T load_value(const std::byte* p, bool swap_bytes) {
  UnsignedOf<sizeof(T)> bits;
  std::memcpy(&bits, p, sizeof bits);
  return std::bit_cast<T>(swap_bytes ? swap_order(bits) : bits);
}

template <class T>
void store_value(std::byte* p, T value, bool swap_bytes) {
  auto bits = std::bit_cast<UnsignedOf<sizeof(T)>>(value);
  if (swap_bytes) bits = swap_order(bits);
  std::memcpy(p, &bits, sizeof bits);
}

// Calls visit(T{}) with the C++ type of an unpacked GL type.
template <class Visit>
void visit_type(GLenum type, Visit&& visit) {
  switch (type) {
    case GL_UNSIGNED_BYTE:
      return visit(uint8_t{});
    case GL_BYTE:
      return visit(int8_t{});
    case GL_UNSIGNED_SHORT:
      return visit(uint16_t{});
    case GL_SHORT:
      return visit(int16_t{});
    case GL_UNSIGNED_INT:
      return visit(uint32_t{});
    case GL_INT:
      return visit(int32_t{});
    case GL_FLOAT:
      return visit(float{});
    default:
      return;
  }
}

// Calls visit(T{}) with the unsigned type of a packed word.
template <class Visit>
void visit_word(size_t bytes, Visit&& visit) {
  switch (bytes) {
    case 1:
      return visit(uint8_t{});
    case 2:
      return visit(uint16_t{});
    default:
      return visit(uint32_t{});
  }
}

// Where the components of a packed type lie in its word, in the order of the format's name.
struct PackedLayout {
  GLenum type;
  uint8_t bytes, components;
  uint8_t shift[4], bits[4];
};
const PackedLayout* find_packed_layout(GLenum type);  // null: not a packed type

// Which of a pixel's numbers, in memory order, is what: 0..3 R, G, B, A; 4 luminance.
struct ComponentOrder {
  uint8_t count;
  uint8_t what[4];
};
inline constexpr uint8_t kLuminance = 4;
ComponentOrder component_order(GLenum format);  // count 0: not a colour format

}  // namespace halfspace::state
