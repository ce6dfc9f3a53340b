// Compiled once an ISA level; exact in integers.
#include "raster/primitive/triangle_filter.h"

#include <string.h>

#include "raster/isa.h"
#include "raster/primitive/segment.h"
#include "raster/vertex/shaded_vertices.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/primitive/triangle_filter.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace halfspace::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Ints = hn::CappedTag<int32_t, kFilterLanes>;
using IntVec = hn::Vec<Ints>;
using IntMask = hn::Mask<Ints>;
constexpr uint32_t kIntLanes = uint32_t(hn::MaxLanes(Ints()));

struct Corners {
  IntVec x[3], y[3];
};

// A window position as it lies in a record.
struct Place {
  int32_t x, y;
};

HWY_INLINE unsigned mask_bits(IntMask mask) {
#if HWY_TARGET == HWY_SCALAR
  return hn::AllFalse(Ints(), mask) ? 0u : 1u;
#else
  uint8_t bits[8] = {};
  hn::StoreMaskBits(Ints(), mask, bits);
  return bits[0];
#endif
}

// Twice the signed area is a difference of products below 2^49: exact in double.
using Doubles = hn::CappedTag<double, kFilterLanes>;
using DoubleVec = hn::Vec<Doubles>;

struct Areas {
  unsigned positive, negative;
};

HWY_INLINE Areas area_signs(const int32_t (&x)[3][kFilterLanes], const int32_t (&y)[3][kFilterLanes],
                            uint32_t i) {
  const Doubles d;
  const hn::Rebind<int32_t, Doubles> ints;
  Areas out{0, 0};
  for (uint32_t j = 0; j < kIntLanes; j += uint32_t(hn::MaxLanes(d))) {
    const auto difference = [&](const int32_t* a, const int32_t* b) HWY_ATTR {
      return hn::PromoteTo(d, hn::Sub(hn::LoadU(ints, a + i + j), hn::LoadU(ints, b + i + j)));
    };
    const DoubleVec area = hn::Sub(hn::Mul(difference(x[1], x[0]), difference(y[2], y[0])),
                                   hn::Mul(difference(x[2], x[0]), difference(y[1], y[0])));
    uint8_t bits[8] = {};
#if HWY_TARGET == HWY_SCALAR
    bits[0] = hn::AllFalse(d, hn::Gt(area, hn::Zero(d))) ? 0 : 1;
    out.positive |= unsigned{bits[0]} << j;
    bits[0] = hn::AllFalse(d, hn::Lt(area, hn::Zero(d))) ? 0 : 1;
#else
    hn::StoreMaskBits(d, hn::Gt(area, hn::Zero(d)), bits);
    out.positive |= unsigned{bits[0]} << j;
    hn::StoreMaskBits(d, hn::Lt(area, hn::Zero(d)), bits);
#endif
    out.negative |= unsigned{bits[0]} << j;
  }
  return out;
}

struct Box {
  IntVec first_x, first_y, last_x, last_y;
};

// Pixel i has its centre at i * 256 + 128.
HWY_INLINE IntVec first_pixel(IntVec v) {
  return hn::ShiftRight<kSubpixelBits>(hn::Add(v, hn::Set(Ints(), kSubpixelScale / 2 - 1)));
}
HWY_INLINE IntVec last_pixel(IntVec v) {
  return hn::ShiftRight<kSubpixelBits>(hn::Sub(v, hn::Set(Ints(), kSubpixelScale / 2)));
}

constexpr int kTestedPixels = 3;  // a side

// An edge function at pixel centres: >= 0 inside, by the top-left rule. Exact where a triangle is at most so
// many pixels large.
struct Edge {
  IntVec value, step_x, step_y;

  // From corner a to corner b of a counter-clockwise triangle; `turn`: all ones where it is clockwise, and
  // the edge runs the other way.
  HWY_INLINE Edge(const Corners& c, int a, int b, IntVec turn, IntVec center_x, IntVec center_y) {
    const Ints d;
    const IntVec dx = hn::Sub(hn::Xor(hn::Sub(c.x[b], c.x[a]), turn), turn);
    const IntVec dy = hn::Sub(hn::Xor(hn::Sub(c.y[b], c.y[a]), turn), turn);
    const IntVec zero = hn::Zero(d);
    const IntMask inclusive = hn::Or(hn::Lt(dy, zero), hn::And(hn::Eq(dy, zero), hn::Lt(dx, zero)));
    const IntVec bias = hn::IfThenZeroElse(inclusive, hn::Set(d, 1));
    value = hn::Sub(hn::Sub(hn::Mul(dx, hn::Sub(center_y, c.y[a])), hn::Mul(dy, hn::Sub(center_x, c.x[a]))),
                    bias);
    step_x = hn::Neg(hn::ShiftLeft<kSubpixelBits>(dy));
    step_y = hn::ShiftLeft<kSubpixelBits>(dx);
  }
};

// Where a pixel centre of the box lies inside. Lanes of larger boxes come out wrong.
HWY_INLINE IntMask covers_center(const Corners& c, const Box& box, IntVec turn, IntVec width, IntVec height) {
  const Ints d;
  const IntVec half = hn::Set(d, kSubpixelScale / 2), none = hn::Set(d, -1);
  const IntVec x = hn::Add(hn::ShiftLeft<kSubpixelBits>(box.first_x), half);
  const IntVec y = hn::Add(hn::ShiftLeft<kSubpixelBits>(box.first_y), half);
  Edge edges[3] = {Edge(c, 0, 1, turn, x, y), Edge(c, 1, 2, turn, x, y), Edge(c, 2, 0, turn, x, y)};
  IntVec inside = none;  // negative: no centre was found so far
  for (int row = 0; row < kTestedPixels; ++row) {
    IntVec e[3] = {edges[0].value, edges[1].value, edges[2].value};
    for (int column = 0; column < kTestedPixels; ++column) {
      IntVec outside = hn::Or(hn::Or(e[0], e[1]), e[2]);
      outside = hn::Or(outside, hn::Sub(width, hn::Set(d, column + 1)));
      outside = hn::Or(outside, hn::Sub(height, hn::Set(d, row + 1)));
      inside = hn::And(inside, outside);
      for (int k = 0; k < 3; ++k) e[k] = hn::Add(e[k], edges[k].step_x);
    }
    for (Edge& edge : edges) edge.value = hn::Add(edge.value, edge.step_y);
  }
  return hn::Gt(inside, none);
}

// Boxes of pixels as boxes of tiles.
HWY_INLINE void store_tiles(const Box& box, int tiles_x, uint32_t i, FilteredTriangles& out) {
  static_assert(kTileSize == 1 << 6);
  const Ints d;
  const IntVec x0 = hn::ShiftRight<6>(box.first_x), x1 = hn::ShiftRight<6>(box.last_x);
  const IntVec y0 = hn::ShiftRight<6>(box.first_y), y1 = hn::ShiftRight<6>(box.last_y);
  hn::StoreU(x0, d, out.tile_x0 + i), hn::StoreU(x1, d, out.tile_x1 + i);
  hn::StoreU(y0, d, out.tile_y0 + i), hn::StoreU(y1, d, out.tile_y1 + i);
  hn::StoreU(hn::Add(hn::Mul(y0, hn::Set(d, tiles_x)), x0), d, out.tile + i);
  const IntMask one = hn::And(hn::Eq(x0, x1), hn::Eq(y0, y1));
  out.in_one_tile |= mask_bits(one) << i;
}

// The lanes from `i` on whose boxes hold pixels, and not only some that the triangle misses.
HWY_INLINE unsigned filter_lanes(const TriangleFilter& filter, uint32_t i, unsigned clockwise,
                                 FilteredTriangles& out) {
  const Ints d;
  Corners c;
  for (int k = 0; k < 3; ++k) c.x[k] = hn::LoadU(d, out.x[k] + i), c.y[k] = hn::LoadU(d, out.y[k] + i);
  const IntVec low_x = hn::Min(hn::Min(c.x[0], c.x[1]), c.x[2]),
               high_x = hn::Max(hn::Max(c.x[0], c.x[1]), c.x[2]);
  const IntVec low_y = hn::Min(hn::Min(c.y[0], c.y[1]), c.y[2]),
               high_y = hn::Max(hn::Max(c.y[0], c.y[1]), c.y[2]);
  const Box box{hn::Max(first_pixel(low_x), hn::Set(d, filter.bounds.x0)),
                hn::Max(first_pixel(low_y), hn::Set(d, filter.bounds.y0)),
                hn::Min(last_pixel(high_x), hn::Set(d, filter.bounds.x1 - 1)),
                hn::Min(last_pixel(high_y), hn::Set(d, filter.bounds.y1 - 1))};
  store_tiles(box, filter.tiles_x, i, out);
  const IntVec one = hn::Set(d, 1);
  const IntVec width = hn::Add(hn::Sub(box.last_x, box.first_x), one);
  const IntVec height = hn::Add(hn::Sub(box.last_y, box.first_y), one);
  const unsigned filled = mask_bits(hn::Gt(hn::Min(width, height), hn::Zero(d)));
  // Of the triangle, not of what the bounds leave of its box: then nothing here overflows. A box of three
  // pixels may, with centres on its border, hold four.
  const IntVec size = hn::Max(hn::Sub(high_x, low_x), hn::Sub(high_y, low_y));
  const unsigned small = mask_bits(hn::Lt(size, hn::Set(d, kTestedPixels * kSubpixelScale)));
  if ((filled & small) == 0) return filled;
  alignas(64) int32_t turns[kFilterLanes];
  for (uint32_t lane = 0; lane < kFilterLanes; ++lane)
    turns[lane] = -static_cast<int32_t>(clockwise >> lane & 1);
  return filled & (~small | mask_bits(covers_center(c, box, hn::LoadU(d, turns + i), width, height)));
}

// Where the corners of all lanes lie; lanes beyond `count` get those of the first triangle.
HWY_INLINE void load_places(const TriangleFilter& filter, const uint32_t* corners, uint32_t count,
                            FilteredTriangles& out) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  // In registers: what is stored narrow and read wide stalls.
  const auto load = [&](auto&& triangle_of) HWY_ATTR {
    for (uint32_t k = 0; k < 3; ++k) {
      const auto two = [&](uint32_t a, uint32_t b) HWY_ATTR {
        const auto at = [&](uint32_t lane) HWY_ATTR {
          return reinterpret_cast<const __m64*>(filter.records +
                                                corners[3 * triangle_of(lane) + k] * filter.stride);
        };
        return _mm_loadh_pi(_mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(at(a)))), at(b));
      };
      const __m256 even = _mm256_insertf128_ps(_mm256_castps128_ps256(two(0, 1)), two(4, 5), 1);
      const __m256 odd = _mm256_insertf128_ps(_mm256_castps128_ps256(two(2, 3)), two(6, 7), 1);
      _mm256_storeu_ps(reinterpret_cast<float*>(out.x[k]), _mm256_shuffle_ps(even, odd, 0x88));
      _mm256_storeu_ps(reinterpret_cast<float*>(out.y[k]), _mm256_shuffle_ps(even, odd, 0xdd));
    }
  };
  if (HWY_LIKELY(count == kFilterLanes))
    load([](uint32_t lane) HWY_ATTR { return lane; });
  else
    load([count](uint32_t lane) HWY_ATTR { return lane < count ? lane : 0; });
#else
  for (uint32_t lane = 0; lane < kFilterLanes; ++lane) {
    const uint32_t* triangle = corners + 3 * (lane < count ? lane : 0);
    for (int k = 0; k < 3; ++k) {
      const auto* place = reinterpret_cast<const Place*>(filter.records + triangle[k] * filter.stride);
      out.x[k][lane] = place->x;
      out.y[k][lane] = place->y;
    }
  }
#endif
}

void FilterTriangles(const TriangleFilter& filter, const uint32_t* corners, uint32_t count,
                     FilteredTriangles& out) {
  unsigned special = 0, outside = 0;
  load_places(filter, corners, count, out);
  if (filter.outcodes != nullptr) {
    for (uint32_t lane = 0; lane < count; ++lane) {
      const unsigned o0 = filter.outcodes[corners[3 * lane]], o1 = filter.outcodes[corners[3 * lane + 1]],
                     o2 = filter.outcodes[corners[3 * lane + 2]], any = o0 | o1 | o2;
      if ((o0 & o1 & o2) != 0 || (any & kOutNotFinite) != 0)
        outside |= 1u << lane;
      else if ((any & kOutCutMask) != 0)
        special |= 1u << lane;
    }
  }
  unsigned positive = 0, negative = 0, filled = 0;
  out.in_one_tile = 0;
  for (uint32_t i = 0; i < kFilterLanes; i += kIntLanes) {
    const Areas areas = area_signs(out.x, out.y, i);
    positive |= areas.positive << i, negative |= areas.negative << i;
  }
  for (uint32_t i = 0; i < kFilterLanes; i += kIntLanes)
    filled |= filter_lanes(filter, i, negative, out) << i;
  unsigned kept =
      filled & ((filter.cull_counter_clockwise ? 0 : positive) | (filter.cull_clockwise ? 0 : negative));
  const unsigned lanes = (1u << count) - 1;
  out.kept = kept & ~outside & ~special & lanes;
  out.special = special;
  out.dropped = count - static_cast<uint32_t>(__builtin_popcount(out.kept | special));
  out.clockwise = negative;
}

}  // namespace HWY_NAMESPACE
}  // namespace halfspace::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace halfspace::raster {
TriangleFilterFunction triangle_filter() { HALFSPACE_SELECT_FUNCTION(FilterTriangles) }
}  // namespace halfspace::raster
#endif
