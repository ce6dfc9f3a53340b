// Evaluating maps. All arithmetic is in double and rounds to float once at the end: the error is below an ulp
// of the largest control point's float, for every order up to kMaxEvalOrder inside the domain.
#include <cmath>
#include <cstring>

#include "state/context.h"
#include "state/evaluator.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace {

// The Bernstein polynomials of an axis at one coordinate, and their derivatives by the coordinate's 0 .. 1.
struct Basis {
  int order;
  double value[kMaxEvalOrder], slope[kMaxEvalOrder];
};

// Raises the degree by one: B(i, n) = (1 - t) B(i, n - 1) + t B(i - 1, n - 1). Inside the domain only
// positive terms are added, so that nothing cancels.
void raise(double* value, int order, double t) {
  value[order] = t * value[order - 1];
  for (int i = order - 1; i > 0; --i) value[i] = (1 - t) * value[i] + t * value[i - 1];
  value[0] *= 1 - t;
}

void make_basis(const MapAxis& axis, double coordinate, Basis& basis) {
  const double t = (coordinate - axis.low) / (axis.high - axis.low);
  const int degree = axis.order - 1;
  basis.order = axis.order;
  double* b = basis.value;
  b[0] = 1;
  for (int order = 1; order < degree; ++order) raise(b, order, t);
  // b holds the polynomials of one degree less, whose differences are the slopes.
  for (int i = 0; i <= degree; ++i) {
    const double left = i > 0 ? b[i - 1] : 0, right = i < degree ? b[i] : 0;
    basis.slope[i] = degree * (left - right);
  }
  if (degree > 0) raise(b, degree, t);
}

// sum of weights[i] * points[i * stride ...], `components` numbers.
void weigh(const double* weights, int count, const float* points, size_t stride, size_t components,
           double* out) {
  for (size_t k = 0; k < components; ++k) {
    double sum = 0;
    for (int i = 0; i < count; ++i) sum += weights[i] * double(points[size_t(i) * stride + k]);
    out[k] = sum;
  }
}

struct Point {
  double v[4] = {0, 0, 0, 1};
};

Point evaluate(const Map1& map, size_t components, double u) {
  Basis basis;
  make_basis(map.u, u, basis);
  Point point;
  weigh(basis.value, basis.order, map.points.data(), components, components, point.v);
  return point;
}

// `u`, `v`: weights by value or by slope.
Point weigh2(const Map2& map, size_t components, const double* u, const double* v) {
  Point point;
  for (size_t k = 0; k < components; ++k) point.v[k] = 0;
  const size_t row = size_t(map.v.order) * components;
  for (int i = 0; i < map.u.order; ++i) {
    double inner[4];
    weigh(v, map.v.order, map.points.data() + size_t(i) * row, components, components, inner);
    for (size_t k = 0; k < components; ++k) point.v[k] += u[i] * inner[k];
  }
  return point;
}

struct Bases {
  Basis u, v;
  Bases(const Map2& map, double u_coordinate, double v_coordinate) {
    make_basis(map.u, u_coordinate, u);
    make_basis(map.v, v_coordinate, v);
  }
};

Point evaluate(const Map2& map, size_t components, double u, double v) {
  const Bases bases(map, u, v);
  return weigh2(map, components, bases.u.value, bases.v.value);
}

// The slope of (x, y, z) / w, times w squared.
void projected_slope(const Point& p, const Point& slope, double out[3]) {
  for (int k = 0; k < 3; ++k) out[k] = slope.v[k] * p.v[3] - p.v[k] * slope.v[3];
}

// Spec 5.1: the normalised cross product of the two slopes. Where there is none, zeros.
void automatic_normal(const Map2& map, bool rational, const Bases& bases, const Point& p, float out[3]) {
  const size_t components = rational ? 4 : 3;
  Point by_u = weigh2(map, components, bases.u.slope, bases.v.value);
  Point by_v = weigh2(map, components, bases.u.value, bases.v.slope);
  if (!rational) by_u.v[3] = by_v.v[3] = 0;
  double a[3], b[3];
  projected_slope(p, by_u, a);
  projected_slope(p, by_v, b);
  // The slopes are by 0 .. 1: a domain that runs backwards turns them around.
  const double sign = (map.u.high < map.u.low) != (map.v.high < map.v.low) ? -1 : 1;
  const double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (int k = 0; k < 3; ++k) out[k] = length > 0 ? float(sign * n[k] / length) : 0.0f;
}

// The highest of the texture coordinate maps counts, and GL_MAP_VERTEX_4 before 3 (spec 5.1). kMapKinds:
// none.
size_t tex_coord_kind(const std::array<bool, kMapKinds>& enabled) {
  for (size_t kind = kMapTexCoord4; kind >= kMapTexCoord1; --kind) {
    if (enabled[kind]) return kind;
  }
  return kMapKinds;
}

size_t vertex_kind(const std::array<bool, kMapKinds>& enabled) {
  if (enabled[kMapVertex4]) return kMapVertex4;
  return enabled[kMapVertex3] ? size_t{kMapVertex3} : kMapKinds;
}

// What is evaluated holds for the one vertex; the current values stay (spec 5.1).
class CurrentValuesKept {
 public:
  explicit CurrentValuesKept(Context& context) : context_(context), values_(context.current) {}
  ~CurrentValuesKept() {
    const CurrentState& v = values_;
    op::color(context_, v.color[0], v.color[1], v.color[2], v.color[3]);
    std::memcpy(context_.current.normal, v.normal, sizeof v.normal);
    std::memcpy(context_.current.tex_coord, v.tex_coord, sizeof v.tex_coord);
  }
  CurrentValuesKept(const CurrentValuesKept&) = delete;
  CurrentValuesKept& operator=(const CurrentValuesKept&) = delete;

 private:
  Context& context_;
  const CurrentState values_;
};

void set_attribute(Context& context, size_t kind, const Point& p) {
  const float v[4] = {float(p.v[0]), float(p.v[1]), float(p.v[2]), float(p.v[3])};
  switch (kind) {
    case kMapColor:
      return op::color(context, v[0], v[1], v[2], v[3]);
    case kMapNormal:
      return op::normal(context, v[0], v[1], v[2]);
    case kMapVertex3:
    case kMapVertex4:
      return op::vertex(context, v[0], v[1], v[2], v[3]);
    default:
      return op::tex_coord(context, v[0], v[1], v[2], v[3]);
  }
}

}  // namespace

void evaluate1(Context& context, double u) {
  const std::array<bool, kMapKinds>& enabled = context.evaluator.map1;
  const size_t vertex = vertex_kind(enabled), tex_coord = tex_coord_kind(enabled);
  if (vertex == kMapKinds) return;
  const CurrentValuesKept kept(context);
  const auto set = [&](size_t kind) {
    set_attribute(context, kind, evaluate(context.maps.map1[kind], kMapComponents[kind], u));
  };
  if (enabled[kMapColor]) set(kMapColor);
  if (enabled[kMapNormal]) set(kMapNormal);
  if (tex_coord < kMapKinds) set(tex_coord);
  set(vertex);
}

void evaluate2(Context& context, double u, double v) {
  const std::array<bool, kMapKinds>& enabled = context.evaluator.map2;
  const size_t vertex = vertex_kind(enabled), tex_coord = tex_coord_kind(enabled);
  if (vertex == kMapKinds) return;
  const CurrentValuesKept kept(context);
  const auto set = [&](size_t kind) {
    set_attribute(context, kind, evaluate(context.maps.map2[kind], kMapComponents[kind], u, v));
  };
  const Map2& map = context.maps.map2[vertex];
  const Bases bases(map, u, v);
  const Point position = weigh2(map, kMapComponents[vertex], bases.u.value, bases.v.value);
  if (enabled[kMapColor]) set(kMapColor);
  if (tex_coord < kMapKinds) set(tex_coord);
  if (context.evaluator.auto_normal) {
    float n[3];
    automatic_normal(map, vertex == kMapVertex4, bases, position, n);
    op::normal(context, n[0], n[1], n[2]);
  } else if (enabled[kMapNormal]) {
    set(kMapNormal);
  }
  set_attribute(context, vertex, position);
}

}  // namespace halfspace::state
