// Triangles of one batch together, where the edges of each are short enough for floats (kSpanStep): their
// groups make one list, so that each kernel is called once for all of them. What lies in the tile of a
// triangle is looked through in windows of 32 x 16 pixels. A row's pixels are a span, from the rightmost of
// the edges it enters by to the leftmost of those it leaves by; a window's sixteen rows are found at once.
// For AVX-512 only, where a list may hold groups of several primitives; others walk each triangle alone.

inline constexpr int kSpanWidth = GroupTables::kColumns, kSpanRows = GroupTables::kRows;

#if HWY_TARGET == HWY_AVX3
// The most an edge's value may gain by a pixel: 64 pixels of edge in steps of 1/256. Values in a window are
// then below 2^21, and exact in float. Where an edge is crossed is e / step: within the window off by less
// than 2^-17 as a float, and it lies at least 2^-14 from the integers it is none of.
inline constexpr int32_t kSpanStep = 1 << 14;
inline constexpr float kSpanSlack = 0x1p-15f;

// What windows of a triangle are found from, of eight triangles at once. As made, that is of each one's first
// window: nothing needs to be worked out for it, and most have but one or two. NextRows and NextColumns go on to
// the others.
struct SpanBatch {
  alignas(32) float base[3][kSetupLanes];  // the edge's value at the window's first pixel
  alignas(32) float run[3][kSetupLanes], rise[3][kSetupLanes];  // what it gains by a column and by a row
  alignas(32) float turn[3][kSetupLanes];                       // columns for each unit of it
  // What makes columns out of where it is crossed: the first inside, or the last; the other one is no bound.
  alignas(32) float enter[3][kSetupLanes], leave[3][kSetupLanes];
  alignas(32) int32_t left[kSetupLanes], bottom[kSetupLanes];  // the first window's first pixel
  alignas(32) int32_t width[kSetupLanes], height[kSetupLanes];  // the box's last column and row, from there
  alignas(32) float first[kSetupLanes], last[kSetupLanes];      // the window's columns that lie in the box
  alignas(64) double dx[kSetupLanes], dy[kSetupLanes];          // the window's first pixel, from the anchor
  alignas(32) int32_t place[kSetupLanes],
      phase[kSetupLanes];                    // of the first group, and its pair of rows in the block
  alignas(64) uint64_t rows[kSetupLanes];    // bits of the box's rows, from the first window's
  alignas(64) uint64_t blocks[kSetupLanes];  // that the box touches
  unsigned fits;                             // lanes that may be walked so

  HWY_INLINE void Make(const SetupBatch& s, unsigned lanes) {
    const auto load = [](const int32_t* from)
                          HWY_ATTR { return _mm256_load_si256(reinterpret_cast<const __m256i*>(from)); };
    const auto store = [](__m256i v, int32_t* to)
                           HWY_ATTR { _mm256_store_si256(reinterpret_cast<__m256i*>(to), v); };
    const auto all = [](int value) HWY_ATTR { return _mm256_set1_epi32(value); };
    const __m256i min_x = load(s.min_x), min_y = load(s.min_y), max_x = load(s.max_x), max_y = load(s.max_y);
    const __m256i x = _mm256_and_si256(min_x, all(~(kBlockSize - 1))), y = _mm256_and_si256(min_y, all(~1));
    __m256i longest = _mm256_setzero_si256();
    for (int k = 0; k < 3; ++k) {
      const __m256i step_x = load(s.step_x[k]), step_y = load(s.step_y[k]);
      longest =
          _mm256_max_epi32(longest, _mm256_max_epi32(_mm256_abs_epi32(step_x), _mm256_abs_epi32(step_y)));
      const __m256i moved = _mm256_add_epi32(_mm256_mullo_epi32(step_x, x), _mm256_mullo_epi32(step_y, y));
      _mm256_store_ps(base[k], _mm256_cvtepi32_ps(_mm256_add_epi32(load(s.edge[k]), moved)));
      _mm256_store_ps(run[k], _mm256_cvtepi32_ps(step_x));
      _mm256_store_ps(rise[k], _mm256_cvtepi32_ps(step_y));
      const __mmask8 level = _mm256_testn_epi32_mask(step_x, step_x);
      const __mmask8 enters = _mm256_cmpge_epi32_mask(step_x, _mm256_setzero_si256());
      // An edge without a step is entered by everywhere, or nowhere.
      const __m256 columns = _mm256_div_ps(_mm256_set1_ps(-1), _mm256_cvtepi32_ps(step_x));
      _mm256_store_ps(turn[k], _mm256_mask_mov_ps(columns, level, _mm256_set1_ps(-0x1p20f)));
      const __m256 far = _mm256_set1_ps(0x1p60f), slack = _mm256_set1_ps(kSpanSlack), one = _mm256_set1_ps(1);
      _mm256_store_ps(enter[k],
                      _mm256_mask_sub_ps(_mm256_sub_ps(_mm256_setzero_ps(), far), enters, one, slack));
      _mm256_store_ps(leave[k], _mm256_mask_mov_ps(slack, enters, far));
    }
    const __m256i wide = _mm256_sub_epi32(max_x, x), high = _mm256_sub_epi32(max_y, y);
    store(x, left);
    store(y, bottom);
    _mm256_store_ps(first, _mm256_cvtepi32_ps(_mm256_sub_epi32(min_x, x)));
    _mm256_store_ps(last, _mm256_cvtepi32_ps(_mm256_min_epi32(wide, all(kSpanWidth - 1))));
    _mm512_store_pd(dx, _mm512_add_pd(_mm512_load_pd(s.anchor_x), _mm512_cvtepi32_pd(x)));
    _mm512_store_pd(dy, _mm512_add_pd(_mm512_load_pd(s.anchor_y), _mm512_cvtepi32_pd(y)));
    store(wide, width);
    store(high, height);
    const __m256i column = _mm256_srli_epi32(x, 3), row = _mm256_srli_epi32(y, 3);
    const __m256i lane = _mm256_slli_epi32(_mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7), TileGroup::kLaneShift);
    const __m256i index = _mm256_add_epi32(_mm256_slli_epi32(row, 5), _mm256_slli_epi32(column, 2));
    store(_mm256_add_epi32(_mm256_slli_epi32(index, TileGroup::kIndexShift), lane), place);
    store(_mm256_and_si256(_mm256_srli_epi32(y, 1), all(3)), phase);
    _mm512_store_si512(rows, Range(_mm256_sub_epi32(min_y, y), high));
    // The row of columns, in all rows.
    const __m512i columns = _mm512_shuffle_epi8(
        Range(column, _mm256_srli_epi32(max_x, 3)),
        _mm512_set_epi64(8 * kAllBytes, 0, 8 * kAllBytes, 0, 8 * kAllBytes, 0, 8 * kAllBytes, 0));
    const __m256i top = _mm256_or_si256(max_y, all(7));
    _mm512_store_si512(blocks, _mm512_and_si512(columns, Range(_mm256_slli_epi32(row, 3), top)));
    const __m256i least = _mm256_min_epi32(_mm256_sub_epi32(max_x, min_x), _mm256_sub_epi32(max_y, min_y));
    fits = lanes & _mm256_cmple_epi32_mask(longest, all(kSpanStep)) & _mm256_cmpge_epi32_mask(least, all(0));
  }

  HWY_INLINE void NextRows(int lane) {
    for (int k = 0; k < 3; ++k) base[k][lane] += rise[k][lane] * kSpanRows;
    dy[lane] += kSpanRows;
  }
  // From the `down`-th window of the last columns to the first of those from the `x`-th on.
  HWY_INLINE void NextColumns(int lane, int x, int down) {
    const auto rows_back = static_cast<float>(kSpanRows * down);
    for (int k = 0; k < 3; ++k) base[k][lane] += run[k][lane] * kSpanWidth - rise[k][lane] * rows_back;
    dx[lane] += kSpanWidth;
    first[lane] = 0;
    last[lane] = static_cast<float>(width[lane] - x < kSpanWidth - 1 ? width[lane] - x : kSpanWidth - 1);
  }

 private:
  static constexpr int64_t kAllBytes = 0x0101010101010101;
  // Bits from the one to the other.
  static HWY_INLINE __m512i Range(__m256i from, __m256i to) {
    return _mm512_andnot_si512(_mm512_sllv_epi64(_mm512_set1_epi64(-2), _mm512_cvtepi32_epi64(to)),
                               _mm512_sllv_epi64(_mm512_set1_epi64(-1), _mm512_cvtepi32_epi64(from)));
  }
};

// Places of a window's groups from its first: pairs of rows one after the other, and of each the blocks
// beside each other in turn; those of even columns of blocks. By the pair of rows of the block that the
// window begins with.
struct SpanPlaces {
  alignas(64) int32_t of[4][16];
};
inline constexpr SpanPlaces kSpanPlaces = [] {
  SpanPlaces places{};
  for (int phase = 0; phase < 4; ++phase)
    for (int i = 0; i < 16; ++i)
      places.of[phase][i] = ((phase + i / 2) / 4 * 32 + (phase + i / 2) % 4 + i % 2 * 8)
                            << TileGroup::kIndexShift;
  return places;
}();

// Adds what the triangle covers of the window at hand, which lies (x, y) from its first one; gives how many
// pixels in each row.
HWY_INLINE __m512i AddWindow(const SpanBatch& b, int lane, int x, int y, GroupList& list) {
  const __m512 row = _mm512_setr_ps(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  __m512 from = _mm512_set1_ps(b.first[lane]), to = _mm512_set1_ps(b.last[lane]);
  for (int k = 0; k < 3; ++k) {
    const __m512 rises = _mm512_mul_ps(row, _mm512_set1_ps(b.rise[k][lane]));
    const __m512 e = _mm512_add_ps(rises, _mm512_set1_ps(b.base[k][lane]));
    const __m512 at = _mm512_mul_ps(e, _mm512_set1_ps(b.turn[k][lane]));
    from = _mm512_max_ps(from, _mm512_add_ps(at, _mm512_set1_ps(b.enter[k][lane])));
    to = _mm512_min_ps(to, _mm512_add_ps(at, _mm512_set1_ps(b.leave[k][lane])));
  }
  from = _mm512_min_ps(from, _mm512_set1_ps(kSpanWidth));
  to = _mm512_max_ps(to, _mm512_set1_ps(-1));
  constexpr int kDown = _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC;
  const __m512i left = _mm512_cvt_roundps_epi32(from, kDown), right = _mm512_cvt_roundps_epi32(to, kDown);
  // Shifts by 32 leave nothing.
  const __m512i ones = _mm512_set1_epi32(-1);
  const auto rows = static_cast<__mmask16>(b.rows[lane] >> y);
  const __m512i beyond = _mm512_srlv_epi32(ones, _mm512_sub_epi32(_mm512_set1_epi32(kSpanWidth - 1), right));
  const __m512i bits = _mm512_maskz_and_epi32(rows, _mm512_sllv_epi32(ones, left), beyond);
  // Of two rows, the blocks' bytes side by side: sixteen pixels each.
  const __m128i turn = _mm_setr_epi8(0, 4, 1, 5, 2, 6, 3, 7, 8, 12, 9, 13, 10, 14, 11, 15);
  const __m512i groups = _mm512_shuffle_epi8(bits, _mm512_broadcast_i32x4(turn));
  const int first = b.place[lane] + ((x / 2 + y * 4) << TileGroup::kIndexShift);
  const __m512i places =
      _mm512_add_epi32(_mm512_load_si512(kSpanPlaces.of[b.phase[lane]]), _mm512_set1_epi32(first));
  list.AddSome(_mm512_slli_epi32(groups, TileGroup::kLiveShift), places);
  list.AddSome(_mm512_and_si512(groups, _mm512_set1_epi32(-1 << TileGroup::kLiveShift)),
               _mm512_add_epi32(places, _mm512_set1_epi32(4 << TileGroup::kIndexShift)));
  const __m512i length = _mm512_sub_epi32(right, left);
  return _mm512_maskz_max_epi32(rows, _mm512_add_epi32(length, _mm512_set1_epi32(1)), _mm512_setzero_si512());
}

// What is listed of a batch's triangles and not yet drawn.
class GroupBatch {
 public:
  // Of these lanes of the batch.
  HWY_INLINE GroupBatch(TileContext& t, unsigned lanes)
      : t_(t), list_(t.groups, 0), length_(_mm512_setzero_si512()) {
    if (!t.stippled && !IsWatched(t))
      spans_.Make(t.setup, lanes);
    else
      spans_.fits = 0;
  }

  // Lists what the triangle covers; false: it has to go another way.
  HWY_INLINE bool Add(int lane) {
    if ((spans_.fits >> lane & 1) == 0) return false;
    if (TileHides(t_, lane)) return true;
    const BlockProgram& stages =
        HasEvenColor(t_, lane) ? t_.program->even : t_.program->variants[t_.setup.variant[lane]];
    if (stages.groups == nullptr) return false;
    if (&stages != stages_ || list_.count > kTileGroups) Draw();
    stages_ = &stages;
    lanes_ |= 1u << lane;
    blocks_ |= spans_.blocks[lane];
    const bool depth = stages.groups_depth != nullptr;
    for (int x = 0;;) {
      FillColumnPlaces(lane, spans_.left[lane] + x, spans_.dx[lane], t_.group_tables);
      if (depth) FillColumnDepths(t_.setup, lane, spans_.left[lane] + x, spans_.dx[lane], t_.group_tables);
      const int down = AddColumns(lane, x, depth && x == 0);
      x += kSpanWidth;
      if (x > spans_.width[lane]) return true;
      spans_.NextColumns(lane, x, down);
    }
  }

  HWY_INLINE void Draw() {
    if (list_.count != 0) DrawSome();
    lanes_ = 0;
    blocks_ = 0;
  }

 private:
  // The windows from the first row on; gives which one, counted from 0, is the last. `depth`: that of these rows
  // is not there yet.
  HWY_INLINE int AddColumns(int lane, int x, bool depth) {
    for (int y = 0;;) {
      if (x == 0) FillRowPlaces(lane, spans_.bottom[lane] + y, spans_.dy[lane], t_.group_tables);
      if (depth) FillRowDepths(t_.setup, lane, spans_.bottom[lane] + y, spans_.dy[lane], t_.group_tables);
      length_ = _mm512_add_epi32(length_, AddWindow(spans_, lane, x, y, list_));
      y += kSpanRows;
      if (y > spans_.height[lane]) return y / kSpanRows - 1;
      spans_.NextRows(lane);
    }
  }

  HWY_NOINLINE void DrawSome() {
    list_.fragments = static_cast<uint64_t>(_mm512_reduce_add_epi32(length_));
    RunGroups(t_, lanes_, list_, blocks_, *stages_);
    list_.count = 0;
    length_ = _mm512_setzero_si512();
  }

  TileContext& t_;
  SpanBatch spans_;
  GroupList list_;
  __m512i length_;  // pixels listed of each row
  const BlockProgram* stages_ = nullptr;
  unsigned lanes_ = 0;
  uint64_t blocks_ = 0;
};
#else
struct GroupBatch {
  HWY_INLINE GroupBatch(TileContext&, unsigned) {}
  HWY_INLINE bool Add(int) { return false; }
  HWY_INLINE void Draw() {}
};
#endif
