// Set-up, first half: corners and attribute values of eight primitives, from records to arrays.

struct SetupInput {
  alignas(64) int32_t x[3][kSetupLanes], y[3][kSetupLanes];
  alignas(64) float rest_x[3][kSetupLanes], rest_y[3][kSetupLanes];
  alignas(64) double z[3][kSetupLanes], inv_w[3][kSetupLanes];
  alignas(64) float attribute[kMaxPlanes - 2][3][kSetupLanes];
};

HWY_INLINE const VertexHead* Head(const ShadedVertices& vertices, size_t stride, uint32_t i) {
  return reinterpret_cast<const VertexHead*>(vertices.records + i * stride);
}
HWY_INLINE const float* Attributes(const VertexHead* head) { return reinterpret_cast<const float*>(head + 1); }

HWY_INLINE bool Below(const VertexHead* a, const VertexHead* b) {
  return a->y < b->y || (a->y == b->y && a->x < b->x);
}

// The reference vertex is the lowest, then leftmost one; the others follow counter-clockwise. So planes and edges
// depend on where the corners are, not on the order they were given in.
HWY_INLINE void OrderCorners(const VertexHead* v[3]) {
  const int64_t area = int64_t{v[1]->x - v[0]->x} * (v[2]->y - v[0]->y) -
                       int64_t{v[2]->x - v[0]->x} * (v[1]->y - v[0]->y);
  const VertexHead *a = v[0], *b = area < 0 ? v[2] : v[1], *c = area < 0 ? v[1] : v[2];
  const bool b_first = Below(b, a) && !Below(c, b), c_first = !b_first && Below(c, a);
  v[0] = b_first ? b : (c_first ? c : a);
  v[1] = b_first ? c : (c_first ? a : b);
  v[2] = b_first ? a : (c_first ? b : c);
}

// Corners of a primitive in the order set-up wants them. Corners that are not the draw's own vertices lie in `made`:
// those of a cut primitive, and the third one of a line. A line's planes have their gradient along it: a corner at
// right angles, as snapped and as it was before, with the first one's values, makes the triangle's formula the line's.
// A point gets two such corners.
HWY_INLINE void FindCorners(const Segment& segment, const ShadedVertices& vertices, size_t stride,
                            const PrimitiveRef& ref, VertexHead made[3], const VertexHead* v[3]) {
  const int given = ref.kind <= PrimitiveKind::smooth_triangle ? 3 : (ref.kind == PrimitiveKind::line ? 2 : 1);
  for (int k = 0; k < given; ++k) {
    if (ref.cut) {
      const CutTriangle& cut = segment.cut_triangles.data()[ref.v[0]];
      made[k] = {cut.x[k], cut.y[k], 0, 1, 0, 0};
      v[k] = &made[k];
    } else {
      v[k] = Head(vertices, stride, ref.v[k]);
    }
  }
  if (given == 3) return OrderCorners(v);
  if (given == 2) {
    if (Below(v[1], v[0])) {
      const VertexHead* first = v[1];
      v[1] = v[0];
      v[0] = first;
    }
    made[2] = {v[0]->x - (v[1]->y - v[0]->y), v[0]->y + (v[1]->x - v[0]->x), v[0]->z, v[0]->inv_w,
               v[0]->rest_x - (v[1]->rest_y - v[0]->rest_y), v[0]->rest_y + (v[1]->rest_x - v[0]->rest_x)};
  } else {
    made[1] = {v[0]->x + kSubpixelScale, v[0]->y, v[0]->z, v[0]->inv_w, 0, 0};
    made[2] = {v[0]->x, v[0]->y + kSubpixelScale, v[0]->z, v[0]->inv_w, 0, 0};
    v[1] = &made[1];
  }
  v[2] = &made[2];
}

// A cut primitive brings its planes along: its attributes are not asked for. A made corner has the first one's.
HWY_INLINE void StoreCorners(const VertexHead* const v[3], const VertexHead made[3], const PrimitiveRef& ref,
                             const VertexLayout& layout, int lane, SetupInput& in) {
  for (int k = 0; k < 3; ++k) {
    in.x[k][lane] = v[k]->x;
    in.y[k][lane] = v[k]->y;
    in.z[k][lane] = v[k]->z;
    in.inv_w[k][lane] = v[k]->inv_w;
    in.rest_x[k][lane] = v[k]->rest_x;
    in.rest_y[k][lane] = v[k]->rest_y;
  }
  if (ref.cut) return;
  const bool back = ref.back_facing && layout.back_color >= 0;
  for (int k = 0; k < 3; ++k) {
    const float* attributes = Attributes(v[k] == &made[k] ? v[0] : v[k]);
    for (int a = 0; a < layout.attribute_count; ++a) in.attribute[a][k][lane] = attributes[a];
    if (HWY_LIKELY(!back)) continue;
    for (int a = 0; a < 4; ++a) in.attribute[layout.color + a][k][lane] = attributes[layout.back_color + a];
  }
}

// Asks for the next batch's vertices while this one is drawn.
HWY_INLINE void PrefetchCorners(const Segment& segment, const ShadedVertices& vertices, size_t stride,
                                const uint32_t* ids, size_t count) {
  for (size_t lane = 0; lane < count; ++lane) {
    const PrimitiveRef& ref = segment.primitives.data()[ids[lane]];
    if (ref.cut) continue;
    for (int k = 0; k < 3; ++k) __builtin_prefetch(vertices.records + ref.v[k] * stride);
  }
}
