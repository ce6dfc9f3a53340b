// Lines, points and smooth shapes on a tile; polygon stipple. Compiled once per ISA level.

// Corners of a primitive, as they were given.
struct ShapeCorners {
  int32_t x[3], y[3];
};

HWY_INLINE ShapeCorners CornersOf(const PrimitiveRef& ref, const Segment& segment, const DrawRecord& draw) {
  ShapeCorners c;
  const size_t stride = draw.vertices.layout.stride();
  const int given =
      ref.kind == PrimitiveKind::smooth_triangle ? 3 : (ref.kind == PrimitiveKind::line ? 2 : 1);
  for (int k = 0; k < 3; ++k) {
    const int from = k < given ? k : given - 1;
    if (ref.cut) {
      c.x[k] = segment.cut_triangles.data()[ref.v[0]].x[from];
      c.y[k] = segment.cut_triangles.data()[ref.v[0]].y[from];
    } else {
      const VertexHead* head = Head(draw.vertices, stride, ref.v[from]);
      c.x[k] = head->x;
      c.y[k] = head->y;
    }
  }
  return c;
}

void RunCoverage(TileContext& t, int lane, const TileCoverage& coverage) {
  const bool packs = Packs(t, lane);
  for (uint64_t todo = coverage.touched; todo != 0; todo &= todo - 1) {
    const int block = __builtin_ctzll(todo);
    if (coverage.blocks[block] != 0) WalkBlock(t, lane, block, coverage.blocks[block], packs);
  }
}

// `limit`: the pixels that may be drawn, relative to the tile.
void RunSmooth(TileContext& t, int lane, SmoothShape shape, Level level, const Rect& limit, bool stippled) {
  shape.level = level;
  alignas(64) float coverage[kBlockPixels];
  FlushPacked(t);
  const int x0 = limit.x0 > shape.box.x0 - t.x ? limit.x0 : shape.box.x0 - t.x;
  const int y0 = limit.y0 > shape.box.y0 - t.y ? limit.y0 : shape.box.y0 - t.y;
  const int x1 = limit.x1 < shape.box.x1 - t.x ? limit.x1 : shape.box.x1 - t.x;
  const int y1 = limit.y1 < shape.box.y1 - t.y ? limit.y1 : shape.box.y1 - t.y;
  if (x0 >= x1 || y0 >= y1) return;
  const float* whole = t.block.coverage;
  t.block.coverage = coverage;
  for (int by = y0 / kBlockSize; by <= (y1 - 1) / kBlockSize; ++by) {
    for (int bx = x0 / kBlockSize; bx <= (x1 - 1) / kBlockSize; ++bx) {
      const int block = by * 8 + bx;
      uint64_t mask = cover_block(shape, t.x + bx * kBlockSize, t.y + by * kBlockSize, coverage) &
                      LimitMask(limit, block);
      if (stippled) mask &= t.stipple[(by % 4) * 4 + bx % 4];
      if (mask != 0) RunBlock(t, lane, block, mask);
    }
  }
  t.block.coverage = whole;
}

// What a pixel-wide line may cover is the viewport's; wider ones and points reach beyond it.
HWY_INLINE Rect WindowLimit(const TileContext& t, const DrawRecord& draw) {
  const Rect cut = intersect(draw.window, {t.x, t.y, t.x + kTileSize, t.y + kTileSize});
  return {cut.x0 - t.x, cut.y0 - t.y, cut.x1 - t.x, cut.y1 - t.y};
}

void RunLine(TileContext& t, const PrimitiveRef& ref, const DrawRecord& draw, const ShapeCorners& c,
             int lane) {
  const ShapePlan& plan = draw.shape;
  const LineState& state = draw.state->line;
  const LineEnds ends{c.x[0], c.y[0], c.x[1], c.y[1]};
  const LineStipple stipple{plan.stippled_lines, state.pattern, state.repeat,
                            plan.stippled_lines ? ref.v[1] : 0};
  if (plan.smooth_lines)
    return RunSmooth(t, lane, smooth_line(ends, plan.smooth_line_width, stipple), plan.line_coverage,
                     WindowLimit(t, draw), false);
  const bool wide = plan.line_width > 1;
  TileCoverage coverage;
  const Viewport& v = draw.state->viewport;
  const Rect middle = wide ? Rect{v.x, v.y, v.x + v.width, v.y + v.height} : draw.bounds;
  cover_line(ends, plan.line_width, stipple, t.x, t.y, wide ? draw.window : draw.bounds, middle, coverage);
  RunCoverage(t, lane, coverage);
}

void RunPoint(TileContext& t, const DrawRecord& draw, const ShapeCorners& c, int lane) {
  const ShapePlan& plan = draw.shape;
  if (plan.smooth_points)
    return RunSmooth(t, lane, smooth_point(c.x[0], c.y[0], plan.smooth_point_size), plan.point_coverage,
                     WindowLimit(t, draw), false);
  TileCoverage coverage;
  cover_point(c.x[0], c.y[0], plan.point_size, t.x, t.y, plan.point_size > 1 ? draw.window : draw.bounds,
              coverage);
  RunCoverage(t, lane, coverage);
}

void RunShape(TileContext& t, const PrimitiveRef& ref, const Segment& segment, const DrawRecord& draw,
              int lane) {
  const ShapeCorners c = CornersOf(ref, segment, draw);
  switch (ref.kind) {
    case PrimitiveKind::line:
      return RunLine(t, ref, draw, c, lane);
    case PrimitiveKind::point:
      return RunPoint(t, draw, c, lane);
    default:
      return RunSmooth(t, lane, smooth_triangle(c.x, c.y), draw.shape.polygon_coverage, t.limit,
                       draw.program->stippled);
  }
}

// The stipple's pixels in each of the 4 x 4 blocks it repeats after (spec 3.5.2); tiles start at multiples
// of 32.
void SetStipple(TileContext& t, const PolygonState& polygon) {
  for (int block = 0; block < 16; ++block) {
    t.stipple[block] = 0;
    for (int i = 0; i < kBlockPixels; ++i) {
      const int x = block % 4 * kBlockSize + i % kBlockSize, y = block / 4 * kBlockSize + i / kBlockSize;
      if ((polygon.pattern.data()[y] >> (31 - x) & 1) != 0) t.stipple[block] |= uint64_t{1} << i;
    }
  }
}
