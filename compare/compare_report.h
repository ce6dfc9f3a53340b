// The HTML report of `halfspace compare`.
#pragma once

#include <string>
#include <vector>

#include "compare/difference.h"
#include "compare/html.h"
#include "compare/pairing.h"

namespace halfspace::compare {

struct ComparedPair {
  PicturePair paths;
  Difference difference;
  std::vector<std::string> broken;  // limits
  std::string problem;              // why it could not be compared; then the rest is void
};

// Pixels around the worst one, drawn large.
constexpr int kCropSize = 16;

// Both pictures, the difference times `gain`, and the worst spot enlarged.
std::vector<Figure> difference_figures(const Image& a, const Image& b, const Difference& difference,
                                       double gain, const std::string& a_name, const std::string& b_name);

// Loads the pictures anew, one pair at a time.
std::string compare_report(const std::vector<ComparedPair>& pairs, double gain);

}  // namespace halfspace::compare
