// Pixels of 8-bit surfaces, a 32-bit lane each, R in the lowest byte. Compiled once per ISA level.

// Channels in 0..255, unrounded, to the nearest bytes.
HWY_INLINE VI RoundToByte(VF v) { return TruncateInRange(hn::Add(v, hn::Set(DF(), 0.5f))); }

// What lies beyond the range is held to it.
HWY_INLINE VI PackPixel(VI r, VI g, VI b, VI a) {
  const VI channel[4] = {r, g, b, a};
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_SSE4
  // Packing saturates. In each 128 bits: four R, four G, four B, four A.
  const hn::Repartition<int16_t, DI> words;
  const auto rg = hn::ReorderDemote2To(words, channel[0], channel[1]);
  const auto ba = hn::ReorderDemote2To(words, channel[2], channel[3]);
  const hn::Repartition<uint8_t, DI> bytes;
#if HWY_TARGET == HWY_AVX3
  const hn::Vec<decltype(bytes)> planar{_mm512_packus_epi16(rg.raw, ba.raw)};
#elif HWY_TARGET == HWY_AVX2
  const hn::Vec<decltype(bytes)> planar{_mm256_packus_epi16(rg.raw, ba.raw)};
#else
  const hn::Vec<decltype(bytes)> planar{_mm_packus_epi16(rg.raw, ba.raw)};
#endif
  alignas(16) static constexpr uint8_t kInterleave[16] = {0, 4, 8,  12, 1, 5, 9,  13,
                                                          2, 6, 10, 14, 3, 7, 11, 15};
  return hn::BitCast(DI(), hn::TableLookupBytes(planar, hn::LoadDup128(bytes, kInterleave)));
#else
  const DI d;
  const auto held = [&](int k)
                        HWY_ATTR { return hn::Min(hn::Max(channel[k], hn::Zero(d)), hn::Set(d, 255)); };
  return hn::Or(hn::Or(held(0), hn::ShiftLeft<8>(held(1))),
                hn::Or(hn::ShiftLeft<16>(held(2)), hn::ShiftLeft<24>(held(3))));
#endif
}

HWY_INLINE VI RoundToPixel(VF r, VF g, VF b, VF a) {
  return PackPixel(RoundToByte(r), RoundToByte(g), RoundToByte(b), RoundToByte(a));
}

// Two channels a lane, 16 bits each: r and b, g and a.
struct WidePixel {
  VU rb, ga;
};

#if HWY_TARGET == HWY_SCALAR
template <class F>
HWY_INLINE VU ForHalves(VU a, VU b, F f) {
  const uint32_t x = hn::GetLane(a), y = hn::GetLane(b);
  return hn::Set(DU(), (f(x & 0xffffu, y & 0xffffu) & 0xffffu) | f(x >> 16, y >> 16) << 16);
}
HWY_INLINE VU Mul16(VU a, VU b) {
  return ForHalves(a, b, [](uint32_t x, uint32_t y) { return x * y; });
}
HWY_INLINE VU MulHigh16(VU a, VU b) {
  return ForHalves(a, b, [](uint32_t x, uint32_t y) { return x * y >> 16; });
}
HWY_INLINE VU Min16(VU a, VU b) {
  return ForHalves(a, b, [](uint32_t x, uint32_t y) { return x < y ? x : y; });
}
HWY_INLINE VU SaturatedAdd16(VU a, VU b) {
  return ForHalves(a, b, [](uint32_t x, uint32_t y) { return x + y < 0xffffu ? x + y : 0xffffu; });
}
#else
using DU16 = hn::Repartition<uint16_t, DU>;
HWY_INLINE VU Mul16(VU a, VU b) {
  return hn::BitCast(DU(), hn::Mul(hn::BitCast(DU16(), a), hn::BitCast(DU16(), b)));
}
HWY_INLINE VU MulHigh16(VU a, VU b) {
  return hn::BitCast(DU(), hn::MulHigh(hn::BitCast(DU16(), a), hn::BitCast(DU16(), b)));
}
HWY_INLINE VU Min16(VU a, VU b) {
  return hn::BitCast(DU(), hn::Min(hn::BitCast(DU16(), a), hn::BitCast(DU16(), b)));
}
HWY_INLINE VU SaturatedAdd16(VU a, VU b) {
  return hn::BitCast(DU(), hn::SaturatedAdd(hn::BitCast(DU16(), a), hn::BitCast(DU16(), b)));
}
#endif

HWY_INLINE WidePixel Widen(VU pixel) {
  const VU low = hn::Set(DU(), 0x00ff00ffu);
#if HWY_TARGET == HWY_SCALAR
  return {hn::And(pixel, low), hn::And(hn::ShiftRight<8>(pixel), low)};
#else
  return {hn::And(pixel, low), hn::BitCast(DU(), hn::ShiftRight<8>(hn::BitCast(DU16(), pixel)))};
#endif
}
HWY_INLINE VU Narrow(const WidePixel& p) { return hn::Or(p.rb, hn::ShiftLeft<8>(p.ga)); }

// The upper half of each lane in both.
HWY_INLINE VU UpperTwice(VU v) {
#if HWY_TARGET == HWY_SCALAR
  const VU half = hn::ShiftRight<16>(v);
  return hn::Or(half, hn::ShiftLeft<16>(half));
#else
  const hn::Repartition<uint8_t, DU> bytes;
  alignas(16) static constexpr uint8_t kUpper[16] = {2, 3, 2, 3, 6, 7, 6, 7, 10, 11, 10, 11, 14, 15, 14, 15};
  return hn::BitCast(DU(), hn::TableLookupBytes(hn::BitCast(bytes, v), hn::LoadDup128(bytes, kUpper)));
#endif
}

// Each half divided by 255 and rounded to the nearest, for 0 <= x <= 255 * 255: exactly, with y = x + 128, as
// (y + y / 256) / 256 in whole numbers.
HWY_INLINE VU Divided255(VU x) {
  return MulHigh16(hn::Add(x, hn::Set(DU(), 0x00800080u)), hn::Set(DU(), 0x01010101u));
}
