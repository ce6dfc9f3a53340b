#include "compare/statistics_json.h"

namespace halfspace::compare {

nlohmann::json to_json(const Summary& summary) {
  return {{"median", summary.median},
          {"lowest", summary.lowest},
          {"highest", summary.highest},
          {"spread", summary.spread},
          {"count", summary.count}};
}

}  // namespace halfspace::compare
