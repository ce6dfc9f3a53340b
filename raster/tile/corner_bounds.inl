// Set-up: whether floats do where PlaneMaker's bounds do not say so. Compiled once per ISA level.

inline constexpr double kLeastNormal = 0x1p-100;  // 1/w of which floats are normal numbers

// A second look at primitives that the bounds of PlaneMaker take for too large for floats: the same roundings, but at
// each corner against 1/w at that very corner. A bound is largest at a corner, since it is convex and 1/w linear.
struct CornerBounds {
  VD x[3], y[3], spread[3];  // of each snapped corner: the way from the anchor, pixels; w, 1 where it is constant
  VD w_error;                // of 1/w in float, in parts of it
  hn::Mask<DD> fails;

  // at_x, at_y: x and y; `affine`: where w is constant, as planes are made.
  HWY_INLINE CornerBounds(const VD at_x[3], const VD at_y[3], hn::Mask<DD> affine, int i, const SetupBatch& out) {
    const DD d;
    const VD one = hn::Set(d, 1.0);
    hn::Mask<DD> normal = hn::Eq(one, one);
    for (int k = 0; k < 3; ++k) x[k] = at_x[k], y[k] = at_y[k], spread[k] = one;
    for (int k = 0; k < 3; ++k) {
      const VD inv_w = Largest(1, k, i, out).value;
      normal = hn::And(normal, hn::Ge(inv_w, hn::Set(d, kLeastNormal)));
      spread[k] = hn::Div(one, hn::IfThenElse(affine, one, inv_w));
    }
    w_error = hn::Zero(d);
    for (int k = 0; k < 3; ++k) w_error = hn::Max(w_error, Largest(1, k, i, out).error);
    w_error = hn::IfThenZeroElse(affine, w_error);
    const auto near = hn::And(normal, hn::Le(w_error, hn::Set(d, 1.0 / 256)));
    fails = hn::Not(hn::Or(affine, near));
  }

  // All planes but depth.
  HWY_INLINE void CheckAttributes(const VertexLayout& layout, const FragmentParams& params, hn::Mask<DD> affine, int i,
                                  const SetupBatch& out) {
    const DD d;
    for (int k = 0; layout.color >= 0 && k < 4; ++k)
      Check(2 + layout.color + k, hn::Set(d, kCloseLook * kColorTolerance), i, out);
    if (layout.tex_coord >= 0) {
      // Down to a level of one texel, and by each pixel's own lambda.
      const LevelRef& last = params.levels[params.level_count - 1];
      const bool mips = params.level_count > 1 && last.width_i == 1 && last.height_i == 1 && !params.one_lambda;
      const VD reach = mips ? ReachOfMips(layout, params, affine, i, out) : hn::Zero(d);
      const double size[2] = {static_cast<double>(params.levels[0].width), static_cast<double>(params.levels[0].height)};
      for (int axis = 0; axis < 2; ++axis)
        Check(2 + layout.tex_coord + axis, hn::Set(d, kCloseLook * kTexelTolerance / size[axis]), i, out,
              mips ? &reach : nullptr);
    }
    if (layout.fog >= 0)
      Check(2 + layout.fog, hn::Set(d, kCloseLook * kColorTolerance * params.fog.level_span), i, out);
  }

 private:
  // The tolerance holds everywhere, or, where there is a `reach`, as many times as much does by way of 1/w: error / w <=
  // reach * tolerance.
  HWY_INLINE void Check(int plane, VD tolerance, int i, const SetupBatch& out, const VD* reach = nullptr) {
    const DD d;
    VD error = hn::Zero(d), value = hn::Zero(d), by_w = hn::Zero(d);
    const VD quotient = hn::Add(w_error, hn::Set(d, 2 * kRounding));
    for (int k = 0; k < 3; ++k) {
      const Corner corner = Largest(plane, k, i, out);
      error = hn::Max(error, corner.error);
      value = hn::Max(value, hn::Abs(corner.value));
      if (reach == nullptr) continue;
      const VD sum = hn::Add(corner.error, hn::Mul(hn::Abs(corner.value), quotient));
      by_w = hn::Max(by_w, hn::Div(sum, spread[k]));
    }
    auto holds = hn::Le(hn::Add(error, hn::Mul(value, quotient)), tolerance);
    if (reach != nullptr) holds = hn::Or(holds, hn::Le(by_w, hn::Mul(tolerance, *reach)));
    fails = hn::Or(fails, hn::Not(holds));
  }

  // Texels are larger than those of level 0 where mip levels are looked up. With rho = g w^2, g its least numerator, a
  // level's texel is at least max(1, rho / 2) >= sqrt(g / 2) w texels of level 0: this is the root.
  HWY_INLINE VD ReachOfMips(const VertexLayout& layout, const FragmentParams& params, hn::Mask<DD> affine, int i,
                            const SetupBatch& out) const {
    const DD d;
    const VD q = hn::IfThenElse(affine, hn::Set(d, 1.0), hn::Load(d, out.f0[1] + i));
    const VD qx = hn::IfThenZeroElse(affine, hn::Load(d, out.dfdx[1] + i));
    const VD qy = hn::IfThenZeroElse(affine, hn::Load(d, out.dfdy[1] + i));
    VD along_x[2], along_y[2], twist[2], back[2];
    for (int axis = 0; axis < 2; ++axis) {
      const int plane = 2 + layout.tex_coord + axis;
      const VD size = hn::Set(d, params.lod_scale[axis]);
      const VD s = hn::Mul(hn::Load(d, out.f0[plane] + i), size);
      const VD sx = hn::Mul(hn::Load(d, out.dfdx[plane] + i), size), sy = hn::Mul(hn::Load(d, out.dfdy[plane] + i), size);
      along_x[axis] = hn::Sub(hn::Mul(sx, q), hn::Mul(qx, s));
      along_y[axis] = hn::Sub(hn::Mul(sy, q), hn::Mul(qy, s));
      twist[axis] = hn::Sub(hn::Mul(sx, qy), hn::Mul(qx, sy));
      back[axis] = hn::Neg(twist[axis]);
    }
    const VD squared = hn::Max(LeastSquare(along_x, twist, y), LeastSquare(along_y, back, x));
    return hn::Sqrt(hn::Mul(hn::Sqrt(squared), hn::Set(d, 1 / 2.05)));
  }

  // The least square of first + step * at, a vector of two, for `at` within the range of three values.
  static HWY_INLINE VD LeastSquare(const VD first[2], const VD step[2], const VD at[3]) {
    const DD d;
    const VD from = hn::Min(hn::Min(at[0], at[1]), at[2]), to = hn::Max(hn::Max(at[0], at[1]), at[2]);
    const VD along = hn::Add(hn::Mul(first[0], step[0]), hn::Mul(first[1], step[1]));
    const VD length = hn::Add(hn::Mul(step[0], step[0]), hn::Mul(step[1], step[1]));
    const auto turns = hn::Gt(length, hn::Zero(d));
    const VD foot = hn::IfThenElseZero(turns, hn::Div(hn::Neg(along), hn::IfThenElse(turns, length, hn::Set(d, 1.0))));
    const VD nearest = hn::Min(hn::Max(foot, from), to);
    const VD a = hn::Add(first[0], hn::Mul(step[0], nearest)), b = hn::Add(first[1], hn::Mul(step[1], nearest));
    return hn::Add(hn::Mul(a, a), hn::Mul(b, b));
  }

  struct Corner {
    VD value, error;  // both times w
  };
  HWY_INLINE Corner Largest(int plane, int k, int i, const SetupBatch& out) const {
    const DD d;
    const VD f0 = hn::Load(d, out.f0[plane] + i);
    const VD across = hn::Mul(hn::Load(d, out.dfdx[plane] + i), x[k]);
    const VD up = hn::Mul(hn::Load(d, out.dfdy[plane] + i), y[k]);
    const VD row = hn::Add(f0, up), value = hn::Add(row, across);
    const VD steps = hn::Mul(hn::Add(hn::Abs(across), hn::Abs(up)), hn::Set(d, 2.0));
    const VD sums = hn::Add(hn::Abs(f0), hn::Add(hn::Abs(row), hn::Abs(value)));
    return {hn::Mul(value, spread[k]), hn::Mul(hn::Mul(hn::Add(sums, steps), hn::Set(d, kRounding)), spread[k])};
  }
};

HWY_NOINLINE void LookCloser(const VertexLayout& layout, const FragmentParams& params, const CornerVectors& v, int i,
                             const SetupBatch& out, PlaneMaker& maker) {
  const VD pixel = hn::Set(DD(), 1.0 / kSubpixelScale);
  VD x[3], y[3];
  for (int k = 0; k < 3; ++k) {
    x[k] = hn::Mul(hn::Sub(v.x[k], v.x[0]), pixel);
    y[k] = hn::Mul(hn::Sub(v.y[k], v.y[0]), pixel);
  }
  CornerBounds bounds(x, y, maker.affine, i, out);
  bounds.CheckAttributes(layout, params, maker.affine, i, out);
  maker.needs_double = hn::And(maker.needs_double, bounds.fails);
}
