// Libraries that draw the benchmark's workloads in turns: each in a process of its own, bench/workloads.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/dialogue.h"
#include "compare/statistics.h"

namespace halfspace::compare {

class Contestant {
 public:
  // Loads `library` by that name or path. Throws StartError and NotFound.
  Contestant(const std::string& library, const std::vector<EnvironmentVariable>& environment,
             const std::vector<int>& cores);

  // bench/runner.h has the orders. Throws std::runtime_error when one fails.
  nlohmann::json order(const std::string& line);

 private:
  Dialogue dialogue_;
};

struct HalfspaceSetting {
  std::optional<std::string> folder{};  // of libOSMesa.so.8; the one that belongs to this command without
  int threads = 1;
  bool draft = false;
  std::string trace{};  // file for HALFSPACE_TRACE; none when empty
};
std::unique_ptr<Contestant> start_halfspace(const HalfspaceSetting& setting, const std::vector<int>& cores);

// `place`: a libOSMesa.so.8 of ours, the folder of one, or a build tree. Throws NotFound.
std::unique_ptr<Contestant> start_other_build(const std::string& place, bool draft,
                                              const std::vector<int>& cores);

// The system's OSMesa on one thread.
std::unique_ptr<Contestant> start_mesa(bool softpipe, const std::vector<int>& cores);

// What GL_RENDERER and GL_VERSION of an `open` say. Throws std::runtime_error when that is not who was asked
// for.
struct Drawer {
  std::string renderer, version;
};
Drawer require_halfspace(const nlohmann::json& opened);
Drawer require_mesa(const nlohmann::json& opened);

// Of a frame.
struct FrameTime {
  Summary cpu_ms, wall_ms;
};

struct Turns {
  FrameTime first, second;
  Summary cpu_ratio, wall_ratio;  // second's over first's, batch by batch
};

// Both have the same workload open. They draw batches of frames in turns, so that a machine that slows down
// slows both; each is first as often as second.
Turns take_turns(Contestant& first, Contestant& second, int rounds);

}  // namespace halfspace::compare
