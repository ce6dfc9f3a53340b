#include "compare/pairing.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <string_view>

#include "compare/image.h"

namespace halfspace::compare {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 14> kPictureExtensions{".png",  ".bmp", ".ppm",  ".pgm", ".pnm",
                                                              ".pam",  ".tif", ".tiff", ".tga", ".jpg",
                                                              ".jpeg", ".exr", ".hdr",  ".webp"};

bool is_picture(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(kPictureExtensions.begin(), kPictureExtensions.end(), extension) !=
         kPictureExtensions.end();
}

std::map<std::string, fs::path> pictures_in(const fs::path& folder) {
  std::map<std::string, fs::path> pictures;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || !is_picture(entry.path())) continue;
    const std::string name = fs::relative(entry.path(), folder).replace_extension().string();
    const auto [place, fresh] = pictures.emplace(name, entry.path());
    if (!fresh)
      throw ImageError(folder.string() + ": holds " + place->second.filename().string() + " and " +
                       entry.path().filename().string() +
                       "; which one is meant? Remove one or name the file");
  }
  return pictures;
}

std::vector<PicturePair> pair_folders(const fs::path& a, const fs::path& b) {
  std::map<std::string, PicturePair> pairs;
  for (const auto& [name, path] : pictures_in(a)) pairs[name].a = path;
  for (const auto& [name, path] : pictures_in(b)) pairs[name].b = path;
  if (pairs.empty()) throw ImageError("no pictures in " + a.string() + " and " + b.string());
  std::vector<PicturePair> list;
  for (auto& [name, pair] : pairs) list.push_back({name, pair.a, pair.b});
  return list;
}

}  // namespace

std::vector<PicturePair> pair_pictures(const fs::path& a, const fs::path& b) {
  for (const fs::path& path : {a, b}) {
    std::error_code error;
    if (!fs::exists(path, error)) throw ImageError(path.string() + ": no such file or folder");
  }
  const bool a_folder = fs::is_directory(a), b_folder = fs::is_directory(b);
  if (a_folder != b_folder)
    throw ImageError((a_folder ? a : b).string() + " is a folder and " + (a_folder ? b : a).string() +
                     " is not; compare two files or two folders");
  if (a_folder) return pair_folders(a, b);
  return {{a.stem().string(), a, b}};
}

}  // namespace halfspace::compare
