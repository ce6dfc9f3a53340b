// The numbers the oracle computes with. Everything a primitive is made of (positions, planes) has 113 bits,
// so that what cancels in a sliver or at the horizon leaves more than a double has; colours, texture and
// light have 64.
#pragma once

#include <cmath>
#include <cstdint>

namespace halfspace::oracle {

using Real = long double;
#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 Wide;
#else
using Wide = long double;  // IEEE's 128 bits on other processors
#endif

template <class T>
constexpr Real real(T v) {
  return static_cast<Real>(v);
}
template <class T>
constexpr Wide wide(T v) {
  return static_cast<Wide>(v);
}

constexpr Wide magnitude(Wide v) { return v < 0 ? -v : v; }
constexpr bool is_finite(Wide v) { return v - v == 0; }

// |v| < 2^62.
constexpr int64_t floor_of(Wide v) {
  const auto whole = static_cast<int64_t>(v);
  return wide(whole) > v ? whole - 1 : whole;
}

// NaN becomes the lower bound.
template <class T>
constexpr T held(T v, T low, T high) {
  return v > low ? (v < high ? v : high) : low;
}

}  // namespace halfspace::oracle
