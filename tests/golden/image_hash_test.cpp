// The bytes of the random scenes, across compilers, machines and time: golden/image_hashes.txt.
//
// The file holds a line a scene: name and FNV-1a of colour and depth at 200x200. It comes from this program's
// own output (`image_hash_test --bless`), blessed when the numerics tests, which compare with the oracle,
// pass. No difference is allowed: a hash that changes is a change of the picture and is to be explained in
// the commit that blesses it.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <map>

#include "tests/support/scenes.h"

namespace halfspace::test {
namespace {

const char* const kFile = HALFSPACE_GOLDEN_DIR "/image_hashes.txt";

TEST(Golden, ImageHashes) {
  std::ifstream file(kFile);
  ASSERT_TRUE(file) << kFile << " is missing; bless it with --bless";
  std::map<std::string, std::string> blessed;
  for (std::string name, value; file >> name >> value;) blessed[name] = value;
  EXPECT_EQ(scene_hashes(), blessed);
}

int bless() {
  std::ofstream file(kFile);
  for (const auto& [name, value] : scene_hashes()) file << name << " " << value << "\n";
  return file.flush() ? 0 : 1;
}

}  // namespace
}  // namespace halfspace::test

int main(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], "--bless") == 0) return halfspace::test::bless();
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
