#include "gl/capture.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <vector>

namespace halfspace::gl {
namespace {

const char* capture_directory() {
  static const char* const directory = [] {
    const char* value = std::getenv("HALFSPACE_CAPTURE");
    return value && *value ? value : nullptr;
  }();
  return directory;
}

void report_failure(const std::string& path, const char* reason) {
  static std::atomic<bool> reported{false};
  if (reported.exchange(true)) return;
  std::fprintf(stderr,
               "halfspace: cannot write the frame %s: %s. HALFSPACE_CAPTURE must name an existing directory "
               "with room in it that this program may write to.\n",
               path.c_str(), reason);
}

bool write_ppm(std::FILE* file, const uint8_t* rgba, int width, int height) {
  if (std::fprintf(file, "P6\n%d %d\n255\n", width, height) < 0) return false;
  std::vector<uint8_t> row(size_t(width) * 3);
  for (int y = height - 1; y >= 0; --y) {  // PPM begins at the top
    const uint8_t* source = rgba + size_t(y) * size_t(width) * 4;
    for (size_t x = 0; x < size_t(width); ++x) std::memcpy(&row[x * 3], source + x * 4, 3);
    if (std::fwrite(row.data(), 1, row.size(), file) != row.size()) return false;
  }
  return true;
}

}  // namespace

bool capture_enabled() { return capture_directory() != nullptr; }

void capture_frame(const uint8_t* rgba, int width, int height) try {
  static std::atomic<unsigned> next_frame{0};
  if (!capture_enabled()) return;
  char name[32];
  std::snprintf(name, sizeof name, "/frame_%05u.ppm", next_frame.fetch_add(1));
  const std::string path = capture_directory() + std::string(name);
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file) return report_failure(path, std::strerror(errno));
  const bool written = write_ppm(file, rgba, width, height);
  const int write_error = errno;
  if (std::fclose(file) != 0 || !written) report_failure(path, std::strerror(written ? errno : write_error));
} catch (const std::bad_alloc&) {
  report_failure("(any)", "out of memory");
}

}  // namespace halfspace::gl
