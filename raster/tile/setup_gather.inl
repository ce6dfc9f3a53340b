// Set-up, first half: corners and attribute values of eight primitives, from records to arrays.

struct SetupInput {
  alignas(64) int32_t x[3][kSetupLanes], y[3][kSetupLanes];
  alignas(64) double z[3][kSetupLanes], inv_w[3][kSetupLanes];
  alignas(64) float attribute[kMaxPlanes - 2][3][kSetupLanes];
};

struct Corner {
  int32_t x, y;
  const VertexHead* head;  // null for a cut primitive
};

HWY_INLINE const VertexHead* Head(const ShadedVertices& vertices, size_t stride, uint32_t i) {
  return reinterpret_cast<const VertexHead*>(vertices.records + i * stride);
}
HWY_INLINE const float* Attributes(const VertexHead* head) { return reinterpret_cast<const float*>(head + 1); }

HWY_INLINE bool Below(const Corner& a, const Corner& b) { return a.y < b.y || (a.y == b.y && a.x < b.x); }

// The reference vertex is the lowest, then leftmost one; the others follow counter-clockwise. So planes and edges
// depend on where the corners are, not on the order they were given in.
HWY_INLINE void OrderCorners(Corner v[3]) {
  const int64_t area = int64_t{v[1].x - v[0].x} * (v[2].y - v[0].y) - int64_t{v[2].x - v[0].x} * (v[1].y - v[0].y);
  const Corner a = v[0], b = area < 0 ? v[2] : v[1], c = area < 0 ? v[1] : v[2];
  const bool b_first = Below(b, a) && !Below(c, b), c_first = !b_first && Below(c, a);
  v[0] = b_first ? b : (c_first ? c : a);
  v[1] = b_first ? c : (c_first ? a : b);
  v[2] = b_first ? a : (c_first ? b : c);
}

// A line's planes have their gradient along it: a third corner at right angles, with the first one's values, makes
// the triangle's formula the line's. A point gets two such corners.
HWY_INLINE void CompleteCorners(PrimitiveKind kind, Corner v[3]) {
  if (kind == PrimitiveKind::line) {
    if (Below(v[1], v[0])) {
      const Corner first = v[1];
      v[1] = v[0];
      v[0] = first;
    }
    v[2] = {v[0].x - (v[1].y - v[0].y), v[0].y + (v[1].x - v[0].x), v[0].head};
  } else {
    v[1] = {v[0].x + kSubpixelScale, v[0].y, v[0].head};
    v[2] = {v[0].x, v[0].y + kSubpixelScale, v[0].head};
  }
}

HWY_INLINE void GatherCorners(const Segment& segment, const ShadedVertices& vertices, size_t stride,
                              const PrimitiveRef& ref, Corner v[3]) {
  const int given = ref.kind == PrimitiveKind::triangle ? 3 : (ref.kind == PrimitiveKind::line ? 2 : 1);
  if (ref.cut) {
    const CutTriangle& cut = segment.cut_triangles.data()[ref.v[0]];
    for (int k = 0; k < given; ++k) v[k] = {cut.x[k], cut.y[k], nullptr};
  } else {
    for (int k = 0; k < given; ++k) {
      const VertexHead* head = Head(vertices, stride, ref.v[k]);
      v[k] = {head->x, head->y, head};
    }
  }
  if (given == 3) OrderCorners(v);
  else CompleteCorners(ref.kind, v);
}

HWY_INLINE void StoreCorners(const Corner v[3], int attribute_count, int lane, SetupInput& in) {
  for (int k = 0; k < 3; ++k) {
    in.x[k][lane] = v[k].x;
    in.y[k][lane] = v[k].y;
  }
  if (v[0].head == nullptr) return;  // a cut primitive brings its planes along
  for (int k = 0; k < 3; ++k) {
    in.z[k][lane] = v[k].head->z;
    in.inv_w[k][lane] = v[k].head->inv_w;
    const float* attributes = Attributes(v[k].head);
    for (int a = 0; a < attribute_count; ++a) in.attribute[a][k][lane] = attributes[a];
  }
}
