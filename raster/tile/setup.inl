// Set-up: eight primitives' edges and planes at once, all in double and exact integers. Compiled once per ISA level.

// Corners and attribute values of the batch, gathered from the vertex records.
struct SetupInput {
  int32_t x[3][kSetupLanes], y[3][kSetupLanes];
  alignas(64) double value[kMaxPlanes][3][kSetupLanes];
  alignas(64) double ex1[kSetupLanes], ey1[kSetupLanes], ex2[kSetupLanes], ey2[kSetupLanes];
  alignas(64) double scale[kSetupLanes];  // 256 / area in 1/65536 px^2
};

inline constexpr double kDepthScale = static_cast<double>(kDepthMax);

HWY_INLINE const VertexHead* Head(const ShadedVertices& vertices, size_t stride, uint32_t i) {
  return reinterpret_cast<const VertexHead*>(vertices.records + i * stride);
}
HWY_INLINE const float* Attributes(const VertexHead* head) { return reinterpret_cast<const float*>(head + 1); }

HWY_INLINE bool Below(const VertexHead* a, const VertexHead* b) {
  return a->y < b->y || (a->y == b->y && a->x < b->x);
}

// The reference vertex is the lowest, then leftmost one; the others follow counter-clockwise. So the planes depend
// on where the corners are, not on the order they were given in.
HWY_INLINE void OrderCorners(const VertexHead* v[3]) {
  const int64_t area = int64_t{v[1]->x - v[0]->x} * (v[2]->y - v[0]->y) -
                       int64_t{v[2]->x - v[0]->x} * (v[1]->y - v[0]->y);
  if (area < 0) {
    const VertexHead* swap = v[1];
    v[1] = v[2];
    v[2] = swap;
  }
  const VertexHead *a = v[0], *b = v[1], *c = v[2];
  if (Below(b, a) && !Below(c, b)) {
    v[0] = b, v[1] = c, v[2] = a;
  } else if (Below(c, a) && Below(c, b)) {
    v[0] = c, v[1] = a, v[2] = b;
  }
}

// Largest whole number below all three, so that REPEAT coordinates start within one turn of zero.
HWY_INLINE double WholeTurns(double a, double b, double c) {
  double low = a < b ? a : b;
  low = low < c ? low : c;
  return __builtin_floor(low);
}

// Values at the corners, in the order of SetupBatch's planes. Returns the variant bits known so far.
HWY_INLINE uint8_t GatherValues(const VertexLayout& layout, const FragmentParams& params, const VertexHead* const v[3],
                                int corners, int lane, SetupInput& in) {
  bool affine = true;
  for (int k = 0; k < 3; ++k) {
    const VertexHead& head = *v[k < corners ? k : corners - 1];
    in.x[k][lane] = head.x;
    in.y[k][lane] = head.y;
    in.value[0][k][lane] = head.z * kDepthScale;
    in.value[1][k][lane] = head.inv_w;
    affine = affine && head.inv_w == v[0]->inv_w;
  }
  const float* attributes[3];
  for (int k = 0; k < 3; ++k) attributes[k] = Attributes(v[k < corners ? k : corners - 1]);
  auto weight = [&](int k, bool divide) { return divide ? in.value[1][k][lane] : 1.0; };
  if (layout.color >= 0) {
    for (int a = 0; a < 4; ++a)
      for (int k = 0; k < 3; ++k)
        in.value[2 + layout.color + a][k][lane] =
            static_cast<double>(attributes[k][layout.color + a]) * 255.0 * weight(k, !affine);
  }
  if (layout.tex_coord >= 0) {
    const int count = layout.projective ? 3 : 2;
    for (int a = 0; a < count; ++a) {
      const int at = layout.tex_coord + a;
      double value[3];
      for (int k = 0; k < 3; ++k) value[k] = static_cast<double>(attributes[k][at]);
      const Wrap wrap = a == 0 ? params.sampler.wrap_s : params.sampler.wrap_t;
      const double turns =
          !layout.projective && wrap == Wrap::repeat ? WholeTurns(value[0], value[1], value[2]) : 0.0;
      for (int k = 0; k < 3; ++k)
        in.value[2 + at][k][lane] = (value[k] - turns) * weight(k, !affine || layout.projective);
    }
  }
  return affine ? kAffine : 0;
}

HWY_INLINE int32_t ClampEdge(int64_t e) {
  constexpr int64_t kLimit = int64_t{1} << 30;  // beyond it the sign holds all over the tile
  return static_cast<int32_t>(e > kLimit ? kLimit : (e < -kLimit ? -kLimit - 1 : e));
}

// Edge from corner a to corner b of a counter-clockwise triangle. Top-left rule, y up: a pixel centre on the edge is
// inside if the edge goes down (a left edge) or runs leftward (a top edge).
HWY_INLINE void SetEdge(const SetupInput& in, int a, int b, int edge, int lane, int32_t center_x, int32_t center_y,
                        SetupBatch& out) {
  const int32_t dx = in.x[b][lane] - in.x[a][lane], dy = in.y[b][lane] - in.y[a][lane];
  const int64_t e = int64_t{dx} * (center_y - in.y[a][lane]) - int64_t{dy} * (center_x - in.x[a][lane]);
  const bool inclusive = dy < 0 || (dy == 0 && dx < 0);
  out.edge[edge][lane] = ClampEdge((e - (inclusive ? 0 : 1)) >> kSubpixelBits);
  out.step_x[edge][lane] = -dy;
  out.step_y[edge][lane] = dx;
}

HWY_INLINE int32_t Min3(int32_t a, int32_t b, int32_t c) { return a < b ? (a < c ? a : c) : (b < c ? b : c); }
HWY_INLINE int32_t Max3(int32_t a, int32_t b, int32_t c) { return a > b ? (a > c ? a : c) : (b > c ? b : c); }

// Pixels whose centres lie in the primitive's box and in `limit` (relative to the tile, half-open).
HWY_INLINE void SetBox(const SetupInput& in, int lane, int32_t center_x, int32_t center_y, const Rect& limit,
                       SetupBatch& out) {
  const int half = kSubpixelScale - 1;
  const int x0 = (Min3(in.x[0][lane], in.x[1][lane], in.x[2][lane]) - center_x + half) >> kSubpixelBits;
  const int y0 = (Min3(in.y[0][lane], in.y[1][lane], in.y[2][lane]) - center_y + half) >> kSubpixelBits;
  const int x1 = (Max3(in.x[0][lane], in.x[1][lane], in.x[2][lane]) - center_x) >> kSubpixelBits;
  const int y1 = (Max3(in.y[0][lane], in.y[1][lane], in.y[2][lane]) - center_y) >> kSubpixelBits;
  out.min_x[lane] = x0 > limit.x0 ? x0 : limit.x0;
  out.min_y[lane] = y0 > limit.y0 ? y0 : limit.y0;
  out.max_x[lane] = x1 < limit.x1 - 1 ? x1 : limit.x1 - 1;
  out.max_y[lane] = y1 < limit.y1 - 1 ? y1 : limit.y1 - 1;
}

// Direction vectors and scale of the plane equations. A line's planes have their gradient along it; a point's are flat.
HWY_INLINE void SetVectors(PrimitiveKind kind, int lane, SetupInput& in) {
  in.ex1[lane] = static_cast<double>(in.x[1][lane] - in.x[0][lane]);
  in.ey1[lane] = static_cast<double>(in.y[1][lane] - in.y[0][lane]);
  in.ex2[lane] = static_cast<double>(in.x[2][lane] - in.x[0][lane]);
  in.ey2[lane] = static_cast<double>(in.y[2][lane] - in.y[0][lane]);
  if (kind != PrimitiveKind::triangle) {
    // With the third corner at right angles to the line and the value of the first, the triangle's formula is the line's.
    in.ex2[lane] = -in.ey1[lane];
    in.ey2[lane] = in.ex1[lane];
    for (int p = 0; p < kMaxPlanes; ++p) in.value[p][2][lane] = in.value[p][0][lane];
  }
  const double area = in.ex1[lane] * in.ey2[lane] - in.ex2[lane] * in.ey1[lane];  // exact: below 2^53
  in.scale[lane] = area != 0 ? 256.0 / area : 0.0;
}

HWY_INLINE void SetPlanes(const SetupInput& in, int plane_count, SetupBatch& out) {
  for (int p = 0; p < plane_count; ++p) {
    for (int i = 0; i < kSetupLanes; ++i) {
      const double f0 = in.value[p][0][i];
      const double d1 = in.value[p][1][i] - f0, d2 = in.value[p][2][i] - f0;
      out.f0[p][i] = f0;
      out.dfdx[p][i] = (d1 * in.ey2[i] - d2 * in.ey1[i]) * in.scale[i];
      out.dfdy[p][i] = (d2 * in.ex1[i] - d1 * in.ex2[i]) * in.scale[i];
    }
  }
}

// --- Precision on demand: an a-priori bound on what the float path may be off at any pixel of the primitive.

inline constexpr double kTexelTolerance = 1.0 / 1024;  // texels of level 0
inline constexpr double kColorTolerance = 1.0 / 64;    // levels of 255

// Each float operation of PlaneAt errs by at most 2^-24 of a term; there are three coefficients, two products, two sums.
HWY_INLINE double PlaneError(const SetupBatch& s, int plane, int lane, double width, double height) {
  auto magnitude = [](double v) { return v < 0 ? -v : v; };
  return 3.0 / (1 << 24) *
         (magnitude(s.f0[plane][lane]) + magnitude(s.dfdx[plane][lane]) * width +
          magnitude(s.dfdy[plane][lane]) * height);
}

HWY_INLINE double LargestMagnitude(const SetupInput& in, int plane, int lane, bool divided) {
  double largest = 0;
  for (int k = 0; k < 3; ++k) {
    double v = in.value[plane][k][lane];
    if (divided) v /= in.value[1][k][lane];
    v = v < 0 ? -v : v;
    largest = v > largest ? v : largest;
  }
  return largest;
}

HWY_INLINE bool NeedsDouble(const SetupInput& in, const SetupBatch& s, const VertexLayout& layout,
                            const FragmentParams& params, int lane) {
  const bool affine = (s.variant[lane] & kAffine) != 0;
  const double width = (Max3(in.x[0][lane], in.x[1][lane], in.x[2][lane]) -
                        Min3(in.x[0][lane], in.x[1][lane], in.x[2][lane])) * (1.0 / kSubpixelScale);
  const double height = (Max3(in.y[0][lane], in.y[1][lane], in.y[2][lane]) -
                         Min3(in.y[0][lane], in.y[1][lane], in.y[2][lane])) * (1.0 / kSubpixelScale);
  double w_error = 0, w_least = 1;
  if (!affine) {
    w_error = PlaneError(s, 1, lane, width, height);
    w_least = in.value[1][0][lane];
    for (int k = 1; k < 3; ++k) w_least = in.value[1][k][lane] < w_least ? in.value[1][k][lane] : w_least;
  }
  auto exceeds = [&](int plane, double largest, double tolerance) {
    const double error = (PlaneError(s, plane, lane, width, height) + largest * w_error) / w_least +
                         largest * (3.0 / (1 << 24));
    return !(error <= tolerance);
  };
  if (layout.tex_coord >= 0) {
    if (layout.projective) return true;
    for (int a = 0; a < 2; ++a) {
      const int plane = 2 + layout.tex_coord + a;
      const double size = static_cast<double>(a == 0 ? params.levels[0].width : params.levels[0].height);
      if (exceeds(plane, LargestMagnitude(in, plane, lane, !affine), kTexelTolerance / size)) return true;
    }
  }
  if (layout.color >= 0)
    for (int a = 0; a < 4; ++a)
      if (exceeds(2 + layout.color + a, 255.0, kColorTolerance)) return true;
  return false;
}

// A cut triangle or line: its planes are those of the whole primitive, already there; always in double.
HWY_INLINE void CopyPlanes(const Segment& segment, const CutTriangle& cut, const VertexLayout& layout, int plane_count,
                           int lane, SetupBatch& out) {
  const PlaneSource& source = segment.plane_sources.data()[cut.source];
  for (int p = 0; p < plane_count; ++p) {
    const bool color = layout.color >= 0 && p >= 2 + layout.color && p < 6 + layout.color;
    const double scale = p == 0 ? kDepthScale : (color ? 255.0 : 1.0);
    out.f0[p][lane] = source.planes[p].f0 * scale;
    out.dfdx[p][lane] = source.planes[p].dfdx * scale;
    out.dfdy[p][lane] = source.planes[p].dfdy * scale;
  }
}

HWY_INLINE void SetFlatColor(const ShadedVertices& vertices, size_t stride, uint32_t vertex, int lane,
                             SetupBatch& out) {
  const float* attributes = Attributes(Head(vertices, stride, vertex)) + vertices.layout.color;
  for (int k = 0; k < 4; ++k) out.flat[k][lane] = attributes[k] * 255.0f;
}

HWY_INLINE void SetEdges(int lane, int32_t center_x, int32_t center_y, SetupInput& in, SetupBatch& out) {
  const int64_t area = int64_t{in.x[1][lane] - in.x[0][lane]} * (in.y[2][lane] - in.y[0][lane]) -
                       int64_t{in.x[2][lane] - in.x[0][lane]} * (in.y[1][lane] - in.y[0][lane]);
  const int second = area < 0 ? 2 : 1, third = area < 0 ? 1 : 2;
  SetEdge(in, 0, second, 0, lane, center_x, center_y, out);
  SetEdge(in, second, third, 1, lane, center_x, center_y, out);
  SetEdge(in, third, 0, 2, lane, center_x, center_y, out);
}

// Fills `out` for the primitives ids[0 .. count) of `segment`, all of one draw. `limit`: the draw's bounds relative to
// the tile whose lowest pixel is (tile_x, tile_y).
void SetUp(const Segment& segment, const DrawRecord& draw, const uint32_t* ids, int count, int tile_x, int tile_y,
           const Rect& limit, SetupInput& in, SetupBatch& out) {
  const VertexLayout& layout = draw.vertices.layout;
  const FragmentParams& params = draw.program->params;
  const bool flat = layout.color >= 0 && draw.state->raster.flat_shading;
  const int plane_count = 2 + layout.attribute_count;
  const size_t stride = layout.stride();
  const int32_t center_x = tile_x * kSubpixelScale + kSubpixelScale / 2;
  const int32_t center_y = tile_y * kSubpixelScale + kSubpixelScale / 2;
  int32_t anchor_x[kSetupLanes] = {}, anchor_y[kSetupLanes] = {};
  for (int i = 0; i < count; ++i) {
    const PrimitiveRef& ref = segment.primitives.data()[ids[i]];
    uint32_t provoking = ref.v[ref.provoking < 3 ? ref.provoking : 0];
    if (ref.cut) {
      const CutTriangle& cut = segment.cut_triangles.data()[ref.v[0]];
      const int corners = ref.kind == PrimitiveKind::triangle ? 3 : 2;
      for (int k = 0; k < 3; ++k) {
        in.x[k][i] = cut.x[k < corners ? k : 1];
        in.y[k][i] = cut.y[k < corners ? k : 1];
        for (int p = 0; p < plane_count; ++p) in.value[p][k][i] = 0;
      }
      const PlaneSource& source = segment.plane_sources.data()[cut.source];
      anchor_x[i] = source.x0;
      anchor_y[i] = source.y0;
      provoking = source.provoking;
      out.variant[i] = kDouble;
    } else {
      const int corners = ref.kind == PrimitiveKind::triangle ? 3 : (ref.kind == PrimitiveKind::line ? 2 : 1);
      const VertexHead* v[3];
      for (int k = 0; k < 3; ++k) v[k] = Head(draw.vertices, stride, ref.v[k < corners ? k : 0]);
      if (corners == 3) OrderCorners(v);
      if (corners == 2 && Below(v[1], v[0])) {
        v[2] = v[0];
        v[0] = v[1];
        v[1] = v[2];
      }
      out.variant[i] = GatherValues(layout, params, v, corners, i, in);
      anchor_x[i] = in.x[0][i];
      anchor_y[i] = in.y[0][i];
    }
    SetVectors(ref.kind, i, in);
    if (flat) SetFlatColor(draw.vertices, stride, provoking, i, out);
    if (ref.kind == PrimitiveKind::triangle) {
      SetEdges(i, center_x, center_y, in, out);
      SetBox(in, i, center_x, center_y, limit, out);
    }
    out.anchor_x[i] = (center_x - anchor_x[i]) * (1.0 / kSubpixelScale);
    out.anchor_y[i] = (center_y - anchor_y[i]) * (1.0 / kSubpixelScale);
  }
  SetPlanes(in, plane_count, out);
  for (int i = 0; i < count; ++i) {
    const PrimitiveRef& ref = segment.primitives.data()[ids[i]];
    if (ref.cut)
      CopyPlanes(segment, segment.cut_triangles.data()[ref.v[0]], layout, plane_count, i, out);
    else if (NeedsDouble(in, out, layout, params, i))
      out.variant[i] |= kDouble;
  }
  for (int i = 0; i < kSetupLanes; ++i) out.f0[0][i] += 0.5;
  for (int p = 1; p < plane_count; ++p) {
    for (int i = 0; i < kSetupLanes; ++i) {
      out.f0_f[p][i] = static_cast<float>(out.f0[p][i]);
      out.dfdx_f[p][i] = static_cast<float>(out.dfdx[p][i]);
      out.dfdy_f[p][i] = static_cast<float>(out.dfdy[p][i]);
    }
  }
}
