#include "raster/surface/rows.h"

#include "raster/isa.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/surface/rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace halfspace::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void CopyBand(const TileBand& band, const PixelRows& out) {
  const hn::CappedTag<uint32_t, kBlockSize> d;
  for (int row = 0; row < kBlockSize; ++row) {
    uint32_t* to = out.first + row * out.step;
    for (int b = 0; b < 8; ++b, to += kBlockSize) {
      const uint32_t* from = band.block[b] + row * band.step[b];
      for (int i = 0; i < kBlockSize; i += static_cast<int>(hn::Lanes(d)))
        hn::StoreU(hn::Load(d, from + i), d, to + i);
    }
  }
}

void FillRows(uint32_t value, int width, int rows, const PixelRows& out) {
  const hn::CappedTag<uint32_t, 16> d;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(hn::CappedTag<uint32_t, 16>()));
  const auto all = hn::Set(d, value);
  for (int row = 0; row < rows; ++row) {
    uint32_t* to = out.first + row * out.step;
    int i = 0;
    for (; i + 2 * kLanes <= width; i += 2 * kLanes) {
      hn::StoreU(all, d, to + i);
      hn::StoreU(all, d, to + i + kLanes);
    }
    for (; i < width; ++i) to[i] = value;
  }
}

RowFunctions Functions() { return {&CopyBand, &FillRows}; }

}  // namespace HWY_NAMESPACE
}  // namespace halfspace::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace halfspace::raster {
RowFunctions row_functions() { HALFSPACE_SELECT(Functions) }
}  // namespace halfspace::raster
#endif
