// Small triangles behind all that others have drawn before them. As none of those covers a block, the tile does not know
// how deep its blocks are: it looks, now and then. Compiled once per ISA level.

// Of the blocks that were drawn on since, how deep they are.
HWY_NOINLINE void LookUpDepths(TileContext& t) {
  const hn::CappedTag<uint32_t, 16> d;
  const uint32_t* depth = t.framebuffer->depth_tile(t.tile);
  for (uint64_t todo = t.hidden.drawn_on & ~t.state->depth_marks(); todo != 0; todo &= todo - 1) {
    const int block = __builtin_ctzll(todo);
    const uint32_t* pixels = depth + block * kBlockPixels;
    auto deepest = hn::Load(d, pixels);
    for (size_t i = hn::Lanes(d); i < kBlockPixels; i += hn::Lanes(d)) deepest = hn::Max(deepest, hn::Load(d, pixels + i));
    t.state->depth_max[block] = hn::GetLane(hn::MaxOfLanes(d, deepest));
  }
  t.hidden.drawn_on = 0;
  t.hidden.since = 0;
  t.hidden.knows = true;
  t.knows_deepest = false;
}

#if HWY_TARGET == HWY_AVX3
// The blocks that boxes of eight triangles touch.
HWY_INLINE __m512i BlocksOfBoxes(__m256i min_x, __m256i min_y, __m256i max_x, __m256i max_y) {
  const auto bits = [](__m256i from, __m256i to) HWY_ATTR {
    return _mm512_andnot_si512(_mm512_sllv_epi64(_mm512_set1_epi64(-2), _mm512_cvtepi32_epi64(to)),
                               _mm512_sllv_epi64(_mm512_set1_epi64(-1), _mm512_cvtepi32_epi64(from)));
  };
  const __m256i in_row = _mm256_set1_epi32(7);
  const __m512i first_byte = _mm512_set_epi64(0x0808080808080808, 0, 0x0808080808080808, 0, 0x0808080808080808, 0,
                                              0x0808080808080808, 0);
  const __m512i columns =
      _mm512_shuffle_epi8(bits(_mm256_srli_epi32(min_x, 3), _mm256_srli_epi32(max_x, 3)), first_byte);
  return _mm512_and_si512(columns, bits(_mm256_andnot_si256(in_row, min_y), _mm256_or_si256(in_row, max_y)));
}

// Of `lanes`, the triangles that IsBehind is true of, in all blocks their boxes touch.
HWY_INLINE unsigned HiddenLanes(const SetupBatch& s, unsigned lanes, const TileState& state) {
  const auto load = [](const int32_t* from) HWY_ATTR { return _mm256_load_si256(reinterpret_cast<const __m256i*>(from)); };
  const __m256i min_x = load(s.min_x), min_y = load(s.min_y), max_x = load(s.max_x), max_y = load(s.max_y);
  const auto least_along = [](const double* slopes, const double* anchor, __m256i low, __m256i high) HWY_ATTR {
    const __m512d slope = _mm512_load_pd(slopes);
    const __mmask8 rises = _mm512_cmp_pd_mask(slope, _mm512_setzero_pd(), _CMP_GT_OQ);
    const __m512d at = _mm512_cvtepi32_pd(_mm256_mask_mov_epi32(high, rises, low));
    return _mm512_mul_pd(slope, _mm512_add_pd(_mm512_load_pd(anchor), at));
  };
  const __m512d up = least_along(s.dfdy[0], s.anchor_y, min_y, max_y);
  const __m512d across = least_along(s.dfdx[0], s.anchor_x, min_x, max_x);
  const __m512d least = _mm512_add_pd(_mm512_add_pd(_mm512_load_pd(s.f0[0]), up), across);
  // What is no number becomes 0. Less the two steps that IsBehind leaves, and one for what is cut off.
  const __m512d held = _mm512_min_pd(_mm512_max_pd(least, _mm512_setzero_pd()), _mm512_set1_pd(kDepthScale));
  alignas(32) int32_t most[kSetupLanes];
  _mm256_store_si256(reinterpret_cast<__m256i*>(most), _mm256_sub_epi32(_mm512_cvttpd_epi32(held), _mm256_set1_epi32(3)));
  alignas(64) uint64_t blocks[kSetupLanes];
  _mm512_store_si512(blocks, BlocksOfBoxes(min_x, min_y, max_x, max_y));
  const auto* depths = reinterpret_cast<const __m512i*>(state.depth_max);
  unsigned hidden = 0;
#pragma GCC unroll 8
  for (int lane = 0; lane < kSetupLanes; ++lane) {
    const __m512i limit = _mm512_set1_epi32(most[lane]);
    const auto deeper = [&](int k) HWY_ATTR { return _mm512_cmpgt_epi32_mask(_mm512_loadu_si512(depths + k), limit); };
    const __mmask64 all = _mm512_kunpackd(_mm512_kunpackw(deeper(3), deeper(2)), _mm512_kunpackw(deeper(1), deeper(0)));
    hidden |= ((blocks[lane] & _cvtmask64_u64(all)) == 0 ? 1u : 0u) << lane;
  }
  return hidden;
}

#else
HWY_INLINE bool IsHidden(const SetupBatch& s, int lane, const TileState& state) {
  const int x0 = s.min_x[lane], y0 = s.min_y[lane], x1 = s.max_x[lane], y1 = s.max_y[lane];
  const double least = BoxDepth(s, lane, s.anchor_x[lane] + x0, s.anchor_y[lane] + y0, x1 - x0, y1 - y0, -1);
  uint32_t deepest = 0;
  for (int y = y0 / kBlockSize; y <= y1 / kBlockSize; ++y)
    for (int x = x0 / kBlockSize; x <= x1 / kBlockSize; ++x)
      if (state.depth_max[y * 8 + x] > deepest) deepest = state.depth_max[y * 8 + x];
  return IsBehind(least, deepest);
}

HWY_INLINE unsigned HiddenLanes(const SetupBatch& s, unsigned lanes, const TileState& state) {
  unsigned hidden = 0;
  for (; lanes != 0; lanes &= lanes - 1) {
    const int lane = __builtin_ctz(lanes);
    if (s.max_x[lane] >= s.min_x[lane] && s.max_y[lane] >= s.min_y[lane] && IsHidden(s, lane, state)) hidden |= 1u << lane;
  }
  return hidden;
}
#endif

// Of triangles in these lanes, those that may be seen.
HWY_INLINE unsigned DropHidden(TileContext& t, unsigned lanes) {
  HiddenTriangles& h = t.hidden;
  if (h.pauses || !t.program->rejects_deeper) return lanes;
  h.since += __builtin_popcount(lanes);
  if (h.since > HiddenTriangles::kAtOnce) LookUpDepths(t);
  if (!h.knows) return lanes;
  const unsigned hidden = lanes & HiddenLanes(t.setup, lanes, *t.state);
  h.asked += static_cast<uint64_t>(__builtin_popcount(lanes));
  h.found += static_cast<uint64_t>(__builtin_popcount(hidden));
  return lanes & ~hidden;
}
