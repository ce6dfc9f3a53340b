// Every name the library exports: it is there, and says so when there is nothing behind it.
#include <dlfcn.h>

#include <fstream>
#include <set>
#include <sstream>

#include "tests/api/osmesa_context.h"

namespace halfspace::test {
namespace {

std::vector<std::string> exported_names() {
  std::ifstream file(HALFSPACE_EXPORTS);
  std::vector<std::string> names;
  for (std::string name; file >> name;) names.push_back(name);
  return names;
}

void* symbol(const std::string& name) { return dlsym(RTLD_DEFAULT, name.c_str()); }

void* proc_address(const std::string& name) {
  return reinterpret_cast<void*>(OSMesaGetProcAddress(name.c_str()));
}

std::vector<std::string> unimplemented_names() {
  std::vector<std::string> names;
  for (const std::string& name : exported_names()) {
    if (!proc_address(name)) names.push_back(name);
  }
  return names;
}

TEST(Exports, EveryNameIsThereAndGetProcAddressAgrees) {
  const std::vector<std::string> names = exported_names();
  ASSERT_GT(names.size(), 1000u);
  for (const std::string& name : names) {
    ASSERT_NE(symbol(name), nullptr) << name;
    if (proc_address(name)) {
      EXPECT_EQ(proc_address(name), symbol(name)) << name;
    }
  }
}

using UnimplementedTest = OsmesaTest;

TEST_F(UnimplementedTest, RecordsAnErrorAndSpeaksOnceAName) {
  const std::vector<std::string> names = unimplemented_names();
  std::multiset<std::string> said;
  testing::internal::CaptureStderr();
  for (int round = 0; round < 2; ++round) {
    for (const std::string& name : names) {
      ASSERT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)) << name;
      const auto function = reinterpret_cast<void* (*)()>(symbol(name));
      EXPECT_EQ(function(), nullptr) << name;
      ASSERT_EQ(glGetError(), static_cast<GLenum>(GL_INVALID_OPERATION)) << name;
    }
  }
  std::istringstream lines(testing::internal::GetCapturedStderr());
  for (std::string line; std::getline(lines, line);) said.insert(line);
  EXPECT_EQ(said.size(), names.size());
  for (const std::string& name : names) {
    EXPECT_EQ(said.count("halfspace: " + name + " is not implemented yet"), 1u) << name;
  }
}

TEST(Unimplemented, IsHarmlessWithoutAContext) {
  const std::vector<std::string> names = unimplemented_names();
  if (names.empty()) GTEST_SKIP() << "everything is implemented";
  testing::internal::CaptureStderr();
  EXPECT_EQ(reinterpret_cast<void* (*)()>(symbol(names[0]))(), nullptr);
  testing::internal::GetCapturedStderr();
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

}  // namespace
}  // namespace halfspace::test
