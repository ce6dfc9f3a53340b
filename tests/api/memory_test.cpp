// Out of memory at any allocation of any command: GL_OUT_OF_MEMORY, and the
// state is as it was (spec 2.5). The entry points are compiled into this
// program, so that its operator new is theirs.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "state/context.h"
#include "tests/api/command_cases.h"
#include "tests/api/gl_snapshot.h"
#include "tests/support/failing_new.h"
#include "tests/unit/state_fixture.h"

namespace halfspace::test {
namespace {

state::VisualConfig everything() {
  state::VisualConfig config;
  config.stencil_bits = 8;
  config.accum_bits = 16;
  return config;
}

class Session {
 public:
  Session() : drawable_(everything(), 8, 8), context_(everything(), nullptr) {
    state::make_current(&context_, &drawable_);
  }
  ~Session() { state::make_current(nullptr, nullptr); }

 private:
  state::MemoryDrawable drawable_;
  state::Context context_;
};

// Runs `c` with its allocation number `n` failing; false: it does not make so
// many.
bool fails_at(const Case& c, int n) {
  const Session session;
  Data data;
  c.setup(data);
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)) << c.text;
  const GlSnapshot before = take_gl_snapshot();
  allocation_failed = false;
  allocations_left = n;
  c.call(data);
  allocations_left = -1;
  if (!allocation_failed) {
    if (c.command() == "glBegin") glEnd();
    return false;
  }
  const GLenum error = glGetError();
  EXPECT_EQ(error, static_cast<GLenum>(GL_OUT_OF_MEMORY)) << c.text << ", allocation " << n;
  if (c.command() == "glBegin" && error == GL_NO_ERROR) glEnd();
  GlSnapshot after = take_gl_snapshot();
  // A list that cannot be kept is over all the same; the one of that name before it stays.
  if (c.command() == "glEndList")
    after["GL_LIST_INDEX"] = before.at("GL_LIST_INDEX"), after["GL_LIST_MODE"] = before.at("GL_LIST_MODE");
  EXPECT_EQ(differences(before, after), "") << c.text << ", allocation " << n;
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)) << c.text << ", allocation " << n;
  return true;
}

TEST(MemoryTest, EveryCommandStandsIt) {
  setenv("HALFSPACE_THREADS", "1", 1);
  int failed = 0;
  for (const Case& c : all_cases()) {
    if (!c.valid) continue;
    int n = 0;
    while (n < 1000 && fails_at(c, n)) ++n;
    EXPECT_LT(n, 1000) << c.text;
    failed += n;
  }
  EXPECT_GT(failed, 50);  // commands that allocate are among them
}

}  // namespace
}  // namespace halfspace::test
