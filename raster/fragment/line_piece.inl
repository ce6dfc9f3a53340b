// Fragments of lines that are set up (raster/primitive/line_packet.h), a vector of columns at a time.
// Compiled once per ISA level.

// Of a line's columns, 0 to 63.
struct ColumnNumbers {
  alignas(64) double of[kTileSize];
};
inline constexpr ColumnNumbers kColumns = [] {
  ColumnNumbers columns{};
  for (int i = 0; i < kTileSize; ++i) columns.of[i] = i;
  return columns;
}();

HWY_INLINE const LinePacket& LineAt(const std::byte* at) { return *reinterpret_cast<const LinePacket*>(at); }

// Fragments of neighbouring columns; of columns that come after the line's last, too.
template <class Floats>
struct LinePiece {
  using Ints = hn::RebindToSigned<Floats>;
  using Doubles = hn::CappedTag<double, 8>;
  static constexpr int kSize = static_cast<int>(hn::MaxLanes(Ints()));
  hn::Vec<Ints> x, y;

  // From the line's `column` on, a multiple of the lanes.
  HWY_INLINE LinePiece(const LinePacket& line, int column) {
    const Ints d;
    const auto u = hn::Add(hn::Iota(d, 0), hn::Set(d, line.first + column));
    const auto v = Rows(line, column);
    const auto steep = hn::MaskFromVec(hn::Set(d, line.steep() ? -1 : 0));
    x = hn::IfThenElse(steep, v, u);
    y = hn::IfThenElse(steep, u, v);
  }

  // From the anchor of the line's planes.
  HWY_INLINE hn::Vec<Floats> FromAnchorX(const LinePacket& line) const { return From(x, line.anchor_x); }
  HWY_INLINE hn::Vec<Floats> FromAnchorY(const LinePacket& line) const { return From(y, line.anchor_y); }

  // Which pixels of the tile they are: as tile_offset() has it.
  HWY_INLINE hn::Vec<Ints> Offset() const {
    const Ints d;
    const auto bits = [&](int which) HWY_ATTR { return hn::Set(d, which); };
    const auto in_row = hn::OrAnd(hn::And(x, bits(7)), hn::ShiftLeft<3>(x), bits(7 << 6));
    const auto in_block_row = hn::OrAnd(in_row, hn::ShiftLeft<3>(y), bits(7 << 3));
    return hn::OrAnd(in_block_row, hn::ShiftLeft<6>(y), bits(7 << 9));
  }

 private:
  static HWY_INLINE hn::Vec<Floats> From(hn::Vec<Ints> pixel, float anchor) {
    return hn::Add(hn::ConvertTo(Floats(), pixel), hn::Set(Floats(), anchor));
  }

  static HWY_INLINE hn::Vec<Ints> Rows(const LinePacket& line, int column) {
    const Doubles d;
    const hn::Rebind<int32_t, Doubles> half;
    const auto at = hn::Set(d, line.place), step = hn::Set(d, line.step);
    const auto rows = [&](int i) HWY_ATTR {
      const auto place = hn::Add(at, hn::Mul(step, hn::Load(d, kColumns.of + column + i)));
#if HWY_TARGET == HWY_AVX3
      return hn::Vec<decltype(half)>{
          _mm512_cvt_roundpd_epi32(place.raw, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC)};
#else
      return hn::DemoteTo(half, hn::Floor(place));
#endif
    };
#if HWY_TARGET != HWY_SCALAR
    constexpr int kHalf = static_cast<int>(hn::MaxLanes(d));
    if constexpr (kSize == 2 * kHalf)
      return hn::Combine(Ints(), rows(kHalf), rows(0));
    else
#endif
      return rows(0);
  }
};

// Every other pixel is in the cache line of its neighbour.
template <int kSize>
HWY_INLINE void AskForPixels(const uint32_t* color, const int32_t* offset) {
  for (int i = 0; i < kSize; i += 2) __builtin_prefetch(color + offset[i], 1);
}
