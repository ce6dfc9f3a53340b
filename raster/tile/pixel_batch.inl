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
    const auto anchor = [&](const double* from)
                            HWY_ATTR { return Take(_mm512_cvtpd_ps(_mm512_load_pd(from))); };
    dx = _mm512_add_ps(_mm512_cvtepi32_ps(_mm512_and_si512(codes, low)), anchor(s.anchor_x));
    dy = _mm512_add_ps(_mm512_cvtepi32_ps(_mm512_and_si512(_mm512_srli_epi32(codes, 6), low)), anchor(s.anchor_y));
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
  const __m512i same = SameBefore(OffsetOf(codes));
  const __mmask16 repeated = live & _mm512_test_epi32_mask(same, _mm512_set1_epi32(-1));
  if (HWY_UNLIKELY(repeated != 0)) {
    count = __builtin_ctz(repeated);
    live = static_cast<__mmask16>((1u << count) - 1);
  }
  // Others stand for the first one, whose depth is written last.
  codes = _mm512_mask_mov_epi32(_mm512_broadcastd_epi32(_mm512_castsi512_si128(codes)), live, codes);
  alignas(64) uint32_t at[kListLanes], values[kListLanes];
  _mm512_store_si512(at, OffsetOf(codes));
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
// What is the same for the pixels of a triangle, of eight triangles at once.
struct ListedWindows {
  alignas(64) int32_t edge[3][kSetupLanes];  // at the window's first pixel
  alignas(32) int32_t code[kSetupLanes];     // of that pixel
  alignas(64) uint64_t box[kSetupLanes];     // pixels of the window to look at
  uint64_t blocks;                           // of all

  // A window is `kSide` pixels wide and high, 8 or 4.
  template <int kSide>
  HWY_INLINE void Make(const SetupBatch& s, __m256i width, __m256i height, __mmask8 lanes) {
    const __m256i x = _mm256_load_si256(reinterpret_cast<const __m256i*>(s.min_x));
    const __m256i y = _mm256_load_si256(reinterpret_cast<const __m256i*>(s.min_y));
    const auto load = [](const int32_t* from)
                          HWY_ATTR { return _mm256_load_si256(reinterpret_cast<const __m256i*>(from)); };
    for (int k = 0; k < 3; ++k) {
      const __m256i moved = _mm256_add_epi32(_mm256_mullo_epi32(load(s.step_x[k]), x),
                                             _mm256_mullo_epi32(load(s.step_y[k]), y));
      _mm256_store_si256(reinterpret_cast<__m256i*>(edge[k]), _mm256_add_epi32(load(s.edge[k]), moved));
    }
    const __m256i lane = _mm256_setr_epi32(0, 1 << 12, 2 << 12, 3 << 12, 4 << 12, 5 << 12, 6 << 12, 7 << 12);
    _mm256_store_si256(reinterpret_cast<__m256i*>(code),
                       _mm256_or_si256(lane, _mm256_or_si256(_mm256_slli_epi32(y, 6), x)));
    MakeBoxes<kSide>(width, height);
    MakeBlocks(x, y, _mm256_add_epi32(x, width), _mm256_add_epi32(y, height), lanes);
  }

 private:
  template <int kSide>
  HWY_INLINE void MakeBoxes(__m256i width, __m256i height) {
    const __m512i w = _mm512_cvtepi32_epi64(width), h = _mm512_cvtepi32_epi64(height);
    const __m512i row = _mm512_sub_epi64(_mm512_sllv_epi64(_mm512_set1_epi64(2), w), _mm512_set1_epi64(1));
    const __m512i columns = _mm512_mullo_epi32(row, _mm512_set1_epi32(kSide == 8 ? 0x01010101 : 0x1111));
    const __m512i all = kSide == 8 ? _mm512_or_si512(columns, _mm512_slli_epi64(columns, 32)) : columns;
    const __m512i beyond =
        _mm512_sllv_epi64(_mm512_set1_epi64(-1 << kSide), _mm512_slli_epi64(h, kSide == 8 ? 3 : 2));
    _mm512_store_si512(box, _mm512_andnot_si512(beyond, all));
  }

  // As WindowBlocks.
  HWY_INLINE void MakeBlocks(__m256i x0, __m256i y0, __m256i x1, __m256i y1, __mmask8 lanes) {
    const __m256i one = _mm256_set1_epi32(1), high = _mm256_set1_epi32(~7);
    const __m512i columns = _mm512_cvtepu32_epi64(_mm256_or_si256(
        _mm256_sllv_epi32(one, _mm256_srai_epi32(x0, 3)), _mm256_sllv_epi32(one, _mm256_srai_epi32(x1, 3))));
    const __m512i lower = _mm512_sllv_epi64(columns, _mm512_cvtepi32_epi64(_mm256_and_si256(y0, high)));
    const __m512i upper = _mm512_sllv_epi64(columns, _mm512_cvtepi32_epi64(_mm256_and_si256(y1, high)));
    blocks = static_cast<uint64_t>(_mm512_mask_reduce_or_epi64(lanes, _mm512_or_si512(lower, upper)));
  }
};

template <int kSide>
HWY_INLINE void ListLane(const SetupBatch& s, const ListedWindows& windows, int lane, ListedPixels& list) {
  constexpr int kRows = kListLanes / kSide;  // a vector's
  const __m512i index = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const __m512i column = _mm512_and_si512(index, _mm512_set1_epi32(kSide - 1));
  const __m512i row = _mm512_srli_epi32(index, kSide == 8 ? 3 : 2);
  __m512i e[3], step[3];
  for (int k = 0; k < 3; ++k) {
    const __m512i up = _mm512_set1_epi32(s.step_y[k][lane]);
    e[k] = _mm512_add_epi32(_mm512_mullo_epi32(column, _mm512_set1_epi32(s.step_x[k][lane])),
                            _mm512_mullo_epi32(row, up));
    e[k] = _mm512_add_epi32(e[k], _mm512_set1_epi32(windows.edge[k][lane]));
    step[k] = _mm512_slli_epi32(up, 1);
  }
  __m512i codes = _mm512_add_epi32(_mm512_or_si512(column, _mm512_slli_epi32(row, 6)),
                                   _mm512_set1_epi32(windows.code[lane]));
  const uint64_t box = windows.box[lane];
  int count = list.count;
  for (int i = 0; i < kSide * kSide; i += kListLanes) {
    const __m512i outside = _mm512_or_si512(_mm512_or_si512(e[0], e[1]), e[2]);
    const auto inside = static_cast<__mmask16>(
        _mm512_mask_cmpge_epi32_mask(static_cast<__mmask16>(box >> i), outside, _mm512_setzero_si512()));
    _mm512_storeu_si512(list.codes + count, _mm512_maskz_compress_epi32(inside, codes));
    count += __builtin_popcount(inside);
    codes = _mm512_add_epi32(codes, _mm512_set1_epi32(kRows << 6));
    for (int k = 0; k < 3; ++k) e[k] = _mm512_add_epi32(e[k], step[k]);
  }
  list.count = count;
}

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

// Of the first `count` triangles of the batch, those of one variant that may be listed, and those without
// pixels.
HWY_INLINE unsigned ListableTriangles(const TileContext& t, int count) {
  const SetupBatch& s = t.setup;
  if (!t.program->packs || t.notes != nullptr || t.block.meter != nullptr) return 0;
  const WindowSizes sizes(s);
  const unsigned all = (1u << count) - 1, empty = sizes.Empty() & all,
                 small = sizes.Below(kWindow) & all & ~empty;
  if (small == 0) return empty;
  uint64_t variants;
  memcpy(&variants, s.variant, sizeof variants);
  const uint8_t variant = s.variant[__builtin_ctz(small)];
  if ((variant & kDouble) != 0) return empty;
  const __m128i same = _mm_cmpeq_epi8(_mm_cvtsi64_si128(static_cast<long long>(variants)),
                                      _mm_set1_epi8(static_cast<char>(variant)));
  return empty | (small & static_cast<unsigned>(_mm_movemask_epi8(same)));
}

// Draws these triangles of the batch, which follow each other.
HWY_INLINE void ListTriangles(TileContext& t, unsigned which) {
  const SetupBatch& s = t.setup;
  const WindowSizes sizes(s);
  const auto lanes = static_cast<__mmask8>(which & ~unsigned{sizes.Empty()});
  if (lanes == 0) return;
  ListedPixels& list = t.listed;
  list.variant = s.variant[__builtin_ctz(lanes)];
  ListedWindows windows;
  if ((lanes & ~unsigned{sizes.Below(4)}) == 0) {
    windows.Make<4>(s, sizes.width, sizes.height, lanes);
    for (unsigned todo = lanes; todo != 0; todo &= todo - 1)
      ListLane<4>(s, windows, __builtin_ctz(todo), list);
  } else {
    windows.Make<8>(s, sizes.width, sizes.height, lanes);
    for (unsigned todo = lanes; todo != 0; todo &= todo - 1)
      ListLane<8>(s, windows, __builtin_ctz(todo), list);
  }
  list.blocks = windows.blocks;
  if (list.count != 0) PackAllListed(t);
}
#else
HWY_INLINE unsigned ListableTriangles(const TileContext&, int) { return 0; }
HWY_INLINE void ListTriangles(TileContext&, unsigned) {}
#endif
