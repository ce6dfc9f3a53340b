#include "tests/oracle/painter.h"

#include <algorithm>

#include "tests/oracle/fog.h"
#include "tests/oracle/fragment.h"

namespace halfspace::oracle {
namespace {

using raster::StencilOp;

constexpr Real kAlphaDoubt = 0.02L / 255;

Rgba wide_color(const raster::Color& c) { return {real(c.r), real(c.g), real(c.b), real(c.a)}; }

uint32_t step_of(Real depth) { return static_cast<uint32_t>(depth + 0.5L); }

uint8_t changed(StencilOp op, uint8_t old, uint8_t reference) {
  switch (op) {
    case StencilOp::keep:
      return old;
    case StencilOp::zero:
      return 0;
    case StencilOp::replace:
      return reference;
    case StencilOp::increment:
      return old == 255 ? old : static_cast<uint8_t>(old + 1);
    case StencilOp::decrement:
      return old == 0 ? old : static_cast<uint8_t>(old - 1);
    case StencilOp::invert:
      break;
  }
  return static_cast<uint8_t>(~old);
}

}  // namespace

raster::Rect Painter::window() const {
  const raster::RasterState& r = state_.raster;
  return r.scissor_test ? intersect(target_.bounds(), r.scissor) : target_.bounds();
}

raster::Rect Painter::bounds() const {
  const raster::Viewport& v = state_.viewport;
  return intersect(window(), {v.x, v.y, v.x + v.width, v.y + v.height});
}

// Ownership and scissor have been looked after. The colour is worked out early only where the alpha test asks
// for it.
void Painter::paint(int px, int py, const Surface& surface, Real coverage, const Given& given) {
  Pixel pixel{target_.at(px, py), 0, doubtful_};
  if (state_.depth.test) pixel.depth = given.depth ? real(*given.depth) : surface.depth(px, py);
  Rgba color;
  if (state_.alpha_test.enabled) {
    color = shade(px, py, surface, coverage, given, &pixel.doubtful);
    if (!alpha_test(color[3], &pixel.doubtful)) {
      target_.owner[pixel.at].doubtful |= pixel.doubtful;
      return;
    }
  }
  const bool passes = stencil_and_depth_test(pixel);
  if (passes && !state_.alpha_test.enabled) color = shade(px, py, surface, coverage, given, &pixel.doubtful);
  PixelOwner& owner = target_.owner[pixel.at];
  owner.doubtful |= pixel.doubtful;
  if (!passes || state_.color_mask.none() || state_.color_targets == 0) return;
  write(color, pixel.at);
  owner.primitive = primitive_, owner.draw = draw_;
}

Rgba Painter::shade(int px, int py, const Surface& surface, Real coverage, const Given& given,
                    bool* doubtful) const {
  Rgba color;
  for (size_t k = 0; k < 4; ++k) {
    color[k] =
        given.color ? real(given.color[k]) : surface.value(static_cast<ValuePlace>(kRed + k), px, py).value;
    color[k] = held(color[k], 0.0L, 1.0L);
  }
  if (texture_) color = textured(color, surface, px, py, doubtful);
  if (state_.fog.enabled) {
    const Real f = fog_factor(state_.fog, std::max(surface.value(kFogDistance, px, py).value, 0.0L));
    const Rgba fog = wide_color(state_.fog.color);
    for (size_t k = 0; k < 3; ++k) color[k] = f * color[k] + (1 - f) * fog[k];
  }
  color[3] *= coverage;
  return color;
}

Rgba Painter::textured(const Rgba& color, const Surface& surface, int px, int py, bool* doubtful) const {
  const Affine<Real> s = surface.coord(kCoordS, px, py), t = surface.coord(kCoordT, px, py);
  const Lookup lookup = sample(*texture_, s, t);
  *doubtful |= lookup.doubtful;
  return environment(state_.texture.env, texture_->base_format, color, lookup.color,
                     wide_color(state_.texture.env_color));
}

// Spec 4.1.4.
bool Painter::alpha_test(Real alpha, bool* doubtful) const {
  const Real reference = held(real(state_.alpha_test.reference), 0.0L, 1.0L);
  const bool passes = compare(state_.alpha_test.func, alpha, reference);
  for (const Real error : {-kAlphaDoubt, kAlphaDoubt})
    *doubtful |= alpha != reference && compare(state_.alpha_test.func, alpha + error, reference) != passes;
  return passes;
}

// Spec 4.1.5 and 4.1.6.
bool Painter::stencil_and_depth_test(Pixel& pixel) {
  const raster::StencilState& s = state_.stencil;
  if (!s.test) return depth_test(pixel);
  const int mask = s.compare_mask;
  if (!compare(s.func, real(s.reference & mask), real(target_.stencil[pixel.at] & mask))) {
    change_stencil(pixel.at, s.fail);
    return false;
  }
  const bool seen = depth_test(pixel);
  change_stencil(pixel.at, seen ? s.depth_pass : s.depth_fail);
  return seen;
}

void Painter::change_stencil(size_t at, StencilOp op) {
  const raster::StencilState& s = state_.stencil;
  uint8_t& stored = target_.stencil[at];
  const uint8_t made = changed(op, stored, s.reference);
  stored = static_cast<uint8_t>((made & s.write_mask) | (stored & ~s.write_mask));
}

bool Painter::depth_test(Pixel& pixel) {
  const raster::DepthState& d = state_.depth;
  if (!d.test) return true;
  DepthPixel& old = target_.depth[pixel.at];
  DepthPixel made;
  made.exact = static_cast<double>(pixel.depth);
  made.stored = step_of(pixel.depth);
  made.low = step_of(std::max(pixel.depth - kDepthDoubt, 0.0L));
  made.high = step_of(std::min(pixel.depth + kDepthDoubt, kDepthSteps));
  const bool passes = compare(d.func, real(made.stored), real(old.stored));
  for (const uint32_t z : {made.low, made.high})
    for (const uint32_t other : {old.low, old.high})
      pixel.doubtful |= compare(d.func, real(z), real(other)) != passes;
  if (passes && d.write) old = made;
  return passes;
}

void Painter::write(const Rgba& color, size_t at) {
  for (const raster::ColorPlane plane : {raster::kBackPlane, raster::kFrontPlane}) {
    std::vector<ColorPixel>& pixels = target_.color[static_cast<size_t>(place_of_plane(plane))];
    if ((state_.color_targets & plane) == 0 || pixels.empty()) continue;
    if (target_.format == raster::ColorFormat::rgba8)
      write_bytes(color, pixels[at]);
    else
      write_floats(color, pixels[at]);
  }
}

// The bytes a colour may become where a correct renderer's may be a little off.
struct Painter::Bytes {
  std::array<uint8_t, 4> nominal, low, high;
  Bytes(const Rgba& color, Real doubt) {
    for (size_t k = 0; k < 4; ++k) {
      nominal[k] = byte_of(color[k] * 255);
      low[k] = byte_of(color[k] * 255 - doubt), high[k] = byte_of(color[k] * 255 + doubt);
    }
  }
};

// Spec 2.14.9 makes bytes of the colour, 4.1.8 blends those with what is stored, or 4.1.10 combines them, and
// the result is rounded once.
void Painter::write_bytes(const Rgba& color, ColorPixel& pixel) const {
  const ColorPixel old = pixel;
  const Bytes s(color, level_doubt_);
  const bool combines = state_.logic_op.enabled && state_.logic_op.op != raster::LogicOp::copy;
  const bool blends = state_.blend.enabled && !state_.logic_op.enabled;
  const bool on[4] = {state_.color_mask.r, state_.color_mask.g, state_.color_mask.b, state_.color_mask.a};
  for (size_t k = 0; k < 4; ++k) {
    if (!on[k]) continue;
    if (combines) {
      pixel.byte[k] = combine_bits(state_.logic_op.op, s.nominal[k], old.byte[k]);
      pixel.level[k] = pixel.byte[k];
      const bool sure = s.low[k] == s.high[k] && old.low[k] == old.high[k];
      pixel.low[k] = sure ? pixel.byte[k] : 0, pixel.high[k] = sure ? pixel.byte[k] : 255;
    } else if (blends) {
      blend_byte(s, old, k, pixel);
    } else {
      pixel.level[k] = static_cast<float>(color[k] * 255);
      pixel.byte[k] = s.nominal[k], pixel.low[k] = s.low[k], pixel.high[k] = s.high[k];
    }
  }
}

// Linear in each of the numbers that go in: what may come out is found with each of them at either of its
// ends.
void Painter::blend_byte(const Bytes& s, const ColorPixel& old, size_t k, ColorPixel& pixel) const {
  const Real level = blended_level(state_.blend, s.nominal, old.byte, k);
  pixel.level[k] = static_cast<float>(level);
  pixel.byte[k] = pixel.low[k] = pixel.high[k] = byte_of(level);
  if (s.low == s.high && old.low == old.high) return;
  for (unsigned ends = 0; ends < 16; ++ends) {
    std::array<uint8_t, 4> source = s.nominal, stored = old.byte;
    source[k] = ends & 1 ? s.high[k] : s.low[k];
    source[3] = ends & 2 ? s.high[3] : s.low[3];
    stored[k] = ends & 4 ? old.high[k] : old.low[k];
    stored[3] = ends & 8 ? old.high[3] : old.low[3];
    const uint8_t byte = byte_of(blended_level(state_.blend, source, stored, k));
    pixel.low[k] = std::min(pixel.low[k], byte), pixel.high[k] = std::max(pixel.high[k], byte);
  }
}

void Painter::write_floats(const Rgba& color, ColorPixel& pixel) const {
  const bool on[4] = {state_.color_mask.r, state_.color_mask.g, state_.color_mask.b, state_.color_mask.a};
  Rgba stored;
  for (size_t k = 0; k < 4; ++k) stored[k] = real(pixel.value[k]);
  const bool combines = state_.logic_op.enabled && state_.logic_op.op != raster::LogicOp::copy;
  for (size_t k = 0; k < 4; ++k) {
    if (!on[k]) continue;
    Real made = color[k];
    if (combines)
      made = combine_wide(state_.logic_op.op, color[k], stored[k]);
    else if (state_.blend.enabled && !state_.logic_op.enabled)
      made = blended(state_.blend, color, stored, k);
    pixel.value[k] = static_cast<float>(made);
    pixel.level[k] = static_cast<float>(made * 255);
    pixel.byte[k] = pixel.low[k] = pixel.high[k] = byte_of(made * 255);
  }
}

}  // namespace halfspace::oracle
