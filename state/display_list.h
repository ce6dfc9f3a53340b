// Display lists (spec 5.4): their names, and what is known of the list being compiled.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "state/gl_types.h"
#include "state/list_compiler.h"
#include "state/list_memory.h"

namespace halfspace::state {

struct Context;

inline constexpr int kMaxListNesting = 64;

// A step of a list; what it needs lies behind it.
struct ListNode {
  void (*play)(Context& context, const ListNode& node);
  ListNode* next = nullptr;
};

// Once compiled it never changes, so that contexts which share can play it at the same time.
struct DisplayList {
  ListMemory memory;
  ListNode* first = nullptr;
  ListNode** tail = &first;  // where the next step is hooked in

  DisplayList() = default;
  DisplayList(const DisplayList&) = delete;
  DisplayList& operator=(const DisplayList&) = delete;
};

// The lists that contexts made with `share` have in common. A list that is being played stays alive.
struct ListNamespace {
  std::mutex mutex;
  std::map<GLuint, std::shared_ptr<const DisplayList>> lists;
};

// The group of GL_LIST_BIT.
struct ListState {
  GLuint base = 0;
};

// For batches in which some vertices take the current values; kept so that the steady state allocates
// nothing.
struct ListScratch {
  std::vector<float> color, normal, tex_coord;
  std::vector<uint8_t> edge_flags;
};

struct ListMachine {
  // `share`: whose lists to use too, or null.
  explicit ListMachine(const ListMachine* share = nullptr)
      : names(share != nullptr ? share->names : std::make_shared<ListNamespace>()) {}

  std::shared_ptr<ListNamespace> names;
  int nesting = 0;  // of the list being played, at most kMaxListNesting
  ListScratch scratch;
  ListCompiler compiler;
};

}  // namespace halfspace::state
