#include "tests/oracle/truth_file.h"

#include <bit>
#include <cstdio>
#include <cstring>
#include <fstream>

namespace halfspace::oracle {
namespace {

static_assert(std::endian::native == std::endian::little);

template <class T>
void append(std::string& out, const T& value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  out.append(bytes, sizeof(T));
}

std::string path_of(const std::string& directory, unsigned frame, const char* suffix) {
  char name[40];
  std::snprintf(name, sizeof name, "/frame_%05u.%s", frame, suffix);
  return directory + name;
}

std::string header(const char* kind, const Target& target) {
  char line[80];
  std::snprintf(line, sizeof line, "halfspace-%s 1 %d %d\n", kind, target.width, target.height);
  return line;
}

bool save(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  return !file.fail();
}

}  // namespace

bool write_truth(const Target& target, raster::ColorPlane plane, const std::string& directory,
                 unsigned frame) {
  std::string truth = header("truth", target), bounds = header("bounds", target);
  const std::vector<ColorPixel>& color = target.color[static_cast<size_t>(place_of_plane(plane))];
  for (size_t i = 0; i < target.pixels(); ++i) {
    append(truth, color[i].level);
    append(truth, target.owner[i].primitive);
    append(truth, target.owner[i].draw);
    append(truth, target.depth[i].exact);
    append(bounds, color[i].low);
    append(bounds, color[i].high);
    append(bounds, static_cast<uint8_t>(target.owner[i].doubtful));
  }
  return save(path_of(directory, frame, "truth"), truth) && save(path_of(directory, frame, "bounds"), bounds);
}

}  // namespace halfspace::oracle
