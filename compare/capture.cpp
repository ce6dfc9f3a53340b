#include "compare/capture.h"

#include <algorithm>

#include "compare/image.h"

namespace halfspace::compare {

namespace fs = std::filesystem;

std::vector<fs::path> captured_frames(const fs::path& folder, const std::string& extension) {
  std::vector<fs::path> frames;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const fs::path& path = entry.path();
    if (path.extension() == "." + extension && path.stem().string().starts_with("frame_"))
      frames.push_back(path);
  }
  std::sort(frames.begin(), frames.end());
  return frames;
}

size_t convert_frames(const fs::path& folder, const std::string& format) {
  const std::vector<fs::path> frames = captured_frames(folder, "ppm");
  if (format == "ppm") return frames.size();
  for (const fs::path& frame : frames) {
    fs::path target = frame;
    save_image(load_image(frame), target.replace_extension(format));
    fs::remove(frame);
  }
  return frames.size();
}

}  // namespace halfspace::compare
