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

// Less than a vector.
HWY_INLINE void FillPart(uint32_t value, uint32_t* to, uint32_t* end) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  const hn::CappedTag<uint32_t, 16> d;
  hn::BlendedStore(hn::Set(d, value), hn::FirstN(d, static_cast<size_t>(end - to)), d, to);
#else
  while (to < end) *to++ = value;
#endif
}

// No store may cross a cache line, or even two pages: it would take many times as long, and callers' pictures begin
// anywhere.
HWY_INLINE void FillRow(uint32_t value, int width, uint32_t* to) {
  const hn::CappedTag<uint32_t, 16> d;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(hn::CappedTag<uint32_t, 16>()));
  const auto all = hn::Set(d, value);
  uint32_t* end = to + width;
  const auto past_line = static_cast<int>(reinterpret_cast<uintptr_t>(to) / sizeof *to % kLanes);
  if (past_line != 0) {
    uint32_t* line = to - past_line + kLanes;
    if (line > end) line = end;
    FillPart(value, to, line);
    to = line;
  }
  for (; end - to >= 2 * kLanes; to += 2 * kLanes) {
    hn::Store(all, d, to);
    hn::Store(all, d, to + kLanes);
  }
  if (end - to >= kLanes) {
    hn::Store(all, d, to);
    to += kLanes;
  }
  if (to < end) FillPart(value, to, end);
}

HWY_INLINE void CopyRow(const uint32_t* from, int blocks, uint32_t* to) {
  const hn::CappedTag<uint32_t, kBlockSize> d;
  for (int b = 0; b < blocks; ++b, from += kBlockPixels, to += kBlockSize)
    for (int i = 0; i < kBlockSize; i += static_cast<int>(hn::Lanes(d))) hn::StoreU(hn::Load(d, from + i), d, to + i);
}

HWY_INLINE void WriteRows(const BlockRun* runs, int count, const PixelRows& out) {
  for (int row = 0; row < kBlockSize; ++row) {
    uint32_t* to = out.first + row * out.step;
    for (const BlockRun* run = runs; run != runs + count; ++run) {
      const int width = run->blocks * kBlockSize;
      if (run->pixels == nullptr) FillRow(run->value, width, to);
      else CopyRow(run->pixels + row * kBlockSize, run->blocks, to);
      to += width;
    }
  }
}

// Memory likes its rows whole, but what was drawn likes to be read in the order it lies in.
void WriteRuns(const BlockRun* runs, int count, const PixelRows& out) {
  bool drawn = true;
  for (int i = 0; i < count; ++i) drawn = drawn && runs[i].pixels != nullptr;
  if (drawn) {
    PixelRows to = out;
    for (int i = 0; i < count; ++i) {
      WriteRows(runs + i, 1, to);
      to.first += runs[i].blocks * kBlockSize;
    }
  } else {
    WriteRows(runs, count, out);
  }
}

// The blocks have left the near caches since they were drawn, so two rows of them are asked for while two are
// written.
void WriteOver(uint32_t value, int width, const PlacedBlock* blocks, int count, const PixelRows& out) {
  if (count == 0 && out.step == width) return FillRow(value, width * kBlockSize, out.first);
  for (int row = 0; row < kBlockSize; ++row) {
    uint32_t* to = out.first + row * out.step;
    if (row % 2 == 0 && row + 2 < kBlockSize)
      for (int i = 0; i < count; ++i) __builtin_prefetch(blocks[i].pixels + (row + 2) * kBlockSize);
    FillRow(value, width, to);
    for (int i = 0; i < count; ++i) CopyRow(blocks[i].pixels + row * kBlockSize, 1, to + blocks[i].at);
  }
}

void FillWords(uint32_t value, int width, uint32_t* to) { FillRow(value, width, to); }

// As DepthPlane::depth has it.
void FillDepth(const DepthPlane& plane, uint64_t blocks, uint32_t* tile) {
  const hn::CappedTag<double, kBlockSize> d;
  const hn::Rebind<int32_t, decltype(d)> words;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(hn::CappedTag<double, kBlockSize>()));
  alignas(64) double across[kTileSize];
  for (int x = 0; x < kTileSize; ++x) across[x] = plane.across(x);
  for (; blocks != 0; blocks &= blocks - 1) {
    const int block = __builtin_ctzll(blocks);
    const double* columns = across + block % 8 * kBlockSize;
    auto* to = reinterpret_cast<int32_t*>(tile + block * kBlockPixels);
    for (int y = 0; y < kBlockSize; ++y, to += kBlockSize) {
      const auto row = hn::Set(d, plane.row(block / 8 * kBlockSize + y));
      for (int x = 0; x < kBlockSize; x += kLanes) {
        const auto sum = hn::Add(row, hn::Load(d, columns + x));
        hn::Store(hn::DemoteTo(words, hn::IfThenElseZero(hn::Gt(sum, hn::Zero(d)), sum)), words, to + x);
      }
    }
  }
}

RowFunctions Functions() { return {&WriteRuns, &WriteOver, &FillWords, &FillDepth}; }

}  // namespace HWY_NAMESPACE
}  // namespace halfspace::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace halfspace::raster {
RowFunctions row_functions() { HALFSPACE_SELECT(Functions) }
}  // namespace halfspace::raster
#endif
