// The lighting kernel's power against MPFR, and against itself on every instruction set.
#include <gtest/gtest.h>

#include <boost/multiprecision/mpfr.hpp>
#include <cmath>
#include <cstring>
#include <iostream>
#include <vector>

#include "raster/vertex/lighting.h"
#include "tests/support/canvas.h"
#include "tests/support/random.h"

namespace halfspace::test {
namespace {

using Exact = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<40>>;

struct Cases {
  std::vector<float> x, s;
  void add(float base, float exponent) { x.push_back(base), s.push_back(exponent); }
  std::vector<float> computed(raster::Level level = raster::Level::standard) const {
    std::vector<float> out(x.size());
    raster::power(x.data(), s.data(), out.data(), x.size(), level);
    return out;
  }
};

// Cosines, most of them near 1, where large exponents leave something; exponents whole, small and any.
Cases cases(size_t count) {
  Cases result;
  Random random(11);
  for (size_t i = 0; i < count; ++i) {
    const float u = random.real(0, 1);
    const float x = i % 4 == 0 ? u : i % 4 == 1 ? 1 - u * u * u * u : i % 4 == 2 ? 1 - u * 1e-3f : u * 1.5f;
    const float v = random.real(0, 128);
    const float s = i % 3 == 0 ? float(int(v)) : i % 3 == 1 ? v : v / 128;
    result.add(x, s);
  }
  return result;
}

TEST(Power, RelativeErrorIsAtMostTenToTheMinusFive) {
  const Cases all = cases(long_tests() ? 2000000 : 100000);
  const std::vector<float> out = all.computed();
  double worst = 0;
  for (size_t i = 0; i < out.size(); ++i) {
    const Exact truth = pow(Exact(all.x[i]), Exact(all.s[i]));
    if (truth < std::ldexp(1.0, -125) || truth > std::ldexp(1.0, 64)) continue;
    const double error = abs((Exact(out[i]) - truth) / truth).convert_to<double>();
    worst = std::max(worst, error);
    ASSERT_LE(error, 1e-5) << all.x[i] << " ^ " << all.s[i];
  }
  std::cout << "largest relative error " << worst << "\n";
}

TEST(Power, DraftIsWithinAThousandthAndExactWithinAnUlp) {
  const Cases all = cases(long_tests() ? 500000 : 50000);
  for (const auto& [level, most] :
       {std::pair(raster::Level::draft, 1e-3), {raster::Level::exact, 0x1p-24 + 1e-12}}) {
    const std::vector<float> out = all.computed(level);
    double worst = 0;
    for (size_t i = 0; i < out.size(); ++i) {
      const Exact truth = pow(Exact(all.x[i]), Exact(all.s[i]));
      if (truth < std::ldexp(1.0, -125) || truth > std::ldexp(1.0, 64)) continue;
      worst = std::max(worst, abs((Exact(out[i]) - truth) / truth).convert_to<double>());
    }
    EXPECT_LE(worst, most) << int(level);
    EXPECT_GT(worst, most / 20) << int(level);
  }
}

TEST(Power, EdgesAreDefined) {
  Cases all;
  const float inf = INFINITY, nan = NAN;
  all.add(0, 0), all.add(0, 1), all.add(0, 128), all.add(1, 0), all.add(1, 128), all.add(0.5f, 0);
  all.add(0.25f, 2), all.add(1e-30f, 128), all.add(2, 128), all.add(inf, 1), all.add(nan, 1), all.add(nan, 0);
  all.add(0.5f, 125), all.add(2, 64);
  const float big = 18446744073709551616.0f;
  const std::vector<float> expected{1,  0, 0, 1, 1, 1, 0.0625f, 0, big, big, 0, 1, std::ldexp(1.0f, -125),
                                    big};
  EXPECT_EQ(all.computed(), expected);
}

TEST(Power, EveryInstructionSetAgrees) {
  const Cases all = cases(50000);
  const auto reference = [&] {
    const IsaScope scope("scalar");
    return all.computed();
  }();
  for (const std::string& isa : isa_levels()) {
    const IsaScope scope(isa);
    const std::vector<float> out = all.computed();
    EXPECT_EQ(std::memcmp(out.data(), reference.data(), out.size() * sizeof(float)), 0) << isa;
  }
}

}  // namespace
}  // namespace halfspace::test
