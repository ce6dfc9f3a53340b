// x ^ s in float, SIMD. Compiled once an ISA level. No table, no estimate, no fused multiply-add: all levels
// agree.

using Floats = hn::ScalableTag<float>;
using FloatVec = hn::Vec<Floats>;
using FloatMask = hn::Mask<Floats>;
using Ints = hn::RebindToSigned<Floats>;

// log2 m for m in [sqrt 1/2, sqrt 2]: 2 / ln 2 * artanh t, t = (m - 1) / (m + 1), as a series in t. |t| <=
// 0.1716, so what is left out is below 2e-9 of the result.
HWY_INLINE FloatVec log2_of_mantissa(FloatVec m) {
  const Floats f;
  const FloatVec one = hn::Set(f, 1.0f);
  const FloatVec t = hn::Div(hn::Sub(m, one), hn::Add(m, one));
  const FloatVec t2 = hn::Mul(t, t);
  FloatVec p = hn::Set(f, 0.32059889f);                  // 2 / ln 2 / 9
  p = hn::Add(hn::Mul(p, t2), hn::Set(f, 0.41219858f));  // / 7
  p = hn::Add(hn::Mul(p, t2), hn::Set(f, 0.57707802f));  // / 5
  p = hn::Add(hn::Mul(p, t2), hn::Set(f, 0.96179669f));  // / 3
  // 2 / ln 2 = 3 - 0.1146...: 3t and its small correction round less than one product would.
  p = hn::Sub(hn::Mul(p, t2), hn::Set(f, 0.11460992f));
  return hn::Add(hn::Mul(t, hn::Set(f, 3.0f)), hn::Mul(t, p));
}

// 2 ^ v for |v| <= 0.51, by the exponential series; what is left out is below 1e-8 of the result.
HWY_INLINE FloatVec exp2_of_fraction(FloatVec v) {
  const Floats f;
  FloatVec p = hn::Set(f, 1.5252734e-5f);
  p = hn::Add(hn::Mul(p, v), hn::Set(f, 1.5403530e-4f));
  p = hn::Add(hn::Mul(p, v), hn::Set(f, 1.3333558e-3f));
  p = hn::Add(hn::Mul(p, v), hn::Set(f, 9.6181291e-3f));
  p = hn::Add(hn::Mul(p, v), hn::Set(f, 5.5504109e-2f));
  p = hn::Add(hn::Mul(p, v), hn::Set(f, 2.4022651e-1f));
  p = hn::Add(hn::Mul(p, v), hn::Set(f, 6.9314718e-1f));
  return hn::Add(hn::Mul(p, v), hn::Set(f, 1.0f));
}

// The draft level's: fewer terms. log2 to 5.6e-6, 2 ^ v to 1.02e-4 of the result; both exact where the result is 1.
HWY_INLINE FloatVec draft_log2_of_mantissa(FloatVec m) {
  const Floats f;
  const FloatVec one = hn::Set(f, 1.0f);
  const FloatVec t = hn::Div(hn::Sub(m, one), hn::Add(m, one));
  return hn::Mul(t, hn::Add(hn::Mul(hn::Mul(t, t), hn::Set(f, 0.98353741f)), hn::Set(f, 2.88522853f)));
}
HWY_INLINE FloatVec draft_exp2_of_fraction(FloatVec v) {
  const Floats f;
  FloatVec p = hn::Add(hn::Mul(v, hn::Set(f, 0.05500913f)), hn::Set(f, 0.24221146f));
  p = hn::Add(hn::Mul(p, v), hn::Set(f, 0.69328296f));
  return hn::Add(hn::Mul(p, v), hn::Set(f, 1.0f));
}

// See raster/vertex/lighting.h. NaN counts as zero.
template <bool kDraft>
HWY_INLINE FloatVec power_of(FloatVec x, FloatVec s) {
  const Floats f;
  const Ints d;
  const auto bits = hn::BitCast(d, x);
  // The exponent that leaves a mantissa in [sqrt 1/2, sqrt 2).
  const auto exponent = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(d, 0x3f3504f3)));
  const FloatVec mantissa = hn::BitCast(f, hn::Sub(bits, hn::ShiftLeft<23>(exponent)));
  // s * log2 x = whole + part. The difference of `whole` and its integer is exact, so that the large part of
  // a product does not cost the small one its bits.
  const FloatVec whole = hn::Mul(s, hn::ConvertTo(f, exponent));
  const FloatVec part =
      hn::Mul(s, kDraft ? draft_log2_of_mantissa(mantissa) : log2_of_mantissa(mantissa));
  const FloatVec low = hn::Set(f, -125.0f), high = hn::Set(f, 64.0f);
  const FloatVec sum = hn::Add(whole, part);
  const FloatMask vanishes = hn::Lt(sum, low), grows = hn::Gt(sum, high);
  const FloatVec n = hn::Floor(hn::Add(sum, hn::Set(f, 0.5f)));
  const FloatMask usable = hn::Not(hn::Or(vanishes, grows));
  const FloatVec fraction = hn::IfThenElseZero(usable, hn::Add(hn::Sub(whole, n), part));
  const auto shift = hn::ShiftLeft<23>(hn::ConvertTo(d, hn::IfThenElseZero(usable, n)));
  FloatVec result = hn::BitCast(f, hn::Add(hn::BitCast(d, kDraft ? draft_exp2_of_fraction(fraction) : exp2_of_fraction(fraction)), shift));
  result = hn::IfThenElse(grows, hn::Set(f, 18446744073709551616.0f), result);
  result = hn::IfThenZeroElse(vanishes, result);
  const FloatVec of_zero = hn::IfThenElseZero(hn::Eq(s, hn::Zero(f)), hn::Set(f, 1.0f));
  return hn::IfThenElse(hn::Ge(x, hn::Set(f, 1.17549435e-38f)), result, of_zero);
}

HWY_NOINLINE FloatVec exact_power_of(FloatVec x, FloatVec s) {
  const Floats f;
  alignas(64) float base[hn::MaxLanes(f)], exponent[hn::MaxLanes(f)];
  hn::Store(x, f, base);
  hn::Store(s, f, exponent);
  for (size_t i = 0; i < hn::Lanes(f); ++i) base[i] = float(ExactPower(double(base[i]), double(exponent[i])));
  return hn::Load(f, base);
}

HWY_INLINE FloatVec power_at(Level level, FloatVec x, FloatVec s) {
  if (HWY_LIKELY(level == Level::standard)) return power_of<false>(x, s);
  return level == Level::draft ? power_of<true>(x, s) : exact_power_of(x, s);
}

void power_columns(const float* x, const float* s, float* out, size_t count, Level level) {
  const Floats f;
  for (size_t i = 0; i < count; i += hn::Lanes(f)) {
    const size_t n = count - i < hn::Lanes(f) ? count - i : hn::Lanes(f);
    alignas(64) float a[hn::MaxLanes(f)] = {}, b[hn::MaxLanes(f)] = {}, c[hn::MaxLanes(f)];
    memcpy(a, x + i, n * sizeof(float));
    memcpy(b, s + i, n * sizeof(float));
    hn::Store(power_at(level, hn::Load(f, a), hn::Load(f, b)), f, c);
    memcpy(out + i, c, n * sizeof(float));
  }
}
