// glEnable, glDisable, glIsEnabled (spec 6.1.1): one table from the name to the bit.
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <span>

#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

inline constexpr size_t kMaxCapabilities = 64;

// Capabilities of GL 1.1 that have no effect yet: kept, so that glIsEnabled answers right, and reported once.
// One moves to its own group's struct when it comes to life.
struct CapabilityState {
  std::bitset<kMaxCapabilities> idle;  // indexed by row of the table
  std::bitset<kMaxCapabilities> reported;
};

struct Capability {
  GLenum name;
  const char* text;        // "GL_BLEND"
  bool* (*bit)(Context&);  // null: an idle one
  uint32_t dirty;          // DirtyBits of what is derived from it
};

std::span<const Capability> all_capabilities();
bool capability_enabled(const Context& context, const Capability& capability);

}  // namespace halfspace::state
