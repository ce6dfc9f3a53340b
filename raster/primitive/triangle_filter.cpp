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

// What leads from a corner to the next.
struct Edges {
  IntVec dx[3], dy[3];
  HWY_INLINE explicit Edges(const Corners& c) {
    for (int k = 0; k < 3; ++k)
      dx[k] = hn::Sub(c.x[(k + 1) % 3], c.x[k]), dy[k] = hn::Sub(c.y[(k + 1) % 3], c.y[k]);
  }
};

struct Areas {
  unsigned positive, negative;
};

// Where a triangle spans less than this, 1/256 px, twice its signed area fits an integer.
constexpr int32_t kSmallSpan = 1 << 15;
HWY_INLINE IntVec small_area(const Edges& e) {
  return hn::Sub(hn::Mul(e.dx[2], e.dy[0]), hn::Mul(e.dx[0], e.dy[2]));
}

HWY_INLINE Areas small_area_signs(IntVec area) {
  const IntVec zero = hn::Zero(Ints());
  return {mask_bits(hn::Gt(area, zero)), mask_bits(hn::Lt(area, zero))};
}

// Of any triangle: a difference of products below 2^49, exact in double.
using Doubles = hn::CappedTag<double, kFilterLanes>;
using DoubleVec = hn::Vec<Doubles>;

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

constexpr int kTestedPixels = 3;  // a side, at most

// An edge function at pixel centres: >= 0 inside, by the top-left rule. Exact where a triangle is at most
// kTestedPixels large.
struct EdgeValue {
  IntVec value, step_x, step_y;

  // dx, dy: along the edge, counter-clockwise. `value` without the rule, at the first centre.
  HWY_INLINE EdgeValue(IntVec dx, IntVec dy, IntVec first) {
    const Ints d;
    // Inclusive are edges that go down, and level ones that go left.
    static_assert(kTestedPixels * kSubpixelScale < 1 << 12);
    const IntVec inclusive = hn::ShiftRight<31>(hn::Add(hn::ShiftLeft<12>(dy), dx));
    value = hn::Add(first, hn::Xor(inclusive, hn::Set(d, -1)));
    step_x = hn::Neg(hn::ShiftLeft<kSubpixelBits>(dy));
    step_y = hn::ShiftLeft<kSubpixelBits>(dx);
  }
};

// Where one of the first kPixels x kPixels centres of the box lies inside. Lanes of larger boxes come out
// wrong.
template <int kPixels>
HWY_INLINE IntMask covers_center(const Corners& c, const Edges& along, IntVec area, const Box& box,
                                 IntVec width, IntVec height) {
  const Ints d;
  const IntVec half = hn::Set(d, kSubpixelScale / 2), none = hn::Set(d, -1);
  const IntVec x = hn::Add(hn::ShiftLeft<kSubpixelBits>(box.first_x), half);
  const IntVec y = hn::Add(hn::ShiftLeft<kSubpixelBits>(box.first_y), half);
  // All ones where it is clockwise: the edges run the other way.
  const IntVec turn = hn::ShiftRight<31>(area);
  const auto turned = [&](IntVec v) HWY_ATTR { return hn::Sub(hn::Xor(v, turn), turn); };
  IntVec dx[3], dy[3], first[3];
  for (int k = 0; k < 3; ++k) dx[k] = turned(along.dx[k]), dy[k] = turned(along.dy[k]);
  for (int k = 0; k < 2; ++k)
    first[k] = hn::Sub(hn::Mul(dx[k], hn::Sub(y, c.y[k])), hn::Mul(dy[k], hn::Sub(x, c.x[k])));
  first[2] = hn::Sub(turned(area), hn::Add(first[0], first[1]));  // the three are the area
  EdgeValue edges[3] = {EdgeValue(dx[0], dy[0], first[0]), EdgeValue(dx[1], dy[1], first[1]),
                        EdgeValue(dx[2], dy[2], first[2])};
  IntVec inside = none;  // negative: no centre was found so far
  for (int row = 0; row < kPixels; ++row) {
    IntVec e[3] = {edges[0].value, edges[1].value, edges[2].value};
    for (int column = 0; column < kPixels; ++column) {
      IntVec outside = hn::Or(hn::Or(e[0], e[1]), e[2]);
      outside = hn::Or(outside, hn::Sub(width, hn::Set(d, column + 1)));
      outside = hn::Or(outside, hn::Sub(height, hn::Set(d, row + 1)));
      inside = hn::And(inside, outside);
      for (int k = 0; k < 3; ++k) e[k] = hn::Add(e[k], edges[k].step_x);
    }
    for (EdgeValue& edge : edges) edge.value = hn::Add(edge.value, edge.step_y);
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

// What is found of some lanes.
struct FoundLanes {
  unsigned filled;  // their boxes hold pixels, and not only some that the triangle misses
  Areas areas;
};

// Of the lanes from `i` on.
HWY_INLINE FoundLanes filter_lanes(const TriangleFilter& filter, uint32_t i, FilteredTriangles& out) {
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
  // Of the triangle, not of what the bounds leave of its box: then nothing here overflows. A box of three
  // pixels may, with centres on its border, hold four.
  const IntVec size = hn::Max(hn::Sub(high_x, low_x), hn::Sub(high_y, low_y));
  const Edges edges(c);
  const IntVec area = small_area(edges);
  const auto all = [&](IntMask mask) HWY_ATTR { return hn::AllTrue(d, mask); };
  FoundLanes found;
  found.filled = mask_bits(hn::Gt(hn::Min(width, height), hn::Zero(d)));
  found.areas = HWY_LIKELY(all(hn::Lt(size, hn::Set(d, kSmallSpan)))) ? small_area_signs(area)
                                                                      : area_signs(out.x, out.y, i);
  const unsigned small = mask_bits(hn::Lt(size, hn::Set(d, kTestedPixels * kSubpixelScale)));
  if ((found.filled & small) == 0) return found;
  const IntMask covers = all(hn::Lt(hn::Max(width, height), hn::Set(d, kTestedPixels)))
                             ? covers_center<kTestedPixels - 1>(c, edges, area, box, width, height)
                             : covers_center<kTestedPixels>(c, edges, area, box, width, height);
  found.filled &= ~small | mask_bits(covers);
  return found;
}

// Where the corners of all lanes lie; lanes beyond `count` get those of the first triangle.
HWY_INLINE void load_places(const TriangleFilter& filter, const uint32_t* corners, uint32_t count,
                            FilteredTriangles& out) {
  uint32_t some[3 * kFilterLanes];
  if (HWY_UNLIKELY(count < kFilterLanes)) {
    for (uint32_t i = 0; i < 3 * kFilterLanes; ++i) some[i] = corners[i < 3 * count ? i : i % 3];
    corners = some;
  }
  // Where vertex 0 would be.
  const auto records = reinterpret_cast<uintptr_t>(filter.records) - size_t{filter.base} * filter.stride;
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  // In registers: what is stored narrow and read wide stalls.
  for (uint32_t k = 0; k < 3; ++k) {
    const auto two = [&](uint32_t a, uint32_t b) HWY_ATTR {
      const auto at = [&](uint32_t lane) HWY_ATTR {
        return reinterpret_cast<const __m64*>(records + corners[3 * lane + k] * filter.stride);
      };
      return _mm_loadh_pi(_mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(at(a)))), at(b));
    };
    const __m256 even = _mm256_insertf128_ps(_mm256_castps128_ps256(two(0, 1)), two(4, 5), 1);
    const __m256 odd = _mm256_insertf128_ps(_mm256_castps128_ps256(two(2, 3)), two(6, 7), 1);
    _mm256_storeu_ps(reinterpret_cast<float*>(out.x[k]), _mm256_shuffle_ps(even, odd, 0x88));
    _mm256_storeu_ps(reinterpret_cast<float*>(out.y[k]), _mm256_shuffle_ps(even, odd, 0xdd));
  }
#else
  for (uint32_t lane = 0; lane < kFilterLanes; ++lane) {
    for (uint32_t k = 0; k < 3; ++k) {
      const auto* place = reinterpret_cast<const Place*>(records + corners[3 * lane + k] * filter.stride);
      out.x[k][lane] = place->x;
      out.y[k][lane] = place->y;
    }
  }
#endif
}

// Whether a corner has to be looked at more closely. All others lie where the vertex stage put them, and
// outside of the view volume's sides outside of the bounds.
HWY_INLINE bool has_no_place(const FilteredTriangles& out) {
  const Ints d;
  IntVec least = hn::LoadU(d, out.x[0]);
  for (int k = 0; k < 3; ++k)
    for (uint32_t i = 0; i < kFilterLanes; i += kIntLanes) least = hn::Min(least, hn::LoadU(d, out.x[k] + i));
  return !hn::AllTrue(d, hn::Gt(least, hn::Set(d, kNoPlace)));
}

void FilterTriangles(const TriangleFilter& filter, const uint32_t* corners, uint32_t count,
                     FilteredTriangles& out) {
  unsigned special = 0, outside = 0;
  load_places(filter, corners, count, out);
  if (HWY_UNLIKELY(has_no_place(out))) {
    const auto outcode = [&](uint32_t corner)
                             HWY_ATTR { return unsigned{filter.outcodes[corner - filter.base]}; };
    for (uint32_t lane = 0; lane < count; ++lane) {
      const unsigned o0 = outcode(corners[3 * lane]), o1 = outcode(corners[3 * lane + 1]),
                     o2 = outcode(corners[3 * lane + 2]), any = o0 | o1 | o2;
      if ((o0 & o1 & o2) != 0 || (any & kOutNotFinite) != 0)
        outside |= 1u << lane;
      else if ((any & kOutCutMask) != 0)
        special |= 1u << lane;
    }
  }
  unsigned positive = 0, negative = 0, filled = 0;
  out.in_one_tile = 0;
  for (uint32_t i = 0; i < kFilterLanes; i += kIntLanes) {
    const FoundLanes found = filter_lanes(filter, i, out);
    positive |= found.areas.positive << i, negative |= found.areas.negative << i, filled |= found.filled << i;
  }
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
