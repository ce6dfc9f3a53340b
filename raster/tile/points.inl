// Points of one pixel, without any set-up: they wait with the fragments of small triangles. Compiled once per
// ISA level.

inline constexpr size_t kPointsAhead = 8;  // their vertices are asked for while others are drawn

// Points of one pixel whose colour is all that their fragments are made from. At standard accuracy it is the
// same float whether a plane in float or one in double gives it.
HWY_INLINE bool PacksPoints(const DrawRecord& draw) {
  const VertexLayout& layout = draw.vertices.layout;
  return draw.program->packs && layout.tex_coord < 0 && layout.fog < 0 && !draw.shape.smooth_points &&
         draw.shape.point_size == 1 && draw.state->accuracy.interpolation != Level::exact;
}

// False: not such a point.
bool RunWaitingPoint(TileContext& t, const Segment& segment, const DrawRecord& draw, uint32_t id) {
  const PrimitiveRef& ref = segment.primitives.data()[id];
  if (ref.kind != PrimitiveKind::point || ref.cut) return false;
  const VertexLayout& layout = draw.vertices.layout;
  const VertexHead* head = Head(draw.vertices, layout.stride(), ref.v[0]);
  const int x = (head->x >> kSubpixelBits) - t.x, y = (head->y >> kSubpixelBits) - t.y;
  float color[4];
  if (layout.color >= 0) {
    const bool to_bytes = draw.program->params.rounds_to_bytes;
    const int place = ref.back_facing && layout.back_color >= 0 ? layout.back_color : layout.color;
    const float* from =
        Attributes(t.flat_color ? Head(draw.vertices, layout.stride(), ref.v[ref.provoking]) : head) + place;
    for (int k = 0; k < 4; ++k)
      color[k] = t.flat_color ? color_level(from[k], to_bytes)
                              : static_cast<float>(static_cast<double>(from[k]) * 255.0);
  }
  uint32_t* depth = PreparePacking(t, kAffine, 1, uint64_t{1} << (y / kBlockSize * 8 + x / kBlockSize));
  t.packer.AppendPoint(head->z, layout.color >= 0 ? color : nullptr, x, y, *t.program, depth);
  return true;
}

// Of those, draws whose points need no look at each other: no depth test, and the colour is the point's own.
HWY_INLINE bool StreamsPoints(const DrawRecord& draw) {
  return PacksPoints(draw) && !draw.program->reads_depth && !draw.state->raster.flat_shading &&
         draw.vertices.layout.back_color < 0;
}

#if HWY_TARGET == HWY_SCALAR

HWY_INLINE size_t StreamPoints(TileContext&, const Segment&, const DrawRecord&, const uint32_t*, size_t) {
  return 0;
}

#else

inline constexpr int kPointGroup = 4;
using PointColor = hn::CappedTag<float, kPointGroup>;

// The colours of four records, as 0..255, to the four columns that begin at `column`. The product by 255 is
// rounded once, like RunWaitingPoint's: in double it would be exact.
HWY_INLINE void QueueColors(const float* const (&colors)[kPointGroup], int column, PixelQueue& queue) {
  const PointColor d;
  const auto scale = hn::Set(d, 255.0f);
  hn::Vec<PointColor> v[kPointGroup];
  for (int j = 0; j < kPointGroup; ++j) v[j] = hn::Mul(hn::LoadU(d, colors[j]), scale);
  const auto low_01 = hn::InterleaveLower(d, v[0], v[1]), low_23 = hn::InterleaveLower(d, v[2], v[3]);
  const auto high_01 = hn::InterleaveUpper(d, v[0], v[1]), high_23 = hn::InterleaveUpper(d, v[2], v[3]);
  hn::StoreU(hn::ConcatLowerLower(d, low_23, low_01), d, queue.plane[column] + queue.count);
  hn::StoreU(hn::ConcatUpperUpper(d, low_23, low_01), d, queue.plane[column + 1] + queue.count);
  hn::StoreU(hn::ConcatLowerLower(d, high_23, high_01), d, queue.plane[column + 2] + queue.count);
  hn::StoreU(hn::ConcatUpperUpper(d, high_23, high_01), d, queue.plane[column + 3] + queue.count);
}

// Points ids[0 .. count), four at a time, up to the first that is cut or no point; how many that were.
size_t StreamPoints(TileContext& t, const Segment& segment, const DrawRecord& draw, const uint32_t* ids,
                    size_t count) {
  const PrimitiveRef* refs = segment.primitives.data();
  const ShadedVertices& vertices = draw.vertices;
  const size_t stride = vertices.layout.stride();
  const int place = vertices.layout.color, column = t.program->params.color_plane;
  Packer& packer = t.packer;
  PixelQueue& queue = packer.queue;
  const uint32_t* color = t.framebuffer->color_tile<uint32_t>(t.tile, t.program->plane);
  if (packer.variant != kAffine) FlushPacked(t);
  packer.variant = kAffine;
  uint64_t blocks = 0;
  size_t done = 0;
  while (done < count) {
    if (queue.count + kPointGroup > PixelQueue::kCapacity) {
      PrepareWindow(t, blocks);
      FlushPacked(t);
      blocks = 0;
    }
    // Of less than a group the last stands for those that lack. They are not counted, and overwritten by the
    // next.
    const size_t left = count - done, group = left < kPointGroup ? left : kPointGroup;
    const VertexHead* heads[kPointGroup];
    bool plain = true;
    for (size_t j = 0; j < kPointGroup; ++j) {
      const PrimitiveRef& ref = refs[ids[done + (j < group ? j : group - 1)]];
      plain &= (ref.kind == PrimitiveKind::point) & !ref.cut;
      heads[j] = Head(vertices, stride, ref.v[0]);
    }
    if (HWY_UNLIKELY(!plain)) break;
    for (int j = 0; j < kPointGroup; ++j) {
      const int at =
          Packer::TileOffset((heads[j]->x >> kSubpixelBits) - t.x, (heads[j]->y >> kSubpixelBits) - t.y);
      queue.offset[queue.count + j] = at;
      blocks |= uint64_t{1} << (at / kBlockPixels);
      __builtin_prefetch(color + at, 1);
    }
    if (place >= 0) {
      const float* const colors[] = {Attributes(heads[0]) + place, Attributes(heads[1]) + place,
                                     Attributes(heads[2]) + place, Attributes(heads[3]) + place};
      QueueColors(colors, column, queue);
    }
    queue.count += static_cast<int>(group);
    packer.blocks |= blocks;
    done += group;
  }
  PrepareWindow(t, blocks);
  t.statistics->fragments += done;
  return done;
}

#endif
