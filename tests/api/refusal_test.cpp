// Every command of OpenGL 1.1 records the error the specification names, and
// then changes nothing that can be asked for, nor what its arguments point at
// (spec 2.5).
#include <cstring>
#include <functional>
#include <set>

#include "tests/api/command_cases.h"
#include "tests/api/gl_snapshot.h"
#include "tests/api/osmesa_context.h"

namespace halfspace::test {
namespace {

struct Command {
  const char* name;
  int enums;
};

constexpr Command kCommands[] = {
#define GL_COMMAND(name, enums) {#name, enums},
#define GL_GET_NAME(name)
#include "tests/api/gl_commands.gen.def"
#undef GL_COMMAND
#undef GL_GET_NAME
};

constexpr const char* kGetNames[] = {
#define GL_COMMAND(name, enums)
#define GL_GET_NAME(name) #name,
#include "tests/api/gl_commands.gen.def"
#undef GL_COMMAND
#undef GL_GET_NAME
};

// Spec 2.6.3: what may stand between Begin and End.
bool is_allowed_inside(const std::string& command) {
  if (command == "glEnd" || command == "glArrayElement" || command == "glCallList" ||
      command == "glCallLists")
    return true;
  if (command.ends_with("Pointer") || command.ends_with("Mask") || command.ends_with("ColorMaterial"))
    return false;
  for (const char* family : {"glVertex", "glColor3", "glColor4", "glIndex", "glNormal3", "glTexCoord",
                             "glEdgeFlag", "glMaterial", "glEvalCoord", "glEvalPoint"}) {
    if (command.starts_with(family)) return true;
  }
  return false;
}

class RefusalTest : public ::testing::Test {
 protected:
  void TearDown() override { end_context(); }
  // With all buffers, so that nothing is refused for want of one.
  void start_context() {
    end_context();
    context_ = OSMesaCreateContextExt(OSMESA_RGBA, 24, 8, 16, nullptr);
    ASSERT_NE(context_, nullptr);
    ASSERT_TRUE(OSMesaMakeCurrent(context_, buffer_.data(), GL_UNSIGNED_BYTE, 8, 8));
    assert_halfspace();
  }
  void end_context() {
    if (context_) OSMesaDestroyContext(context_);
    context_ = nullptr;
  }

  OSMesaContext context_ = nullptr;
  std::vector<GLubyte> buffer_ = std::vector<GLubyte>(8 * 8 * 4);
};

// A command nobody has thought about here fails; so does one with an
// enumeration that is never wrong.
TEST_F(RefusalTest, EveryCommandIsHere) {
  std::map<std::string, int> valid, bad;
  for (const Case& c : all_cases()) ++(c.valid ? valid : bad)[c.command()];
  for (const Command& command : kCommands) {
    if (!is_allowed_inside(command.name)) {
      EXPECT_GT(valid[command.name], 0) << command.name << " is never called right";
    }
    EXPECT_GE(bad[command.name], command.enums) << command.name << ": an enumeration is never wrong";
  }
}

TEST_F(RefusalTest, EveryNameOfGetIsKnownToTheSnapshot) {
  std::set<std::string> known{"GL_LOGIC_OP"};  // another name for GL_INDEX_LOGIC_OP
  for (const StateRow& row : all_state_rows()) known.insert(row.text);
  for (const char* name : kGetNames) EXPECT_TRUE(known.contains(name)) << name;
  EXPECT_EQ(known.size(), std::size(kGetNames));
}

TEST_F(RefusalTest, RightCallsAreTaken) {
  for (const Case& c : all_cases()) {
    if (!c.valid) continue;
    start_context();
    Data data;
    c.setup(data);
    c.call(data);
    // Begin has to end before anything can be asked.
    if (c.command() == "glBegin") glEnd();
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)) << c.text;
  }
}

TEST_F(RefusalTest, WrongCallsChangeNothing) {
  for (const Case& c : all_cases()) {
    if (c.valid) continue;
    start_context();
    Data data;
    c.setup(data);
    ASSERT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)) << c.text;
    const GlSnapshot before = take_gl_snapshot();
    ASSERT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)) << c.text;
    Data copy;
    std::memcpy(&copy, &data, sizeof data);
    c.call(data);
    EXPECT_EQ(glGetError(), c.error) << c.text;
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)) << c.text;
    EXPECT_EQ(std::memcmp(&copy, &data, sizeof data), 0) << c.text << " wrote through a pointer";
    EXPECT_EQ(differences(before, take_gl_snapshot()), "") << c.text;
  }
}

TEST_F(RefusalTest, BetweenBeginAndEnd) {
  for (const Case& c : all_cases()) {
    if (!c.valid || is_allowed_inside(c.command())) continue;
    start_context();
    Data data;
    // Between NewList and EndList what is wrong is found out when the list is
    // called.
    if (c.command() != "glEndList") c.setup(data);
    ASSERT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)) << c.text;
    const GlSnapshot before = take_gl_snapshot();
    Data copy;
    std::memcpy(&copy, &data, sizeof data);
    glBegin(GL_POINTS);
    c.call(data);
    glEnd();
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_INVALID_OPERATION)) << c.text;
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)) << c.text;
    EXPECT_EQ(std::memcmp(&copy, &data, sizeof data), 0) << c.text << " wrote through a pointer";
    EXPECT_EQ(differences(before, take_gl_snapshot()), "") << c.text;
  }
}

}  // namespace
}  // namespace halfspace::test
