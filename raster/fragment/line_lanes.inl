// Lines of one pixel's width from their packets to memory, in one call. A value is (f0 + dfdy * dy) + dfdx *
// dx as in lanes.inl, with the same bits. Compiled once per ISA level.
//
// Their pixels are listed first (LinePixels), and stored when there are many: by then the cache has the
// memory they are stored to.

struct LinePlane {
  const BlockContext& c;
  int table;  // how many planes after the packet's first
  HWY_INLINE LinePlane(const BlockContext& context, int plane)
      : c(context), table(plane - context.first_line_plane) {}
  HWY_INLINE LinePlane(const BlockContext& context, int, int at) : c(context), table(at) {}
  HWY_INLINE VF At(int) const {
    const DF d;
    const float* plane = c.line_planes + 3 * table;
    const VF row = hn::Add(hn::Set(d, plane[0]), hn::Mul(hn::Set(d, plane[1]), hn::Load(d, c.line_dy)));
    return hn::Add(row, hn::Mul(hn::Set(d, plane[2]), hn::Load(d, c.line_dx)));
  }
};

// The same for a plane without slope.
struct LineLevelPlane {
  const BlockContext& c;
  int table;
  HWY_INLINE LineLevelPlane(const BlockContext& context, int, int at) : c(context), table(at) {}
  HWY_INLINE VF At(int) const { return hn::Set(DF(), c.line_planes[3 * table]); }
};

// Here a group's pixel `i` counts in the list. kLevelAlpha: the plane of alpha has no slope.
template <bool kLevelAlpha>
struct LineLanes : PackedLanes {
  using Plane = LinePlane;
  using PlaneOfAlpha = std::conditional_t<kLevelAlpha, LineLevelPlane, LinePlane>;
  struct FlatColor {
    const BlockContext& c;
    HWY_INLINE explicit FlatColor(const BlockContext& context) : c(context) {}
    HWY_INLINE VF At(int channel, int i) const { return LinePlane(c, c.params->color_plane + channel).At(i); }
  };
  static HWY_INLINE void StoreRgba8(const BlockContext& c, int i, VI packed, MF) {
    hn::StoreU(hn::BitCast(DU(), packed), DU(), c.line_pixels->color + i);
  }
};

// In the order of the lines, so where two of them share a pixel the later one's stays.
HWY_INLINE void StoreListed(const LinePixels& list, int count, uint32_t* color) {
#pragma GCC unroll 8
  for (int i = 0; i < count; ++i) color[list.offset[i]] = list.color[i];
}
