#include "raster/device_options.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>

namespace halfspace::raster {

int thread_count(const DeviceOptions& options) {
  if (options.threads > 0) return std::min(options.threads, 256);
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const char* wish = std::getenv("HALFSPACE_THREADS");
  if (wish == nullptr || *wish == '\0') return cores;
  char* end = nullptr;
  const long n = std::strtol(wish, &end, 10);
  if (*end == '\0' && n >= 1 && n <= 256) return static_cast<int>(n);
  std::fprintf(stderr, "halfspace: HALFSPACE_THREADS=%s is not a number from 1 to 256; using %d\n", wish,
               cores);
  return cores;
}

bool fuses(const DeviceOptions& options) {
  const char* wish = std::getenv("HALFSPACE_FUSE");
  return options.fuse && (wish == nullptr || std::strcmp(wish, "0") != 0);
}

}  // namespace halfspace::raster
