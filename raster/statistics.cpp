#include "raster/statistics.h"

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace halfspace::raster {
namespace {

// The same stage's counts in an earlier list, or zeros.
StageCount count_of(const DeviceStatistics& statistics, std::string_view name) {
  for (const StageCount& stage : statistics.stages)
    if (stage.name == name) return stage;
  return {name, 0, 0};
}

void print_vertices(const DeviceStatistics& before, const DeviceStatistics& now, size_t pixels) {
  std::fprintf(stderr,
               "halfspace: %s: %" PRIu64 "%s, %" PRIu64 " vertices in %.3f ms (%" PRIu64
               " lit, %" PRIu64 " with generated coordinates), %" PRIu64 " triangles (%" PRIu64
               " culled, %" PRIu64 " clipped), %" PRIu64 " fragments (%" PRIu64 " in double)",
               pixels != 0 ? "picture" : "draw", pixels != 0 ? now.draws - before.draws : now.draws,
               pixels != 0 ? " draws" : "", now.vertices - before.vertices,
               static_cast<double>(now.vertex_nanoseconds - before.vertex_nanoseconds) * 1e-6,
               now.lit_vertices - before.lit_vertices, now.generated_vertices - before.generated_vertices,
               now.triangles - before.triangles, now.culled - before.culled, now.clipped - before.clipped,
               now.fragments - before.fragments, now.double_fragments - before.double_fragments);
  if (pixels != 0)
    std::fprintf(stderr, ", overdraw %.2f",
                 static_cast<double>(now.fragments - before.fragments) / static_cast<double>(pixels));
  std::fputc('\n', stderr);
}

}  // namespace

Report report_from_environment() {
  const char* wish = std::getenv("HALFSPACE_STATS");
  if (wish == nullptr || *wish == '\0' || std::string_view(wish) == "0") return Report::nothing;
  return std::string_view(wish) == "draws" ? Report::draws : Report::pictures;
}

void print_statistics(const DeviceStatistics& before, const DeviceStatistics& now, size_t pixels) {
  print_vertices(before, now, pixels);
  for (const StageCount& stage : now.stages) {
    const StageCount earlier = count_of(before, stage.name);
    const uint64_t fragments = stage.fragments - earlier.fragments;
    if (fragments == 0) continue;
    const auto time = static_cast<double>(stage.nanoseconds - earlier.nanoseconds);
    std::fprintf(stderr, "  %-28.*s %10" PRIu64 " fragments %9.3f ms %7.2f ns each\n",
                 static_cast<int>(stage.name.size()), stage.name.data(), fragments, time * 1e-6,
                 time / static_cast<double>(fragments));
  }
}

}  // namespace halfspace::raster
