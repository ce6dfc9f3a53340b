// limits: what one core of this machine can do at best of what drawing is made of. Each is the least work
// that gives the result, with the data where a renderer by tiles has it, and nothing around it: no coverage,
// no state, no bins.
#include <benchmark/benchmark.h>
#include <hwy/highway.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr size_t kTilePixels = 64 * 64;
constexpr size_t kVertices = 4096;
constexpr int kTextureSize = 256;

const hn::ScalableTag<float> kF;
const hn::ScalableTag<int32_t> kI;
const hn::ScalableTag<uint32_t> kU;
[[maybe_unused]] const hn::ScalableTag<uint8_t> kU8;
using VF = hn::Vec<decltype(kF)>;
using VI = hn::Vec<decltype(kI)>;
using VU = hn::Vec<decltype(kU)>;
const size_t kLanes = hn::Lanes(kF);

constexpr std::align_val_t kAlignment{64};
struct Free {
  void operator()(void* memory) const { operator delete[](memory, kAlignment); }
};
template <typename T>
using Array = std::unique_ptr<T[], Free>;

template <typename T>
Array<T> make_array(size_t count) {
  Array<T> array(static_cast<T*>(operator new[](count * sizeof(T), kAlignment)));
  // A pattern, so that tests pass and fail and indices are spread.
  for (size_t i = 0; i < count; ++i) array[i] = static_cast<T>(i * 2654435761u % 1000);
  return array;
}

struct Tile {
  Array<uint32_t> color = make_array<uint32_t>(kTilePixels);
  Array<uint32_t> depth = make_array<uint32_t>(kTilePixels);
};

void count_items(benchmark::State& state, size_t items) {
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations()) * static_cast<int64_t>(items));
}

// ---- memory; the range is in KiB
// ------------------------------------------------------------------------------------

void bytes_set(benchmark::State& state) {
  const auto size = static_cast<size_t>(state.range(0)) * 1024;
  std::vector<char> bytes(size);
  for (auto _ : state) {
    std::memset(bytes.data(), static_cast<int>(state.iterations() & 0xff), size);
    benchmark::ClobberMemory();
  }
  count_items(state, size);
}

void bytes_copied(benchmark::State& state) {
  const auto size = static_cast<size_t>(state.range(0)) * 1024 / 2;  // from and to together
  std::vector<char> from(size, 'a'), to(size);
  for (auto _ : state) {
    std::memcpy(to.data(), from.data(), size);
    benchmark::ClobberMemory();
  }
  count_items(state, size);
}

// ---- pixels of a tile
// -----------------------------------------------------------------------------------------------

void pixel_stored(benchmark::State& state) {
  Tile tile;
  uint32_t color = 0;
  for (auto _ : state) {
    const VU value = hn::Set(kU, ++color);
    for (size_t i = 0; i < kTilePixels; i += kLanes) hn::Store(value, kU, tile.color.get() + i);
    benchmark::ClobberMemory();
  }
  count_items(state, kTilePixels);
}

VU packed(VI red, VI green, VI blue) {
  const VI rg = hn::Or(red, hn::ShiftLeft<8>(green));
  return hn::BitCast(
      kU, hn::Or(hn::Or(rg, hn::ShiftLeft<16>(blue)), hn::Set(kI, static_cast<int32_t>(0xff000000u))));
}

// Red, green and blue from planes; a block of 8x8 pixels is in one piece.
template <class Body>
void over_smooth_pixels(const Body& body) {
  const VF lane = hn::ConvertTo(kF, hn::Iota(kI, 0));
  for (size_t i = 0; i < kTilePixels; i += kLanes) {
    const VF x = hn::Add(lane, hn::Set(kF, static_cast<float>(i)));
    const VF step = hn::Set(kF, 0.01F);
    body(i, packed(hn::ConvertTo(kI, hn::MulAdd(x, step, hn::Set(kF, 10.0F))),
                   hn::ConvertTo(kI, hn::MulAdd(x, step, hn::Set(kF, 20.0F))),
                   hn::ConvertTo(kI, hn::MulAdd(x, step, hn::Set(kF, 30.0F)))));
  }
}

void pixel_interpolated(benchmark::State& state) {
  Tile tile;
  for (auto _ : state) {
    over_smooth_pixels([&](size_t i, VU color) { hn::Store(color, kU, tile.color.get() + i); });
    benchmark::ClobberMemory();
  }
  count_items(state, kTilePixels);
}

template <bool kWrites>
void depth_work(benchmark::State& state) {
  Tile tile;
  float near = 1e9F;
  for (auto _ : state) {
    near -= 64;
    const VF slope = hn::Set(kF, kWrites ? 0.001F : 1e3F), base = hn::Set(kF, kWrites ? near : 1e6F);
    const VF lane = hn::ConvertTo(kF, hn::Iota(kI, 0));
    const VU color = hn::Set(kU, 7);
    auto passed = hn::Eq(color, hn::Zero(kU));
    for (size_t i = 0; i < kTilePixels; i += kLanes) {
      const VF x = hn::Add(lane, hn::Set(kF, static_cast<float>(i)));
      const VU depth = hn::BitCast(kU, hn::ConvertTo(kI, hn::MulAdd(x, slope, base)));
      const VU before = hn::Load(kU, tile.depth.get() + i);
      const auto pass = hn::Lt(depth, before);
      if constexpr (kWrites) {
        hn::BlendedStore(depth, pass, kU, tile.depth.get() + i);
        hn::BlendedStore(color, pass, kU, tile.color.get() + i);
      } else {
        passed = hn::Or(passed, pass);
      }
    }
    benchmark::DoNotOptimize(hn::CountTrue(kU, passed));
    benchmark::ClobberMemory();
  }
  count_items(state, kTilePixels);
}

void depth_tested(benchmark::State& state) { depth_work<false>(state); }
void depth_tested_and_stored(benchmark::State& state) { depth_work<true>(state); }

// A comparison for each 64 pixels: what a coarse depth buffer needs to reject.
void depth_block_tested(benchmark::State& state) {
  constexpr size_t kBlocks = kTilePixels / 64;
  const auto farthest = make_array<uint32_t>(kBlocks);
  uint32_t depth = 1000;
  for (auto _ : state) {
    uint32_t visible = 0;
    benchmark::DoNotOptimize(depth);
    for (size_t i = 0; i < kBlocks; ++i)
      if (depth + i < farthest[i]) ++visible;
    benchmark::DoNotOptimize(visible);
  }
  count_items(state, kBlocks);
}

// color * a + there * (255 - a), over 255, in 16 bits.
void pixel_blended(benchmark::State& state) {
  Tile tile;
  const hn::Repartition<uint16_t, decltype(kU8)> wide;
  const hn::Half<decltype(kU8)> half;
  const auto keep = hn::Set(wide, 155), source = hn::Set(wide, 100 * 90 + 128);
  auto* bytes = reinterpret_cast<uint8_t*>(tile.color.get());
  for (auto _ : state) {
    for (size_t i = 0; i < kTilePixels * 4; i += hn::Lanes(half)) {
      const auto sum = hn::Add(hn::Mul(hn::PromoteTo(wide, hn::Load(half, bytes + i)), keep), source);
      hn::Store(hn::DemoteTo(half, hn::BitCast(hn::RebindToSigned<decltype(wide)>(),
                                               hn::ShiftRight<8>(hn::Add(sum, hn::ShiftRight<8>(sum))))),
                half, bytes + i);
    }
    benchmark::ClobberMemory();
  }
  count_items(state, kTilePixels);
}

void pixel_scattered(benchmark::State& state) {
  constexpr size_t kPixels = 1024 * 1024;
  const auto pixels = make_array<uint32_t>(kPixels);
  uint32_t place = 1;
  for (auto _ : state) {
    for (size_t i = 0; i < kTilePixels; ++i) {
      place = place * 1664525u + 1013904223u;
      pixels[place >> 12] = place;
    }
    benchmark::ClobberMemory();
  }
  count_items(state, kTilePixels);
}

// ---- texels: a rotated grid over a 256x256 texture
// ------------------------------------------------------------------

struct Texture {
  Array<uint32_t> texels = make_array<uint32_t>(static_cast<size_t>(kTextureSize * (kTextureSize + 2)));
};

VI texel_index(size_t i) {
  const VF lane = hn::ConvertTo(kF, hn::Iota(kI, 0));
  const VF x = hn::Add(lane, hn::Set(kF, static_cast<float>(i & 63)));
  const VF y = hn::Set(kF, static_cast<float>(i >> 6));
  const VI wrap = hn::Set(kI, kTextureSize - 1);
  const VI s = hn::And(hn::ConvertTo(kI, hn::MulAdd(x, hn::Set(kF, 0.8F), y)), wrap);
  const VI t = hn::And(hn::ConvertTo(kI, hn::MulAdd(y, hn::Set(kF, 0.8F), x)), wrap);
  return hn::Or(hn::ShiftLeft<8>(t), s);
}

// One load and one store a pixel.
void texel_nearest_by_loads(benchmark::State& state) {
  const Texture texture;
  Tile tile;
  for (auto _ : state) {
    for (size_t i = 0; i < kTilePixels; i += kLanes) {
      HWY_ALIGN int32_t at[hn::MaxLanes(kI)];
      hn::Store(texel_index(i), kI, at);
      for (size_t lane = 0; lane < kLanes; ++lane)
        tile.color[i + lane] = texture.texels[static_cast<size_t>(at[lane])];
    }
    benchmark::ClobberMemory();
  }
  count_items(state, kTilePixels);
}

void texel_nearest_by_gather(benchmark::State& state) {
  const Texture texture;
  Tile tile;
  for (auto _ : state) {
    for (size_t i = 0; i < kTilePixels; i += kLanes)
      hn::Store(hn::GatherIndex(kU, texture.texels.get(), texel_index(i)), kU, tile.color.get() + i);
    benchmark::ClobberMemory();
  }
  count_items(state, kTilePixels);
}

// a + (b - a) * weight for four channels a pixel: of even and odd place in 16-bit lanes, weights of 8 bits.
// As cheap as a filter gets.
VU mix(VU a, VU b, VU weight) {
  const hn::Repartition<uint16_t, decltype(kU)> wide;
  const VU mask = hn::Set(kU, 0x00ff00ffu), rest = hn::Sub(hn::Set(kU, 0x01000100u), weight);
  const auto times = [&](VU value, VU by) {
    return hn::BitCast(kU, hn::Mul(hn::BitCast(wide, value), hn::BitCast(wide, by)));
  };
  const VU even = hn::Add(times(hn::And(a, mask), rest), times(hn::And(b, mask), weight));
  const VU odd = hn::Add(times(hn::And(hn::ShiftRight<8>(a), mask), rest),
                         times(hn::And(hn::ShiftRight<8>(b), mask), weight));
  return hn::Or(hn::And(hn::ShiftRight<8>(even), mask), hn::AndNot(mask, odd));
}

// A texel and its right neighbour in one load of 64 bits, for each index.
template <class D>
hn::Vec<D> load_pairs(D d, const uint32_t* texels, const int32_t* at) {
  if constexpr (hn::MaxLanes(d) == 1) {
    uint64_t pair;
    std::memcpy(&pair, texels + *at, sizeof pair);
    return hn::Set(d, pair);
  } else {
    const hn::Half<D> half;
    return hn::Combine(d, load_pairs(half, texels, at + hn::MaxLanes(half)), load_pairs(half, texels, at));
  }
}

struct Pairs {
  VU low, high;  // of the first and of the second half of the pixels
};

Pairs row_by_loads(const uint32_t* texels, VI index) {
  const hn::ScalableTag<uint64_t> d;
  HWY_ALIGN int32_t at[hn::MaxLanes(kI)];
  hn::Store(index, kI, at);
  return {hn::BitCast(kU, load_pairs(d, texels, at)),
          hn::BitCast(kU, load_pairs(d, texels, at + hn::MaxLanes(d)))};
}

Pairs row_by_gather(const uint32_t* texels, VI index) {
  const VU left = hn::GatherIndex(kU, texels, index), right = hn::GatherIndex(kU, texels + 1, index);
  return {hn::InterleaveLower(kU, left, right), hn::InterleaveUpper(kU, left, right)};
}

template <Pairs (*row)(const uint32_t* texels, VI index)>
void bilinear(benchmark::State& state) {
  const Texture texture;
  Tile tile;
  const VU weight = hn::Set(kU, 0x00500050u);
  for (auto _ : state) {
    for (size_t i = 0; i < kTilePixels; i += kLanes) {
      const VI index = texel_index(i);
      const Pairs upper = row(texture.texels.get(), index),
                  lower = row(texture.texels.get() + kTextureSize, index);
      const VU low = mix(upper.low, lower.low, weight), high = mix(upper.high, lower.high, weight);
      hn::Store(mix(hn::ConcatEven(kU, high, low), hn::ConcatOdd(kU, high, low), weight), kU,
                tile.color.get() + i);
    }
    benchmark::ClobberMemory();
  }
  count_items(state, kTilePixels);
}

void texel_bilinear_by_loads(benchmark::State& state) { bilinear<row_by_loads>(state); }
void texel_bilinear_by_gather(benchmark::State& state) { bilinear<row_by_gather>(state); }

// ---- vertices and triangles
// -----------------------------------------------------------------------------------------

// Through a matrix, over w, to the window.
void vertex_transformed(benchmark::State& state) {
  const auto x = make_array<float>(kVertices), y = make_array<float>(kVertices),
             z = make_array<float>(kVertices);
  const auto out = make_array<float>(4 * kVertices);
  const auto row = [](VF a, VF b, VF c, float offset) {
    const VF m = hn::Set(kF, 0.3F + offset);
    return hn::MulAdd(a, m, hn::MulAdd(b, hn::Set(kF, 0.1F), hn::MulAdd(c, m, hn::Set(kF, 1.0F))));
  };
  for (auto _ : state) {
    for (size_t i = 0; i < kVertices; i += kLanes) {
      const VF a = hn::Load(kF, x.get() + i), b = hn::Load(kF, y.get() + i), c = hn::Load(kF, z.get() + i);
      const VF over_w = hn::Div(hn::Set(kF, 1.0F), row(a, b, c, 0.4F));
      for (size_t k = 0; k < 3; ++k)
        hn::Store(hn::Mul(row(a, b, c, 0.1F * static_cast<float>(k)), over_w), kF,
                  out.get() + k * kVertices + i);
      hn::Store(over_w, kF, out.get() + 3 * kVertices + i);
    }
    benchmark::ClobberMemory();
  }
  count_items(state, kVertices);
}

// A directional light: the normal through a matrix, made of length one, and its cosine into three channels.
void vertex_lit(benchmark::State& state) {
  const auto x = make_array<float>(kVertices), y = make_array<float>(kVertices),
             z = make_array<float>(kVertices);
  const auto out = make_array<float>(3 * kVertices);
  const VF m = hn::Set(kF, 0.3F), zero = hn::Zero(kF);
  const auto row = [&](VF a, VF b, VF c) { return hn::MulAdd(a, m, hn::MulAdd(b, m, hn::Mul(c, m))); };
  for (auto _ : state) {
    for (size_t i = 0; i < kVertices; i += kLanes) {
      const VF a = hn::Load(kF, x.get() + i), b = hn::Load(kF, y.get() + i), c = hn::Load(kF, z.get() + i);
      const VF p = row(a, b, c), q = row(b, c, a), r = row(c, a, b);
      const VF length = hn::Sqrt(hn::MulAdd(p, p, hn::MulAdd(q, q, hn::Mul(r, r))));
      const VF cosine = hn::Max(zero, hn::Div(row(p, q, r), length));
      for (size_t k = 0; k < 3; ++k) hn::Store(hn::MulAdd(cosine, m, m), kF, out.get() + k * kVertices + i);
    }
    benchmark::ClobberMemory();
  }
  count_items(state, kVertices);
}

// Corners fetched by index, area, bounding box: what decides whether a triangle is drawn, and where.
void triangle_looked_at(benchmark::State& state) {
  const auto x = make_array<float>(kVertices), y = make_array<float>(kVertices);
  std::vector<int32_t> indices;
  for (size_t i = 0; i < 3 * kVertices; ++i)
    indices.push_back(static_cast<int32_t>((i / 3 + i % 3 * 5) % kVertices));
  for (auto _ : state) {
    size_t drawn = 0;
    for (size_t i = 0; i < kVertices; i += kLanes) {
      const auto fetch = [&](const float* from, size_t corner) {
        return hn::GatherIndex(kF, from, hn::LoadU(kI, indices.data() + corner * kVertices + i));
      };
      const VF x0 = fetch(x.get(), 0), x1 = fetch(x.get(), 1), x2 = fetch(x.get(), 2);
      const VF y0 = fetch(y.get(), 0), y1 = fetch(y.get(), 1), y2 = fetch(y.get(), 2);
      const VF area =
          hn::Sub(hn::Mul(hn::Sub(x1, x0), hn::Sub(y2, y0)), hn::Mul(hn::Sub(x2, x0), hn::Sub(y1, y0)));
      const VF wide = hn::Sub(hn::Max(x0, hn::Max(x1, x2)), hn::Min(x0, hn::Min(x1, x2)));
      const VF high = hn::Sub(hn::Max(y0, hn::Max(y1, y2)), hn::Min(y0, hn::Min(y1, y2)));
      drawn += hn::CountTrue(
          kF, hn::And(hn::Gt(area, hn::Zero(kF)), hn::Gt(hn::Mul(wide, high), hn::Set(kF, 1.0F))));
    }
    benchmark::DoNotOptimize(drawn);
  }
  count_items(state, kVertices);
}

// ---- commands
// -------------------------------------------------------------------------------------------------------

struct Current {
  float value[4];
};
__attribute__((noinline)) void set_current(Current* current, const float* values) {
  std::memcpy(current->value, values, 3 * sizeof(float));
}

// Through a pointer, as a program calls a shared library, keeping three floats.
void command_called(benchmark::State& state) {
  void (*volatile command)(Current*, const float*) = set_current;
  Current current{};
  const float values[3] = {1, 2, 3};
  for (auto _ : state) {
    for (int i = 0; i < 1000; ++i) command(&current, values);
    benchmark::DoNotOptimize(current);
  }
  count_items(state, 1000);
}

// Half of the first two levels of the usual caches, a share of the third, and more than any.
BENCHMARK(bytes_set)->Arg(16)->Arg(512)->Arg(8192)->Arg(262144);
BENCHMARK(bytes_copied)->Arg(16)->Arg(512)->Arg(8192)->Arg(262144);
BENCHMARK(pixel_stored);
BENCHMARK(pixel_interpolated);
BENCHMARK(pixel_blended);
BENCHMARK(pixel_scattered);
BENCHMARK(depth_tested);
BENCHMARK(depth_tested_and_stored);
BENCHMARK(depth_block_tested);
BENCHMARK(texel_nearest_by_loads);
BENCHMARK(texel_nearest_by_gather);
BENCHMARK(texel_bilinear_by_loads);
BENCHMARK(texel_bilinear_by_gather);
BENCHMARK(vertex_transformed);
BENCHMARK(vertex_lit);
BENCHMARK(triangle_looked_at);
BENCHMARK(command_called);

}  // namespace

BENCHMARK_MAIN();
