// Lookups that depend on lambda: magnify or minify, which mip level, one level or two (spec 3.8.8, 3.8.9).

struct ChooseLevel {
  static constexpr bool kKills = false, kPacks = false, kInTiles = true;
  template <class L>
  struct Once {
    VF last, magnify_below, magnified;
    MipMode mip;
    HWY_INLINE explicit Once(const BlockContext& c)
        : last(hn::Set(DF(), static_cast<float>(c.params->level_count - 1))),
          magnify_below(hn::Set(DF(), c.params->magnify_below)),
          magnified(hn::Set(DF(), c.params->sampler.mag == c.params->sampler.min ? 0.0f : -1.0f)),
          mip(c.params->sampler.mip) {}
  };
  template <class L>
  static HWY_INLINE void Run(const BlockContext&, const Once<L>& once, int, Lanes& v) {
    const DF d;
    const VF lambda = v.slot[kLambda];
    const MF magnify = hn::Le(lambda, once.magnify_below);
    const VF clamped = HeldBelow(NotNegative(lambda), once.last);
    VF level = hn::Zero(d), blend = hn::Zero(d);
    if (once.mip == MipMode::nearest) {
      // d = ceil(lambda + 1/2) - 1, level 0 for lambda <= 1/2.
      const VF up = hn::Sub(hn::Ceil(hn::Add(clamped, hn::Set(d, 0.5f))), hn::Set(d, 1.0f));
      level = HeldBelow(NotNegative(up), once.last);
    } else if (once.mip == MipMode::linear) {
      level = hn::Floor(clamped);
      blend = hn::Sub(clamped, level);
    }
    v.slot[kMipKey] = hn::IfThenElse(magnify, once.magnified, level);
    v.slot[kMipBlend] = hn::IfThenZeroElse(magnify, blend);
  }
};

// kBytes: the draft level's filter.
template <bool kBytes>
struct SampleLevels {
  static constexpr bool kKills = false, kPacks = false, kInTiles = true, kOncePerBlock = true;
  static constexpr bool kRunsBlocks = kFetchesAhead;

  // Where the lookups of groups read that fall on one level, or between the same two, and are linear: most
  // groups are such. Found ahead of all loads, so that lookups overlap.
  template <class L>
  struct Once {
    static constexpr int kGroups = kBlockPixels / kLanes;
    struct Group {
      const LevelRef* level;  // null: several, or none
      bool blends;
    };
    Group groups[kGroups];
    alignas(64) int32_t offset[2][kBlockPixels];
    alignas(64) float wu[2][kBlockPixels], wv[2][kBlockPixels];

    HWY_INLINE explicit Once(const BlockContext& c) {
      const Sampler& sampler = c.params->sampler;
      if (!kBytes && sampler.wrap_s == Wrap::repeat && sampler.wrap_t == Wrap::repeat)
        FindGroups<true>(c);
      else
        FindGroups<false>(c);
    }

   private:
    template <bool kRepeat>
    HWY_INLINE void FindGroups(const BlockContext& c) {
      const DF d;
      const FragmentParams& p = *c.params;
      const float* const keys = c.slot[kMipKey] + c.first_slot;
      for (int g = 0; g < kGroups; ++g) {
        const int i = g * kLanes;
        const uint64_t live = c.live >> i & kGroupBits;
        groups[g] = {nullptr, false};
        if (live == 0) continue;
        const float key = keys[i + __builtin_ctzll(live)];
        const uint64_t same = MaskBits(hn::Eq(hn::Load(d, keys + i), hn::Set(d, key)));
        if ((live & ~same) != 0 || !IsLinear(p, static_cast<int>(key))) continue;
        const VF blend = hn::Load(d, c.slot[kMipBlend] + c.first_slot + i);
        const uint64_t blended = MaskBits(hn::Ne(blend, hn::Zero(d)));
        groups[g] = {&p.levels[LevelOf(static_cast<int>(key))], (live & blended) != 0};
        VF s = hn::Load(d, c.slot[kS] + c.first_slot + i), t = hn::Load(d, c.slot[kT] + c.first_slot + i);
        if constexpr (kRepeat) s = InOneTurn(s), t = InOneTurn(t);
        for (int n = 0; n <= (groups[g].blends ? 1 : 0); ++n) {
          const LevelRef& level = groups[g].level[n];
          Place place;
          if constexpr (kRepeat)
            place = RepeatedLevel(level).Find(s, t);
          else
            place = PlaceOn(level, p.sampler, s, t);
          hn::Store(place.offset, DI(), offset[n] + i);
          hn::Store(place.wu, d, wu[n] + i);
          hn::Store(place.wv, d, wv[n] + i);
        }
      }
    }
  };

  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>& once, int i, Lanes& v) {
    const int first = i % kBlockPixels;
    const auto& group = once.groups[first / kLanes];
    if (group.level == nullptr) return LookEach(*c.params, v);
    if (IsStacked(c.params->levels[0])) LookUp<true>(group, once, first, v);
    else LookUp<false>(group, once, first, v);
  }

  // A block that is live all over and between levels all over: while a lookup's texels are filtered, the next one's are
  // fetched.
  template <class Places, class Load, class Store>
  static HWY_INLINE bool RunBlock(const BlockContext& c, const Places& once, int first, Load load, Store store) {
    for (const auto& group : once.groups)
      if (!group.blends) return false;
    if (IsStacked(c.params->levels[0])) LookUpBlock<true>(once, first, load, store);
    else LookUpBlock<false>(once, first, load, store);
    return true;
  }

 private:
  template <bool kStacked, class Places, class Load, class Store>
  static HWY_INLINE void LookUpBlock(const Places& once, int first, Load load, Store store) {
    Footprints texels = FetchPlaced<kStacked>(once.groups[0].level[0], once, 0, 0);
    constexpr int kLast = kBlockPixels - kLanes;
    for (int i = 0; i <= kLast; i += kLanes) {
      const LevelRef* const level = once.groups[i / kLanes].level;
      Lanes v;
      load(first + i, v);
      Footprints others;
      LookPlaced(level[0], texels, once, 0, i, v,
                 [&]() HWY_ATTR { others = FetchPlaced<kStacked>(level[1], once, 1, i); });
      Lanes next = v;
      LookPlaced(level[1], others, once, 1, i, next, [&]() HWY_ATTR {
        const int n = i < kLast ? i + kLanes : kLast;
        texels = FetchPlaced<kStacked>(once.groups[n / kLanes].level[0], once, 0, n);
      });
      Blend(next, v);
      store(v, first + i);
    }
  }
  template <bool kStacked, class Group, class Places>
  static HWY_INLINE void LookUp(const Group& group, const Places& places, int i, Lanes& v) {
    const LevelRef* const level = group.level;
    const Footprints texels = FetchPlaced<kStacked>(level[0], places, 0, i);
    if (!group.blends) return LookPlaced(level[0], texels, places, 0, i, v, NothingMeanwhile());
    Footprints others;
    LookPlaced(level[0], texels, places, 0, i, v,
               [&]() HWY_ATTR { others = FetchPlaced<kStacked>(level[1], places, 1, i); });
    Lanes next = v;
    LookPlaced(level[1], others, places, 1, i, next, NothingMeanwhile());
    Blend(next, v);
  }
  template <bool kStacked, class Places>
  static HWY_INLINE Footprints FetchPlaced(const LevelRef& level, const Places& places, int n, int i) {
    return FetchFrom<kStacked>(level, LaneOffsets(places.offset[n] + i));
  }
  template <class Places, class FetchNext>
  static HWY_INLINE void LookPlaced(const LevelRef& level, const Footprints& texels, const Places& places, int n, int i,
                                    Lanes& v, FetchNext fetch_next) {
    const DF d;
    LookPlace(level, texels, hn::Load(d, places.wu[n] + i), hn::Load(d, places.wv[n] + i), v, fetch_next);
  }

  static HWY_INLINE Place PlaceOn(const LevelRef& level, const Sampler& sampler, VF s, VF t) {
    return kBytes ? FindPlaceDraft(level, sampler.wrap_s, sampler.wrap_t, s, t)
                  : FindPlace(level, sampler.wrap_s, sampler.wrap_t, s, t);
  }
  template <class FetchNext>
  static HWY_INLINE void LookPlace(const LevelRef& level, const Footprints& texels, VF wu, VF wv, Lanes& v,
                                   FetchNext fetch_next) {
    if constexpr (kBytes) {
      BilinearDraft(texels, wu, wv, v);
      fetch_next();
    } else {
      Bilinear(texels, wu, wv, level.opaque, v, fetch_next);
    }
  }
  static HWY_INLINE int LevelOf(int key) { return key < 0 ? 0 : key; }
  static HWY_INLINE bool IsLinear(const FragmentParams& p, int key) {
    return (key < 0 ? p.sampler.mag : p.sampler.min) == Filter::linear;
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
    LookPlace(level, Fetch(level, LaneOffsets(place.offset)), place.wu, place.wv, v, NothingMeanwhile());
  }
};
