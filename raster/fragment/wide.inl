// Values in double, for the exact level. Slots hold floats, so a double goes in two: the nearest float, which any stage
// can read, and what that leaves, which only stages of the exact level do. 48 bits of it survive. Speed comes second
// here: a stage asks the draw's state for what others have as a template's argument.

template <class V>
HWY_INLINE VD PromoteGroup(V v) {
  const DD d;
  VD out;
#if HWY_TARGET != HWY_SCALAR
  if constexpr (kDoubleParts == 2) {
    const hn::Half<hn::DFromV<V>> half;
    out.part[0] = hn::PromoteTo(d, hn::LowerHalf(half, v));
    out.part[1] = hn::PromoteTo(d, hn::UpperHalf(half, v));
  } else
#endif
  {
    out.part[0] = hn::PromoteTo(d, v);
  }
  return out;
}

HWY_INLINE VD SetWide(double value) {
  VD out;
  for (int p = 0; p < kDoubleParts; ++p) out.part[p] = hn::Set(DD(), value);
  return out;
}
HWY_INLINE VD LoadWide(const double* from) {
  VD out;
  for (int p = 0; p < kDoubleParts; ++p) out.part[p] = hn::Load(DD(), from + p * kDoubleLanes);
  return out;
}
HWY_INLINE void StoreWide(const VD& v, double* to) {
  for (int p = 0; p < kDoubleParts; ++p) hn::Store(v.part[p], DD(), to + p * kDoubleLanes);
}

#define HALFSPACE_WIDE(name, operation)                                                       \
  HWY_INLINE VD name(const VD& a, const VD& b) {                                              \
    VD out;                                                                                   \
    for (int p = 0; p < kDoubleParts; ++p) out.part[p] = hn::operation(a.part[p], b.part[p]); \
    return out;                                                                               \
  }
HALFSPACE_WIDE(AddWide, Add)
HALFSPACE_WIDE(SubWide, Sub)
HALFSPACE_WIDE(MulWide, Mul)
HALFSPACE_WIDE(DivWide, Div)
HALFSPACE_WIDE(MinWide, Min)
HALFSPACE_WIDE(MaxWide, Max)
#undef HALFSPACE_WIDE

HWY_INLINE VD FloorWide(const VD& v) {
  VD out;
  for (int p = 0; p < kDoubleParts; ++p) out.part[p] = hn::Floor(v.part[p]);
  return out;
}
HWY_INLINE VD ClampLevels(const VD& v) { return MinWide(MaxWide(v, SetWide(0)), SetWide(255)); }

constexpr int LowSlot(int slot) {
  return slot <= kT ? kLowR + (slot - kR) : (slot == kLambda ? kLowLambda : kLowTexR + (slot - kTexR));
}

// Whether stages hand on both parts: of colours and coordinates, of texels, of lambda.
HWY_INLINE bool IsWide(const BlockContext& c) { return c.params->accuracy.interpolation == Level::exact; }
HWY_INLINE bool HasWideTexel(const BlockContext& c) { return c.params->accuracy.filter == Level::exact; }
HWY_INLINE bool HasWideLambda(const BlockContext& c) { return c.params->accuracy.lod == Level::exact; }

HWY_INLINE VD GetWide(const Lanes& v, int slot, bool wide) {
  const VD high = PromoteGroup(v.slot[slot]);
  return wide ? AddWide(high, PromoteGroup(v.slot[LowSlot(slot)])) : high;
}
HWY_INLINE void PutWide(const VD& value, int slot, Lanes& v) {
  v.slot[slot] = DemoteGroup(DF(), value);
  v.slot[LowSlot(slot)] = DemoteGroup(DF(), SubWide(value, PromoteGroup(v.slot[slot])));
}
