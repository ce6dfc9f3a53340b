// Positions and normals in eye coordinates (spec 2.10.1, 2.10.3), for the effects that ask for them. Compiled
// once an ISA level.

// A vertex at infinity (w = 0) is taken as very far away.
HWY_INLINE void eye_group(const ShadeJob& job, const Group& g, uint32_t count, EffectColumns& e) {
  const Doubles d;
  const Vec one = hn::Set(d, 1.0);
  for (uint32_t i = 0; i < count; i += uint32_t(hn::Lanes(d))) {
    const Vec x = load_column(g.position[0] + i), y = load_column(g.position[1] + i);
    const Vec z = load_column(g.position[2] + i), w = load_column(g.position[3] + i);
    Vec eye[3];
    for (int k = 0; k < 3; ++k) eye[k] = row_times(job.eye + k, x, y, z, w);
    const Vec eye_w = row_times(job.eye + 3, x, y, z, w);
    if (HWY_UNLIKELY(!hn::AllTrue(d, hn::Eq(eye_w, one)))) {
      const Vec divisor = hn::IfThenElse(hn::Eq(eye_w, hn::Zero(d)), hn::Set(d, 1e-12), eye_w);
      for (int k = 0; k < 3; ++k) eye[k] = hn::Div(eye[k], divisor);
    }
    for (int k = 0; k < 3; ++k) hn::Store(eye[k], d, e.eye[k] + i);
  }
}

// Whether squares and products of such a normal's components are harmless floats.
HWY_INLINE FloatMask is_moderate(FloatVec longest) {
  const Floats f;
  return hn::And(hn::Ge(longest, hn::Set(f, 1e-15f)), hn::Le(longest, hn::Set(f, 1e15f)));
}

// A component of a normal that is not moderate: brought into range, by a factor that its length takes out
// again, or by force.
HWY_INLINE FloatVec moderated(FloatVec v, FloatVec factor, bool normalize) {
  const Floats f;
  const FloatVec limit = hn::Set(f, normalize ? 3e38f : 1e15f);
  v = hn::IfThenElse(hn::Gt(v, limit), limit, v);
  v = hn::IfThenElse(hn::Lt(v, hn::Neg(limit)), hn::Neg(limit), v);
  return normalize ? hn::Mul(v, factor) : v;
}

HWY_NOINLINE void moderate_normals(FloatVec longest, bool normalize, FloatVec (&n)[3]) {
  const Floats f;
  const FloatMask moderate = is_moderate(longest);
  FloatVec factor =
      hn::IfThenElse(hn::Lt(longest, hn::Set(f, 1e-15f)), hn::Set(f, 1e25f), hn::Set(f, 1e-25f));
  factor = hn::IfThenElse(moderate, hn::Set(f, 1.0f), factor);
  for (int k = 0; k < 3; ++k) n[k] = hn::IfThenElse(moderate, n[k], moderated(n[k], factor, normalize));
}

HWY_INLINE void normal_lanes(const ShadeJob& job, uint32_t i, EffectColumns& e) {
  const Floats f;
  const FloatVec x = hn::Load(f, e.normal[0] + i), y = hn::Load(f, e.normal[1] + i),
                 z = hn::Load(f, e.normal[2] + i);
  const float* m = job.normal_matrix;
  FloatVec n[3];
  for (int k = 0; k < 3; ++k) {
    n[k] = dot(hn::Set(f, m[k]), hn::Set(f, m[3 + k]), hn::Set(f, m[6 + k]), x, y, z);
  }
  const FloatVec ax = hn::Abs(n[0]), ay = hn::Abs(n[1]), az = hn::Abs(n[2]);
  const FloatVec xy = hn::IfThenElse(hn::Gt(ax, ay), ax, ay);
  const FloatVec longest = hn::IfThenElse(hn::Gt(xy, az), xy, az);
  // The sum sees a NaN that the comparisons lose; such a normal is none.
  const FloatVec sum = hn::Add(hn::Add(ax, ay), az);
  if (HWY_UNLIKELY(!hn::AllTrue(f, hn::And(is_moderate(longest), hn::Eq(sum, sum))))) {
    for (int k = 0; k < 3; ++k) n[k] = hn::IfThenElseZero(hn::Eq(sum, sum), n[k]);
    moderate_normals(hn::IfThenElseZero(hn::Eq(sum, sum), longest), job.normalize, n);
  }
  if (job.normalize) {
    const FloatVec inverse = inverse_length(dot(n[0], n[1], n[2], n[0], n[1], n[2]));
    for (int k = 0; k < 3; ++k) n[k] = hn::Mul(n[k], inverse);
  }
  for (int k = 0; k < 3; ++k) hn::Store(n[k], f, e.normal[k] + i);
}

HWY_INLINE void normal_group(const ShadeJob& job, uint32_t first, uint32_t count, EffectColumns& e) {
  const float fallback[4] = {0, 0, 1, 0};
  load_columns(job.normal, first, count, 3, fallback, e.normal);
  for (uint32_t i = 0; i < count; i += uint32_t(hn::Lanes(Floats()))) normal_lanes(job, i, e);
}
