// Text by a format of printf.
#pragma once

#include <cstdio>
#include <string>

namespace halfspace::compare {

// A line of at most 599 bytes; what is longer is cut off.
template <typename... Values>
std::string formatted(const char* format, Values... values) {
  char text[600];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

}  // namespace halfspace::compare
