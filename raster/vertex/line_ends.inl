// Lines' vertices from client memory to columns, which set-up takes at once: no record of a vertex is made. Values are
// what the vertex stage would have stored. Compiled once an ISA level.

// Of a draw's vertices every other one.
HWY_INLINE StreamRef every_other(const StreamRef& stream, uint32_t first) {
  return {stream.data + size_t{first} * stream.stride, 2 * stream.stride, stream.size, stream.bytes};
}

HWY_INLINE void shade_end_lanes(const ShadeJob& job, const float (*position)[kGroup], uint32_t i,
                                EndColumns::End& out, bool& all_inside) {
  const Doubles d;
  const ClipVec c = clip_position(job, position, i);
  Mask usable = surely_inside(c);
  if (HWY_LIKELY(job.window.inside_guard && hn::AllTrue(d, usable))) {
    hn::Store(hn::Zero(Words()), Words(), out.outcode + i);
  } else {
    all_inside = false;
    const Vec code = outcodes(c, job.window);
    usable = is_usable(code);
    hn::Store(hn::BitCast(Words(), code), Words(), out.outcode + i);
  }
  const DividedVec place(c, usable);
  const Fixed x = to_fixed(place.x, usable, job.window.scale_x, job.window.offset_x);
  const Fixed y = to_fixed(place.y, usable, job.window.scale_y, job.window.offset_y);
  const hn::Rebind<int32_t, Doubles> di;
  const hn::Rebind<float, Doubles> df;
  hn::Store(x.value, di, out.x + i), hn::Store(y.value, di, out.y + i);
  hn::Store(x.rest, df, out.rest_x + i), hn::Store(y.rest, df, out.rest_y + i);
  hn::Store(hn::IfThenElseZero(usable, window_depth(place.z, job.window)), d, out.z + i);
  hn::Store(hn::IfThenElseZero(usable, place.inv_w), d, out.inv_w + i);
}

// As ColorReader holds colours to their range.
HWY_INLINE void hold_columns(uint32_t count, float (*columns)[kGroup]) {
  const hn::CappedTag<float, kLongestVector> d;
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  for (int k = 0; k < 4; ++k) {
    for (uint32_t i = 0; i < count; i += uint32_t(hn::MaxLanes(d))) {
      auto v = hn::Load(d, columns[k] + i);
      v = hn::IfThenElseZero(hn::Gt(v, zero), v);
      hn::Store(hn::IfThenElse(hn::Lt(v, one), v, one), d, columns[k] + i);
    }
  }
}

// Of lines whose first vertex is `first`.
void shade_ends(const ShadeJob& job, uint32_t first, uint32_t lines, EndColumns& out) {
  alignas(64) float position[4][kGroup];
  out.all_inside = true;
  for (uint32_t k = 0; k < 2; ++k) {
    EndColumns::End& end = out.end[k];
    load_columns(every_other(job.position, first + k), 0, lines, 4, kDefaults, position);
    for (uint32_t i = 0; i < lines; i += uint32_t(hn::Lanes(Doubles())))
      shade_end_lanes(job, position, i, end, out.all_inside);
    if (job.color_offset < 0) continue;
    load_columns(every_other(job.color, first + k), 0, lines, 4, kDefaults, end.color);
    hold_columns(lines, end.color);
  }
}
