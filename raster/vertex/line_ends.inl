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

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
// Of bytes, eight elements at a time: fewer divisions.
HWY_INLINE void load_byte_columns(const StreamRef& stream, uint32_t count, float (*out)[kGroup]) {
  const __m256 whole = _mm256_set1_ps(255.0f);
  for (uint32_t i = 0; i < count; i += 8) {
    const auto word = [&](uint32_t j) HWY_ATTR {
      int v;
      memcpy(&v, stream.data + size_t{i + j < count ? i + j : 0} * stream.stride, sizeof v);
      return v;
    };
    const __m256i words = _mm256_setr_epi32(word(0), word(1), word(2), word(3), word(4), word(5), word(6), word(7));
    for (int k = 0; k < 4; ++k) {
      const __m256i byte = _mm256_and_si256(_mm256_srli_epi32(words, 8 * k), _mm256_set1_epi32(255));
      _mm256_store_ps(out[k] + i, _mm256_div_ps(_mm256_cvtepi32_ps(byte), whole));
    }
  }
}
#endif

// What positions of the same vertices have asked for.
HWY_INLINE void load_color_columns(const StreamRef& colors, uint32_t count, float (*out)[kGroup]) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  if (colors.bytes) return load_byte_columns(colors, count, out);
#endif
  load_columns<false>(colors, 0, count, 4, kDefaults, out);
  hold_columns(count, out);
}

// Of lines whose first vertex is `first`.
void shade_ends(const ShadeJob& job, uint32_t first, uint32_t lines, EndColumns& out) {
  alignas(64) float position[4][kGroup];
  out.all_inside = true;
  for (uint32_t k = 0; k < 2; ++k) {
    EndColumns::End& end = out.end[k];
    const StreamRef positions = every_other(job.position, first + k);
    if (k == 0) load_columns(positions, 0, lines, 4, kDefaults, position);
    else load_columns<false>(positions, 0, lines, 4, kDefaults, position);
    for (uint32_t i = 0; i < lines; i += uint32_t(hn::Lanes(Doubles())))
      shade_end_lanes(job, position, i, end, out.all_inside);
    if (job.color_offset < 0) continue;
    load_color_columns(every_other(job.color, first + k), lines, end.color);
  }
}
