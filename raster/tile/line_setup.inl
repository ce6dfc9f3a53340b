// Set-up of lines of one pixel's width, eight at a time: their planes, as SetUp has them, and which pixels
// they make fragments at, exactly as raster/tile/cover_line.cpp has it pixel by pixel. Compiled once per ISA
// level.

// Records of both ends of each line, and of the vertex that gives its flat colour.
#if HALFSPACE_DIRECT_CORNERS
using LineCorners = DirectCorners;
#else
struct LineCorners {
  const unsigned char* const (&at)[3][kSetupLanes];

  HWY_INLINE void Heads(int k, int i, VD out[4]) const {
    alignas(64) VertexHead heads[kDoubleLanes];
    for (int j = 0; j < kDoubleLanes; ++j) memcpy(&heads[j], at[k][i + j], sizeof heads[j]);
    hn::LoadInterleaved4(DD(), reinterpret_cast<const double*>(heads), out[0], out[1], out[2], out[3]);
  }
  HWY_INLINE void Quad(const QuadPlan& quads, int q, int k, int i, hn::Vec<DDf> out[4]) const {
    const auto after = static_cast<ptrdiff_t>(sizeof(VertexHead)) + quads.Start(q) * ptrdiff_t{sizeof(float)};
    alignas(64) float quad[kDoubleLanes][4];
    for (int j = 0; j < kDoubleLanes; ++j) memcpy(quad[j], at[k][i + j] + after, sizeof quad[j]);
    hn::LoadInterleaved4(DDf(), quad[0], out[0], out[1], out[2], out[3]);
  }
};
#endif

// Both ends of each line, in the order they were given in.
struct LineEndVectors {
  VDi x[2], y[2];
};
struct LineEndValues {
  VD z[2], inv_w[2];
  hn::Vec<DDf> rest_x[2], rest_y[2];
};

// Lines whose ends are columns, from the `first` of them on.
struct LineColumnsAt {
  const EndColumns& columns;
  uint32_t first;

  HWY_INLINE void Ends(int i, LineEndVectors& ends, LineEndValues& values) const {
    for (int k = 0; k < 2; ++k) {
      const EndColumns::End& end = columns.end[k];
      const size_t at = size_t{first} + static_cast<size_t>(i);
      ends.x[k] = hn::Load(DDi(), end.x + at), ends.y[k] = hn::Load(DDi(), end.y + at);
      values.z[k] = hn::Load(DD(), end.z + at), values.inv_w[k] = hn::Load(DD(), end.inv_w + at);
      values.rest_x[k] = hn::Load(DDf(), end.rest_x + at), values.rest_y[k] = hn::Load(DDf(), end.rest_y + at);
    }
  }
  // Calls take(attribute, its values at both ends).
  template <class Take>
  HWY_INLINE void Attributes(const QuadPlan&, int attributes, int i, Take take) const {
    const size_t at = size_t{first} + static_cast<size_t>(i);
    for (int a = 0; a < attributes; ++a)
      take(a, hn::Load(DDf(), columns.end[0].color[a] + at), hn::Load(DDf(), columns.end[1].color[a] + at));
  }
  HWY_INLINE void FlatColor(const VertexLayout&, int lane, float color[4]) const {
    for (int k = 0; k < 4; ++k) color[k] = columns.end[1].color[k][first + static_cast<uint32_t>(lane)];
  }
};

// The columns lines have fragments in. u is along the longer axis, v along the other, both in 1/256 px. The
// diamond-exit rule (spec 3.4.1) as bounds on sums and differences of coordinates: the diamond |x - cx| + |y
// - cy| < 1/2 is a square on the axes x + y and x - y, where the moved ends make one side of each bound
// belong to it.
//
// In a column that the line goes all through, its fragment is the pixel that it is in at the column's middle:
// the quotient of two integers below 2^47, rounded down. Half an integer is added to the first, which takes
// the quotient away from whole pixels by more than all that follows is rounded by, and changes nothing else.
// Where the line runs exactly between two pixels, both diamonds touch it with a corner, and the moved line
// passes through one of them. Half an integer is then taken away instead where that is the one below.
struct LineColumns {
  static constexpr int kHalf = kSubpixelScale / 2;
  VDi first, count;  // there is a fragment in each; none where count < 1
  VDi steep;         // -1 or 0
  VDi from, to;      // pixels along v, of the first and the last
  VD place, step;    // as LinePacket has them
  VDi x0, y0, sum, difference;

  HWY_INLINE explicit LineColumns(const LineEndVectors& line) {
    const DD d;
    const DDi di;
    const VDi zero = hn::Zero(di), one = hn::Set(di, 1);
    x0 = hn::Sub(line.x[0], hn::Set(di, kHalf)), y0 = hn::Sub(line.y[0], hn::Set(di, kHalf));
    const VDi dx = hn::Sub(line.x[1], line.x[0]), dy = hn::Sub(line.y[1], line.y[0]);
    sum = hn::Add(dx, dy), difference = hn::Sub(dx, dy);
    const VDi width = hn::Max(dx, hn::Neg(dx)), height = hn::Max(dy, hn::Neg(dy));
    const auto is_steep = hn::Gt(height, width);
    steep = hn::VecFromMask(di, is_steep);
    const VDi u0 = hn::IfThenElse(is_steep, line.y[0], line.x[0]),
              v0 = hn::IfThenElse(is_steep, line.x[0], line.y[0]);
    const VDi du = hn::IfThenElse(is_steep, dy, dx), dv = hn::IfThenElse(is_steep, dx, dy);
    const VDi rise = hn::IfThenElse(hn::Lt(du, zero), hn::Neg(dv), dv);
    const VDi begin = ColumnBelow(hn::Min(u0, hn::Add(u0, du))),
              last = ColumnBelow(hn::Max(u0, hn::Add(u0, du)));
    const VDi along = hn::Sub(hn::Add(hn::ShiftLeft<kSubpixelBits>(begin), hn::Set(di, kHalf)), u0);
    // Steep, or level, or falling to the right.
    const VDi falls =
        hn::Or(steep, hn::Or(hn::VecFromMask(di, hn::Eq(dy, zero)), hn::BroadcastSignBit(hn::Xor(dx, dy))));
    const VD long_side = hn::PromoteTo(d, hn::Max(hn::Max(width, height), one)),
             climb = hn::PromoteTo(d, rise);
    const VD moved = hn::Add(hn::Set(d, 0.5), hn::PromoteTo(d, falls));
    const VD place_by_pitch =
        hn::Add(hn::Mul(hn::PromoteTo(d, v0), long_side), hn::Mul(climb, hn::PromoteTo(d, along)));
    place = hn::Div(hn::Add(place_by_pitch, moved),
                    hn::Mul(long_side, hn::Set(d, static_cast<double>(kSubpixelScale))));
    step = hn::Div(climb, long_side);
    LeaveEnds(begin, last);
  }

 private:
  // At either end, the column the line's end lies in, and the one before, need not have a fragment.
  HWY_INLINE void LeaveEnds(VDi begin, VDi last) {
    const DD d;
    const DDi di;
    const VDi zero = hn::Zero(di), one = hn::Set(di, 1);
    const VD end = hn::Add(place, hn::Mul(step, hn::PromoteTo(d, hn::Sub(last, begin))));
    const auto has_first = MakesFragments(begin, Row(place));
    const auto has_second = MakesFragments(hn::Add(begin, one), Row(hn::Add(place, step)));
    const auto has_last = MakesFragments(last, Row(end));
    const VDi front = hn::IfThenZeroElse(has_first, hn::IfThenElse(has_second, one, hn::Set(di, 2)));
    first = hn::Add(begin, front);
    count = hn::Sub(hn::Sub(last, first), hn::IfThenElse(has_last, hn::Set(di, -1), zero));
    place = hn::Add(place, hn::Mul(step, hn::PromoteTo(d, front)));
    from = Row(place);
    to = Row(hn::Add(place, hn::Mul(step, hn::PromoteTo(d, hn::Sub(count, one)))));
  }

  static HWY_INLINE VDi ColumnBelow(VDi u) {
    const DDi d;
    return hn::Sub(hn::ShiftRight<kSubpixelBits>(hn::Add(u, hn::Set(d, kSubpixelScale - 1))), hn::Set(d, 1));
  }
  static HWY_INLINE VDi Row(VD v) { return hn::DemoteTo(DDi(), hn::Floor(v)); }

  // Whether the segment reaches into the pixels' diamonds, and leaves them.
  HWY_INLINE hn::Mask<DDi> MakesFragments(VDi u, VDi v) const {
    const DDi d;
    const auto is_steep = hn::MaskFromVec(steep);
    const VDi x = hn::IfThenElse(is_steep, v, u), y = hn::IfThenElse(is_steep, u, v);
    const VDi to_x = hn::Sub(x0, hn::ShiftLeft<kSubpixelBits>(x)),
              to_y = hn::Sub(y0, hn::ShiftLeft<kSubpixelBits>(y));
    const VDi a = hn::Add(to_x, to_y), b = hn::Sub(to_x, to_y), zero = hn::Zero(d);
    const auto reaches = hn::And(Within(a, hn::Min(sum, zero), hn::Max(sum, zero)),
                                 Within(b, hn::Min(difference, zero), hn::Max(difference, zero)));
    const auto ends = hn::And(Within(a, sum, sum), Within(b, difference, difference));
    return hn::AndNot(ends, reaches);
  }
  // `v` plus some of [least, most] lies within half a pixel.
  static HWY_INLINE hn::Mask<DDi> Within(VDi v, VDi least, VDi most) {
    const DDi d;
    return hn::And(hn::Gt(hn::Add(v, most), hn::Set(d, -kHalf)),
                   hn::Lt(hn::Add(v, least), hn::Set(d, kHalf + 1)));
  }
};

struct LineRecords {
  LineCorners corners;

  HWY_INLINE void Ends(int i, LineEndVectors& ends, LineEndValues& values) const {
    const DDi di;
    const DDf df;
    for (int k = 0; k < 2; ++k) {
      VD words[4];
      corners.Heads(k, i, words);
      ends.x[k] = LowHalf(di, words[0]), ends.y[k] = HighHalf(di, words[0]);
      values.z[k] = words[1], values.inv_w[k] = words[2];
      values.rest_x[k] = LowHalf(df, words[3]), values.rest_y[k] = HighHalf(df, words[3]);
    }
  }
  template <class Take>
  HWY_INLINE void Attributes(const QuadPlan& quads, int attributes, int i, Take take) const {
    for (int q = 0; q < quads.count; ++q) {
      hn::Vec<DDf> quad[2][4];
      for (int k = 0; k < 2; ++k) corners.Quad(quads, q, k, i, quad[k]);
      for (int f = 0; f < 4; ++f) {
        const int a = quads.Start(q) + f;
        if (a >= 4 * q && a < attributes) take(a, quad[0][f], quad[1][f]);
      }
    }
  }
  HWY_INLINE void FlatColor(const VertexLayout& layout, int lane, float color[4]) const {
    memcpy(color, raster::HWY_NAMESPACE::Attributes(reinterpret_cast<const VertexHead*>(corners.at[2][lane])) + layout.color,
           4 * sizeof(float));
  }
};

// Lanes [i, i + kDoubleLanes) to vectors, and attributes to columns of `in`. The lower end first, as Below()
// has it, and the third corner at right angles that FindCorners makes.
template <class Lines>
HWY_INLINE void SpreadLines(const Lines& from, const QuadPlan& quads, int attributes, int i,
                            LineEndVectors& ends, CornerVectors& v, SetupInput& in) {
  const DD d;
  const DDi di;
  const DDf df;
  LineEndValues values;
  from.Ends(i, ends, values);
  const VDi *x = ends.x, *y = ends.y;
  const auto swap = hn::Or(hn::Lt(y[1], y[0]), hn::And(hn::Eq(y[1], y[0]), hn::Lt(x[1], x[0])));
  const auto swap_words = hn::Ne(hn::PromoteTo(d, hn::VecFromMask(di, swap)), hn::Zero(d));
  const auto swap_floats = hn::RebindMask(df, swap);
  v.place_x[0] = hn::IfThenElse(swap, x[1], x[0]), v.place_x[1] = hn::IfThenElse(swap, x[0], x[1]);
  v.place_y[0] = hn::IfThenElse(swap, y[1], y[0]), v.place_y[1] = hn::IfThenElse(swap, y[0], y[1]);
  hn::Vec<DDf> rest_x[3], rest_y[3];
  for (int k = 0; k < 2; ++k) {
    v.z[k] = hn::IfThenElse(swap_words, values.z[1 - k], values.z[k]);
    v.inv_w[k] = hn::IfThenElse(swap_words, values.inv_w[1 - k], values.inv_w[k]);
    rest_x[k] = hn::IfThenElse(swap_floats, values.rest_x[1 - k], values.rest_x[k]);
    rest_y[k] = hn::IfThenElse(swap_floats, values.rest_y[1 - k], values.rest_y[k]);
  }
  v.z[2] = v.z[0], v.inv_w[2] = v.inv_w[0];
  v.place_x[2] = hn::Sub(v.place_x[0], hn::Sub(v.place_y[1], v.place_y[0]));
  v.place_y[2] = hn::Add(v.place_y[0], hn::Sub(v.place_x[1], v.place_x[0]));
  rest_x[2] = hn::Sub(rest_x[0], hn::Sub(rest_y[1], rest_y[0]));
  rest_y[2] = hn::Add(rest_y[0], hn::Sub(rest_x[1], rest_x[0]));
  for (int k = 0; k < 3; ++k) {
    v.x[k] = hn::PromoteTo(d, v.place_x[k]), v.y[k] = hn::PromoteTo(d, v.place_y[k]);
    v.rest_x[k] = hn::PromoteTo(d, rest_x[k]), v.rest_y[k] = hn::PromoteTo(d, rest_y[k]);
  }
  from.Attributes(quads, attributes, i, [&](int a, hn::Vec<DDf> first, hn::Vec<DDf> second) HWY_ATTR {
    const auto low = hn::IfThenElse(swap_floats, second, first);
    hn::Store(low, df, in.attribute[a][0] + i);
    hn::Store(hn::IfThenElse(swap_floats, first, second), df, in.attribute[a][1] + i);
    hn::Store(low, df, in.attribute[a][2] + i);
  });
}

HWY_INLINE VDi TileOf(VDi pixel) {
  static_assert(kTileSize == 64);
  return hn::ShiftRight<6>(pixel);
}
HWY_INLINE VDi PixelOf(VDi tile) { return hn::ShiftLeft<6>(tile); }

// Gives which lines lie all within the bounds.
HWY_INLINE hn::Mask<DDi> StoreTiles(const LineColumns& line, const Rect& bounds, int i, LineGroup& out) {
  const DDi d;
  const auto steep = hn::MaskFromVec(line.steep);
  const VDi lower = hn::Min(line.from, line.to), upper = hn::Max(line.from, line.to);
  const VDi one = hn::Set(d, 1), last = hn::Sub(hn::Add(line.first, line.count), one);
  const auto store = [&](VDi low, VDi high, int from, int to, int32_t* least, int32_t* most) HWY_ATTR {
    const VDi begin = hn::Max(low, hn::Set(d, from)), end = hn::Min(high, hn::Set(d, to - 1));
    hn::Store(TileOf(begin), d, least + i);
    hn::Store(hn::IfThenElse(hn::Lt(end, begin), hn::Set(d, -1), TileOf(end)), d, most + i);
    return hn::And(hn::Eq(begin, low), hn::Eq(end, high));
  };
  const auto within_x = store(hn::IfThenElse(steep, lower, line.first), hn::IfThenElse(steep, upper, last),
                              bounds.x0, bounds.x1, out.tile_x0, out.tile_x1);
  const auto within_y = store(hn::IfThenElse(steep, line.first, lower), hn::IfThenElse(steep, last, upper),
                              bounds.y0, bounds.y1, out.tile_y0, out.tile_y1);
  // None at all: then that of the longer axis is empty already.
  return hn::And(within_x, within_y);
}

// Cuts lines where they go from tile to tile: once along either axis, since they are no longer than a tile.
struct LineCuts {
  VDi first, second;       // columns before the one cut, and before the other
  VDi u[3], v[3];          // which tiles the parts are in
  hn::Mask<DDi> is_whole;  // longer, or beyond the bounds

  HWY_INLINE LineCuts(const LineColumns& line, hn::Mask<DDi> is_within) {
    const DD d;
    const DDi di;
    const VDi one = hn::Set(di, 1);
    u[0] = TileOf(line.first), v[0] = TileOf(line.from);
    u[2] = TileOf(hn::Sub(hn::Add(line.first, line.count), one)), v[2] = TileOf(line.to);
    is_whole = hn::Or(hn::Not(is_within), hn::Gt(line.count, hn::Set(di, kTileSize)));
    // In no column does the line come to just where a pixel begins.
    const auto crosses = hn::AndNot(is_whole, hn::Ne(v[0], v[2]));
    const auto crosses_in_double = hn::Ne(hn::PromoteTo(d, hn::VecFromMask(di, crosses)), hn::Zero(d));
    const VD edge = hn::PromoteTo(d, PixelOf(hn::Max(v[0], v[2])));
    const VD step = hn::IfThenElse(crosses_in_double, line.step, hn::Set(d, 1));
    const VD columns = hn::IfThenElseZero(crosses_in_double, hn::Div(hn::Sub(edge, line.place), step));
    const VDi beyond = hn::Add(hn::DemoteTo(di, hn::Floor(columns)), one);
    const VDi across = hn::IfThenElse(crosses, beyond, line.count);
    const VDi left = hn::Min(line.count, hn::Sub(PixelOf(hn::Add(u[0], one)), line.first));
    const VDi along = hn::IfThenElse(is_whole, line.count, left);
    first = hn::Min(across, along), second = hn::Max(across, along);
    const auto along_first = hn::Lt(along, across);
    u[1] = hn::IfThenElse(along_first, u[2], u[0]), v[1] = hn::IfThenElse(along_first, v[0], v[2]);
  }
};

HWY_INLINE void StoreParts(const LineColumns& line, const LineCuts& cuts, VDi shape, const SetupBatch& s,
                           int i, LineGroup& out) {
  const DD d;
  const DDi di;
  const DDf df;
  const auto steep = hn::MaskFromVec(line.steep);
  const auto has_any = hn::Gt(line.count, hn::Zero(di));
  const VDi begins[LineGroup::kParts + 1] = {hn::Zero(di), cuts.first, cuts.second, line.count};
  for (int k = 0; k < LineGroup::kParts; ++k) {
    LineGroup::Part& part = out.parts[k];
    const VDi count = hn::IfThenElseZero(has_any, hn::Sub(begins[k + 1], begins[k]));
    hn::Store(count, di, part.count + i);
    hn::Store(hn::IfThenElse(steep, cuts.v[k], cuts.u[k]), di, part.x + i);
    hn::Store(hn::IfThenElse(steep, cuts.u[k], cuts.v[k]), di, part.y + i);
    const VD place = hn::Add(line.place, hn::Mul(line.step, hn::PromoteTo(d, begins[k])));
    hn::StoreInterleaved2(place, line.step, d, part.place[i]);
    const VDi first = hn::Add(line.first, begins[k]);
    hn::StoreInterleaved4(hn::Load(df, s.anchor_x_f + i), hn::Load(df, s.anchor_y_f + i),
                          hn::BitCast(df, first), hn::BitCast(df, hn::Or(shape, count)), df, part.anchor[i]);
  }
  hn::Store(hn::VecFromMask(di, cuts.is_whole), di, out.whole + i);
}

// Lanes whose alpha's plane has no slope.
HWY_INLINE VDi AlphaIsLevel(const SetupBatch& s, int alpha, int i) {
  const DDf df;
  const auto zero = hn::Zero(df);
  return hn::VecFromMask(DDi(),
                         hn::RebindMask(DDi(), hn::And(hn::Eq(hn::Load(df, s.dfdx_f[alpha] + i), zero),
                                                       hn::Eq(hn::Load(df, s.dfdy_f[alpha] + i), zero))));
}

// LinePacket::shape, but for the columns. `level`: -1 where alpha's plane has no slope.
HWY_INLINE VDi LineShape(const LineColumns& line, VDi variant, VDi level, const LineGroup& out) {
  const DDi d;
  const auto bytes = [&](int first_plane) HWY_ATTR {
    const size_t all = line_packet_bytes(out.plane_end - first_plane, out.has_depth);
    return hn::Set(d, static_cast<int32_t>(all / 8));
  };
  const auto affine = hn::Ne(hn::And(variant, hn::Set(d, kAffine)), hn::Zero(d));
  const VDi steep = hn::And(line.steep, hn::Set(d, static_cast<int32_t>(LinePacket::kSteep)));
  const VDi alpha = hn::And(level, hn::Set(d, static_cast<int32_t>(LinePacket::kLevelAlpha)));
  return hn::Or(hn::Or(hn::Or(steep, alpha), hn::ShiftLeft<LinePacket::kVariantAt>(variant)),
                hn::ShiftLeft<LinePacket::kBytesAt>(hn::IfThenElse(affine, bytes(2), bytes(1))));
}

// The planes of four colours, of which each line has 12 floats in a row.
HWY_INLINE void StoreColorQuads(const SetupBatch& s, int i, LineGroup& out) {
  const DDf df;
  hn::Vec<DDf> column[4 * LineGroup::kQuads];
  for (int k = 0; k < 4; ++k) {
    column[3 * k] = hn::Load(df, s.f0_f[2 + k] + i);
    column[3 * k + 1] = hn::Load(df, s.dfdy_f[2 + k] + i);
    column[3 * k + 2] = hn::Load(df, s.dfdx_f[2 + k] + i);
  }
  for (int q = 0; q < LineGroup::kQuads; ++q)
    hn::StoreInterleaved4(column[4 * q], column[4 * q + 1], column[4 * q + 2], column[4 * q + 3], df,
                          out.plane[2 + q][i]);
}

// Planes `first` and up of the set-up.
HWY_INLINE void StoreLinePlanes(const SetupBatch& s, int first, int i, LineGroup& out) {
  const DD d;
  const DDf df;
  for (int p = first; p < out.plane_end; ++p)
    hn::StoreInterleaved4(hn::Load(df, s.f0_f[p] + i), hn::Load(df, s.dfdy_f[p] + i),
                          hn::Load(df, s.dfdx_f[p] + i), hn::Zero(df), df, out.plane[p][i]);
  if (out.has_depth)
    hn::StoreInterleaved4(hn::Load(d, s.f0[0] + i), hn::Load(d, s.dfdy[0] + i), hn::Load(d, s.dfdx[0] + i),
                          hn::Zero(d), d, out.depth[i]);
}

// Flat colours are planes that are level.
template <class Lines>
HWY_NOINLINE void StoreFlatColors(const DrawRecord& draw, const Lines& from, int count, LineGroup& out) {
  const FragmentParams& params = draw.program->params;
  for (int lane = 0; lane < count; ++lane) {
    float color[4];
    from.FlatColor(draw.vertices.layout, lane, color);
    for (int k = 0; k < 4; ++k) {
      float* plane = out.plane[params.color_plane + k][lane];
      plane[0] = color_level(color[k], params.rounds_to_bytes);
      plane[1] = plane[2] = 0;
    }
  }
}

// Lines of one draw, of `count` <= kSetupLanes; those beyond are to be some that can be computed with.
template <class Lines>
void MakeLines(const DrawRecord& draw, const Lines& from, int count, LineGroup& out) {
  const DD d;
  const VertexLayout& layout = draw.vertices.layout;
  const FragmentParams& params = draw.program->params;
  const QuadPlan quads(layout.attribute_count);
  SetupInput in;
  SetupBatch planes;
  out.plane_end = 2 + layout.attribute_count;
  out.has_depth = draw.program->reads_depth;
  // Where one vector has all lines.
  const bool may_have_quads = kDoubleLanes == kSetupLanes && layout.color >= 0 && layout.attribute_count == 4 &&
                              !out.has_depth && !draw.program->flat_shading;
  const VD middle = hn::Set(d, static_cast<double>(kSubpixelScale / 2));
  for (int i = 0; i < kSetupLanes; i += kDoubleLanes) {
    LineEndVectors ends;
    CornerVectors v;
    SpreadLines(from, quads, layout.attribute_count, i, ends, v, in);
    const LineColumns columns(ends);
    SetAnchor(v, i, middle, middle, planes);
    const VDi variant = hn::DemoteTo(DDi(), SetPlanes(in, layout, params, v, out.has_depth, i, planes));
    hn::Store(variant, DDi(), out.variant + i);
    const VDi level = layout.color >= 0 ? AlphaIsLevel(planes, params.color_plane + 3, i) : hn::Zero(DDi());
    const LineCuts cuts(columns, StoreTiles(columns, draw.bounds, i, out));
    StoreParts(columns, cuts, LineShape(columns, variant, level, out), planes, i, out);
    const bool affine = hn::AllTrue(d, hn::Eq(v.inv_w[0], v.inv_w[1]));
    out.has_quads = may_have_quads && affine;
    if (out.has_quads) StoreColorQuads(planes, i, out);
    else StoreLinePlanes(planes, affine ? 2 : 1, i, out);
  }
  if (layout.color >= 0 && draw.program->flat_shading) StoreFlatColors(draw, from, count, out);
}

// What raster/tile/line_setup.h promises.
void SetUpLines(const DrawRecord& draw, const uint32_t* ends, int count, LineGroup& out) {
  const size_t stride = draw.vertices.layout.stride();
  const auto* records = reinterpret_cast<const unsigned char*>(draw.vertices.records);
  const unsigned char* at[3][kSetupLanes];
  for (int lane = 0; lane < kSetupLanes; ++lane) {
    const uint32_t* v = ends + 2 * (lane < count ? lane : 0);
    at[0][lane] = records + v[0] * stride;
    at[1][lane] = at[2][lane] = records + v[1] * stride;
  }
  MakeLines(draw, LineRecords{{at}}, count, out);
}

void SetUpLineColumns(const DrawRecord& draw, const EndColumns& ends, uint32_t first, int count, LineGroup& out) {
  MakeLines(draw, LineColumnsAt{ends, first}, count, out);
}
