// Lookups that depend on lambda: magnify or minify, which mip level, one level or two (spec 3.8.8, 3.8.9).

// A level per lane: what differs between the lanes of a group is gathered here by plain loads.
struct LaneLevels {
  alignas(64) float width[kMaxLanes], height[kMaxLanes];
  alignas(64) int32_t width_i[kMaxLanes], height_i[kMaxLanes], pitch[kMaxLanes];
  const uint32_t* texels[kMaxLanes];

  HWY_INLINE LaneLevels(const FragmentParams& params, VI level) {
    alignas(64) int32_t index[kMaxLanes];
    hn::Store(level, DI(), index);
    for (int j = 0; j < kLanes; ++j) {
      const LevelRef& l = params.levels[index[j]];
      width[j] = l.width;
      height[j] = l.height;
      width_i[j] = l.width_i;
      height_i[j] = l.height_i;
      pitch[j] = l.pitch;
      texels[j] = l.texels;
    }
  }
};

struct SampleLevels {
  static constexpr bool kKills = false, kPacks = false;

  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int, Lanes& v) {
    const DF d;
    const DI di;
    const FragmentParams& p = *c.params;
    const VF lambda = v.slot[kLambda];
    const MF magnify = hn::Le(lambda, hn::Set(d, p.magnify_below));
    const VF last = hn::Set(d, static_cast<float>(p.level_count - 1));
    const VF clamped = hn::Min(hn::Max(lambda, hn::Zero(d)), last);
    VF level = hn::Zero(d), blend = hn::Zero(d);
    if (p.sampler.mip == MipMode::nearest) {
      // d = ceil(lambda + 1/2) - 1, level 0 for lambda <= 1/2.
      const VF up = hn::Sub(hn::Ceil(hn::Add(clamped, hn::Set(d, 0.5f))), hn::Set(d, 1.0f));
      level = hn::Min(hn::Max(up, hn::Zero(d)), last);
    } else if (p.sampler.mip == MipMode::linear) {
      level = hn::Floor(clamped);
      blend = hn::Sub(clamped, level);
    }
    level = hn::IfThenZeroElse(magnify, level);
    blend = hn::IfThenZeroElse(magnify, blend);
    Look(p, hn::ConvertTo(di, level), magnify, v);
    if (p.sampler.mip != MipMode::linear || hn::AllTrue(d, hn::Eq(blend, hn::Zero(d)))) return;
    Lanes next = v;
    Look(p, hn::ConvertTo(di, hn::Min(hn::Add(level, hn::Set(d, 1.0f)), last)), magnify, next);
    for (int k = kTexR; k <= kTexA; ++k)
      v.slot[k] = hn::Add(v.slot[k], hn::Mul(hn::Sub(next.slot[k], v.slot[k]), blend));
  }

 private:
  // One level a lane, by the magnification or the minification filter as the lane calls for.
  static HWY_INLINE void Look(const FragmentParams& p, VI level, MF magnify, Lanes& v) {
    const DF d;
    const bool mag_linear = p.sampler.mag == Filter::linear, min_linear = p.sampler.min == Filter::linear;
    const MF all = hn::Eq(hn::Zero(d), hn::Zero(d));
    const MF linear = mag_linear == min_linear ? (mag_linear ? all : hn::Not(all))
                                               : (mag_linear ? magnify : hn::Not(magnify));
    const LaneLevels levels(p, level);
    Lanes nearest = v;
    const bool some_linear = !hn::AllFalse(d, linear), some_nearest = !hn::AllTrue(d, linear);
    if (some_linear) Linear(p, levels, v);
    if (!some_nearest) return;
    Nearest(p, levels, nearest);
    for (int k = kTexR; k <= kTexA; ++k)
      v.slot[k] = some_linear ? hn::IfThenElse(linear, v.slot[k], nearest.slot[k]) : nearest.slot[k];
  }

  static HWY_INLINE void Nearest(const FragmentParams& p, const LaneLevels& l, Lanes& v) {
    const DF d;
    const DI di;
    const VF u = NearestTexel(v.slot[kS], hn::Load(d, l.width), p.sampler.wrap_s);
    const VF t = NearestTexel(v.slot[kT], hn::Load(d, l.height), p.sampler.wrap_t);
    alignas(64) int32_t x[kMaxLanes], y[kMaxLanes];
    alignas(64) uint32_t texels[kMaxLanes];
    hn::Store(TexelIndex(u, hn::Load(di, l.width_i), 0), di, x);
    hn::Store(TexelIndex(t, hn::Load(di, l.height_i), 0), di, y);
    for (int j = 0; j < kLanes; ++j) texels[j] = l.texels[j][(y[j] + 1) * l.pitch[j] + x[j] + 1];
    UnpackTexels(hn::Load(DU(), texels), v);
  }

  static HWY_INLINE void Linear(const FragmentParams& p, const LaneLevels& l, Lanes& v) {
    const DF d;
    const DI di;
    const VF u = TexelCoord(v.slot[kS], hn::Load(d, l.width), p.sampler.wrap_s, 0.5f);
    const VF t = TexelCoord(v.slot[kT], hn::Load(d, l.height), p.sampler.wrap_t, 0.5f);
    const VF u0 = hn::Floor(u), t0 = hn::Floor(t);
    alignas(64) int32_t x[kMaxLanes], y[kMaxLanes];
    hn::Store(TexelIndex(u0, hn::Load(di, l.width_i), -1), di, x);
    hn::Store(TexelIndex(t0, hn::Load(di, l.height_i), -1), di, y);
    const uint32_t* low[kMaxLanes];
    for (int j = 0; j < kLanes; ++j) low[j] = l.texels[j] + (y[j] + 1) * l.pitch[j] + x[j] + 1;
    Bilinear([&](int j) HWY_ATTR { return low[j]; }, [&](int j) HWY_ATTR { return low[j] + l.pitch[j]; },
             hn::Sub(u, u0), hn::Sub(t, t0), false, v);
  }
};
