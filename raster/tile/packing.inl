// Small triangles: coverage in one 8x8 window, depth test at once and in order, then their fragments wait, packed,
// until there are enough to shade together. A triangle of eight pixels so costs one group of lanes, not six rows that
// are mostly dead.

using DFq = hn::CappedTag<float, 8>;
using DIq = hn::RebindToSigned<DFq>;
inline constexpr int kQueueLanes = static_cast<int>(hn::MaxLanes(DFq()));
inline constexpr int kQueueParts = kQueueLanes / kDoubleLanes;
inline constexpr int kWindow = 8;       // pixels a side
inline constexpr int kPackAtMost = 20;  // pixels of a block; with more, its rows are full enough to go as they are

// Takes the lowest kQueueLanes set bits off `mask` and returns their indices, one byte each; bytes beyond the last are
// 0. In a register: a list in memory, written by bytes and read by words, would stall.
HWY_INLINE uint64_t TakeBits(uint64_t& mask) {
  uint64_t word = 0;
  for (int j = 0; j < kQueueLanes; ++j) {
    const auto index = static_cast<uint64_t>(mask != 0 ? __builtin_ctzll(mask) : 0);
    word |= index << (8 * j);
    mask &= mask - 1;
  }
  return word;
}

// memory[offset[j]] for each lane. By plain loads where that is known to beat the gather instruction.
HWY_INLINE hn::Vec<DIq> GatherPixels(const int32_t* memory, const int32_t* offset, hn::Vec<DIq> offsets) {
  (void)offset, (void)offsets;
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  return hn::Vec<DIq>{_mm256_setr_epi32(memory[offset[0]], memory[offset[1]], memory[offset[2]], memory[offset[3]],
                                        memory[offset[4]], memory[offset[5]], memory[offset[6]], memory[offset[7]])};
#elif HWY_TARGET == HWY_SSE4
  return hn::Vec<DIq>{_mm_setr_epi32(memory[offset[0]], memory[offset[1]], memory[offset[2]], memory[offset[3]])};
#else
  return hn::GatherIndex(DIq(), memory, offsets);
#endif
}

// Moves the lanes of a mask to the front. Highway's Compress does; but its tables for AVX2 are local, and g++ copies the
// whole kilobyte to the stack at each use.
#if HWY_TARGET == HWY_AVX2
struct SqueezeTable {
  uint32_t lanes[256];  // of each mask: the lanes set in it, from the lowest on, four bits each
};
inline constexpr SqueezeTable kSqueezeTable = [] {
  SqueezeTable table{};
  for (uint32_t mask = 0; mask < 256; ++mask)
    for (uint32_t lane = 0, place = 0; lane < 8; ++lane)
      if ((mask >> lane & 1) != 0) table.lanes[mask] |= lane << (4 * place++);
  return table;
}();

struct Squeeze {
  __m256i order;
  HWY_INLINE explicit Squeeze(hn::Mask<DIq> keep) {
    const auto bits = static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(keep.raw)));
    const __m256i shifts = _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28);
    order = _mm256_srlv_epi32(_mm256_set1_epi32(static_cast<int>(kSqueezeTable.lanes[bits])), shifts);
  }
  HWY_INLINE hn::Vec<DFq> operator()(hn::Vec<DFq> v) const {
    return hn::Vec<DFq>{_mm256_permutevar8x32_ps(v.raw, order)};
  }
  HWY_INLINE hn::Vec<DIq> operator()(hn::Vec<DIq> v) const {
    return hn::Vec<DIq>{_mm256_permutevar8x32_epi32(v.raw, order)};
  }
};
#else
struct Squeeze {
  hn::Mask<DIq> keep;
  HWY_INLINE explicit Squeeze(hn::Mask<DIq> lanes) : keep(lanes) {}
  HWY_INLINE hn::Vec<DFq> operator()(hn::Vec<DFq> v) const { return hn::Compress(v, hn::RebindMask(DFq(), keep)); }
  HWY_INLINE hn::Vec<DIq> operator()(hn::Vec<DIq> v) const { return hn::Compress(v, keep); }
};
#endif

struct QueuedDoubles {
  VD part[kQueueParts];
};

template <class To>
HWY_INLINE hn::Vec<To> DemoteQueued(To d, const QueuedDoubles& v) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (kQueueParts == 2) {
    const hn::Half<To> half;
    return hn::Combine(d, hn::DemoteTo(half, v.part[1]), hn::DemoteTo(half, v.part[0]));
  } else
#endif
  {
    return hn::DemoteTo(d, v.part[0]);
  }
}

template <class V>
HWY_INLINE QueuedDoubles PromoteQueued(V v) {
  const DD d;
#if HWY_TARGET != HWY_SCALAR
  if constexpr (kQueueParts == 2) {
    const hn::Half<hn::DFromV<V>> half;
    return {{hn::PromoteTo(d, hn::LowerHalf(half, v)), hn::PromoteTo(d, hn::UpperHalf(half, v))}};
  } else
#endif
  {
    return {{hn::PromoteTo(d, v)}};
  }
}

template <class V>
HWY_INLINE hn::Mask<hn::DFromV<V>> PassesDepth(CompareFunc func, V z, V old) {
  switch (func) {
    case CompareFunc::never: return hn::Ne(z, z);
    case CompareFunc::less: return hn::Lt(z, old);
    case CompareFunc::equal: return hn::Eq(z, old);
    case CompareFunc::less_equal: return hn::Not(hn::Gt(z, old));
    case CompareFunc::greater: return hn::Gt(z, old);
    case CompareFunc::not_equal: return hn::Ne(z, old);
    case CompareFunc::greater_equal: return hn::Not(hn::Lt(z, old));
    case CompareFunc::always: break;
  }
  return hn::Eq(z, z);
}

HWY_INLINE bool PassesDepthAt(CompareFunc func, int32_t z, int32_t old) {
  switch (func) {
    case CompareFunc::never: return false;
    case CompareFunc::less: return z < old;
    case CompareFunc::equal: return z == old;
    case CompareFunc::less_equal: return z <= old;
    case CompareFunc::greater: return z > old;
    case CompareFunc::not_equal: return z != old;
    case CompareFunc::greater_equal: return z >= old;
    case CompareFunc::always: break;
  }
  return true;
}

struct Packer {
  PixelQueue queue;
  unsigned variant = 0;  // of all that waits
  uint64_t blocks = 0;   // of the tile, that something waits for

  // Fragments of one primitive at the pixels `mask` of the window whose first pixel is (x, y) of the tile.
  HWY_INLINE void Append(const SetupBatch& s, int lane, int x, int y, uint64_t mask, const PipelineProgram& program,
                         int plane_count, uint32_t* depth) {
    const DIq di;
    const hn::Rebind<uint8_t, DIq> bytes;
    while (mask != 0) {
      const int count = __builtin_popcountll(mask);
      const uint64_t indices = TakeBits(mask);
      const auto index = hn::PromoteTo(di, hn::LoadU(bytes, reinterpret_cast<const uint8_t*>(&indices)));
      const auto px = hn::Add(hn::And(index, hn::Set(di, 7)), hn::Set(di, x));
      const auto py = hn::Add(hn::ShiftRight<3>(index), hn::Set(di, y));
      AppendGroup(s, lane, px, py, count, program, plane_count, depth);
    }
  }

  // A point's fragment, at the pixel `at` of the tile, if its depth of 24 bits passes the test. Its planes are level, so
  // that they need no set-up: `color` is its colour, 0..255, or null where none is asked for.
  HWY_INLINE void AppendPoint(int32_t z, const float* color, int at, const PipelineProgram& program, uint32_t* depth) {
    if (depth != nullptr && !TestPoint(z, program.depth, depth[at])) return;
    queue.offset[queue.count] = at;
    for (int k = 0; color != nullptr && k < 4; ++k) queue.plane[program.params.color_plane + k][queue.count] = color[k];
    ++queue.count;
  }

  // The last `count` fragments take the provoking vertex's colour instead of an interpolated one.
  HWY_INLINE void SetFlatColor(const SetupBatch& s, int lane, int color_plane, int first) {
    for (int k = 0; k < 4; ++k)
      for (int i = first; i < queue.count; ++i) queue.plane[color_plane + k][i] = s.flat[k][lane];
  }

  static HWY_INLINE hn::Vec<DFq> PlaneAt(const SetupBatch& s, int lane, int plane, hn::Vec<DFq> dx, hn::Vec<DFq> dy) {
    const DFq d;
    const auto row = hn::Add(hn::Set(d, s.f0_f[plane][lane]), hn::Mul(hn::Set(d, s.dfdy_f[plane][lane]), dy));
    return hn::Add(row, hn::Mul(hn::Set(d, s.dfdx_f[plane][lane]), dx));
  }

  // Fragments at the first `count` lanes' pixels, those that pass the depth test. Lanes beyond stand for the first one's.
  HWY_INLINE void AppendGroup(const SetupBatch& s, int lane, hn::Vec<DIq> px, hn::Vec<DIq> py, int count,
                              const PipelineProgram& program, int plane_count, uint32_t* depth) {
    const DFq df;
    const DIq di;
    const auto offset = TileOffset(px, py);
    const int first = (variant & kAffine) != 0 ? 2 : 1;  // only perspective asks for 1/w
    if (depth == nullptr) {
      const auto dx = hn::Add(hn::ConvertTo(df, px), hn::Set(df, static_cast<float>(s.anchor_x[lane])));
      const auto dy = hn::Add(hn::ConvertTo(df, py), hn::Set(df, static_cast<float>(s.anchor_y[lane])));
      for (int p = first; p < plane_count; ++p) hn::StoreU(PlaneAt(s, lane, p, dx, dy), df, queue.plane[p] + queue.count);
      hn::StoreU(offset, di, queue.offset + queue.count);
      queue.count += count < kQueueLanes ? count : kQueueLanes;
      return;
    }
    auto live = hn::Lt(hn::Iota(di, 0), hn::Set(di, count));
    live = DepthTest(s, lane, px, py, offset, live, program.depth, depth);
    const auto dx = hn::Add(hn::ConvertTo(df, px), hn::Set(df, static_cast<float>(s.anchor_x[lane])));
    const auto dy = hn::Add(hn::ConvertTo(df, py), hn::Set(df, static_cast<float>(s.anchor_y[lane])));
    const Squeeze squeeze(live);
    for (int p = first; p < plane_count; ++p)
      hn::StoreU(squeeze(PlaneAt(s, lane, p, dx, dy)), df, queue.plane[p] + queue.count);
    // Not CompressStore: to memory, that instruction takes a hundred cycles on Zen 4.
    hn::StoreU(squeeze(offset), di, queue.offset + queue.count);
    queue.count += static_cast<int>(hn::CountTrue(di, live));
  }

 private:
  static HWY_INLINE bool TestPoint(int32_t value, const DepthState& test, uint32_t& memory) {
    const auto old = static_cast<int32_t>(memory);
    if (!PassesDepthAt(test.func, value, old)) return false;
    if (test.write) memory = static_cast<uint32_t>(value);
    return true;
  }

  static HWY_INLINE hn::Vec<DIq> TileOffset(hn::Vec<DIq> x, hn::Vec<DIq> y) {
    const DIq d;
    const auto high = hn::Set(d, 56), low = hn::Set(d, 7);
    const auto block = hn::Add(hn::ShiftLeft<6>(hn::And(y, high)), hn::ShiftLeft<3>(hn::And(x, high)));
    return hn::Add(block, hn::Add(hn::ShiftLeft<3>(hn::And(y, low)), hn::And(x, low)));
  }

  // Tests and writes. Lanes that are not live stand for the window's first pixel, which only the first lane may have
  // too: memory is written from the last lane to the first, so a live value stays.
  static HWY_INLINE hn::Mask<DIq> DepthTest(const SetupBatch& s, int lane, hn::Vec<DIq> px, hn::Vec<DIq> py,
                                            hn::Vec<DIq> offset, hn::Mask<DIq> live, const DepthState& test,
                                            uint32_t* depth) {
    const DIq di;
    const DD d;
    const QueuedDoubles x = PromoteQueued(px), y = PromoteQueued(py);
    QueuedDoubles z;
    for (int p = 0; p < kQueueParts; ++p) {
      const VD dx = hn::Add(x.part[p], hn::Set(d, s.anchor_x[lane])), dy = hn::Add(y.part[p], hn::Set(d, s.anchor_y[lane]));
      const VD row = hn::Add(hn::Set(d, s.f0[0][lane]), hn::Mul(hn::Set(d, s.dfdy[0][lane]), dy));
      z.part[p] = hn::Add(row, hn::Mul(hn::Set(d, s.dfdx[0][lane]), dx));
    }
    const auto value = hn::Min(hn::Max(DemoteQueued(di, z), hn::Zero(di)), hn::Set(di, static_cast<int32_t>(kDepthMax)));
    alignas(64) int32_t at[8];
    hn::Store(offset, di, at);
    const auto old = GatherPixels(reinterpret_cast<const int32_t*>(depth), at, offset);
    const auto pass = hn::And(live, PassesDepth(test.func, value, old));
    if (test.write) {
      alignas(64) int32_t values[8];
      hn::Store(hn::IfThenElse(pass, value, old), di, values);
      for (int j = kQueueLanes - 1; j >= 0; --j) depth[at[j]] = static_cast<uint32_t>(values[j]);
    }
    return pass;
  }
};

// Pixels of small triangles of one batch, until they are tested and packed (pixel_batch.inl).
inline constexpr int kListLanes = 16;
inline constexpr int kWideWindow = 16;  // pixels a side, where a program has no groups (group_walk.inl)

struct ListedPixels {
  // Column in bits 0 to 5, row in bits 6 to 11, lane of the batch in bits 12 to 14.
  alignas(64) uint32_t codes[kSetupLanes * kWideWindow * kWideWindow + kListLanes];
  int count = 0;
  unsigned variant = 0;  // of all their triangles
  uint64_t blocks = 0;   // they may lie in
};
