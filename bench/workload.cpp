#include "bench/workload.h"

#include <stdexcept>

namespace halfspace::bench {

#define WORKLOAD(name, target, draft, what) Frame name(Screen screen);
#include "bench/workloads.def"
#undef WORKLOAD

const std::vector<Workload>& all_workloads() {
  static const std::vector<Workload> workloads{
#define WORKLOAD(name, target, draft, what) {#name, target, draft, what, name},
#include "bench/workloads.def"
#undef WORKLOAD
  };
  return workloads;
}

std::map<std::string, double> work_of(const std::string& workload) {
  std::map<std::string, double> work;
#define WORK(name, limit, amount) \
  if (workload == #name) work[limit] += amount;
#include "bench/work.def"
#undef WORK
  return work;
}

const Workload& workload_named(const std::string& name) {
  std::string known;
  for (const Workload& workload : all_workloads()) {
    if (workload.name == name) return workload;
    known += std::string(" ") + workload.name;
  }
  throw std::runtime_error("there is no workload " + name + "; there are:" + known);
}

}  // namespace halfspace::bench
