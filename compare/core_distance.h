// How far apart two cores are.
#pragma once

namespace halfspace::compare {

// Nanoseconds that a cache line takes from one core to the other and back, the median of many. Cores that
// share a cache are some 50 apart, others 200 and more; a virtual machine's are the one now and the other a
// minute later.
double core_distance(int core, int other);

}  // namespace halfspace::compare
