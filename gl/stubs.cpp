// Names the ABI has and we do not implement yet. Programs are linked against them, often BIND_NOW, without
// ever calling them; one that does call is told so, once a name. Compiled once a library, with its list in
// HALFSPACE_STUB_LIST.
//
// No GL header here: a stub has no parameters, and the caller's are left alone (the caller removes them in
// every C ABI that Linux has). The result is 0 in every integer type and a null pointer.
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "gl/unimplemented.h"

namespace {

enum StubIndex : uint32_t {
#define HALFSPACE_STUB(name) k_##name,
#define HALFSPACE_FLOAT_STUB(name) k_##name,
#include HALFSPACE_STUB_LIST
#undef HALFSPACE_STUB
#undef HALFSPACE_FLOAT_STUB
  kStubCount
};

// One after the other, each with its zero: a pointer a name would be a relocation a name when a program
// starts.
constexpr char kNames[] =
#define HALFSPACE_STUB(name) #name "\0"
#define HALFSPACE_FLOAT_STUB(name) #name "\0"
#include HALFSPACE_STUB_LIST
#undef HALFSPACE_STUB
#undef HALFSPACE_FLOAT_STUB
    ;

const char* stub_name(uint32_t index) {
  const char* name = kNames;
  while (index-- > 0) name += std::strlen(name) + 1;
  return name;
}

std::atomic<uint32_t> reported[kStubCount / 32 + 1];

__attribute__((cold, noinline)) void* unimplemented(uint32_t index) {
  const uint32_t bit = 1u << (index % 32);
  const bool first = (reported[index / 32].fetch_or(bit, std::memory_order_relaxed) & bit) == 0;
  halfspace::gl::call_of_unimplemented(stub_name(index), first);
  return nullptr;
}

[[maybe_unused]] __attribute__((cold, noinline)) double unimplemented_float(uint32_t index) {
  unimplemented(index);
  return 0;  // GLfloat and GLdouble alike: all bits of the register are 0
}

}  // namespace

#define HALFSPACE_STUB_FUNCTION extern "C" __attribute__((visibility("default"), cold))
#define HALFSPACE_STUB(name) \
  HALFSPACE_STUB_FUNCTION void* name() { return unimplemented(k_##name); }
#define HALFSPACE_FLOAT_STUB(name) \
  HALFSPACE_STUB_FUNCTION double name() { return unimplemented_float(k_##name); }
#include HALFSPACE_STUB_LIST
