// The oracle's pictures of a scene, drawn once and kept.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "compare/cost_scenes.h"

namespace halfspace::compare {

// The last truth file of `folder`. Throws std::runtime_error when there is none.
std::filesystem::path last_truth_file(const std::filesystem::path& folder);

// Of one scene, by paint. A picture of an earlier run is taken when the oracle and the program are still the
// same files.
class PaintedTruths {
 public:
  // `index`: of the group's scene. Throws what draw_scenes throws, and ImageError.
  PaintedTruths(const CostOptions& options, const SceneGroup& group, size_t index, const Progress& progress);

  // `pictures`: files by paint.
  TruthError error_of(const std::map<std::string, std::filesystem::path>& pictures) const;
  const std::string& renderer() const { return renderer_; }

 private:
  std::map<std::string, Truth> truths_;
  std::string renderer_;
};

}  // namespace halfspace::compare
