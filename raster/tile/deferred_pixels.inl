// Pixels whose colour is worked out later, or never: what is drawn over before their tile is left need not be shaded.
// Each pixel knows which of some triangles is to shade it. Compiled once per ISA level.

struct DeferredPixels {
  static constexpr int kTriangles = 2 * kSetupLanes;
  static constexpr uint8_t kNobody = 0;

  struct Triangle {
    const PipelineProgram* program;
    const BlockProgram* stages;
    uint64_t blocks;  // where it has been given pixels
  };
  Triangle triangles[kTriangles];
  int count = 0;
  bool pauses = false, asked = false;  // whether nothing is deferred in this visit; whether something could have been
  uint64_t taken = 0, shaded = 0;      // pixels
  uint64_t blocks = 0;                     // of the tile, where pixels may wait; elsewhere `owner` says nothing
  const BlockProgram* taker = nullptr;     // of the triangle at hand, triangles[count], if its colours are deferred
  SetupBatch setup[kTriangles / kSetupLanes];
  alignas(64) uint8_t owner[kTilePixels];  // 1 + index of a triangle, or nobody

  // Whether what is drawn next leaves alone what waits, or says which pixels it takes.
  HWY_INLINE bool MayStay(const DrawRecord& draw) const {
    if (blocks == 0) return true;
    const bool has_triangles = draw.image == nullptr && !draw.runs_points && !draw.runs_lines;
    return has_triangles && draw.program->covers && draw.program->plane == triangles[0].program->plane;
  }

  // Pixels of blocks become those of the triangle at hand: of each block in `which`, masks[block % kRowBlocks].
  HWY_INLINE void Take(uint64_t which, const uint64_t* masks) {
    const uint64_t used = blocks;
    for (uint64_t todo = which; todo != 0; todo &= todo - 1) {
      const int block = __builtin_ctzll(todo);
      taken += static_cast<uint64_t>(__builtin_popcountll(masks[block % kRowBlocks]));
      TakeBlock(owner + block * kBlockPixels, masks[block % kRowBlocks], (used >> block & 1) == 0);
    }
    blocks |= which;
    triangles[count].blocks |= which;
  }

  // The pixels of a block that are still the triangle's.
  HWY_INLINE uint64_t Left(int block, int triangle) const {
    const uint8_t* at = owner + block * kBlockPixels;
    const auto own = static_cast<uint8_t>(triangle + 1);
    uint64_t mask = 0;
#if HWY_TARGET == HWY_AVX3
    mask = _cvtmask64_u64(_mm512_cmpeq_epi8_mask(_mm512_load_si512(at), _mm512_set1_epi8(static_cast<char>(own))));
#elif HWY_TARGET == HWY_SCALAR
    for (int i = 0; i < kBlockPixels; ++i) mask |= uint64_t{at[i] == own} << i;
#else
    const hn::CappedTag<uint8_t, kBlockPixels> d;
    for (size_t i = 0; i < kBlockPixels; i += hn::Lanes(d)) {
      uint64_t bits = 0;
      hn::StoreMaskBits(d, hn::Eq(hn::Load(d, at + i), hn::Set(d, own)), reinterpret_cast<uint8_t*>(&bits));
      mask |= bits << i;
    }
#endif
    return mask;
  }

  // What has been drawn over: all of some blocks, listed pixels, groups.
  HWY_INLINE void Drop(uint64_t which) { blocks &= ~which; }
  HWY_INLINE void DropListed(const int32_t* offsets, int length) {
    for (int i = 0; i < length; ++i) owner[offsets[i]] = kNobody;
  }
  HWY_INLINE void DropGroups(const TileGroup* groups, int length) {
    for (int i = 0; i < length; ++i) {
      const unsigned live = groups[i].live();
#if HWY_TARGET == HWY_AVX3
      auto* at = reinterpret_cast<__m128i*>(owner) + groups[i].index();
      _mm_store_si128(at, _mm_maskz_mov_epi8(static_cast<__mmask16>(~live), _mm_load_si128(at)));
#else
      // Eight pixels: a byte of each bit.
      uint8_t* at = owner + groups[i].index() * 8;
      const uint64_t bits = (live * 0x0101010101010101u) & 0x8040201008040201u;
      const uint64_t bytes = ((bits + 0x7f7f7f7f7f7f7f7fu) >> 7 & 0x0101010101010101u) * 255;
      uint64_t old;
      __builtin_memcpy(&old, at, sizeof old);
      old &= ~bytes;
      __builtin_memcpy(at, &old, sizeof old);
#endif
    }
  }

  // The planes of the triangle at hand, a lane of `from`, which does not stay.
  HWY_INLINE void KeepPlanes(const SetupBatch& from, int lane, int plane_count) {
    SetupBatch& to = setup[count / kSetupLanes];
    const int own = count % kSetupLanes;
    for (int p = 1; p < plane_count; ++p) {
      to.f0[p][own] = from.f0[p][lane], to.f0_f[p][own] = from.f0_f[p][lane];
      to.dfdx[p][own] = from.dfdx[p][lane], to.dfdx_f[p][own] = from.dfdx_f[p][lane];
      to.dfdy[p][own] = from.dfdy[p][lane], to.dfdy_f[p][own] = from.dfdy_f[p][lane];
    }
    to.anchor_x[own] = from.anchor_x[lane], to.anchor_x_f[own] = from.anchor_x_f[lane];
    to.anchor_y[own] = from.anchor_y[lane], to.anchor_y_f[own] = from.anchor_y_f[lane];
    for (int k = 0; k < 4; ++k) to.flat[k][own] = from.flat[k][lane];
    to.variant[own] = from.variant[lane];
    to.lambda[own] = from.lambda[lane];
  }

 private:
  // `fresh`: they were nobody's.
  HWY_INLINE void TakeBlock(uint8_t* at, uint64_t mask, bool fresh) const {
    const auto own = static_cast<uint8_t>(count + 1);
#if HWY_TARGET == HWY_AVX3
    const __m512i old = fresh ? _mm512_setzero_si512() : _mm512_load_si512(at);
    _mm512_store_si512(at, _mm512_mask_mov_epi8(old, _cvtu64_mask64(mask), _mm512_set1_epi8(static_cast<char>(own))));
#elif HWY_TARGET == HWY_SCALAR
    for (int i = 0; i < kBlockPixels; ++i) {
      if ((mask >> i & 1) != 0) at[i] = own;
      else if (fresh) at[i] = kNobody;
    }
#else
    const hn::CappedTag<uint8_t, kBlockPixels> d;
    for (size_t i = 0; i < kBlockPixels; i += hn::Lanes(d)) {
      const uint64_t bits = mask >> i;
      const auto live = hn::LoadMaskBits(d, reinterpret_cast<const uint8_t*>(&bits));
      const auto old = fresh ? hn::Zero(d) : hn::Load(d, at + i);
      hn::Store(hn::IfThenElse(live, hn::Set(d, own), old), d, at + i);
    }
#endif
  }
};
