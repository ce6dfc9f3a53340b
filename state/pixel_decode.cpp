#include <cmath>
#include <cstring>

#include "state/pixel_format.h"
#include "state/pixel_value.h"

namespace halfspace::state {
namespace {

// Where R, G, B and A come from among a pixel's numbers and the two constants behind them.
constexpr uint8_t kZero = 4, kOne = 5;
struct Gather {
  uint8_t from[4] = {kZero, kZero, kZero, kOne};
};

Gather gather_of(const ComponentOrder& order) {
  Gather gather;
  for (uint8_t i = 0; i < order.count; ++i) {
    if (order.what[i] == kLuminance) {
      gather.from[0] = gather.from[1] = gather.from[2] = i;
    } else {
      gather.from[order.what[i]] = i;
    }
  }
  return gather;
}

// How a pixel's numbers are kept: as bytes, or as floats.
struct ByteSink {
  using Value = uint8_t;
  static constexpr Value kOneValue = 255;
  template <class T>
  static Value convert(T c) {
    return to_byte(c);
  }
  static Value from_bits(uint32_t v, uint32_t max) { return Value(rescale(v, max, kByteMax)); }
};

struct FloatSink {
  using Value = float;
  static constexpr Value kOneValue = 1;
  template <class T>
  static Value convert(T c) {
    return to_component(c);
  }
  static Value from_bits(uint32_t v, uint32_t max) { return Value(v) / Value(max); }
};

// next(source, numbers) converts one pixel's numbers.
template <class Sink, class Next>
void decode_each(const Gather& gather, const std::byte* source, size_t pixel_bytes, size_t count,
                 typename Sink::Value* rgba, Next&& next) {
  typename Sink::Value numbers[6] = {0, 0, 0, 0, 0, Sink::kOneValue};
  for (size_t i = 0; i < count; ++i, source += pixel_bytes, rgba += 4) {
    next(source, numbers);
    for (int c = 0; c < 4; ++c) rgba[c] = numbers[gather.from[c]];
  }
}

template <class Sink>
void decode_components(const PixelFormat& format, const Gather& gather, bool swap_bytes,
                       const std::byte* source, size_t count, typename Sink::Value* rgba) {
  visit_type(format.type, [&]<class T>(T) {
    decode_each<Sink>(gather, source, format.pixel_bytes, count, rgba,
                      [&](const std::byte* p, auto* numbers) {
                        for (size_t c = 0; c < format.components; ++c) {
                          numbers[c] = Sink::convert(load_value<T>(p + c * sizeof(T), swap_bytes));
                        }
                      });
  });
}

template <class Sink>
void decode_packed(const PixelFormat& format, const Gather& gather, bool swap_bytes, const std::byte* source,
                   size_t count, typename Sink::Value* rgba) {
  const PackedLayout& layout = *find_packed_layout(format.type);
  visit_word(format.element_bytes, [&]<class Word>(Word) {
    decode_each<Sink>(gather, source, format.pixel_bytes, count, rgba,
                      [&](const std::byte* p, auto* numbers) {
                        const uint32_t word = load_value<Word>(p, swap_bytes);
                        for (size_t c = 0; c < layout.components; ++c) {
                          const uint32_t max = (1u << layout.bits[c]) - 1;
                          numbers[c] = Sink::from_bits(word >> layout.shift[c] & max, max);
                        }
                      });
  });
}

template <class Sink>
void decode_color(const PixelFormat& format, bool swap_bytes, const std::byte* source, size_t count,
                  typename Sink::Value* rgba) {
  const Gather gather = gather_of(component_order(format.format));
  (format.packed ? decode_packed<Sink> : decode_components<Sink>)(format, gather, swap_bytes, source, count,
                                                                  rgba);
}

// A whole number no further from 0; what 64 bits cannot hold, and NaN, becomes 0.
template <class T>
int64_t to_index(T v) {
  if constexpr (std::floating_point<T>) {
    return std::fabs(v) < T(9.2e18) ? int64_t(v) : 0;
  } else {
    return int64_t{v};
  }
}

// The commonest textures of old programs, worth their own loop.
void decode_rgb8(const std::byte* source, size_t count, uint8_t* rgba) {
  for (size_t i = 0; i < count; ++i, source += 3, rgba += 4) {
    std::memcpy(rgba, source, 3);
    rgba[3] = 255;
  }
}

}  // namespace

void decode_pixels(const PixelFormat& format, bool swap_bytes, const std::byte* source, size_t count,
                   uint8_t* rgba) {
  if (is_plain_rgba8(format, swap_bytes)) {
    std::memcpy(rgba, source, count * 4);
  } else if (format.format == GL_RGB && format.type == GL_UNSIGNED_BYTE) {
    decode_rgb8(source, count, rgba);
  } else {
    decode_color<ByteSink>(format, swap_bytes, source, count, rgba);
  }
}

void decode_pixels(const PixelFormat& format, bool swap_bytes, const std::byte* source, size_t count,
                   float* rgba) {
  decode_color<FloatSink>(format, swap_bytes, source, count, rgba);
}

void decode_indices(const PixelFormat& format, bool swap_bytes, const std::byte* source, size_t count,
                    int64_t* indices) {
  visit_type(format.type, [&]<class T>(T) {
    for (size_t i = 0; i < count; ++i)
      indices[i] = to_index(load_value<T>(source + i * sizeof(T), swap_bytes));
  });
}

void decode_depths(const PixelFormat& format, bool swap_bytes, const std::byte* source, size_t count,
                   double* depths) {
  visit_type(format.type, [&]<class T>(T) {
    for (size_t i = 0; i < count; ++i) {
      const T v = load_value<T>(source + i * sizeof(T), swap_bytes);
      if constexpr (std::floating_point<T>)
        depths[i] = double(v);
      else if constexpr (std::unsigned_integral<T>)
        depths[i] = double(v) / double(kTypeMax<T>);
      else
        depths[i] = (2 * double(v) + 1) / double(kTypeMax<T>);
    }
  });
}

}  // namespace halfspace::state
