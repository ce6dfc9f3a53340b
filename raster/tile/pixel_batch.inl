// Small triangles of one batch together: their pixels are listed, and then tested and packed a whole vector
// at a time, whichever triangles they are of. A vector's lanes take their planes by a permutation, since
// eight primitives' values of a plane lie side by side. For AVX-512 only, which can squeeze and permute 16
// lanes; others take each triangle alone.

#if HWY_TARGET == HWY_AVX3
// Planes of a batch at pixels of its primitives.
struct ListedLanes {
  __m512i lane;
  __m512 dx, dy;  // from each one's anchor; exact

  HWY_INLINE ListedLanes(const SetupBatch& s, __m512i codes) : lane(_mm512_srli_epi32(codes, 12)) {
    const __m512i low = _mm512_set1_epi32(63);
    const __m512i y = _mm512_and_si512(_mm512_srli_epi32(codes, 6), low);
    dx = _mm512_add_ps(_mm512_cvtepi32_ps(_mm512_and_si512(codes, low)), Take(s.anchor_x_f));
    dy = _mm512_add_ps(_mm512_cvtepi32_ps(y), Take(s.anchor_y_f));
  }

  HWY_INLINE __m512 Take(__m256 eight) const {
    return _mm512_permutexvar_ps(lane, _mm512_castps256_ps512(eight));
  }
  HWY_INLINE __m512 Take(const float* eight) const { return Take(_mm256_load_ps(eight)); }

  HWY_INLINE __m512 Plane(const SetupBatch& s, int plane) const {
    const __m512 row = _mm512_add_ps(Take(s.f0_f[plane]), _mm512_mul_ps(Take(s.dfdy_f[plane]), dy));
    return _mm512_add_ps(row, _mm512_mul_ps(Take(s.dfdx_f[plane]), dx));
  }

  // Of eight lanes, the lower or the upper ones.
  template <int kHalf>
  HWY_INLINE __m256i Depth(const SetupBatch& s) const {
    const __m512i which = _mm512_cvtepu32_epi64(_mm512_extracti64x4_epi64(lane, kHalf));
    const auto take = [&](const double* eight)
                          HWY_ATTR { return _mm512_permutexvar_pd(which, _mm512_load_pd(eight)); };
    const auto widen = [](__m512 v) HWY_ATTR {
      return _mm512_cvtps_pd(_mm256_castpd_ps(_mm512_extractf64x4_pd(_mm512_castps_pd(v), kHalf)));
    };
    const __m512d row = _mm512_add_pd(take(s.f0[0]), _mm512_mul_pd(take(s.dfdy[0]), widen(dy)));
    const VD z{_mm512_add_pd(row, _mm512_mul_pd(take(s.dfdx[0]), widen(dx)))};
    return hn::DemoteTo(DDi(), z).raw;
  }
};

// As TileOffset, of codes.
HWY_INLINE __m512i OffsetOf(__m512i codes) {
  const auto bits = [](__m512i from, int which)
                        HWY_ATTR { return _mm512_and_si512(from, _mm512_set1_epi32(which)); };
  return _mm512_or_si512(
      bits(codes, 7 | 7 << 9),
      _mm512_or_si512(bits(_mm512_srli_epi32(codes, 3), 7 << 3), bits(_mm512_slli_epi32(codes, 3), 7 << 6)));
}

// Of each lane, which lanes before it have the same value. Not by the intrinsic: Highway does not compile
// AVX3 for it.
HWY_INLINE __m512i SameBefore(__m512i v) {
  __m512i same;
  __asm__("vpconflictd %1, %0" : "=v"(same) : "v"(v));
  return same;
}

// g++ would rather take a vector's elements out of the register, which costs two instructions each.
HWY_INLINE void KeepInMemory(uint32_t (&values)[kListLanes]) { __asm__("" : "+m"(values)); }

HWY_INLINE __m512i LoadEach(const uint32_t* memory, const uint32_t* at) {
  const auto four = [&](int j) HWY_ATTR {
    const auto one = [&](int k) HWY_ATTR { return static_cast<int>(memory[at[j + k]]); };
    return _mm_setr_epi32(one(0), one(1), one(2), one(3));
  };
  const auto eight = [&](int j) HWY_ATTR {
    return _mm256_inserti128_si256(_mm256_castsi128_si256(four(j)), four(j + 4), 1);
  };
  return _mm512_inserti64x4(_mm512_castsi256_si512(eight(0)), eight(8), 1);
}

// Tests as many of the codes from `i` on as a vector holds, up to the first that has the pixel of one before it. Those
// that pass go to the codes from `left` <= `i` on. Gives how many were tested.
HWY_INLINE int TestListed(const SetupBatch& s, const DepthState& test, uint32_t* depth, int i, int& left,
                          ListedPixels& list) {
  __m512i codes = _mm512_loadu_si512(list.codes + i);
  int count = list.count - i < kListLanes ? list.count - i : kListLanes;
  auto live = static_cast<__mmask16>((1u << count) - 1);
  __m512i places = OffsetOf(codes);
  const __m512i same = SameBefore(places);
  const __mmask16 repeated = live & _mm512_test_epi32_mask(same, _mm512_set1_epi32(-1));
  if (HWY_UNLIKELY(repeated != 0)) {
    count = __builtin_ctz(repeated);
    live = static_cast<__mmask16>((1u << count) - 1);
  }
  // Others stand for the first one, whose depth is written last.
  const auto first_for_others = [&](__m512i v) HWY_ATTR {
    return _mm512_mask_mov_epi32(_mm512_broadcastd_epi32(_mm512_castsi512_si128(v)), live, v);
  };
  codes = first_for_others(codes);
  places = first_for_others(places);
  alignas(64) uint32_t at[kListLanes], values[kListLanes];
  _mm512_store_si512(at, places);
  KeepInMemory(at);
  const ListedLanes lanes(s, codes);
  const __m512i z = _mm512_inserti64x4(_mm512_castsi256_si512(lanes.Depth<0>(s)), lanes.Depth<1>(s), 1);
  const __m512i held = _mm512_min_epi32(_mm512_max_epi32(z, _mm512_setzero_si512()),
                                        _mm512_set1_epi32(static_cast<int>(kDepthMax)));
  const __m512i old = LoadEach(depth, at);
  using D16 = hn::CappedTag<int32_t, kListLanes>;
  const __mmask16 pass = live & PassesDepth(test.func, hn::Vec<D16>{held}, hn::Vec<D16>{old}).raw;
  if (test.write) {
    _mm512_store_si512(values, _mm512_mask_mov_epi32(old, pass, held));
    KeepInMemory(values);
    for (int j = kListLanes - 1; j >= 0; --j) depth[at[j]] = values[j];
  }
  const __m512i passed = _mm512_maskz_compress_epi32(pass, codes);
  const int passes = __builtin_popcount(pass);
  if (HWY_LIKELY(repeated == 0)) _mm512_storeu_si512(list.codes + left, passed);
  else _mm512_mask_storeu_epi32(list.codes + left, static_cast<__mmask16>((1u << passes) - 1), passed);
  left += passes;
  return count;
}

// Queues the pixels of a vector of codes; those beyond the list's end are written over by the next.
HWY_INLINE void QueueListed(TileContext& t, __m512i codes, int first) {
  const SetupBatch& s = t.setup;
  PixelQueue& queue = t.packer.queue;
  const ListedLanes lanes(s, codes);
  const int color = t.flat_color ? t.program->params.color_plane : kMaxPlanes;
  // Where w is constant nobody asks for it.
  for (int p = first; p < t.plane_count; ++p) {
    const bool flat = p >= color && p < color + 4;
    _mm512_storeu_ps(queue.plane[p] + queue.count, flat ? lanes.Take(s.flat[p - color]) : lanes.Plane(s, p));
  }
  _mm512_storeu_si512(queue.offset + queue.count, OffsetOf(codes));
}

// Tests and packs what is listed. To be called before anything else is drawn, and while the batch is there. All are
// tested before the first is packed: so no interpolation waits for memory.
HWY_NOINLINE void PackAllListed(TileContext& t) {
  ListedPixels& list = t.listed;
  PixelQueue& queue = t.packer.queue;
  uint32_t* depth = PreparePacking(t, list.variant, 0, list.blocks);
  t.statistics->fragments += static_cast<uint64_t>(list.count);
  if (depth != nullptr) {
    int left = 0;
    for (int i = 0; i < list.count;) i += TestListed(t.setup, t.program->depth, depth, i, left, list);
    list.count = left;
  }
  const int first = (list.variant & kAffine) != 0 ? 2 : 1;
  for (int i = 0; i < list.count; i += kListLanes) {
    if (queue.count > PixelQueue::kCapacity - kListLanes) {
      FlushPacked(t);
      t.packer.blocks = list.blocks;
    }
    QueueListed(t, _mm512_loadu_si512(list.codes + i), first);
    queue.count += list.count - i < kListLanes ? list.count - i : kListLanes;
  }
  list.count = 0;
  list.blocks = 0;
}
// Pixels of a window row by row, windows of each width: a vector holds as many rows as go into it, whole or not.
struct WindowLanes {
  // Of pixel i of a window: column and row, as the 16-bit halves of a word; the same in the places of a code.
  alignas(64) uint32_t places[kWindow][kBlockPixels], codes[kWindow][kBlockPixels];
};
inline constexpr WindowLanes kWindowLanes = [] {
  WindowLanes lanes{};
  for (uint32_t width = 1; width <= kWindow; ++width) {
    for (uint32_t i = 0; i < kBlockPixels; ++i) {
      lanes.places[width - 1][i] = i % width | (i / width) << 16;
      lanes.codes[width - 1][i] = i % width | (i / width) << 6;
    }
  }
  return lanes;
}();

// What is the same for the pixels of a triangle, of eight triangles at once.
struct ListedWindows {
  alignas(32) int32_t edge[3][kSetupLanes];  // at the window's first pixel
  alignas(32) int32_t step[3][kSetupLanes];  // along a row and a column, in 16 bits each
  alignas(32) int32_t code[kSetupLanes];     // of the first pixel
  alignas(32) int32_t side[kSetupLanes];     // pixels of a row, less one
  alignas(32) int32_t pixels[kSetupLanes];   // of the window
  __mmask8 wide;                             // lanes of more columns or rows than kWindow
  __mmask8 above_16, above_32;               // of more pixels than that; what is wide counts among the former
  uint64_t blocks;                           // of all

  HWY_INLINE ListedWindows(const SetupBatch& s, __m256i width, __m256i height, __mmask8 lanes) {
    const auto load = [](const int32_t* from)
                          HWY_ATTR { return _mm256_load_si256(reinterpret_cast<const __m256i*>(from)); };
    const auto store = [](__m256i v, int32_t* to) HWY_ATTR { _mm256_store_si256(reinterpret_cast<__m256i*>(to), v); };
    const __m256i x = load(s.min_x), y = load(s.min_y), one = _mm256_set1_epi32(1);
    for (int k = 0; k < 3; ++k) {
      const __m256i right = load(s.step_x[k]), up = load(s.step_y[k]);
      const __m256i moved = _mm256_add_epi32(_mm256_mullo_epi32(right, x), _mm256_mullo_epi32(up, y));
      store(_mm256_add_epi32(load(s.edge[k]), moved), edge[k]);
      store(_mm256_blend_epi16(right, _mm256_slli_epi32(up, 16), 0xaa), step[k]);
    }
    const __m256i lane = _mm256_setr_epi32(0, 1 << 12, 2 << 12, 3 << 12, 4 << 12, 5 << 12, 6 << 12, 7 << 12);
    store(_mm256_or_si256(lane, _mm256_or_si256(_mm256_slli_epi32(y, 6), x)), code);
    store(width, side);
    const __m256i count = _mm256_mullo_epi32(_mm256_add_epi32(width, one), _mm256_add_epi32(height, one));
    store(count, pixels);
    wide = _mm256_mask_cmpge_epi32_mask(lanes, _mm256_max_epi32(width, height), _mm256_set1_epi32(kWindow));
    above_16 = _mm256_mask_cmpgt_epi32_mask(lanes, count, _mm256_set1_epi32(16)) | wide;
    above_32 = _mm256_mask_cmpgt_epi32_mask(lanes, count, _mm256_set1_epi32(32));
    FindBlocks(x, y, _mm256_add_epi32(x, width), _mm256_add_epi32(y, height), lanes);
  }

 private:
  // As WindowBlocks; of three blocks along an axis, the one in the middle lies there.
  HWY_INLINE void FindBlocks(__m256i x0, __m256i y0, __m256i x1, __m256i y1, __mmask8 lanes) {
    const __m256i one = _mm256_set1_epi32(1), high = _mm256_set1_epi32(~7);
    const auto middle = [](__m256i low, __m256i top)
                            HWY_ATTR { return _mm256_srli_epi32(_mm256_add_epi32(low, top), 1); };
    const auto column = [&](__m256i x) HWY_ATTR { return _mm256_sllv_epi32(one, _mm256_srai_epi32(x, 3)); };
    const __m512i columns = _mm512_cvtepu32_epi64(
        _mm256_or_si256(_mm256_or_si256(column(x0), column(x1)), column(middle(x0, x1))));
    const auto row = [&](__m256i y) HWY_ATTR {
      return _mm512_sllv_epi64(columns, _mm512_cvtepi32_epi64(_mm256_and_si256(y, high)));
    };
    const __m512i rows = _mm512_or_si512(_mm512_or_si512(row(y0), row(y1)), row(middle(y0, y1)));
    blocks = static_cast<uint64_t>(_mm512_mask_reduce_or_epi64(lanes, rows));
  }
};

// Lists the pixels inside a triangle, of a vector of its window at a time.
struct WindowLister {
  const uint32_t *places, *codes;
  __m512i edge[3], step[3], code, pixels;
  int side;

  HWY_INLINE WindowLister(const ListedWindows& windows, int lane)
      : places(kWindowLanes.places[windows.side[lane] % kWindow]),
        codes(kWindowLanes.codes[windows.side[lane] % kWindow]),
        code(_mm512_set1_epi32(windows.code[lane])),
        pixels(_mm512_set1_epi32(windows.pixels[lane])),
        side(windows.side[lane]) {
    for (int k = 0; k < 3; ++k) {
      edge[k] = _mm512_set1_epi32(windows.edge[k][lane]);
      step[k] = _mm512_set1_epi32(windows.step[k][lane]);
    }
  }

  // After the first `count` of the list; gives how many there are then.
  template <int kVector>
  HWY_INLINE int List(uint32_t* list, int count) const {
    constexpr int kFirst = kVector * kListLanes;
    const __mmask16 window = _mm512_cmplt_epi32_mask(_mm512_add_epi32(Lanes(), _mm512_set1_epi32(kFirst)), pixels);
    return ListPlaces(_mm512_load_si512(places + kFirst), _mm512_load_si512(codes + kFirst), window, list, count);
  }

  // Windows of up to 16 columns: a row, or two of up to 8, at a time.
  HWY_INLINE int ListWide(int rows, uint32_t* list, int count) const {
    const bool pairs = side < kWindow;
    const __m512i column = pairs ? _mm512_and_si512(Lanes(), _mm512_set1_epi32(7)) : Lanes();
    const __m512i row = pairs ? _mm512_srli_epi32(Lanes(), 3) : _mm512_setzero_si512();
    const __mmask16 within = _mm512_cmple_epi32_mask(column, _mm512_set1_epi32(side));
    const int step_rows = pairs ? 2 : 1;
    const __m512i next_place = _mm512_set1_epi32(step_rows << 16), next_code = _mm512_set1_epi32(step_rows << 6);
    __m512i place = _mm512_or_si512(column, _mm512_slli_epi32(row, 16));
    __m512i found = _mm512_or_si512(column, _mm512_slli_epi32(row, 6));
    for (int y = 0; y < rows; y += step_rows) {
      const __mmask16 window = y + step_rows <= rows ? within : within & 0xff;
      count = ListPlaces(place, found, window, list, count);
      place = _mm512_add_epi32(place, next_place);
      found = _mm512_add_epi32(found, next_code);
    }
    return count;
  }

 private:
  static HWY_INLINE __m512i Lanes() { return _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15); }

  HWY_INLINE int ListPlaces(__m512i place, __m512i codes_there, __mmask16 window, uint32_t* list, int count) const {
    const auto at = [&](int k) HWY_ATTR { return _mm512_add_epi32(_mm512_madd_epi16(place, step[k]), edge[k]); };
    const __m512i outside = _mm512_or_si512(_mm512_or_si512(at(0), at(1)), at(2));
    const __mmask16 inside = _mm512_mask_cmpge_epi32_mask(window, outside, _mm512_setzero_si512());
    _mm512_storeu_si512(list + count, _mm512_maskz_compress_epi32(inside, _mm512_add_epi32(codes_there, code)));
    return count + __builtin_popcount(inside);
  }
};

struct WindowSizes {
  __m256i width, height;  // of the pixels to look at, less one
  HWY_INLINE explicit WindowSizes(const SetupBatch& s)
      : width(Side(s.min_x, s.max_x)), height(Side(s.min_y, s.max_y)) {}
  HWY_INLINE __mmask8 Empty() const {
    return _mm256_cmplt_epi32_mask(_mm256_min_epi32(width, height), _mm256_setzero_si256());
  }
  HWY_INLINE __mmask8 Below(int size) const {
    return _mm256_cmplt_epi32_mask(_mm256_max_epi32(width, height), _mm256_set1_epi32(size));
  }

 private:
  static HWY_INLINE __m256i Side(const int32_t* least, const int32_t* most) {
    return _mm256_sub_epi32(_mm256_load_si256(reinterpret_cast<const __m256i*>(most)),
                            _mm256_load_si256(reinterpret_cast<const __m256i*>(least)));
  }
};

// Triangles whose edges' steps fit in 16 bits. Of a large one, a window may be all that the draw's bounds leave.
HWY_INLINE __mmask8 ShortSides(const SetupBatch& s) {
  const __m256i size = _mm256_load_si256(reinterpret_cast<const __m256i*>(s.size));
  return _mm256_cmplt_epi32_mask(size, _mm256_set1_epi32(1 << 15));
}

HWY_INLINE unsigned EmptyTriangles(const SetupBatch& s) { return WindowSizes(s).Empty(); }

// Of these triangles of the batch, none of them without pixels, those of one variant that may be listed.
HWY_INLINE unsigned ListableTriangles(const TileContext& t, unsigned all) {
  const SetupBatch& s = t.setup;
  if (!t.program->packs || IsWatched(t)) return 0;
  const WindowSizes sizes(s);
  unsigned small = sizes.Below(kWideWindow) & ShortSides(s) & all;
  if (small == 0) return 0;
  uint64_t variants;
  memcpy(&variants, s.variant, sizeof variants);
  const uint8_t variant = s.variant[__builtin_ctz(small)];
  if ((variant & kDouble) != 0) return 0;
  if (t.program->variants[variant].groups != nullptr) small &= sizes.Below(kWindow);
  const __m128i same = _mm_cmpeq_epi8(_mm_cvtsi64_si128(static_cast<long long>(variants)),
                                      _mm_set1_epi8(static_cast<char>(variant)));
  return small & static_cast<unsigned>(_mm_movemask_epi8(same));
}

void PackBlocks(TileContext& t, int lane, const uint64_t* masks, uint64_t blocks) {
  ListedPixels& list = t.listed;
  list.variant = t.setup.variant[lane];
  list.blocks = blocks;
  // Codes of a block's first two rows.
  const __m512i two_rows = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 64, 65, 66, 67, 68, 69, 70, 71);
  int count = list.count;
  for (; blocks != 0; blocks &= blocks - 1) {
    const int block = __builtin_ctzll(blocks);
    __m512i codes = _mm512_add_epi32(
        two_rows, _mm512_set1_epi32(lane << 12 | block / 8 * kBlockSize << 6 | block % 8 * kBlockSize));
    for (uint64_t left = masks[block]; left != 0; left >>= kListLanes) {
      const auto live = static_cast<__mmask16>(left);
      _mm512_storeu_si512(list.codes + count, _mm512_maskz_compress_epi32(live, codes));
      count += __builtin_popcount(live);
      codes = _mm512_add_epi32(codes, _mm512_set1_epi32(2 << 6));
    }
  }
  list.count = count;
  PackAllListed(t);
}

// Draws these triangles of the batch, which follow each other but for triangles without pixels.
HWY_INLINE void ListTriangles(TileContext& t, unsigned which) {
  const SetupBatch& s = t.setup;
  const WindowSizes sizes(s);
  const auto lanes = static_cast<__mmask8>(which);
  ListedPixels& list = t.listed;
  list.variant = s.variant[__builtin_ctz(lanes)];
  const ListedWindows windows(s, sizes.width, sizes.height, lanes);
  int count = list.count;  // in a register: stores of codes might be to the list's
  if (windows.above_16 == 0) {
    for (unsigned todo = lanes; todo != 0; todo &= todo - 1)
      count = WindowLister(windows, __builtin_ctz(todo)).List<0>(list.codes, count);
  } else {
    for (unsigned todo = lanes; todo != 0; todo &= todo - 1) {
      const int lane = __builtin_ctz(todo);
      const WindowLister lister(windows, lane);
      if ((windows.wide >> lane & 1) != 0) {
        count = lister.ListWide(s.max_y[lane] - s.min_y[lane] + 1, list.codes, count);
        continue;
      }
      count = lister.List<1>(list.codes, lister.List<0>(list.codes, count));
      if ((windows.above_32 >> lane & 1) != 0) count = lister.List<3>(list.codes, lister.List<2>(list.codes, count));
    }
  }
  list.count = count;
  list.blocks = windows.blocks;
  if (list.count != 0) PackAllListed(t);
}
#else
HWY_INLINE unsigned EmptyTriangles(const SetupBatch&) { return 0; }
HWY_INLINE unsigned ListableTriangles(const TileContext&, unsigned) { return 0; }
HWY_INLINE void ListTriangles(TileContext&, unsigned) {}
void PackBlocks(TileContext& t, int lane, const uint64_t* masks, uint64_t blocks) {
  for (; blocks != 0; blocks &= blocks - 1) {
    const int block = __builtin_ctzll(blocks);
    TestAndPack(t, lane, block % 8 * kBlockSize, block / 8 * kBlockSize, masks[block], blocks & -blocks);
  }
}
#endif
