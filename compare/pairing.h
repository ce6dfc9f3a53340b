// Which pictures of two folders belong together.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace halfspace::compare {

struct PicturePair {
  std::string name;            // relative to the folders, without the extension
  std::filesystem::path a, b;  // one is empty when its folder lacks the picture
};

// Two files are one pair. In two folders (their sub-folders too) pictures belong together when their names
// agree up to the extension, so that scene_1.bmp meets scene_1.png; sorted by name. Files that are no
// pictures are passed over. Throws ImageError: a file and a folder, a missing one, two pictures of one name
// in one folder.
std::vector<PicturePair> pair_pictures(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace halfspace::compare
