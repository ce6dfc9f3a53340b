// Set-up of cut primitives: their planes are those of the whole primitive, there already. Compiled once per ISA level.

// Of a batch. A triangle's planes are moved to its own corner where 1/w is least, since floats round least where they
// start from; whether floats do is then decided by the bounds at its own corners, as for whole triangles. Cut lines and
// points take doubles.
class CutPlanes {
 public:
  HWY_INLINE CutPlanes(const Segment& segment, const VertexLayout& layout, int32_t center_x, int32_t center_y)
      : segment_(segment), layout_(layout), center_x_(center_x), center_y_(center_y) {}

  HWY_INLINE void Copy(const PrimitiveRef& ref, int lane, SetupBatch& out) {
    const CutTriangle& cut = segment_.cut_triangles.data()[ref.v[0]];
    const PlaneSource& source = segment_.plane_sources.data()[cut.source];
    Place anchor{source.x0, source.y0};
    if (ref.kind == PrimitiveKind::triangle) {
      anchor = Farthest(cut, source);
      for (int k = 0; k < 3; ++k) x_[k][lane] = Pixels(cut.x[k] - anchor.x), y_[k][lane] = Pixels(cut.y[k] - anchor.y);
      triangles_ |= 1u << lane;
    }
    const double dx = Pixels(anchor.x - source.x0), dy = Pixels(anchor.y - source.y0);
    for (int p = 0; p < 2 + layout_.attribute_count; ++p) {
      const bool color = layout_.color >= 0 && p >= 2 + layout_.color && p < 6 + layout_.color;
      const double scale = p == 0 ? kDepthScale : (color ? 255.0 : 1.0);
      const Plane& plane = source.planes[p];
      out.f0[p][lane] = ((plane.f0 + plane.dfdy * dy) + plane.dfdx * dx) * scale + (p == 0 ? 0.5 : 0.0);
      out.dfdx[p][lane] = plane.dfdx * scale;
      out.dfdy[p][lane] = plane.dfdy * scale;
    }
    out.variant[lane] = kDouble;
    out.anchor_x[lane] = Pixels(center_x_ - anchor.x);
    out.anchor_y[lane] = Pixels(center_y_ - anchor.y);
    out.anchor_x_f[lane] = static_cast<float>(out.anchor_x[lane]);
    out.anchor_y_f[lane] = static_cast<float>(out.anchor_y[lane]);
  }

  // Which of the triangles floats do for.
  HWY_INLINE void Judge(const FragmentParams& params, SetupBatch& out) const {
    if (triangles_ == 0 || layout_.projective || params.plane_rule == PlaneRule::in_double) return;
    for (int i = 0; i < kSetupLanes; i += kDoubleLanes)
      if ((triangles_ >> i & ((1u << kDoubleLanes) - 1)) != 0) JudgeGroup(params, i, out);
  }

 private:
  struct Place {
    int32_t x, y;  // 16.8
  };
  static HWY_INLINE double Pixels(int32_t distance) { return distance * (1.0 / kSubpixelScale); }

  // Of several the lowest, then leftmost.
  static HWY_INLINE Place Farthest(const CutTriangle& cut, const PlaneSource& source) {
    const Plane& inv_w = source.planes[1];
    Place place{};
    double least = 0;
    for (int k = 0; k < 3; ++k) {
      const Place at{cut.x[k], cut.y[k]};
      const double value = (inv_w.f0 + inv_w.dfdy * Pixels(at.y - source.y0)) + inv_w.dfdx * Pixels(at.x - source.x0);
      const bool lower = at.y < place.y || (at.y == place.y && at.x < place.x);
      if (k == 0 || value < least || (value == least && lower)) place = at, least = value;
    }
    return place;
  }

  HWY_NOINLINE void JudgeGroup(const FragmentParams& params, int i, SetupBatch& out) const {
    const DD d;
    VD x[3], y[3];
    for (int k = 0; k < 3; ++k) x[k] = hn::Load(d, x_[k] + i), y[k] = hn::Load(d, y_[k] + i);
    if (layout_.tex_coord >= 0) TakeWholeTurns(params, x, y, i, out);
    for (int p = 1; p < 2 + layout_.attribute_count; ++p) {
      const DDf f;
      hn::Store(hn::DemoteTo(f, hn::Load(d, out.f0[p] + i)), f, out.f0_f[p] + i);
      hn::Store(hn::DemoteTo(f, hn::Load(d, out.dfdx[p] + i)), f, out.dfdx_f[p] + i);
      hn::Store(hn::DemoteTo(f, hn::Load(d, out.dfdy[p] + i)), f, out.dfdy_f[p] + i);
    }
    CornerBounds bounds(x, y, NoLane(), i, out);
    bounds.CheckAttributes(layout_, params, NoLane(), i, out);
    alignas(64) double fails[kDoubleLanes];
    hn::Store(hn::IfThenElseZero(bounds.fails, hn::Set(d, 1.0)), d, fails);
    for (int k = 0; k < kDoubleLanes; ++k)
      if ((triangles_ >> (i + k) & 1) != 0 && fails[k] == 0) out.variant[i + k] = 0;
  }

  HWY_INLINE void TakeWholeTurns(const FragmentParams& params, const VD x[3], const VD y[3], int i,
                                 SetupBatch& out) const {
    const DD d;
    const VD least = hn::Set(d, kLeastNormal);
    const auto at = [&](int plane, int k) HWY_ATTR {
      const VD row = hn::Add(hn::Load(d, out.f0[plane] + i), hn::Mul(hn::Load(d, out.dfdy[plane] + i), y[k]));
      return hn::Add(row, hn::Mul(hn::Load(d, out.dfdx[plane] + i), x[k]));
    };
    VD inv_w[3];
    auto usable = CutLanes(i);
    for (int k = 0; k < 3; ++k) inv_w[k] = at(1, k), usable = hn::And(usable, hn::Ge(inv_w[k], least));
    const Wrap wrap[2] = {params.sampler.wrap_s, params.sampler.wrap_t};
    for (int axis = 0; axis < 2; ++axis) {
      if (wrap[axis] != Wrap::repeat) continue;
      const int plane = 2 + layout_.tex_coord + axis;
      VD value[3];
      for (int k = 0; k < 3; ++k) value[k] = hn::Div(at(plane, k), hn::Max(inv_w[k], least));
      const VD turns = hn::IfThenElseZero(usable, WholeTurns(inv_w, params.level_count > 1, value));
      const auto take = [&](double(&of)[kMaxPlanes][kSetupLanes]) HWY_ATTR {
        hn::Store(hn::Sub(hn::Load(d, of[plane] + i), hn::Mul(turns, hn::Load(d, of[1] + i))), d, of[plane] + i);
      };
      take(out.f0), take(out.dfdx), take(out.dfdy);
    }
  }

  HWY_INLINE hn::Mask<DD> CutLanes(int i) const {
    alignas(64) double is_cut[kDoubleLanes];
    for (int k = 0; k < kDoubleLanes; ++k) is_cut[k] = triangles_ >> (i + k) & 1;
    return hn::Ne(hn::Load(DD(), is_cut), hn::Zero(DD()));
  }

  const Segment& segment_;
  const VertexLayout& layout_;
  const int32_t center_x_, center_y_;
  unsigned triangles_ = 0;                                                 // bits of the lanes that are
  alignas(64) double x_[3][kSetupLanes] = {}, y_[3][kSetupLanes] = {};  // their corners, pixels from the anchor
};
