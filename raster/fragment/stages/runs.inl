// Perspective at the draft level: the divide at the ends of runs of 16 pixels, straight lines between them. Runs begin
// at multiples of 16 in the window, so a value follows from pixel and primitive alone; for 8 rows of a run at a time it
// is decided whether 1/w changes little enough. Where not (and where an end lies behind the eye), pixels are divided
// one by one, in double.

inline constexpr int kRunPixels = 16;
// Least 1/w over greatest at a run's ends. A straight line then is off by at most 0.034 of the change over the run: half a
// texel where a pixel is a texel.
inline constexpr double kSteadyW = 0.875;

// kCount attributes from plane `first` on, over the plane `divisor`.
template <int kCount>
struct RunPlanes {
  alignas(64) float base[kCount][kBlockSize], step[kCount][kBlockSize];  // a row: at the block's first column, a pixel
  bool straight = true;

  HWY_INLINE RunPlanes(const BlockContext& c, int first, int divisor) {
    const SetupBatch& s = *c.setup;
    const double anchor_column = c.dx - s.anchor_x[c.lane];  // the block's, in the tile
    const double into = static_cast<double>(static_cast<int>(anchor_column) & (kRunPixels - 1));
    const double left = c.dx - into, right = left + kRunPixels;
    for (int row = 0; row < kBlockSize; ++row) {
      const double y = c.dy + row;
      const double start = At(s, divisor, c.lane, left, y), end = At(s, divisor, c.lane, right, y);
      const double least = start < end ? start : end, most = start < end ? end : start;
      if (!(least >= kSteadyW * most && most > 0)) {
        straight = false;
        return;
      }
      for (int k = 0; k < kCount; ++k) {
        double a = At(s, first + k, c.lane, left, y) / start;
        const double slope = (At(s, first + k, c.lane, right, y) / end - a) * (1.0 / kRunPixels);
        a += slope * into;
        base[k][row] = static_cast<float>(a);
        step[k][row] = static_cast<float>(slope);
      }
    }
  }

  HWY_INLINE VF Value(int k, int i) const {
    const DF d;
    const VF lane = hn::Iota(d, 0);
    const int row = i / kBlockSize;
    if constexpr (kRowsPerGroup == 1) {
      const VF column = hn::Add(lane, hn::Set(d, static_cast<float>(i % kBlockSize)));
      return hn::Add(hn::Set(d, base[k][row]), hn::Mul(hn::Set(d, step[k][row]), column));
    } else {
      const MF second = hn::Ge(lane, hn::Set(d, static_cast<float>(kBlockSize)));
      const VF column = hn::Sub(lane, hn::IfThenElseZero(second, hn::Set(d, static_cast<float>(kBlockSize))));
      const VF from = hn::IfThenElse(second, hn::Set(d, base[k][row + 1]), hn::Set(d, base[k][row]));
      const VF slope = hn::IfThenElse(second, hn::Set(d, step[k][row + 1]), hn::Set(d, step[k][row]));
      return hn::Add(from, hn::Mul(slope, column));
    }
  }

 private:
  static HWY_INLINE double At(const SetupBatch& s, int plane, int lane, double dx, double dy) {
    return (s.f0[plane][lane] + s.dfdy[plane][lane] * dy) + s.dfdx[plane][lane] * dx;
  }
};

struct ColorRuns {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  struct Once : RunPlanes<4> {
    HWY_INLINE explicit Once(const BlockContext& c) : RunPlanes<4>(c, c.params->color_plane, 1) {}
  };
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>& once, int i, Lanes& v) {
    using Divided = ColorSmooth<kDouble>;
    if (!once.straight) return Divided::Run<BlockLanes>(c, Divided::Once<BlockLanes>(c), i, v);
    const DF d;
    for (int k = 0; k < 4; ++k)
      v.slot[kR + k] = hn::Min(hn::Max(once.Value(k, i), hn::Zero(d)), hn::Set(d, 255.0f));
  }
};

template <bool kProjective>
struct CoordRuns {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  struct Once : RunPlanes<2> {
    HWY_INLINE explicit Once(const BlockContext& c)
        : RunPlanes<2>(c, c.params->tex_plane, kProjective ? c.params->tex_plane + 2 : 1) {}
  };
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>& once, int i, Lanes& v) {
    using Divided = Coord<kDouble, kProjective>;
    if (!once.straight)
      return Divided::template Run<BlockLanes>(c, typename Divided::template Once<BlockLanes>(c), i, v);
    v.slot[kS] = once.Value(0, i);
    v.slot[kT] = once.Value(1, i);
  }
};

struct FogRuns {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  struct Once : RunPlanes<1> {
    HWY_INLINE explicit Once(const BlockContext& c) : RunPlanes<1>(c, c.params->fog.plane, 1) {}
  };
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>& once, int i, Lanes& v) {
    using Divided = Fog<kDouble>;
    if (!once.straight) return Divided::Run<BlockLanes>(c, Divided::Once<BlockLanes>(c), i, v);
    const DF d;
    const FogParams& fog = c.params->fog;
    const VF depth = hn::Mul(hn::Sub(once.Value(0, i), hn::Set(d, fog.origin)), hn::Set(d, fog.slope));
    MixFog(fog, FogFactor(fog.curve, depth), v);
  }
};
