// Lighting (spec 2.14.1), SIMD over vertices. Compiled once an ISA level. Float, but for what comes out of a
// difference of positions. Comparisons and selects rather than min and max: those disagree between levels
// about NaN and -0.

HWY_INLINE FloatVec positive_part(FloatVec v) { return hn::IfThenElseZero(hn::Gt(v, hn::Zero(Floats())), v); }

HWY_INLINE FloatVec dot(FloatVec ax, FloatVec ay, FloatVec az, FloatVec bx, FloatVec by, FloatVec bz) {
  return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
}

// 1 / the length of a vector whose square is `square`; 0 for one that has none.
HWY_INLINE FloatVec inverse_length(FloatVec square) {
  const Floats f;
  const FloatVec one = hn::Set(f, 1.0f);
  const FloatMask usable = hn::Gt(square, hn::Set(f, 1e-36f));
  return hn::IfThenElseZero(usable, hn::Div(one, hn::Sqrt(hn::IfThenElse(usable, square, one))));
}

// A property of the material: of all vertices alike, or a column a component.
struct PropertyRef {
  const float (*columns)[kVertexGroup];  // null: `value`
  const float* value;
  HWY_INLINE FloatVec get(int component, uint32_t i) const {
    const Floats f;
    return columns ? hn::Load(f, columns[component] + i) : hn::Set(f, value[component]);
  }
};

struct SideRef {
  PropertyRef ambient, diffuse, specular, emission, shininess;
};

HWY_INLINE SideRef side_ref(const LightingJob& job, int side, const EffectColumns& e,
                            const MaterialColumns* own) {
  const MaterialTerms& m = job.material[side];
  const LightingState::ColorMaterial& tracked = job.tracked[side];
  SideRef ref{{own ? own[side].ambient : nullptr, m.ambient},
              {own ? own[side].diffuse : nullptr, m.diffuse},
              {own ? own[side].specular : nullptr, m.specular},
              {own ? own[side].emission : nullptr, m.emission},
              {own ? &own[side].shininess : nullptr, &m.shininess}};
  if (tracked.ambient) ref.ambient.columns = e.color;
  if (tracked.diffuse) ref.diffuse.columns = e.color;
  if (tracked.specular) ref.specular.columns = e.color;
  if (tracked.emission) ref.emission.columns = e.color;
  return ref;
}

HWY_INLINE void store_color(const Color& c, uint32_t i, float (*columns)[kVertexGroup]) {
  columns[0][i] = c.r, columns[1][i] = c.g, columns[2][i] = c.b, columns[3][i] = c.a;
}

HWY_INLINE void store_material(const Material& m, uint32_t i, MaterialColumns& out) {
  store_color(m.ambient, i, out.ambient);
  store_color(m.diffuse, i, out.diffuse);
  store_color(m.specular, i, out.specular);
  store_color(m.emission, i, out.emission);
  out.shininess[i] = m.shininess;
}

// Columns beyond `count` repeat the last vertex's.
HWY_INLINE void gather_materials(const LightingJob& job, const uint32_t* index, uint32_t count,
                                 MaterialColumns* out) {
  for (uint32_t i = 0; i < kVertexGroup; ++i) {
    const MaterialPair& pair = job.materials[index[i < count ? i : count - 1]];
    store_material(pair.front, i, out[0]);
    store_material(pair.back, i, out[1]);
  }
}

// From the vertices to a light, in double until the difference is taken. Held to 1e15, so that its square is
// a float.
struct alignas(64) ToLight {
  float v[3][kVertexGroup];
};

HWY_INLINE void vectors_to(const LightTerm& light, const EffectColumns& e, uint32_t count, ToLight& out) {
  const Doubles d;
  const hn::Rebind<float, Doubles> df;
  const Vec high = hn::Set(d, 1e15), low = hn::Set(d, -1e15);
  for (int k = 0; k < 3; ++k) {
    const Vec at = hn::Set(d, light.position[k]);
    for (uint32_t i = 0; i < count; i += uint32_t(hn::Lanes(d))) {
      Vec v = hn::Sub(at, hn::Load(d, e.eye[k] + i));
      v = hn::IfThenElse(hn::Gt(v, high), high, v);
      v = hn::IfThenElse(hn::Gt(v, low), v, low);
      hn::Store(hn::DemoteTo(df, v), df, out.v[k] + i);
    }
  }
}

// What one light is to some vertices.
struct LightAt {
  FloatVec x, y, z;  // unit vector to it
  FloatVec weight;   // attenuation times spotlight
};

HWY_INLINE LightAt locate(const LightTerm& light, const ToLight& to, uint32_t i) {
  const Floats f;
  const FloatVec one = hn::Set(f, 1.0f);
  if (!light.local) {
    return {hn::Set(f, light.direction[0]), hn::Set(f, light.direction[1]), hn::Set(f, light.direction[2]),
            hn::Set(f, light.weight)};
  }
  const FloatVec x = hn::Load(f, to.v[0] + i), y = hn::Load(f, to.v[1] + i), z = hn::Load(f, to.v[2] + i);
  const FloatVec square = dot(x, y, z, x, y, z), inverse = inverse_length(square);
  LightAt at{hn::Mul(x, inverse), hn::Mul(y, inverse), hn::Mul(z, inverse), one};
  if (light.attenuated) {
    const FloatVec far = hn::Add(hn::Mul(hn::Set(f, light.attenuation[1]), hn::Sqrt(square)),
                                 hn::Mul(hn::Set(f, light.attenuation[2]), square));
    const FloatVec sum = hn::Add(hn::Set(f, light.attenuation[0]), far);
    const FloatVec least = hn::Set(f, 1e-15f);  // all three factors zero: as bright as it gets, but finite
    at.weight = hn::Div(one, hn::IfThenElse(hn::Gt(sum, least), sum, least));
  }
  return at;
}

HWY_INLINE FloatVec spot_factor(const LightingJob& job, const LightTerm& light, const LightAt& at) {
  const Floats f;
  const FloatVec cosine =
      hn::Neg(dot(at.x, at.y, at.z, hn::Set(f, light.spot_direction[0]), hn::Set(f, light.spot_direction[1]),
                  hn::Set(f, light.spot_direction[2])));
  const FloatMask inside = hn::Ge(cosine, hn::Set(f, light.spot_cosine));
  if (light.spot_exponent == 0) return hn::IfThenElseZero(inside, hn::Set(f, 1.0f));
  return hn::IfThenElseZero(inside, power_at(job.power, positive_part(cosine), hn::Set(f, light.spot_exponent)));
}

struct Viewer {
  FloatVec x, y, z;  // unit vector to the eye
};

HWY_INLINE Viewer viewer_at(const LightingJob& job, const EffectColumns& e, uint32_t i) {
  const Floats f;
  if (!job.local_viewer || !job.needs_eye) return {hn::Zero(f), hn::Zero(f), hn::Set(f, 1.0f)};
  // Scaled by the longest component: eye coordinates have a double's range.
  const Doubles d;
  const hn::Rebind<float, Doubles> df;
  alignas(64) float v[3][hn::MaxLanes(f)];
  for (uint32_t j = 0; j < hn::Lanes(f); j += uint32_t(hn::Lanes(d))) {
    const Vec x = hn::Load(d, e.eye[0] + i + j), y = hn::Load(d, e.eye[1] + i + j),
              z = hn::Load(d, e.eye[2] + i + j);
    const Vec ax = hn::Abs(x), ay = hn::Abs(y), az = hn::Abs(z);
    const Vec xy = hn::IfThenElse(hn::Gt(ax, ay), ax, ay);
    const Vec longest = hn::IfThenElse(hn::Gt(xy, az), xy, az);
    const Mask usable = hn::Gt(longest, hn::Set(d, 1e-300));
    const Vec scale = hn::IfThenElseZero(
        usable, hn::Div(hn::Set(d, -1.0), hn::IfThenElse(usable, longest, hn::Set(d, 1.0))));
    hn::Store(hn::DemoteTo(df, hn::Mul(x, scale)), df, v[0] + j);
    hn::Store(hn::DemoteTo(df, hn::Mul(y, scale)), df, v[1] + j);
    hn::Store(hn::DemoteTo(df, hn::Mul(z, scale)), df, v[2] + j);
  }
  const FloatVec x = hn::Load(f, v[0]), y = hn::Load(f, v[1]), z = hn::Load(f, v[2]);
  const FloatVec inverse = inverse_length(dot(x, y, z, x, y, z));
  return {hn::Mul(x, inverse), hn::Mul(y, inverse), hn::Mul(z, inverse)};
}

// Cosine of the normal and the half vector; with no half vector, 0.
HWY_INLINE FloatVec half_cosine(const LightingJob& job, const LightTerm& light, const LightAt& at,
                                const Viewer& viewer, FloatVec nx, FloatVec ny, FloatVec nz) {
  const Floats f;
  if (!light.local && !job.local_viewer) {
    return dot(nx, ny, nz, hn::Set(f, light.half[0]), hn::Set(f, light.half[1]), hn::Set(f, light.half[2]));
  }
  const FloatVec x = hn::Add(at.x, viewer.x), y = hn::Add(at.y, viewer.y), z = hn::Add(at.z, viewer.z);
  return hn::Mul(dot(nx, ny, nz, x, y, z), inverse_length(dot(x, y, z, x, y, z)));
}

struct Sum3 {
  FloatVec c[3];
  HWY_INLINE void clear() { c[0] = c[1] = c[2] = hn::Zero(Floats()); }
  HWY_INLINE void add(FloatVec weight, const float* color) {
    for (int k = 0; k < 3; ++k) c[k] = hn::Add(c[k], hn::Mul(weight, hn::Set(Floats(), color[k])));
  }
};

// Sums over the lights: what the material's colours are multiplied with.
struct LightSums {
  Sum3 ambient, diffuse[2], specular[2];
};

HWY_INLINE void add_specular(const LightingJob& job, const LightTerm& light, FloatVec cosine, FloatVec half,
                             FloatVec weight, const SideRef* sides, uint32_t i, LightSums& sums) {
  const Floats f;
  const FloatVec zero = hn::Zero(f);
  const FloatMask lit = hn::Gt(cosine, zero);
  FloatVec shininess = sides[0].shininess.get(0, i);
  if (job.two_sided) {
    // A light shines on one side only: one power serves both.
    half = hn::IfThenElse(lit, half, hn::Neg(half));
    shininess = hn::IfThenElse(lit, shininess, sides[1].shininess.get(0, i));
  }
  const FloatVec shine = hn::Mul(weight, power_at(job.power, positive_part(half), shininess));
  sums.specular[0].add(hn::IfThenElseZero(lit, shine), light.specular);
  if (job.two_sided) sums.specular[1].add(hn::IfThenElseZero(hn::Lt(cosine, zero), shine), light.specular);
}

HWY_INLINE void add_light(const LightingJob& job, const LightTerm& light, const LightAt& at,
                          const Viewer& viewer, const EffectColumns& e, const SideRef* sides, uint32_t i,
                          LightSums& sums) {
  const Floats f;
  const FloatVec nx = hn::Load(f, e.normal[0] + i), ny = hn::Load(f, e.normal[1] + i),
                 nz = hn::Load(f, e.normal[2] + i);
  FloatVec weight = at.weight;
  if (light.spot) weight = hn::Mul(weight, spot_factor(job, light, at));
  if (light.ambient_varies) sums.ambient.add(weight, light.ambient);
  const FloatVec cosine = dot(nx, ny, nz, at.x, at.y, at.z);
  sums.diffuse[0].add(hn::Mul(weight, positive_part(cosine)), light.diffuse);
  if (job.two_sided) sums.diffuse[1].add(hn::Mul(weight, positive_part(hn::Neg(cosine))), light.diffuse);
  if (!job.specular) return;
  const FloatVec half = half_cosine(job, light, at, viewer, nx, ny, nz);
  add_specular(job, light, cosine, half, weight, sides, i, sums);
}

HWY_INLINE FloatVec clamp_unit(FloatVec v) {
  const Floats f;
  const FloatVec one = hn::Set(f, 1.0f);
  v = positive_part(v);  // NaN too
  return hn::IfThenElse(hn::Lt(v, one), v, one);
}

HWY_INLINE void store_lit(const LightingJob& job, const SideRef& side, const LightSums& sums, int which,
                          uint32_t i, float (*out)[kVertexGroup]) {
  const Floats f;
  for (int k = 0; k < 3; ++k) {
    const FloatVec ambient = hn::Add(hn::Set(f, job.ambient[k]), sums.ambient.c[k]);
    FloatVec v = hn::Add(side.emission.get(k, i), hn::Mul(side.ambient.get(k, i), ambient));
    v = hn::Add(v, hn::Mul(side.diffuse.get(k, i), sums.diffuse[which].c[k]));
    if (job.specular) v = hn::Add(v, hn::Mul(side.specular.get(k, i), sums.specular[which].c[k]));
    hn::Store(clamp_unit(v), f, out[k] + i);
  }
  hn::Store(clamp_unit(side.diffuse.get(3, i)), f, out[3] + i);
}

// Lights `count` vertices of a group (more, up to a vector's length, are computed with). index: their
// materials, or null.
HWY_INLINE void light_group(const LightingJob& job, const uint32_t* index, uint32_t count, EffectColumns& e) {
  MaterialColumns own[2];
  if (job.materials) gather_materials(job, index, count, own);
  const SideRef sides[2] = {side_ref(job, 0, e, job.materials ? own : nullptr),
                            side_ref(job, 1, e, job.materials ? own : nullptr)};
  ToLight to[kMaxLights];
  for (int l = 0; l < job.light_count; ++l) {
    if (job.lights[l].local) vectors_to(job.lights[l], e, count, to[l]);
  }
  for (uint32_t i = 0; i < count; i += uint32_t(hn::Lanes(Floats()))) {
    LightSums sums;
    sums.ambient.clear();
    for (int side = 0; side < 2; ++side) sums.diffuse[side].clear(), sums.specular[side].clear();
    const Viewer viewer = viewer_at(job, e, i);
    for (int l = 0; l < job.light_count; ++l) {
      add_light(job, job.lights[l], locate(job.lights[l], to[l], i), viewer, e, sides, i, sums);
    }
    store_lit(job, sides[0], sums, 0, i, e.lit[0]);
    if (job.two_sided) store_lit(job, sides[1], sums, 1, i, e.lit[1]);
  }
}
