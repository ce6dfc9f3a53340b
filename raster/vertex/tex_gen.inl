// Texture coordinate generation (spec 2.11.4), in double. Compiled once an ISA level.

struct SpherePoint {
  double s, t;
};

// u: unit vector from the eye to the vertex; r = u - 2 n (n . u); m = 2 sqrt(rx^2 + ry^2 + (rz + 1)^2).
HWY_INLINE SpherePoint sphere_map(const EffectColumns& e, uint32_t i) {
  double x = e.eye[0][i], y = e.eye[1][i], z = e.eye[2][i];
  const double length = __builtin_sqrt(x * x + y * y + z * z);
  const double inverse = length > 0 ? 1 / length : 0;
  x *= inverse, y *= inverse, z *= inverse;
  const double nx = double(e.normal[0][i]), ny = double(e.normal[1][i]), nz = double(e.normal[2][i]);
  const double along = 2 * (nx * x + ny * y + nz * z);
  const double rx = x - nx * along, ry = y - ny * along, rz = z - nz * along + 1;
  const double m = 2 * __builtin_sqrt(rx * rx + ry * ry + rz * rz);
  // Straight back from the sphere's far side there is no point: its middle.
  if (!(m > 0)) return {0.5, 0.5};
  return {rx / m + 0.5, ry / m + 0.5};
}

HWY_INLINE void generate_coords(const TexGenJob& job, const Group& g, const EffectColumns& e, uint32_t i,
                                float* v) {
  SpherePoint sphere{};
  if (job.sphere) sphere = sphere_map(e, i);
  for (int k = 0; k < 4; ++k) {
    switch (job.kind[k]) {
      case TexGenJob::kGiven:
        break;
      case TexGenJob::kPlane: {
        const double* p = job.plane[k];
        const double xy = p[0] * double(g.position[0][i]) + p[1] * double(g.position[1][i]);
        v[k] = bounded_double((xy + p[2] * double(g.position[2][i])) + p[3] * double(g.position[3][i]));
        break;
      }
      case TexGenJob::kSphere:
        v[k] = bounded_double(k == 0 ? sphere.s : sphere.t);
        break;
    }
  }
}
