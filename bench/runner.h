// Runs workloads, and takes orders to do so.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "bench/clock.h"
#include "bench/workload.h"

namespace halfspace::bench {

nlohmann::json list_of_workloads();

// One workload in a context of its own.
class Run {
 public:
  using Prepare = std::function<Frame(Screen)>;
  Run(const Library& library, const Prepare& prepare, Screen screen);
  // Draws so many frames, and gives the time of all. Throws std::runtime_error when GL recorded an error.
  Times frames(int count);
  // What was resident more after the context was made than before.
  long context_kib() const { return context_kib_; }
  // The frame drawn last, as PPM. Throws std::runtime_error when it cannot be written.
  void save_picture(const std::filesystem::path& path) const;

 private:
  Screen screen_;
  long before_kib_;
  Context context_;
  long context_kib_;
  Frame frame_;
};

// A program that compares libraries starts this one once for each and lets them take turns. A line of `in` is
// an order, and is answered by a line of JSON; what failed, by {"error": "..."}. Until `in` ends.
//   list           answers workloads and scales
//   open NAME      a fresh context, the workload prepared; answers renderer, version
//   run COUNT      so many frames; answers cpu_ms and wall_ms, of all together
//   picture PATH   the last frame, as PPM
//   scale NAME AMOUNT   as open
//   empty          a fresh context in which nothing is drawn; its frame is a glFinish
//   memory         answers resident_kib, peak_kib since it was asked last, and unloaded_kib: before the
//   library came close
void serve(const Library& library, Screen screen, long unloaded_kib, std::istream& in, std::ostream& out);

}  // namespace halfspace::bench
