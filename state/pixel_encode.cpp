#include <cstring>

#include "state/pixel_format.h"
#include "state/pixel_value.h"

namespace halfspace::state {
namespace {

// A source of components: how to pick one, and how to convert it to a type or to `bits` bits.
struct ByteSource {
  using Value = uint8_t;
  static uint32_t pick(const Value* rgba, uint8_t what) {
    if (what != kLuminance) return rgba[what];
    const uint32_t sum = uint32_t{rgba[0]} + rgba[1] + rgba[2];
    return sum < kByteMax ? sum : uint32_t{kByteMax};
  }
  template <class T>
  static T convert(uint32_t v) {
    return from_unorm<T, kByteMax>(v);
  }
  static uint32_t to_bits(uint32_t v, uint32_t max) { return uint32_t(rescale(v, kByteMax, max)); }
};

struct FloatSource {
  using Value = float;
  static float pick(const Value* rgba, uint8_t what) {
    return what != kLuminance ? rgba[what] : rgba[0] + rgba[1] + rgba[2];
  }
  template <class T>
  static T convert(float v) {
    return from_float<T>(v);
  }
  static uint32_t to_bits(float v, uint32_t max) { return uint32_t(double(clamp_unit(v)) * max + 0.5); }
};

template <class Source>
void encode_components(const PixelFormat& format, bool swap_bytes, const typename Source::Value* rgba,
                       size_t count, std::byte* target) {
  const ComponentOrder order = component_order(format.format);
  visit_type(format.type, [&]<class T>(T) {
    for (size_t i = 0; i < count; ++i, rgba += 4) {
      for (size_t c = 0; c < order.count; ++c, target += sizeof(T)) {
        store_value(target, Source::template convert<T>(Source::pick(rgba, order.what[c])), swap_bytes);
      }
    }
  });
}

template <class Source>
void encode_packed(const PixelFormat& format, bool swap_bytes, const typename Source::Value* rgba,
                   size_t count, std::byte* target) {
  const ComponentOrder order = component_order(format.format);
  const PackedLayout& layout = *find_packed_layout(format.type);
  visit_word(format.element_bytes, [&]<class Word>(Word) {
    for (size_t i = 0; i < count; ++i, rgba += 4, target += sizeof(Word)) {
      uint32_t word = 0;
      for (size_t c = 0; c < layout.components; ++c) {
        const uint32_t max = (1u << layout.bits[c]) - 1;
        word |= Source::to_bits(Source::pick(rgba, order.what[c]), max) << layout.shift[c];
      }
      store_value(target, Word(word), swap_bytes);
    }
  });
}

}  // namespace

void encode_pixels(const PixelFormat& format, bool swap_bytes, const uint8_t* rgba, size_t count,
                   std::byte* target) {
  if (is_plain_rgba8(format, swap_bytes)) {
    std::memcpy(target, rgba, count * 4);
  } else if (format.packed) {
    encode_packed<ByteSource>(format, swap_bytes, rgba, count, target);
  } else {
    encode_components<ByteSource>(format, swap_bytes, rgba, count, target);
  }
}

void encode_pixels(const PixelFormat& format, bool swap_bytes, const float* rgba, size_t count,
                   std::byte* target) {
  if (format.packed) {
    encode_packed<FloatSource>(format, swap_bytes, rgba, count, target);
  } else {
    encode_components<FloatSource>(format, swap_bytes, rgba, count, target);
  }
}

void encode_depth(const PixelFormat& format, bool swap_bytes, const uint32_t* depth, size_t count,
                  std::byte* target) {
  visit_type(format.type, [&]<class T>(T) {
    for (size_t i = 0; i < count; ++i, target += sizeof(T)) {
      store_value(target, from_unorm<T, kDepthMax>(depth[i]), swap_bytes);
    }
  });
}

void encode_depth(const PixelFormat& format, bool swap_bytes, const double* depth, size_t count,
                  std::byte* target) {
  visit_type(format.type, [&]<class T>(T) {
    for (size_t i = 0; i < count; ++i, target += sizeof(T)) {
      store_value(target, from_unit<T>(depth[i]), swap_bytes);
    }
  });
}

void encode_indices(const PixelFormat& format, bool swap_bytes, const int64_t* indices, size_t count,
                    std::byte* target) {
  visit_type(format.type, [&]<class T>(T) {
    // Signed types have their sign bit left out.
    for (size_t i = 0; i < count; ++i, target += sizeof(T)) {
      if constexpr (std::floating_point<T>)
        store_value(target, T(indices[i]), swap_bytes);
      else
        store_value(target, T(indices[i] & int64_t{std::numeric_limits<T>::max()}), swap_bytes);
    }
  });
}

}  // namespace halfspace::state
