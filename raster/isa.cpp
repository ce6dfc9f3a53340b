#include "raster/isa.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "raster/api/device.h"

namespace halfspace::raster {
namespace {

struct IsaLevel {
  Isa isa;
  std::string_view name;
};
constexpr IsaLevel kLevels[] = {
#if defined(__aarch64__)
    {Isa::neon, "neon"},
#else
    {Isa::scalar, "scalar"},
#if HALFSPACE_WITH_SSE4
    {Isa::sse4, "sse4"},
#endif
#if HALFSPACE_WITH_AVX2
    {Isa::avx2, "avx2"},
#endif
#if HALFSPACE_WITH_AVX512
    {Isa::avx512, "avx512"},
#endif
#endif
};

// What Highway's targets of these names are compiled to use; and avx512cd, which all that have the others have, too
// (pixel_batch.inl).
bool cpu_has(Isa isa) {
#if defined(__x86_64__)
  __builtin_cpu_init();
  const bool sse4 = __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("pclmul") &&
                    __builtin_cpu_supports("aes");
  const bool avx2 = sse4 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2") &&
                    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("fma");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512cd");
  switch (isa) {
    case Isa::scalar: return true;
    case Isa::sse4: return sse4;
    case Isa::avx2: return avx2;
    case Isa::avx512: return avx512;
    case Isa::neon: return false;
  }
  return false;
#else
  return isa == kLevels[0].isa;
#endif
}

const IsaLevel* find_level(std::string_view name) {
  for (const IsaLevel& level : kLevels)
    if (level.name == name) return &level;
  return nullptr;
}

Isa best_up_to(Isa limit) {
  Isa best = kLevels[0].isa;
  for (const IsaLevel& level : kLevels)
    if (level.isa <= limit && cpu_has(level.isa)) best = level.isa;
  return best;
}

Isa choose() {
  constexpr Isa kHighest = kLevels[std::size(kLevels) - 1].isa;
  const char* wish = std::getenv("HALFSPACE_ISA");
  if (wish == nullptr || *wish == '\0') return best_up_to(kHighest);
  if (const IsaLevel* level = find_level(wish)) return best_up_to(level->isa);
  std::fprintf(stderr, "halfspace: HALFSPACE_ISA=%s is not known; this build has: %s\n", wish,
               std::string(isa_available()).c_str());
  return best_up_to(kHighest);
}

// Kept out of chosen(), which draws call several times.
[[gnu::noinline, gnu::cold]] Isa choose_once() { return choose(); }

std::atomic<Isa>& chosen() {
  static std::atomic<Isa> isa{choose_once()};
  return isa;
}

}  // namespace

Isa current_isa() { return chosen().load(std::memory_order_relaxed); }

std::string_view isa_name() {
  for (const IsaLevel& level : kLevels)
    if (level.isa == current_isa()) return level.name;
  return "unknown";
}

std::string_view isa_available() {
  static const std::string names = [] {
    std::string all;
    for (const IsaLevel& level : kLevels) {
      if (!cpu_has(level.isa)) continue;
      if (!all.empty()) all += ' ';
      all += level.name;
    }
    return all;
  }();
  return names;
}

bool set_isa(std::string_view name) {
  const IsaLevel* level = find_level(name);
  if (level == nullptr || !cpu_has(level->isa)) return false;
  chosen().store(level->isa, std::memory_order_relaxed);
  return true;
}

}  // namespace halfspace::raster
