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

// next(source, numbers) converts one pixel's numbers to bytes.
template <class Next>
void decode_each(const Gather& gather, const std::byte* source, size_t pixel_bytes, size_t count,
                 uint8_t* rgba, Next&& next) {
  uint8_t numbers[6] = {0, 0, 0, 0, 0, 255};
  for (size_t i = 0; i < count; ++i, source += pixel_bytes, rgba += 4) {
    next(source, numbers);
    for (int c = 0; c < 4; ++c) rgba[c] = numbers[gather.from[c]];
  }
}

void decode_components(const PixelFormat& format, const Gather& gather, bool swap_bytes,
                       const std::byte* source, size_t count, uint8_t* rgba) {
  visit_type(format.type, [&]<class T>(T) {
    decode_each(gather, source, format.pixel_bytes, count, rgba, [&](const std::byte* p, uint8_t* numbers) {
      for (size_t c = 0; c < format.components; ++c) {
        numbers[c] = to_byte(load_value<T>(p + c * sizeof(T), swap_bytes));
      }
    });
  });
}

void decode_packed(const PixelFormat& format, const Gather& gather, bool swap_bytes, const std::byte* source,
                   size_t count, uint8_t* rgba) {
  const PackedLayout& layout = *find_packed_layout(format.type);
  visit_word(format.element_bytes, [&]<class Word>(Word) {
    decode_each(gather, source, format.pixel_bytes, count, rgba, [&](const std::byte* p, uint8_t* numbers) {
      const uint32_t word = load_value<Word>(p, swap_bytes);
      for (size_t c = 0; c < layout.components; ++c) {
        const uint32_t max = (1u << layout.bits[c]) - 1;
        numbers[c] = uint8_t(rescale(word >> layout.shift[c] & max, max, kByteMax));
      }
    });
  });
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
  } else if (is_index_format(format.format)) {
    std::memset(rgba, 0, count * 4);
  } else {
    const Gather gather = gather_of(component_order(format.format));
    (format.packed ? decode_packed : decode_components)(format, gather, swap_bytes, source, count, rgba);
  }
}

}  // namespace halfspace::state
