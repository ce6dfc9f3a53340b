// Planes of what was cut, as set-up takes them: made once, when it is cut. They are those of the whole primitive, there
// already. Compiled once per ISA level.

// Of up to eight pieces. A triangle's planes are moved to its own corner where 1/w is least, since floats round least
// where they start from; whether floats do is then decided by the bounds at its own corners, as for whole triangles. Cut
// lines and points take doubles, and so do smooth triangles.
class CutPlanes {
 public:
  HWY_INLINE CutPlanes(const VertexLayout& layout, bool triangles, const PlaneSource* const* sources, int count)
      : layout_(layout), triangles_(triangles) {
    for (int lane = 0; lane < kSetupLanes; ++lane) source_[lane] = sources[lane < count ? lane : 0];
  }

  // The planes, of pieces whose corners are `in`'s. Anchors are those of the whole picture's first pixel.
  HWY_INLINE void Move(const SetupInput& in, SetupBatch& out) {
    for (int i = 0; i < kSetupLanes; i += kDoubleLanes) MoveGroup(in, i, out);
    memset(out.variant, kDouble, sizeof out.variant);
  }

  // Which of the triangles floats do for.
  HWY_INLINE void Judge(const FragmentParams& params, SetupBatch& out) const {
    if (!triangles_ || layout_.projective || params.plane_rule == PlaneRule::in_double) return;
    for (int i = 0; i < kSetupLanes; i += kDoubleLanes) JudgeGroup(params, i, out);
  }

 private:
  struct Places {
    VD x, y;  // 16.8
  };
  static HWY_INLINE VD Pixels(VD distance) { return hn::Mul(distance, hn::Set(DD(), 1.0 / kSubpixelScale)); }

  // A double of each lane's source.
  template <class Of>
  HWY_INLINE VD Gather(int i, Of of) const {
    const DD d;
    VD all = hn::Set(d, of(*source_[i]));
    for (int k = 1; k < kDoubleLanes; ++k)
      all = hn::IfThenElse(Lanes(1u << k, 0), hn::Set(d, of(*source_[i + k])), all);
    return all;
  }

  struct Planes {
    VD f0, dfdx, dfdy;
    HWY_INLINE VD At(VD x, VD y) const { return hn::Add(hn::Add(f0, hn::Mul(dfdy, y)), hn::Mul(dfdx, x)); }
  };
  HWY_INLINE Planes PlanesOf(int plane, int i) const {
    return {Gather(i, [plane](const PlaneSource& s) HWY_ATTR { return s.planes[plane].f0; }),
            Gather(i, [plane](const PlaneSource& s) HWY_ATTR { return s.planes[plane].dfdx; }),
            Gather(i, [plane](const PlaneSource& s) HWY_ATTR { return s.planes[plane].dfdy; })};
  }

  // Of the corners where 1/w is least the lowest, then leftmost.
  static HWY_INLINE Places Farthest(const Places corner[3], const Planes& inv_w, const Places& from) {
    Places place{};
    VD least{};
    for (int k = 0; k < 3; ++k) {
      const Places& at = corner[k];
      const VD value = inv_w.At(Pixels(hn::Sub(at.x, from.x)), Pixels(hn::Sub(at.y, from.y)));
      if (k == 0) {
        place = at, least = value;
        continue;
      }
      const auto lower = hn::Or(hn::Lt(at.y, place.y), hn::And(hn::Eq(at.y, place.y), hn::Lt(at.x, place.x)));
      const auto take = hn::Or(hn::Lt(value, least), hn::And(hn::Eq(value, least), lower));
      place = {hn::IfThenElse(take, at.x, place.x), hn::IfThenElse(take, at.y, place.y)};
      least = hn::IfThenElse(take, value, least);
    }
    return place;
  }

  HWY_NOINLINE void MoveGroup(const SetupInput& in, int i, SetupBatch& out) {
    const DD d;
    const DDi di;
    const VD words = Gather(i, [](const PlaneSource& s) HWY_ATTR {
      double word;  // x0 and y0
      memcpy(&word, &s.x0, sizeof word);
      return word;
    });
    static_assert(offsetof(PlaneSource, y0) == offsetof(PlaneSource, x0) + sizeof(int32_t));
    const Places from{hn::PromoteTo(d, LowHalf(di, words)), hn::PromoteTo(d, HighHalf(di, words))};
    Places corner[3];
    for (int k = 0; k < 3; ++k)
      corner[k] = {hn::PromoteTo(d, hn::Load(di, in.x[k] + i)), hn::PromoteTo(d, hn::Load(di, in.y[k] + i))};
    const Planes inv_w = PlanesOf(1, i);
    const Places anchor = triangles_ ? Farthest(corner, inv_w, from) : from;
    for (int k = 0; k < 3; ++k) {
      hn::Store(Pixels(hn::Sub(corner[k].x, anchor.x)), d, x_[k] + i);
      hn::Store(Pixels(hn::Sub(corner[k].y, anchor.y)), d, y_[k] + i);
    }
    const VD dx = Pixels(hn::Sub(anchor.x, from.x)), dy = Pixels(hn::Sub(anchor.y, from.y));
    for (int p = 0; p < 2 + layout_.attribute_count; ++p) {
      const Planes plane = p == 1 ? inv_w : PlanesOf(p, i);
      const bool color = layout_.color >= 0 && p >= 2 + layout_.color && p < 6 + layout_.color;
      const VD scale = hn::Set(d, p == 0 ? kDepthScale : (color ? 255.0 : 1.0));
      // Truncation then rounds depth to nearest.
      hn::Store(hn::Add(hn::Mul(plane.At(dx, dy), scale), hn::Set(d, p == 0 ? 0.5 : 0.0)), d, out.f0[p] + i);
      hn::Store(hn::Mul(plane.dfdx, scale), d, out.dfdx[p] + i);
      hn::Store(hn::Mul(plane.dfdy, scale), d, out.dfdy[p] + i);
    }
    hn::Store(Pixels(hn::Neg(anchor.x)), d, out.anchor_x + i);
    hn::Store(Pixels(hn::Neg(anchor.y)), d, out.anchor_y + i);
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
    hn::Store(hn::IfThenElseZero(bounds.fails, hn::Set(d, static_cast<double>(kDouble))), d, fails);
    for (int k = 0; k < kDoubleLanes; ++k) out.variant[i + k] = static_cast<uint8_t>(fails[k]);
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
    auto usable = hn::Eq(least, least);
    for (int k = 0; k < 3; ++k) inv_w[k] = at(1, k), usable = hn::And(usable, hn::Ge(inv_w[k], least));
    const Wrap wrap[2] = {params.sampler.wrap_s, params.sampler.wrap_t};
    for (int axis = 0; axis < 2; ++axis) {
      if (wrap[axis] != Wrap::repeat) continue;
      const int plane = 2 + layout_.tex_coord + axis;
      VD value[3];
      for (int k = 0; k < 3; ++k) value[k] = hn::Div(at(plane, k), hn::Max(inv_w[k], least));
      const VD turns = WholeTurns(inv_w, params.level_count > 1, value);
      const auto take = [&](double(&of)[kMaxPlanes][kSetupLanes]) HWY_ATTR {
        const VD off = hn::IfThenElseZero(usable, hn::Mul(turns, hn::Load(d, of[1] + i)));
        hn::Store(hn::Sub(hn::Load(d, of[plane] + i), off), d, of[plane] + i);
      };
      take(out.f0), take(out.dfdx), take(out.dfdy);
    }
  }

  // Of the group that starts at lane i, those whose bits are set.
  static HWY_INLINE hn::Mask<DD> Lanes(unsigned bits, int i) {
    const hn::RebindToUnsigned<DD> words;
    alignas(64) static constexpr uint64_t kBits[8] = {1, 2, 4, 8, 16, 32, 64, 128};
    return hn::RebindMask(DD(), hn::TestBit(hn::Set(words, bits >> i), hn::Load(words, kBits)));
  }

  const VertexLayout& layout_;
  bool triangles_;
  const PlaneSource* source_[kSetupLanes];
  alignas(64) double x_[3][kSetupLanes], y_[3][kSetupLanes];  // corners, pixels from the anchor
};

// What SettlePlanesFunction says.
void SettlePlanes(const DrawRecord& draw, PrimitiveKind kind, const CutTriangle* pieces, const PlaneSource* const* sources,
                  int count, PlaneSource* out) {
  const VertexLayout& layout = draw.vertices.layout;
  const bool triangles = kind == PrimitiveKind::triangle;
  SetupInput in;
  SetupBatch batch;
  for (int lane = 0; lane < kSetupLanes; ++lane) {
    const CutTriangle& piece = pieces[lane < count ? lane : 0];
    for (int k = 0; k < 3; ++k) {
      const int corner = triangles ? k : 0;
      in.x[k][lane] = piece.x[corner], in.y[k][lane] = piece.y[corner];
    }
  }
  const DD d;
  for (int i = 0; triangles && i < kSetupLanes; i += kDoubleLanes) {
    CornerVectors v;
    VD inv_w[3];
    for (int k = 0; k < 3; ++k) {
      v.place_x[k] = hn::Load(DDi(), in.x[k] + i), v.place_y[k] = hn::Load(DDi(), in.y[k] + i);
      v.x[k] = hn::PromoteTo(d, v.place_x[k]), v.y[k] = hn::PromoteTo(d, v.place_y[k]);
      inv_w[k] = hn::Set(d, 1.0);
    }
    const CornerOrder order(v.x, v.y, inv_w);
    order.Apply(v.place_x), order.Apply(v.place_y);
    StorePlaces(v, i, in);
  }
  CutPlanes planes(layout, triangles, sources, count);
  planes.Move(in, batch);
  planes.Judge(draw.program->params, batch);
  for (int lane = 0; lane < count; ++lane) {
    PlaneSource& to = out[lane];
    memcpy(to.x, pieces[lane].x, sizeof to.x);
    memcpy(to.y, pieces[lane].y, sizeof to.y);
    to.x0 = static_cast<int32_t>(-batch.anchor_x[lane] * kSubpixelScale);
    to.y0 = static_cast<int32_t>(-batch.anchor_y[lane] * kSubpixelScale);
    to.provoking = sources[lane]->provoking;
    to.variant = batch.variant[lane];
    for (int p = 0; p < 2 + layout.attribute_count; ++p)
      to.planes[p] = {batch.f0[p][lane], batch.dfdx[p][lane], batch.dfdy[p][lane]};
  }
}

// Settled planes take the place of those that set-up has made.
HWY_INLINE void TakeSettled(const PlaneSource& from, int plane_count, int32_t center_x, int32_t center_y, int lane,
                            SetupBatch& out) {
  constexpr double kPixel = 1.0 / kSubpixelScale;
  out.anchor_x[lane] = static_cast<double>(center_x - from.x0) * kPixel;
  out.anchor_y[lane] = static_cast<double>(center_y - from.y0) * kPixel;
  out.anchor_x_f[lane] = static_cast<float>(out.anchor_x[lane]);
  out.anchor_y_f[lane] = static_cast<float>(out.anchor_y[lane]);
  out.variant[lane] = from.variant;
  for (int p = 0; p < plane_count; ++p) {
    const Plane& plane = from.planes[p];
    out.f0[p][lane] = plane.f0, out.dfdx[p][lane] = plane.dfdx, out.dfdy[p][lane] = plane.dfdy;
    out.f0_f[p][lane] = static_cast<float>(plane.f0);
    out.dfdx_f[p][lane] = static_cast<float>(plane.dfdx), out.dfdy_f[p][lane] = static_cast<float>(plane.dfdy);
  }
}
