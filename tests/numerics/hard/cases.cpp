#include "cases.h"

namespace halfspace::hard {

const std::vector<Case>& cases() {
  static const std::vector<Case> list = {
#define HARD_CASE(function, level, hazard, claim) {#function, #level, hazard, claim, function},
#include "cases.def"
#undef HARD_CASE
  };
  return list;
}

}  // namespace halfspace::hard
