// Attributes from client memory, a vertex or a column at a time. Compiled once an ISA level.

HWY_INLINE void load_element(const unsigned char* from, int size, const float* fallback, float* to) {
  for (int k = 0; k < 4; ++k) to[k] = fallback[k];
  for (int k = 0; k < 4 && k < size; ++k) memcpy(to + k, from + size_t(k) * sizeof(float), sizeof(float));
}

#if HWY_TARGET == HWY_SCALAR

HWY_INLINE void load_any(const StreamRef& stream, const unsigned char* from, const float* fallback, float* to) {
  if (!stream.bytes) return load_element(from, stream.size, fallback, to);
  for (int k = 0; k < 4; ++k) to[k] = float(from[k]) / 255.0f;
}

template <bool kAsks = true>
HWY_INLINE void load_columns(const StreamRef& stream, uint32_t first, uint32_t count, int columns,
                             const float* fallback, float (*out)[kVertexGroup]) {
  const unsigned char* p = stream.data + size_t{first} * stream.stride;
  for (uint32_t i = 0; i < count; ++i, p += stream.stride) {
    float v[4];
    load_any(stream, p, fallback, v);
    for (int k = 0; k < columns; ++k) out[k][i] = v[k];
  }
}

// Vertices' own colours, held to [0, 1].
struct ColorReader {
  const StreamRef& stream;
  const unsigned char* from;

  HWY_INLINE ColorReader(const ShadeJob& job, uint32_t first, uint32_t)
      : stream(job.color), from(job.color.data + size_t{first} * job.color.stride) {}

  HWY_INLINE void Copy(uint32_t i, void* to) const {
    float rgba[4];
    load_any(stream, from + size_t{i} * stream.stride, kDefaults, rgba);
    for (float& v : rgba) v = v > 0 ? (v < 1 ? v : 1.0f) : 0.0f;
    memcpy(to, rgba, sizeof rgba);
  }
};

#else

using Quads = hn::CappedTag<float, 4>;
using QuadVec = hn::Vec<Quads>;

// Elements of a stream as four floats each; what one lacks is filled up. Reads four from memory whatever their size:
// only behind the last elements would that reach beyond the array.
struct QuadReader {
  const unsigned char* from;
  size_t stride;
  int size;
  bool bytes;
  uint32_t careful;  // from this element on, no more is read than there is
  const float* fallback;
  QuadVec missing;
  hn::Mask<Quads> given;

  HWY_INLINE QuadReader(const StreamRef& stream, uint32_t first, uint32_t count, const float* defaults)
      : from(stream.data + size_t{first} * stream.stride),
        stride(stream.stride),
        size(stream.size),
        bytes(stream.bytes),
        careful(count - careful_elements(stream, count)),
        fallback(defaults),
        missing(hn::LoadU(Quads(), defaults)),
        given(hn::FirstN(Quads(), size_t(stream.size))) {}

  HWY_INLINE QuadVec get(uint32_t i) const {
    const unsigned char* p = from + size_t{i} * stride;
    if (bytes) {
      const hn::Rebind<uint8_t, Quads> from_bytes;
      const hn::Rebind<int32_t, Quads> ints;
      const auto whole = hn::ConvertTo(Quads(), hn::PromoteTo(ints, hn::LoadU(from_bytes, p)));
      return hn::Div(whole, hn::Set(Quads(), 255.0f));
    }
    if (HWY_LIKELY(i < careful))
      return hn::IfThenElse(given, hn::LoadU(Quads(), reinterpret_cast<const float*>(p)), missing);
    return load_given(p);
  }
  // What lies beyond is as the first is: nothing is decided then by what nobody draws.
  HWY_INLINE QuadVec get_or_first(uint32_t i, uint32_t count) const { return get(i < count ? i : 0); }

 private:
  // Not written in parts to be read whole, where that can be helped.
  HWY_INLINE QuadVec load_given(const unsigned char* p) const {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
    return hn::IfThenElse(given, hn::MaskedLoad(given, Quads(), reinterpret_cast<const float*>(p)), missing);
#else
    float v[4];
    load_element(p, size, fallback, v);
    return hn::LoadU(Quads(), v);
#endif
  }
  static HWY_INLINE uint32_t careful_elements(const StreamRef& stream, uint32_t count) {
    const size_t lacking = size_t(4 - stream.size) * sizeof(float);
    if (lacking == 0) return 0;
    const size_t elements = stream.stride == 0 ? count : (lacking + stream.stride - 1) / stream.stride;
    return elements < count ? uint32_t(elements) : count;
  }
};

// How far ahead of what is read memory is asked for, in bytes: arrays of a million vertices come from beyond the caches.
inline constexpr size_t kPrefetch = 2048;

// Four elements as columns.
struct FourColumns {
  QuadVec column[4];

  HWY_INLINE FourColumns(QuadVec a, QuadVec b, QuadVec c, QuadVec e) {
    const Quads d;
    const QuadVec low_ab = hn::InterleaveLower(d, a, b), low_ce = hn::InterleaveLower(d, c, e);
    const QuadVec high_ab = hn::InterleaveUpper(d, a, b), high_ce = hn::InterleaveUpper(d, c, e);
    column[0] = hn::ConcatLowerLower(d, low_ce, low_ab), column[1] = hn::ConcatUpperUpper(d, low_ce, low_ab);
    column[2] = hn::ConcatLowerLower(d, high_ce, high_ab), column[3] = hn::ConcatUpperUpper(d, high_ce, high_ab);
  }
  // From element i on, of `count`.
  HWY_INLINE FourColumns(const QuadReader& quads, uint32_t i, uint32_t count)
      : FourColumns(i + 4 <= count ? FourColumns(quads.get(i), quads.get(i + 1), quads.get(i + 2), quads.get(i + 3))
                                   : FourColumns(quads.get_or_first(i, count), quads.get_or_first(i + 1, count),
                                                 quads.get_or_first(i + 2, count), quads.get_or_first(i + 3, count))) {}
};

// Eight elements of each column: a vector of doubles is made of what one store has written, or waits for it.
HWY_INLINE void store_columns(const FourColumns& low, const FourColumns& high, int columns, uint32_t i,
                              float (*out)[kVertexGroup]) {
  for (int k = 0; k < columns; ++k) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
    const hn::CappedTag<float, 8> d;
    hn::Store(hn::Combine(d, high.column[k], low.column[k]), d, out[k] + i);
#else
    hn::Store(low.column[k], Quads(), out[k] + i), hn::Store(high.column[k], Quads(), out[k] + i + 4);
#endif
  }
}

// The first `columns` floats of each element, missing ones from `fallback`. Columns are filled up to a multiple of the
// longest vector. kAsks: for what lies ahead, which one of several streams in the same memory needs to.
template <bool kAsks = true>
HWY_INLINE void load_columns(const StreamRef& stream, uint32_t first, uint32_t count, int columns,
                             const float* fallback, float (*out)[kVertexGroup]) {
  const QuadReader quads(stream, first, count, fallback);
  uint32_t i = 0;
  const size_t step = 8 * stream.stride;
  for (; i < count; i += 8) {
    const unsigned char* ahead = quads.from + size_t{i} * stream.stride + kPrefetch;
    for (size_t k = 0; kAsks && k < step; k += 64) __builtin_prefetch(ahead + k);
    store_columns(FourColumns(quads, i, count), FourColumns(quads, i + 4, count), columns, i, out);
  }
  const FourColumns none(quads.missing, quads.missing, quads.missing, quads.missing);
  for (; i % kLongestVector != 0; i += 8) store_columns(none, none, columns, i, out);
}

// Vertices' own colours, held to [0, 1]: with comparisons and selects, since levels disagree in min and max about NaN
// and -0.
struct ColorReader {
  QuadReader quads;

  HWY_INLINE ColorReader(const ShadeJob& job, uint32_t first, uint32_t count)
      : quads(job.color, first, count, kDefaults) {}

  HWY_INLINE void Copy(uint32_t i, void* to) const {
    const Quads d;
    const QuadVec zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    QuadVec v = quads.get(i);
    v = hn::IfThenElseZero(hn::Gt(v, zero), v);
    hn::StoreU(hn::IfThenElse(hn::Lt(v, one), v, one), d, static_cast<float*>(to));
  }
};

#endif

HWY_INLINE void shade_colors(const ShadeJob& job, uint32_t first, uint32_t count) {
  const ColorReader colors(job, first, count);
  unsigned char* out = job.records + size_t{first} * job.record_stride + job.color_offset;
  for (uint32_t i = 0; i < count; ++i, out += job.record_stride) colors.Copy(i, out);
}
