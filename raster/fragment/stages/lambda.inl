// The level-of-detail parameter lambda (spec 3.8.8): rho from the planes' exact derivatives, the longer gradient.

// log2 of positive finite floats, |error| < 1.6e-5. The exponent is taken from the bits; of the mantissa in [0.75, 1.5),
// less one, a polynomial without a constant, so that powers of two are exact.
HWY_INLINE VF Log2(VF x) {
  const DF d;
  const DI di;
  const VI bits = hn::BitCast(di, x);
  const VI shifted = hn::Sub(bits, hn::Set(di, 0x3f400000));  // 0.75f
  // Times 2^23. Nothing is shifted, since the units that do are those that add.
  const VI exponent = hn::And(shifted, hn::Set(di, ~0x7fffff));
  const VF t = hn::Sub(hn::BitCast(d, hn::Sub(bits, exponent)), hn::Set(d, 1.0f));
  VF p = hn::Set(d, 0.197522074f);
  p = hn::Add(hn::Mul(p, t), hn::Set(d, -0.377522558f));
  p = hn::Add(hn::Mul(p, t), hn::Set(d, 0.491849184f));
  p = hn::Add(hn::Mul(p, t), hn::Set(d, -0.721219659f));
  p = hn::Add(hn::Mul(p, t), hn::Set(d, 1.44244754f));
  return hn::Add(hn::Mul(hn::ConvertTo(d, exponent), hn::Set(d, 0x1p-23f)), hn::Mul(p, t));
}
HWY_INLINE VF HalfLog2(VF rho2) {
  const DF d;
  rho2 = hn::Min(hn::Max(rho2, hn::Set(d, 1e-30f)), hn::Set(d, 1e30f));
  return hn::Mul(hn::Set(d, 0.5f), Log2(rho2));
}

// With S and Q planes, d(S/Q)/dx = (dS/dx * Q - S * dQ/dx) / Q^2, and the numerator does not depend on x: it is the same
// for all pixels of a row, and that of d/dy for all of a column. So rho^2 = max(row's, column's) / Q^4. In double since
// the differences may cancel.
struct CoordGradient {  // of s or t, in texels, times Q^2
  double s, sx, sy, q = 1, qx = 0, qy = 0, size, twist;

  // divisor: the plane of Q, or less than 0 where that is 1. `unit`: what texels are counted in.
  HWY_INLINE CoordGradient(const BlockContext& c, int axis, int divisor, double unit) {
    const SetupBatch& setup = *c.setup;
    const int k = c.lane, plane = c.params->tex_plane + axis;
    size = c.params->lod_scale[axis] * unit;
    s = setup.f0[plane][k], sx = setup.dfdx[plane][k], sy = setup.dfdy[plane][k];
    if (divisor >= 0) q = setup.f0[divisor][k], qx = setup.dfdx[divisor][k], qy = setup.dfdy[divisor][k];
    twist = sx * qy - qx * sy;
  }
  HWY_INLINE double AlongX(double dy) const { return (sx * q - qx * s + twist * dy) * size; }
  HWY_INLINE double AlongY(double dx) const { return (sy * q - qy * s - twist * dx) * size; }
};

// Squares of the gradients along x of each row of a row of blocks; along y of each column. `out` is 0 before.
template <class L>
HWY_INLINE void SquareRows(const BlockContext& c, int divisor, double unit, double* out) {
  for (int axis = 0; axis < 2; ++axis) {
    const CoordGradient gradient(c, axis, divisor, unit);
    const double dy = c.dy + L::FirstRow(c);
    for (int n = 0; n < kBlockSize; ++n) {
      const double g = gradient.AlongX(dy + n);
      out[n] += g * g;
    }
  }
}
template <class L>
HWY_INLINE void SquareColumns(const BlockContext& c, int divisor, double unit, double* out) {
  for (int axis = 0; axis < 2; ++axis) {
    const CoordGradient gradient(c, axis, divisor, unit);
    for (int n = 0; n < L::kSide; ++n) {
      const double g = gradient.AlongY(c.dx + n);
      out[n] += g * g;
    }
  }
}

template <class L>
struct Gradients {
  alignas(64) double along_x[kBlockSize] = {}, along_y[L::kSide] = {};

  HWY_INLINE Gradients(const BlockContext& c, int divisor, double unit) {
    SquareRows<L>(c, divisor, unit, along_x);
    SquareColumns<L>(c, divisor, unit, along_y);
  }
  static HWY_INLINE int Row(int i) { return L::Row(i) % kBlockSize; }
  HWY_INLINE double First() const { return along_x[0] > along_y[0] ? along_x[0] : along_y[0]; }
};

// By each pixel's own Q, in double.
template <bool kProjective>
struct Lambda {
  static constexpr bool kKills = false, kPacks = false, kInTiles = true;

  template <class L>
  struct Once {
    static HWY_INLINE bool IsConstant(const BlockContext& c) {
      return !kProjective && (c.setup->variant[c.lane] & kAffine) != 0;
    }
    static HWY_INLINE int Divisor(const BlockContext& c) { return kProjective ? c.params->tex_plane + 2 : 1; }

    typename L::PlaneDouble divisor;
    bool constant;  // the divisor is
    Gradients<L> gradients;
    VF lambda;  // where the divisor is constant
    HWY_INLINE explicit Once(const BlockContext& c)
        : divisor(c, Divisor(c)), constant(IsConstant(c)), gradients(c, constant ? -1 : Divisor(c), 1) {
      lambda = hn::Zero(DF());
      if (constant) lambda = HalfLog2(hn::Set(DF(), static_cast<float>(gradients.First())));
    }
  };

  template <class L>
  static HWY_INLINE void Run(const BlockContext&, const Once<L>& once, int i, Lanes& v) {
    if (once.constant) {
      v.slot[kLambda] = once.lambda;
      return;
    }
    v.slot[kLambda] = HalfLog2(DemoteGroup(DF(), SquareOfRho<L>(once, i)));
  }

  // Where the divisor is not constant.
  template <class L>
  static HWY_INLINE VD SquareOfRho(const Once<L>& once, int i) {
    constexpr int kParts = BlockPlaneDouble::kParts;
    VD rho2 = once.divisor.At(i);
    for (int p = 0; p < kDoubleParts; ++p) {
      const auto row = hn::Set(DD(), once.gradients.along_x[Gradients<L>::Row(i) + p / kParts]);
      const auto columns = hn::Load(DD(), once.gradients.along_y + L::Column(i) + p % kParts * kDoubleLanes);
      const auto q2 = hn::Mul(rho2.part[p], rho2.part[p]);
      rho2.part[p] = hn::Div(hn::Max(row, columns), hn::Mul(q2, q2));
    }
    return rho2;
  }
};

inline constexpr int whole_vectors(int count) { return count < kLanes ? kLanes : count; }

// Where planes are in float, by way of w, which is there already: lambda = max(row's, column's) + 2 log2(w), with
// logarithms taken once for a row or a column. 1/w is then within 1/191 of the true one (docs/numerics.md), lambda within
// 1/66.
struct LambdaAtW {
  static constexpr bool kKills = false, kPacks = false, kInTiles = true;

  // What texels are counted in: the anchor's w to a power of two, so that floats can hold it.
  struct Unit {
    double value;
    float rise;  // what the logarithm is to be raised by
    HWY_INLINE explicit Unit(const BlockContext& c) {
      uint64_t bits;
      __builtin_memcpy(&bits, &c.setup->f0[1][c.lane], sizeof bits);
      const int exponent = static_cast<int>(bits >> 52 & 2047) - 1023;
      bits = static_cast<uint64_t>(1023 - 2 * exponent) << 52;
      __builtin_memcpy(&value, &bits, sizeof value);
      rise = static_cast<float>(2 * exponent);
    }
  };

  // Of the columns of a tile only once for all its rows of blocks.
  template <class L>
  struct Once {
    static constexpr bool kInTable = L::kSide == kTileSize;
    alignas(64) float along_x[whole_vectors(kBlockSize)], own_columns[kInTable ? kLanes : whole_vectors(L::kSide)];
    const float* table = nullptr;
    HWY_INLINE const float* AlongY() const { return kInTable ? table : own_columns; }
    HWY_INLINE explicit Once(const BlockContext& c) {
      const Unit unit(c);
      double rows[kBlockSize] = {};
      SquareRows<L>(c, 1, unit.value, rows);
      TakeLogarithms(rows, kBlockSize, unit.rise, along_x);
      if constexpr (kInTable) {
        if (!c.planes->has_lod_columns) FillColumns<L>(c, unit, c.planes->lod_columns);
        c.planes->has_lod_columns = true;
        table = c.planes->lod_columns;
      } else {
        FillColumns<L>(c, unit, own_columns);
      }
    }
  };

  template <class L>
  static HWY_INLINE void Run(const BlockContext&, const Once<L>& once, int i, Lanes& v) {
    const VF longer =
        hn::Max(FillRows(once.along_x + Gradients<L>::Row(i)), RepeatColumns(once.AlongY() + L::Column(i)));
    const VF log_w = Log2(v.slot[kW]);
    v.slot[kLambda] = hn::Add(longer, hn::Mul(log_w, hn::Set(DF(), 2.0f)));
  }

 private:
  template <class L>
  static HWY_NOINLINE void FillColumns(const BlockContext& c, const Unit& unit, float* out) {
    alignas(64) double squares[L::kSide] = {};
    SquareColumns<L>(c, 1, unit.value, squares);
    TakeLogarithms(squares, L::kSide, unit.rise, out);
  }
  // To whole vectors.
  static HWY_INLINE void TakeLogarithms(const double* squares, int count, float rise, float* out) {
    const DF d;
    int n = 0;
    for (; n < count; ++n) out[n] = static_cast<float>(squares[n]);
    for (; n % kLanes != 0; ++n) out[n] = 0;
    for (n = 0; n < count; n += kLanes)
      hn::Store(hn::Add(HalfLog2(hn::Load(d, out + n)), hn::Set(d, rise)), d, out + n);
  }
};

// The exact level: the logarithm in double, and what a float loses of it handed on.
template <bool kProjective>
struct LambdaExact {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  using Once = typename Lambda<kProjective>::template Once<L>;
  template <class L>
  static HWY_INLINE void Run(const BlockContext&, const Once<L>& once, int i, Lanes& v) {
    alignas(64) double rho2[kMaxLanes];
    StoreWide(once.constant ? SetWide(once.gradients.First()) : Lambda<kProjective>::template SquareOfRho<L>(once, i), rho2);
    for (int j = 0; j < kLanes; ++j) {
      const double held = rho2[j] > 1e-30 ? (rho2[j] < 1e30 ? rho2[j] : 1e30) : 1e-30;
      rho2[j] = 0.5 * ExactLog2(held);
    }
    PutWide(LoadWide(rho2), kLambda, v);
  }
};

// The draft level: one lambda for all of a primitive, from set-up.
struct LambdaOfPrimitive {
  static constexpr bool kKills = false, kPacks = false;
  template <class L>
  using Once = NothingOnce;
  template <class L>
  static HWY_INLINE void Run(const BlockContext& c, const Once<L>&, int, Lanes& v) {
    v.slot[kLambda] = hn::Set(DF(), c.setup->lambda[c.lane]);
  }
};
