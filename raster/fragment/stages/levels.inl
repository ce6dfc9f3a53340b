// Lookups that depend on lambda: magnify or minify, which mip level, one level or two (spec 3.8.8, 3.8.9).

struct ChooseLevel {
  static constexpr bool kKills = false, kPacks = false, kInTiles = true;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int, Lanes& v) {
    const DF d;
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
    const float magnified = p.sampler.mag == p.sampler.min ? 0.0f : -1.0f;
    v.slot[kMipKey] = hn::IfThenElse(magnify, hn::Set(d, magnified), level);
    v.slot[kMipBlend] = hn::IfThenZeroElse(magnify, blend);
  }
};

// kBytes: the draft level's filter.
template <bool kBytes>
struct SampleLevels {
  static constexpr bool kKills = false, kPacks = false, kInTiles = true, kOncePerBlock = true;

  // Where the lookups of a block read that all fall on one level, or between the same two, and are linear: most blocks
  // are such. Found ahead of all loads, so that lookups overlap.
  template <class L>
  struct Once {
    bool uniform = true, blends = false;
    int level = 0;
    alignas(64) int32_t offset[2][kBlockPixels];
    alignas(64) float wu[2][kBlockPixels], wv[2][kBlockPixels];

    HWY_INLINE explicit Once(const BlockContext& c) {
      const DF d;
      if (c.live == 0) return;
      const float key = Keys(c)[__builtin_ctzll(c.live)];
      const VF none = hn::Zero(d);
      VF different = none, blend = none;
      for (int i = 0; i < kBlockPixels; i += kLanes) {
        const MF live = MaskFromBits(c.live >> i & kGroupBits);
        const VF off = hn::Abs(hn::Sub(hn::Load(d, Keys(c) + i), hn::Set(d, key)));
        different = hn::Max(different, hn::IfThenElseZero(live, off));
        blend = hn::Max(blend, hn::IfThenElseZero(live, hn::Load(d, c.slot[kMipBlend] + c.first_slot + i)));
      }
      uniform = hn::AllTrue(d, hn::Eq(different, none)) && IsLinear(*c.params, static_cast<int>(key));
      if (!uniform) return;
      level = LevelOf(static_cast<int>(key));
      blends = !hn::AllTrue(d, hn::Eq(blend, none));
      FindPlaces(c, 0);
      if (blends) FindPlaces(c, 1);
    }

   private:
    static HWY_INLINE const float* Keys(const BlockContext& c) { return c.slot[kMipKey] + c.first_slot; }
    HWY_INLINE void FindPlaces(const BlockContext& c, int n) {
      const DF d;
      const Sampler& sampler = c.params->sampler;
      for (int i = 0; i < kBlockPixels; i += kLanes) {
        const Place place = PlaceOn(c.params->levels[level + n], sampler,
                                    hn::Load(d, c.slot[kS] + c.first_slot + i),
                                    hn::Load(d, c.slot[kT] + c.first_slot + i));
        hn::Store(place.offset, DI(), offset[n] + i);
        hn::Store(place.wu, d, wu[n] + i);
        hn::Store(place.wv, d, wv[n] + i);
      }
    }
  };

  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>& once, int i, Lanes& v) {
    if (!once.uniform) return LookEach(*c.params, v);
    LookPlaced(*c.params, once, 0, i % kBlockPixels, v);
    if (!once.blends) return;
    Lanes next = v;
    LookPlaced(*c.params, once, 1, i % kBlockPixels, next);
    Blend(next, v);
  }

 private:
  static HWY_INLINE Place PlaceOn(const LevelRef& level, const Sampler& sampler, VF s, VF t) {
    return kBytes ? FindPlaceDraft(level, sampler.wrap_s, sampler.wrap_t, s, t)
                  : FindPlace(level, sampler.wrap_s, sampler.wrap_t, s, t);
  }
  static HWY_INLINE void LookPlace(const LevelRef& level, const LaneOffsets& offsets, VF wu, VF wv, Lanes& v) {
    if constexpr (kBytes) LookLinearDraft(level, offsets, wu, wv, v);
    else LookLinear(level, offsets, wu, wv, v);
  }
  static HWY_INLINE int LevelOf(int key) { return key < 0 ? 0 : key; }
  static HWY_INLINE bool IsLinear(const FragmentParams& p, int key) {
    return (key < 0 ? p.sampler.mag : p.sampler.min) == Filter::linear;
  }

  template <class Places>
  static HWY_INLINE void LookPlaced(const FragmentParams& p, const Places& places, int n, int i, Lanes& v) {
    const DF d;
    LookPlace(p.levels[places.level + n], LaneOffsets(places.offset[n] + i), hn::Load(d, places.wu[n] + i),
               hn::Load(d, places.wv[n] + i), v);
  }

  static HWY_INLINE void Blend(const Lanes& next, Lanes& v) {
    for (int k = kTexR; k <= kTexA; ++k)
      v.slot[k] = hn::Add(v.slot[k], hn::Mul(hn::Sub(next.slot[k], v.slot[k]), v.slot[kMipBlend]));
  }

  // A lookup for each level that some live lane wants.
  static HWY_NOINLINE void LookEach(const FragmentParams& p, Lanes& v) {
    const DF d;
    alignas(64) float keys[kMaxLanes];
    hn::Store(v.slot[kMipKey], d, keys);
    for (unsigned todo = MaskBits(v.live); todo != 0;) {
      const float key = keys[__builtin_ctz(todo)];
      const MF here = hn::Eq(v.slot[kMipKey], hn::Set(d, key));
      Lanes texels = v;
      Look(p, static_cast<int>(key), texels);
      for (int k = kTexR; k <= kTexA; ++k) v.slot[k] = hn::IfThenElse(here, texels.slot[k], v.slot[k]);
      todo &= ~MaskBits(here);
    }
  }

  // All lanes on the key's level, and on the one after where some blend the two.
  static HWY_INLINE void Look(const FragmentParams& p, int key, Lanes& v) {
    const int level = LevelOf(key);
    LookAt(p, level, IsLinear(p, key), v);
    if (p.sampler.mip != MipMode::linear || key < 0 || level + 1 >= p.level_count) return;
    Lanes next = v;
    LookAt(p, level + 1, IsLinear(p, key), next);
    Blend(next, v);
  }

  static HWY_INLINE void LookAt(const FragmentParams& p, int index, bool linear, Lanes& v) {
    const LevelRef& level = p.levels[index];
    if (!linear) {
      const LaneOffsets offsets(NearestOffset(level, p.sampler, v.slot[kS], v.slot[kT]));
      return UnpackTexels(LoadTexels(offsets, level.texels), v);
    }
    const Place place = PlaceOn(level, p.sampler, v.slot[kS], v.slot[kT]);
    LookPlace(level, LaneOffsets(place.offset), place.wu, place.wv, v);
  }
};
