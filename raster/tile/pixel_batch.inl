// Small triangles of one batch together: their pixels are listed, and then tested and packed a whole vector
// at a time, whichever triangles they are of. A vector's lanes take their planes by a permutation, since
// eight primitives' values of a plane lie side by side. For AVX-512 only, which can squeeze and permute 16
// lanes; others take each triangle alone.

#if HWY_TARGET == HWY_AVX3
// Planes of a batch at pixels of its primitives.
struct ListedLanes {
  __m512i lane, x, y;
  __m512 dx, dy;  // from each one's anchor

  HWY_INLINE ListedLanes(const SetupBatch& s, __m512i codes)
      : lane(_mm512_srli_epi32(codes, 12)),
        x(_mm512_and_si512(codes, _mm512_set1_epi32(63))),
        y(_mm512_and_si512(_mm512_srli_epi32(codes, 6), _mm512_set1_epi32(63))) {
    const auto anchor = [&](const double* from)
                            HWY_ATTR { return Take(_mm512_cvtpd_ps(_mm512_load_pd(from))); };
    dx = _mm512_add_ps(_mm512_cvtepi32_ps(x), anchor(s.anchor_x));
    dy = _mm512_add_ps(_mm512_cvtepi32_ps(y), anchor(s.anchor_y));
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
    const __m512d px = _mm512_cvtepi32_pd(_mm512_extracti64x4_epi64(x, kHalf));
    const __m512d py = _mm512_cvtepi32_pd(_mm512_extracti64x4_epi64(y, kHalf));
    const __m512d ddx = _mm512_add_pd(px, take(s.anchor_x)), ddy = _mm512_add_pd(py, take(s.anchor_y));
    const __m512d row = _mm512_add_pd(take(s.f0[0]), _mm512_mul_pd(take(s.dfdy[0]), ddy));
    const VD z{_mm512_add_pd(row, _mm512_mul_pd(take(s.dfdx[0]), ddx))};
    return hn::DemoteTo(DDi(), z).raw;
  }
};

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

// The lanes of `live` that pass. No two have the same pixel.
HWY_INLINE __mmask16 TestListed(const SetupBatch& s, const ListedLanes& lanes, __m512i offset, __mmask16 live,
                                int count, const DepthState& test, uint32_t* depth) {
  alignas(64) uint32_t at[kListLanes], values[kListLanes];
  _mm512_store_si512(at, offset);
  KeepInMemory(at);
  const __m512i z = _mm512_inserti64x4(_mm512_castsi256_si512(lanes.Depth<0>(s)), lanes.Depth<1>(s), 1);
  const __m512i held = _mm512_min_epi32(_mm512_max_epi32(z, _mm512_setzero_si512()),
                                        _mm512_set1_epi32(static_cast<int>(kDepthMax)));
  const __m512i old = LoadEach(depth, at);
  using D16 = hn::CappedTag<int32_t, kListLanes>;
  const __mmask16 pass = live & PassesDepth(test.func, hn::Vec<D16>{held}, hn::Vec<D16>{old}).raw;
  if (!test.write) return pass;
  _mm512_store_si512(values, _mm512_mask_mov_epi32(old, pass, held));
  KeepInMemory(values);
  if (count == kListLanes) {
    for (int j = 0; j < kListLanes; ++j) depth[at[j]] = values[j];
  } else {
    for (int j = 0; j < count; ++j) depth[at[j]] = values[j];
  }
  return pass;
}

// Pixels of the codes from `i` on, up to the first that another one of them has, too. Gives how many.
HWY_INLINE int PackListed(TileContext& t, int i, uint32_t* depth) {
  const SetupBatch& s = t.setup;
  const ListedPixels& list = t.listed;
  PixelQueue& queue = t.packer.queue;
  const __m512i codes = _mm512_loadu_si512(list.codes + i);
  const ListedLanes lanes(s, codes);
  const auto bits = [&](__m512i from, int which)
                        HWY_ATTR { return _mm512_and_si512(from, _mm512_set1_epi32(which)); };
  // As TileOffset, of codes.
  const __m512i offset = _mm512_or_si512(
      bits(codes, 7 | 7 << 9),
      _mm512_or_si512(bits(_mm512_srli_epi32(codes, 3), 7 << 3), bits(_mm512_slli_epi32(codes, 3), 7 << 6)));
  int count = list.count - i < kListLanes ? list.count - i : kListLanes;
  auto live = static_cast<__mmask16>((1u << count) - 1);
  const __mmask16 repeated = live & _mm512_test_epi32_mask(SameBefore(offset), _mm512_set1_epi32(-1));
  if (HWY_UNLIKELY(repeated != 0)) {
    count = __builtin_ctz(repeated);
    live = static_cast<__mmask16>((1u << count) - 1);
  }
  if (depth != nullptr) live = TestListed(s, lanes, offset, live, count, t.program->depth, depth);
  const auto pack = [&](__m512 values, void* to)
                        HWY_ATTR { _mm512_storeu_ps(to, _mm512_maskz_compress_ps(live, values)); };
  const int color = t.flat_color ? t.program->params.color_plane : kMaxPlanes;
  // Where w is constant nobody asks for it.
  for (int p = (list.variant & kAffine) != 0 ? 2 : 1; p < t.plane_count; ++p) {
    const bool flat = p >= color && p < color + 4;
    pack(flat ? lanes.Take(s.flat[p - color]) : lanes.Plane(s, p), queue.plane[p] + queue.count);
  }
  pack(_mm512_castsi512_ps(offset), queue.offset + queue.count);
  queue.count += __builtin_popcount(live);
  return count;
}

// Tests and packs what is listed. To be called before anything else is drawn, and while the batch is there.
HWY_NOINLINE void PackAllListed(TileContext& t) {
  ListedPixels& list = t.listed;
  PixelQueue& queue = t.packer.queue;
  uint32_t* depth = PreparePacking(t, list.variant, 0, list.blocks);
  t.statistics->fragments += static_cast<uint64_t>(list.count);
  for (int i = 0; i < list.count;) {
    if (queue.count > PixelQueue::kCapacity - kListLanes) {
      FlushPacked(t);
      t.packer.blocks = list.blocks;
    }
    i += PackListed(t, i, depth);
  }
  list.count = 0;
  list.blocks = 0;
}
HWY_INLINE void FinishListed(TileContext& t) {
  if (t.listed.count != 0) PackAllListed(t);
}

// A triangle of a window's size.
HWY_INLINE void ListTriangle(TileContext& t, int lane) {
  const SetupBatch& s = t.setup;
  ListedPixels& list = t.listed;
  if (list.variant != s.variant[lane]) {
    FinishListed(t);
    list.variant = s.variant[lane];
  }
  const int x = s.min_x[lane], y = s.min_y[lane], width = s.max_x[lane] - x + 1,
            height = s.max_y[lane] - y + 1;
  uint64_t mask = GroupWalk(s, lane).Pixels(x, y);
  mask &= (0x0101010101010101u * ((1u << width) - 1)) & (~uint64_t{0} >> (64 - 8 * height));
  if (mask == 0) return;
  list.blocks |= WindowBlocks(x, y, s.max_x[lane], s.max_y[lane]);
  const __m512i pattern = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 64, 65, 66, 67, 68, 69, 70, 71);
  __m512i codes = _mm512_add_epi32(pattern, _mm512_set1_epi32(lane << 12 | y << 6 | x));
  for (int i = 0; i < kBlockPixels; i += kListLanes) {
    const auto group = static_cast<__mmask16>(mask >> i);
    _mm512_storeu_si512(list.codes + list.count, _mm512_maskz_compress_epi32(group, codes));
    list.count += __builtin_popcount(group);
    codes = _mm512_add_epi32(codes, _mm512_set1_epi32(2 << 6));
  }
}
#else
HWY_INLINE void FinishListed(TileContext&) {}
HWY_INLINE void ListTriangle(TileContext& t, int lane) { PackTriangle(t, lane); }
#endif
