// Compiled once an ISA level. All that is said of a lane here holds for any number of them: the operations
// are those of raster/primitive/clip.cpp, in the same order.
#include "raster/primitive/triangle_cut.h"

#include <string.h>

#include "raster/isa.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/primitive/triangle_cut.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace halfspace::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, kCutLanes>;
using Ints = hn::Rebind<int32_t, Doubles>;
using VD = hn::Vec<Doubles>;
using Mask = hn::Mask<Doubles>;
constexpr int kDoubleLanes = static_cast<int>(hn::MaxLanes(Doubles()));

HWY_INLINE VD All(double value) { return hn::Set(Doubles(), value); }

HWY_INLINE const VertexHead* HeadOf(const ShadedVertices& vertices, size_t stride, uint32_t v) {
  return reinterpret_cast<const VertexHead*>(vertices.records + v * stride);
}

// Clip coordinates of a group of lanes, lanes beyond `count` as the first one.
struct ClipVectors {
  VD x, y, z, w;

  HWY_INLINE ClipVectors() = default;
  HWY_INLINE ClipVectors(const ClipVertex* const* clip, int corner, int i, int count) {
    alignas(64) ClipVertex each[kDoubleLanes];
    for (int k = 0; k < kDoubleLanes; ++k) each[k] = clip[i + k < count ? i + k : 0][corner];
    hn::LoadInterleaved4(Doubles(), &each[0].x, x, y, z, w);
  }
  HWY_INLINE void SwapIf(Mask swap, ClipVectors& other) {
    const auto exchange = [swap](VD& a, VD& b) HWY_ATTR {
      const VD was = a;
      a = hn::IfThenElse(swap, b, a), b = hn::IfThenElse(swap, was, b);
    };
    exchange(x, other.x), exchange(y, other.y), exchange(z, other.z), exchange(w, other.w);
  }
};

// Bits of a mask's lanes.
HWY_INLINE unsigned LaneBits(Mask mask) {
#if HWY_TARGET == HWY_SCALAR
  return hn::AllFalse(Doubles(), mask) ? 0u : 1u;
#else
  uint8_t bits[8] = {};
  hn::StoreMaskBits(Doubles(), mask, bits);
  return bits[0];
#endif
}

// --- What a plane leaves

struct Point {
  VD x, y;  // 16.8, whole
};
HWY_INLINE Point Choose(Mask mask, const Point& yes, const Point& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y)};
}
HWY_INLINE Mask IsLower(const Point& p, const Point& than) {
  return hn::Or(hn::Lt(p.y, than.y), hn::And(hn::Eq(p.y, than.y), hn::Lt(p.x, than.x)));
}
// Below 2^48: exact.
HWY_INLINE VD Cross(const Point& a, const Point& b, const Point& c) {
  return hn::Sub(hn::Mul(hn::Sub(b.x, a.x), hn::Sub(c.y, a.y)),
                 hn::Mul(hn::Sub(c.x, a.x), hn::Sub(b.y, a.y)));
}

// As distance() and crossing() in raster/primitive/clip_planes.h, and snap_coordinate().
struct DepthPlane {
  VD x, y, z, w, constant;
  HWY_INLINE DepthPlane(const ClipPlane& near, const ClipPlane& far, Mask is_far)
      : x(hn::IfThenElse(is_far, All(far.x), All(near.x))),
        y(hn::IfThenElse(is_far, All(far.y), All(near.y))),
        z(hn::IfThenElse(is_far, All(far.z), All(near.z))),
        w(hn::IfThenElse(is_far, All(far.w), All(near.w))),
        constant(hn::IfThenElse(is_far, All(far.constant), All(near.constant))) {}
  HWY_INLINE VD Distance(const ClipVectors& v) const {
    const VD across = hn::Add(hn::Mul(x, v.x), hn::Mul(y, v.y));
    return hn::Add(hn::Add(hn::Add(across, hn::Mul(z, v.z)), hn::Mul(w, v.w)), constant);
  }
};
HWY_INLINE VD Crossing(VD in, VD d_in, VD out, VD d_out) {
  return hn::Div(hn::Add(hn::Mul(in, hn::Neg(d_out)), hn::Mul(out, d_in)), hn::Sub(d_in, d_out));
}
HWY_INLINE VD Snapped(VD clip, VD w, double scale, double offset) {
  const VD low = All(static_cast<double>(kGuardBandMin) * kSubpixelScale);
  const VD high = All(static_cast<double>(kGuardBandMax) * kSubpixelScale - 1);
  const VD pixels = hn::Floor(hn::Add(hn::Mul(hn::Div(clip, w), All(scale)), All(0.5)));
  const VD v = hn::Add(pixels, All(offset));
  return hn::IfThenElse(hn::Gt(v, low), hn::Min(v, high), low);
}

// The three corners of each lane, from the one on that lies alone on its side of the plane.
struct OddFirst {
  Mask second, third;
  template <class T, class Choice>
  HWY_INLINE void Turn(T (&v)[3], Choice choose) const {
    const T a = v[0], b = v[1], c = v[2];
    v[0] = choose(third, c, choose(second, b, a));
    v[1] = choose(third, a, choose(second, c, b));
    v[2] = choose(third, b, choose(second, a, c));
  }
  HWY_INLINE void Turn(VD (&v)[3]) const {
    Turn(v, [](Mask mask, VD yes, VD no) HWY_ATTR { return hn::IfThenElse(mask, yes, no); });
  }
  HWY_INLINE void Turn(Point (&p)[3]) const {
    Turn(p, [](Mask mask, const Point& yes, const Point& no) HWY_ATTR { return Choose(mask, yes, no); });
  }
};

// Where the vertex stage put the corners.
HWY_INLINE Point PlaceOf(const ShadedVertices& vertices, size_t stride, const DepthCut& cut, int corner,
                         int i) {
  alignas(64) int32_t x[kDoubleLanes], y[kDoubleLanes];
  for (int k = 0; k < kDoubleLanes; ++k) {
    const auto lane = static_cast<uint32_t>(i + k);
    const VertexHead* head = HeadOf(vertices, stride, cut.v[lane < cut.count ? lane : 0][corner]);
    x[k] = head->x, y[k] = head->y;
  }
  return {hn::PromoteTo(Doubles(), hn::Load(Ints(), x)), hn::PromoteTo(Doubles(), hn::Load(Ints(), y))};
}

// Fans the polygon from its lowest corner. False where snapping has bent it so that another one has to serve.
HWY_INLINE Mask Fan(const Point (&p)[4], VD area, int i, DepthCut& cut) {
  const VD zero = hn::Zero(Doubles());
  Point lowest = p[0];
  Mask is[4];
  for (int k = 1; k < 4; ++k) {
    is[k] = IsLower(p[k], lowest);
    lowest = Choose(is[k], p[k], lowest);
  }
  is[2] = hn::AndNot(is[3], is[2]);
  is[1] = hn::AndNot(hn::Or(is[3], is[2]), is[1]);
  for (int k = 0; k < 4; ++k) {
    const auto after = [&](int from) HWY_ATTR { return p[(from + k) % 4]; };
    const Point corner = Choose(is[3], after(3), Choose(is[2], after(2), Choose(is[1], after(1), after(0))));
    hn::Store(hn::DemoteTo(Ints(), corner.x), Ints(), cut.x[k] + i);
    hn::Store(hn::DemoteTo(Ints(), corner.y), Ints(), cut.y[k] + i);
  }
  // Of the two ways to part the polygon: its triangles, and the one that comes first from the lowest corner.
  const Mask odd = hn::Or(is[1], is[3]), late = hn::Or(is[2], is[3]);
  const VD one = hn::IfThenElse(odd, Cross(p[1], p[2], p[3]), Cross(p[0], p[1], p[2])),
           other = hn::Sub(area, one);
  const VD first = hn::IfThenElse(late, other, one), second = hn::IfThenElse(late, one, other);
  cut.has_piece[0] |= LaneBits(hn::Ne(first, zero)) << i;
  cut.has_piece[1] |= LaneBits(hn::Ne(second, zero)) << i;
  // Each turns as the whole does, or is nothing.
  const VD least =
      hn::IfThenElse(hn::Gt(area, zero), hn::Min(first, second), hn::Neg(hn::Max(first, second)));
  return hn::Ge(least, zero);
}

void CutAtDepth(const ShadedVertices& vertices, const WindowTransform& window, DepthCut& cut) {
  const Doubles d;
  const size_t stride = vertices.layout.stride();
  const auto count = static_cast<int>(cut.count);
  ClipPlane planes[kClipPlanes];
  make_clip_planes(window, planes);
  alignas(64) double is_far[kCutLanes];
  for (int lane = 0; lane < static_cast<int>(kCutLanes); ++lane)
    is_far[lane] = lane < count && cut.far[lane] ? 1 : 0;
  cut.not_cut = cut.has_piece[0] = cut.has_piece[1] = 0;
  for (int i = 0; i < count; i += kDoubleLanes) {
    const DepthPlane plane(planes[0], planes[1], hn::Gt(hn::Load(d, is_far + i), hn::Zero(d)));
    VD x[3], y[3], w[3], distance[3];
    Point place[3];
    for (int k = 0; k < 3; ++k) {
      const ClipVectors corner(cut.clip, k, i, count);
      x[k] = corner.x, y[k] = corner.y, w[k] = corner.w, distance[k] = plane.Distance(corner);
      place[k] = PlaceOf(vertices, stride, cut, k, i);
    }
    Mask out[3];
    for (int k = 0; k < 3; ++k) out[k] = hn::Lt(distance[k], hn::Zero(d));
    const Mask most =
        hn::Or(hn::And(out[0], hn::Or(out[1], out[2])), hn::And(out[1], out[2]));  // two are outside
    const Mask crosses =
        hn::AndNot(hn::And(hn::And(out[0], out[1]), out[2]), hn::Or(hn::Or(out[0], out[1]), out[2]));
    const OddFirst order{hn::Xor(out[1], most), hn::Xor(out[2], most)};
    order.Turn(x), order.Turn(y), order.Turn(w), order.Turn(distance), order.Turn(place);
    Point made[2];
    VD least = hn::IfThenElse(most, w[0], hn::Min(w[1], w[2]));  // w of what is left
    for (int k = 0; k < 2; ++k) {
      // From either end, the same bits result.
      const auto at = [&](const VD(&v)[3])
                          HWY_ATTR { return Crossing(v[0], distance[0], v[k + 1], distance[k + 1]); };
      const VD made_w = at(w);
      made[k] = {Snapped(at(x), made_w, window.scale_x, window.offset_x),
                 Snapped(at(y), made_w, window.scale_y, window.offset_y)};
      least = hn::Min(least, made_w);
    }
    const Point polygon[4] = {made[1], Choose(most, place[0], made[0]), Choose(most, made[0], place[1]),
                              Choose(most, made[1], place[2])};
    const VD area =
        hn::Add(Cross(polygon[0], polygon[1], polygon[2]), Cross(polygon[0], polygon[2], polygon[3]));
    hn::Store(area, d, cut.area + i);
    Mask good = Fan(polygon, area, i, cut);
    good = hn::And(good, hn::And(crosses, hn::Ge(least, All(kMinW))));
    cut.not_cut |= (~LaneBits(good) & ((1u << kDoubleLanes) - 1)) << i;
  }
  cut.not_cut &= (1u << count) - 1;
}

// --- Planes

// By position, so that the order the vertices came in changes no bit.
HWY_INLINE Mask Precedes(const ClipVectors& a, const ClipVectors& b) {
  const auto by = [](VD p, VD q, Mask or_else)
                      HWY_ATTR { return hn::Or(hn::Lt(p, q), hn::And(hn::Eq(p, q), or_else)); };
  return by(a.x, b.x, by(a.y, b.y, by(a.w, b.w, hn::Lt(a.z, b.z))));
}

struct SortedCorners {
  ClipVectors corner[3];
  alignas(64) double index[3][kDoubleLanes];  // which of the triangle's it is

  HWY_INLINE SortedCorners(const PlaneJob& job, int i) {
    VD which[3];
    for (int k = 0; k < 3; ++k) {
      corner[k] = ClipVectors(job.clip, k, i, static_cast<int>(job.count));
      which[k] = All(k);
    }
    const auto order = [&](int a, int b) HWY_ATTR {
      const Mask swap = Precedes(corner[b], corner[a]);
      corner[a].SwapIf(swap, corner[b]);
      const VD was = which[a];
      which[a] = hn::IfThenElse(swap, which[b], was), which[b] = hn::IfThenElse(swap, was, which[b]);
    };
    order(0, 1), order(1, 2), order(0, 1);
    for (int k = 0; k < 3; ++k) hn::Store(which[k], Doubles(), index[k]);
  }
};

struct PlaneVectors {
  VD f0, dfdx, dfdy;
  HWY_INLINE Mask IsFinite() const {
    return hn::And(hn::And(hn::IsFinite(f0), hn::IsFinite(dfdx)), hn::IsFinite(dfdy));
  }
};

// The inverse of the matrix with the corners as columns, (x / w, y / w) a corner's place in pixels relative
// to the anchor: row i, times (x, y, 1), is corner i's weight over w.
struct Adjugate {
  PlaneVectors row[3];
  Mask usable;

  HWY_INLINE Adjugate(const ClipVectors (&c)[3], const WindowTransform& t, VD anchor_x, VD anchor_y) {
    const VD pixel = All(1.0 / kSubpixelScale);
    const auto place = [&](VD clip, VD w, double scale, double offset, VD anchor) HWY_ATTR {
      return hn::Mul(hn::Add(hn::Mul(clip, All(scale)), hn::Mul(w, hn::Sub(All(offset), anchor))), pixel);
    };
    VD x[3], y[3], w[3];
    for (int k = 0; k < 3; ++k) {
      x[k] = place(c[k].x, c[k].w, t.scale_x, t.offset_x, anchor_x);
      y[k] = place(c[k].y, c[k].w, t.scale_y, t.offset_y, anchor_y);
      w[k] = c[k].w;
    }
    const auto minor = [](VD a, VD b, VD e, VD f) HWY_ATTR { return hn::Sub(hn::Mul(a, b), hn::Mul(e, f)); };
    VD cofactor_x[3], cofactor_y[3], cofactor_1[3];
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      cofactor_x[i] = minor(y[j], w[k], y[k], w[j]);
      cofactor_y[i] = minor(x[k], w[j], x[j], w[k]);
      cofactor_1[i] = minor(x[j], y[k], x[k], y[j]);
    }
    const VD det = hn::Add(hn::Add(hn::Mul(w[0], cofactor_1[0]), hn::Mul(w[1], cofactor_1[1])),
                           hn::Mul(w[2], cofactor_1[2]));
    const VD scale = hn::Div(All(1.0), det);
    usable = hn::And(hn::IsFinite(det), hn::IsFinite(scale));
    for (int i = 0; i < 3; ++i)
      row[i] = {hn::Mul(cofactor_1[i], scale), hn::Mul(cofactor_x[i], scale), hn::Mul(cofactor_y[i], scale)};
  }

  // The plane of a value over w that is `f` at the corners.
  HWY_INLINE PlaneVectors Combine(VD f0, VD f1, VD f2) const {
    const auto sum = [&](VD a, VD b, VD c) HWY_ATTR {
      return hn::Add(hn::Add(hn::Mul(f0, a), hn::Mul(f1, b)), hn::Mul(f2, c));
    };
    return {sum(row[0].f0, row[1].f0, row[2].f0), sum(row[0].dfdx, row[1].dfdx, row[2].dfdx),
            sum(row[0].dfdy, row[1].dfdy, row[2].dfdy)};
  }
};

HWY_INLINE void StorePlane(const PlaneVectors& plane, int which, int i, PlaneJob& job) {
  const Doubles d;
  alignas(64) double f0[kDoubleLanes], dfdx[kDoubleLanes], dfdy[kDoubleLanes];
  hn::Store(plane.f0, d, f0), hn::Store(plane.dfdx, d, dfdx), hn::Store(plane.dfdy, d, dfdy);
  for (int k = 0; k < kDoubleLanes; ++k) job.planes[i + k].planes[which] = {f0[k], dfdx[k], dfdy[k]};
}

// The floats of attribute `which` and what they leave, at one of the sorted corners.
HWY_INLINE VD AttributeAt(const ShadedVertices& vertices, const float* const (&at)[kDoubleLanes],
                          const bool* back, int which) {
  const VertexLayout& layout = vertices.layout;
  const int places[2] = {layout.place(which, false), layout.place(which, true)};
  alignas(64) double value[kDoubleLanes];
  for (int k = 0; k < kDoubleLanes; ++k) {
    const float* attribute = at[k] + places[back[k] ? 1 : 0];
    value[k] = static_cast<double>(*attribute);
    if (layout.low >= 0) value[k] += static_cast<double>(attribute[layout.low]);
  }
  return hn::Load(Doubles(), value);
}

void MakePlanes(const ShadedVertices& vertices, const WindowTransform& window, PlaneJob& job) {
  const Doubles d;
  const size_t stride = vertices.layout.stride();
  job.usable = 0;
  for (int i = 0; i < static_cast<int>(job.count); i += kDoubleLanes) {
    const SortedCorners sorted(job, i);
    const float* at[3][kDoubleLanes];
    bool back[kDoubleLanes];
    alignas(64) int32_t anchor_x[kDoubleLanes], anchor_y[kDoubleLanes];
    for (int k = 0; k < kDoubleLanes; ++k) {
      const auto lane = static_cast<uint32_t>(i + k) < job.count ? static_cast<uint32_t>(i + k) : 0;
      for (int c = 0; c < 3; ++c) {
        const uint32_t vertex = job.v[lane][static_cast<int>(sorted.index[c][k])];
        at[c][k] = reinterpret_cast<const float*>(HeadOf(vertices, stride, vertex) + 1);
      }
      back[k] = job.back[lane];
      anchor_x[k] = job.planes[i + k].x0 = job.anchor_x[lane];
      anchor_y[k] = job.planes[i + k].y0 = job.anchor_y[lane];
    }
    const Adjugate inverse(sorted.corner, window, hn::PromoteTo(d, hn::Load(Ints(), anchor_x)),
                           hn::PromoteTo(d, hn::Load(Ints(), anchor_y)));
    Mask usable = inverse.usable;
    const auto take = [&](const PlaneVectors& plane, int which) HWY_ATTR {
      usable = hn::And(usable, plane.IsFinite());
      StorePlane(plane, which, i, job);
    };
    // z / w is linear in the window; depth is that, scaled and moved by the depth range.
    const PlaneVectors z = inverse.Combine(sorted.corner[0].z, sorted.corner[1].z, sorted.corner[2].z);
    const VD depth_scale = All(window.depth_scale);
    take({hn::Add(hn::Mul(z.f0, depth_scale), All(window.depth_offset)), hn::Mul(z.dfdx, depth_scale),
          hn::Mul(z.dfdy, depth_scale)},
         0);
    take(inverse.Combine(All(1.0), All(1.0), All(1.0)), 1);
    for (int a = 0; a < vertices.layout.attribute_count; ++a)
      take(inverse.Combine(AttributeAt(vertices, at[0], back, a), AttributeAt(vertices, at[1], back, a),
                           AttributeAt(vertices, at[2], back, a)),
           2 + a);
    job.usable |= LaneBits(usable) << i;
  }
}

TriangleCutFunctions TriangleCuts() { return {&CutAtDepth, &MakePlanes}; }

}  // namespace HWY_NAMESPACE
}  // namespace halfspace::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace halfspace::raster {
TriangleCutFunctions triangle_cut_functions() { HALFSPACE_SELECT(TriangleCuts) }
}  // namespace halfspace::raster
#endif
