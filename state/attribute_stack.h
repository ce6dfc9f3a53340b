// Attribute stacks, server and client (spec 6.1.14), and copying attributes from context to context.
#pragma once

#include <memory>
#include <vector>

#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

inline constexpr size_t kMaxAttributeDepth = 16, kMaxClientAttributeDepth = 16;

struct SavedAttributes;        // one push of server state
struct SavedClientAttributes;  // one push of client state

struct AttributeStackState {
  AttributeStackState();
  ~AttributeStackState();
  // Levels are kept when they are popped, so that the steady state allocates nothing.
  std::vector<std::unique_ptr<SavedAttributes>> server;
  std::vector<std::unique_ptr<SavedClientAttributes>> client;
  size_t server_depth = 0, client_depth = 0;
};

// glXCopyContext: the groups of `mask` (as glPushAttrib takes them) of one context go to another. What only
// the visual of `from` has, and texture objects whose names `to` does not know, stay behind.
void copy_attributes(const Context& from, Context& to, GLbitfield mask);

}  // namespace halfspace::state
