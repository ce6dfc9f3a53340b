// Set-up of several small draws at once: set-up takes as long for one triangle as for eight.

#if HALFSPACE_DIRECT_CORNERS
// Whether set-up asks nothing of a draw but its vertices and what SetUpAlike compares.
HWY_INLINE bool IsPlainToSetUp(const DrawRecord& draw) {
  const VertexLayout& layout = draw.vertices.layout;
  const bool flat = layout.color >= 0 && draw.program->flat_shading;
  const bool has_triangles = draw.image == nullptr && !draw.runs_points && !draw.runs_lines;
  return has_triangles && !flat && layout.low < 0 && !draw.shape.offset_fill && !draw.program->params.one_lambda;
}

// Compares all that SetPlanes and LookCloser read of the parameters.
HWY_INLINE bool SetUpAlike(const FragmentParams& a, const FragmentParams& b) {
  if (a.level_count != b.level_count || a.fog.level_span != b.fog.level_span || a.plane_rule != b.plane_rule) return false;
  if (a.level_count == 0) return true;
  const LevelRef &last_a = a.levels[a.level_count - 1], &last_b = b.levels[b.level_count - 1];
  return a.levels[0].width == b.levels[0].width && a.levels[0].height == b.levels[0].height &&
         last_a.width_i == last_b.width_i && last_a.height_i == last_b.height_i &&
         a.sampler.wrap_s == b.sampler.wrap_s && a.sampler.wrap_t == b.sampler.wrap_t &&
         a.lod_scale[0] == b.lod_scale[0] && a.lod_scale[1] == b.lod_scale[1];
}

HWY_INLINE bool SetUpAlike(const DrawRecord& a, const DrawRecord& b) {
  const VertexLayout &p = a.vertices.layout, &q = b.vertices.layout;
  const bool same_layout = p.attribute_count == q.attribute_count && p.color == q.color && p.tex_coord == q.tex_coord &&
                           p.projective == q.projective && p.fog == q.fog && p.back_color == q.back_color;
  return same_layout && a.bounds == b.bounds &&
         (a.program == b.program || SetUpAlike(a.program->params, b.program->params));
}

// Plain triangles of draws that follow each other in a bin, as many as are set up at once.
struct JoinedDraws {
  BatchRefs refs;
  const DrawRecord* draws[kSetupLanes];
  int ends[kSetupLanes];  // of each draw's lanes
  int draw_count = 0, count = 0;

  // From ids[at] on, of draw `draw`; false: only of that.
  HWY_INLINE bool Find(const Segment& segment, const uint32_t* ids, size_t at, size_t total, size_t draw) {
    const Segment::DrawStart* starts = segment.draws.data();
    const size_t all = segment.draws.size();
    bool whole = true;
    for (; whole && at < total && count < kSetupLanes; ++draw_count) {
      draw = DrawOf(segment, ids[at], draw);
      const DrawRecord& record = *starts[draw].draw;
      if (!IsPlainToSetUp(record) || (draw_count != 0 && !SetUpAlike(*draws[0], record))) break;
      const size_t before = at;
      whole = Take(segment, record, ids, at, total, draw + 1 < all ? starts[draw + 1].first_primitive : ~0u);
      if (at == before) break;
      draws[draw_count] = &record;
      ends[draw_count] = count;
    }
    if (draw_count < 2) return false;
    refs.triangles = true, refs.any_back = false, refs.cut = 0;
    for (int lane = count; lane < kSetupLanes; ++lane)
      for (int k = 0; k < 3; ++k) refs.at[k][lane] = refs.at[k][0];
    return true;
  }

 private:
  // Triangles of one draw, which ends before `end`; false: not all of those in the bin.
  HWY_INLINE bool Take(const Segment& segment, const DrawRecord& record, const uint32_t* ids, size_t& at, size_t total,
                       uint32_t end) {
    const auto* records = reinterpret_cast<const unsigned char*>(record.vertices.records);
    const size_t stride = record.vertices.layout.stride();
    for (; at < total && ids[at] < end; ++at, ++count) {
      const PrimitiveRef& ref = segment.primitives.data()[ids[at]];
      const bool back = ref.back_facing && record.vertices.layout.back_color >= 0;
      if (count == kSetupLanes || ref.kind != PrimitiveKind::triangle || ref.cut || back) return false;
      for (int k = 0; k < 3; ++k) refs.at[k][count] = records + ref.v[k] * stride;
    }
    return true;
  }
};

// Draws what of several draws can be set up together; gives how many primitives of the bin that were. The first of them
// is selected.
HWY_NOINLINE size_t RunJoinedDraws(TileContext& t, const Segment& segment, const uint32_t* ids, size_t at, size_t total,
                                   size_t draw) {
  JoinedDraws joined;
  if (!joined.Find(segment, ids, at, total, draw)) return 0;
  SetUp(segment, *joined.draws[0], ids + at, joined.refs, joined.count, t.x, t.y, t.limit, t.input, t.setup);
  int first = 0;
  for (int i = 0; i < joined.draw_count; ++i) {
    if (i != 0) SelectDraw(t, *joined.draws[i]);
    RunTriangles(t, first, joined.ends[i]);
    first = joined.ends[i];
  }
  return static_cast<size_t>(joined.count);
}
#else
HWY_INLINE size_t RunJoinedDraws(TileContext&, const Segment&, const uint32_t*, size_t, size_t, size_t) { return 0; }
#endif
