// Texture lookups at the exact level (spec 3.8.8, 3.8.9): one fragment at a time, in double throughout.

struct ExactTexel {
  double channel[4];
};

// The texel whose lower left corner is (i, j), from -1 to the size.
HWY_INLINE ExactTexel TexelAt(const LevelRef& level, double i, double j) {
  const uint32_t texel = level.texels[(static_cast<int>(j) + 1) * level.pitch + static_cast<int>(i) + 1];
  return {{static_cast<double>(texel & 255u), static_cast<double>(texel >> 8 & 255u),
           static_cast<double>(texel >> 16 & 255u), static_cast<double>(texel >> 24)}};
}

HWY_INLINE ExactTexel MixTexels(const ExactTexel& a, const ExactTexel& b, double weight) {
  ExactTexel out;
  for (int k = 0; k < 4; ++k) out.channel[k] = a.channel[k] + (b.channel[k] - a.channel[k]) * weight;
  return out;
}

// One axis: the index of the (left) texel, and the weight of the one after it.
struct ExactPlace {
  double index, weight;
};

HWY_INLINE double HeldTo(double v, double low, double high) { return !(v > low) ? low : (v < high ? v : high); }

HWY_INLINE ExactPlace PlaceOf(double s, double size, Wrap wrap, Filter filter) {
  if (wrap == Wrap::repeat) s -= __builtin_floor(s);
  double u = s * size;
  if (wrap == Wrap::clamp) u = HeldTo(u, 0, size);
  if (wrap == Wrap::clamp_to_edge) u = HeldTo(u, 0.5, size - 0.5);
  if (filter == Filter::nearest) {
    // The rule of NearestTexel, so that all levels choose alike.
    double index = __builtin_floor(__builtin_floor(u * 1024 + 0.5) / 1024);
    if (wrap == Wrap::repeat && index >= size) index = 0;
    return {HeldTo(index, 0, size - 1), 0};
  }
  u -= 0.5;
  const double index = __builtin_floor(u);
  return {HeldTo(index, -1, size - 1), u - index};
}

HWY_INLINE ExactTexel LookUpExactly(const LevelRef& level, const Sampler& sampler, Filter filter, double s, double t) {
  const ExactPlace x = PlaceOf(s, static_cast<double>(level.width), sampler.wrap_s, filter);
  const ExactPlace y = PlaceOf(t, static_cast<double>(level.height), sampler.wrap_t, filter);
  if (filter == Filter::nearest) return TexelAt(level, x.index, y.index);
  const ExactTexel low = MixTexels(TexelAt(level, x.index, y.index), TexelAt(level, x.index + 1, y.index), x.weight);
  const ExactTexel high =
      MixTexels(TexelAt(level, x.index, y.index + 1), TexelAt(level, x.index + 1, y.index + 1), x.weight);
  return MixTexels(low, high, y.weight);
}

// As SampleLevels chooses them.
HWY_INLINE ExactTexel LookUpLevels(const FragmentParams& p, double s, double t, double lambda) {
  const Sampler& sampler = p.sampler;
  if (!(lambda > static_cast<double>(p.magnify_below)))
    return LookUpExactly(p.levels[0], sampler, sampler.mag, s, t);
  const double last = p.level_count - 1;
  const double held = HeldTo(lambda, 0, last);
  if (sampler.mip == MipMode::none) return LookUpExactly(p.levels[0], sampler, sampler.min, s, t);
  if (sampler.mip == MipMode::nearest) {
    const double level = HeldTo(__builtin_ceil(held + 0.5) - 1, 0, last);
    return LookUpExactly(p.levels[static_cast<int>(level)], sampler, sampler.min, s, t);
  }
  const double level = __builtin_floor(held), weight = held - level;
  const ExactTexel near = LookUpExactly(p.levels[static_cast<int>(level)], sampler, sampler.min, s, t);
  if (weight == 0) return near;
  const ExactTexel far = LookUpExactly(p.levels[static_cast<int>(level) + 1], sampler, sampler.min, s, t);
  return MixTexels(near, far, weight);
}

// kLevels: lambda has been worked out.
template <bool kLevels>
struct SampleExact {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int, Lanes& v) {
    const FragmentParams& p = *c.params;
    alignas(64) double s[kMaxLanes], t[kMaxLanes], lambda[kMaxLanes] = {};
    alignas(64) double out[4][kMaxLanes] = {};
    StoreWide(GetWide(v, kS, IsWide(c)), s);
    StoreWide(GetWide(v, kT, IsWide(c)), t);
    if constexpr (kLevels) StoreWide(GetWide(v, kLambda, HasWideLambda(c)), lambda);
    for (unsigned todo = MaskBits(v.live); todo != 0; todo &= todo - 1) {
      const int j = __builtin_ctz(todo);
      const ExactTexel texel = kLevels ? LookUpLevels(p, s[j], t[j], lambda[j])
                                       : LookUpExactly(p.levels[0], p.sampler, p.sampler.mag, s[j], t[j]);
      for (int k = 0; k < 4; ++k) out[k][j] = texel.channel[k];
    }
    for (int k = 0; k < 4; ++k) PutWide(LoadWide(out[k]), kTexR + k, v);
  }
};
