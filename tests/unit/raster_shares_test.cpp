// raster/shares.h: nothing is left out, nothing is done twice, no share is empty.
#include <gtest/gtest.h>

#include <cstdint>

#include "raster/shares.h"

namespace {

using halfspace::raster::even_shares;
using halfspace::raster::Shares;

void expect_whole(uint32_t total, uint32_t wanted, uint32_t multiple) {
  SCOPED_TRACE(testing::Message() << total << " in " << wanted << " shares of multiples of " << multiple);
  const Shares shares = even_shares(total, wanted, multiple);
  ASSERT_LE(shares.count, wanted);
  ASSERT_EQ(shares.each % multiple, 0u);
  uint32_t next = 0;
  for (uint32_t i = 0; i < shares.count; ++i) {
    ASSERT_EQ(shares.first(i), next);
    ASSERT_GT(shares.size(i), 0u) << "share " << i;
    ASSERT_LE(shares.size(i), shares.each);
    next += shares.size(i);
  }
  ASSERT_EQ(next, total);
}

TEST(Shares, CoverWhatIsShared) {
  for (const uint32_t multiple : {1u, 16u})
    for (const uint32_t wanted : {1u, 2u, 3u, 7u, 64u})
      for (uint32_t total = 0; total < 300; ++total) expect_whole(total, wanted, multiple);
}

// A strip that is not taken in parts: its vertices by 2048, in whole vectors. With 130 such tasks and a
// vector more for each than it needs, the last one began where the vertices end.
TEST(Shares, NoneIsEmptyWhereThereAreMany) {
  for (uint32_t wanted = 1; wanted < 400; ++wanted)
    for (const uint32_t less : {0u, 1u, 15u, 16u, 2047u}) expect_whole(2048 * wanted - less, wanted, 16);
}

}  // namespace
