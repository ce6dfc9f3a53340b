// The level-of-detail parameter lambda (spec 3.8.8): rho from the planes' exact derivatives, the longer gradient.

// log2 of positive finite floats, |error| < 1e-4. The exponent is taken from the bits, the mantissa in [0.75, 1.5)
// goes through the series of log2((1 + r) / (1 - r)).
HWY_INLINE VF Log2(VF x) {
  const DF d;
  const DI di;
  const VI bits = hn::BitCast(di, x);
  const VI shifted = hn::Sub(bits, hn::Set(di, 0x3f400000));  // 0.75f
  const VI exponent = hn::ShiftRight<23>(shifted);
  const VF m = hn::BitCast(d, hn::Sub(bits, hn::ShiftLeft<23>(exponent)));
  const VF r = hn::Div(hn::Sub(m, hn::Set(d, 1.0f)), hn::Add(m, hn::Set(d, 1.0f)));
  const VF r2 = hn::Mul(r, r);
  // 2/ln2 * (1 + r^2/3 + r^4/5 + r^6/7)
  VF p = hn::Set(d, 0.41219858f);
  p = hn::Add(hn::Mul(p, r2), hn::Set(d, 0.57707802f));
  p = hn::Add(hn::Mul(p, r2), hn::Set(d, 0.96179669f));
  p = hn::Add(hn::Mul(p, r2), hn::Set(d, 2.88539008f));
  return hn::Add(hn::ConvertTo(d, exponent), hn::Mul(p, r));
}

// With S and Q planes, d(S/Q)/dx = (dS/dx * Q - S * dQ/dx) / Q^2, and the numerator does not depend on x: it is the same
// for all pixels of a row, and that of d/dy for all of a column. So rho^2 = max(row's, column's) / Q^4. In double since
// the differences may cancel.
template <bool kProjective>
struct Lambda {
  static constexpr bool kKills = false, kPacks = false, kInTiles = true;

  template <class L>
  struct Once {
    typename L::PlaneDouble divisor;
    bool constant;                                                  // the divisor is
    alignas(64) double along_x[L::kSide], along_y[L::kSide];  // of each row, of each column: texels squared * Q^4
    VF lambda;                                                      // where the divisor is constant
    HWY_INLINE explicit Once(const BlockContext& c) : divisor(c, kProjective ? c.params->tex_plane + 2 : 1) {
      constant = !kProjective && (c.setup->variant[c.lane] & kAffine) != 0;
      for (int n = 0; n < L::kSide; ++n) along_x[n] = along_y[n] = 0;
      lambda = hn::Zero(DF());
      for (int axis = 0; axis < 2; ++axis) AddAxis(c, axis);
      const double longer = along_x[0] > along_y[0] ? along_x[0] : along_y[0];
      if (constant) lambda = HalfLog2(hn::Set(DF(), static_cast<float>(longer)));
    }

   private:
    HWY_INLINE void AddAxis(const BlockContext& c, int axis) {
      const SetupBatch& setup = *c.setup;
      const int k = c.lane, plane = c.params->tex_plane + axis;
      const double size = c.params->lod_scale[axis];
      const double s = setup.f0[plane][k], sx = setup.dfdx[plane][k], sy = setup.dfdy[plane][k];
      // q, qx, qy of a constant divisor.
      double q = 1, qx = 0, qy = 0;
      if (!constant) {
        const int d = kProjective ? c.params->tex_plane + 2 : 1;
        q = setup.f0[d][k], qx = setup.dfdx[d][k], qy = setup.dfdy[d][k];
      }
      const double twist = sx * qy - qx * sy;
      for (int n = 0; n < L::kSide; ++n) {
        const double gx = (sx * q - qx * s + twist * (c.dy + n)) * size;
        const double gy = (sy * q - qy * s - twist * (c.dx + n)) * size;
        along_x[n] += gx * gx;
        along_y[n] += gy * gy;
      }
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
      const auto row = hn::Set(DD(), once.along_x[L::Row(i) + p / kParts]);
      const auto columns = hn::Load(DD(), once.along_y + L::Column(i) + p % kParts * kDoubleLanes);
      const auto q2 = hn::Mul(rho2.part[p], rho2.part[p]);
      rho2.part[p] = hn::Div(hn::Max(row, columns), hn::Mul(q2, q2));
    }
    return rho2;
  }

 private:
  static HWY_INLINE VF HalfLog2(VF rho2) {
    const DF d;
    rho2 = hn::Min(hn::Max(rho2, hn::Set(d, 1e-30f)), hn::Set(d, 1e30f));
    return hn::Mul(hn::Set(d, 0.5f), Log2(rho2));
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
    const double constant = once.along_x[0] > once.along_y[0] ? once.along_x[0] : once.along_y[0];
    StoreWide(once.constant ? SetWide(constant) : Lambda<kProjective>::template SquareOfRho<L>(once, i), rho2);
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
