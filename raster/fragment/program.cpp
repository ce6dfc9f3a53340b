#include "raster/fragment/program.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "raster/texture/level.h"

namespace halfspace::raster {
namespace {

constexpr double kSteepest = 1e30;

StageId depth_stage(const DepthState& depth) {
  using enum StageId;
  constexpr StageId kWriting[] = {depth_never,   depth_less,      depth_equal,         depth_less_equal,
                                  depth_greater, depth_not_equal, depth_greater_equal, depth_always};
  constexpr StageId kReadOnly[] = {depth_never,
                                   depth_less_readonly,
                                   depth_equal_readonly,
                                   depth_less_equal_readonly,
                                   depth_greater_readonly,
                                   depth_not_equal_readonly,
                                   depth_greater_equal_readonly,
                                   depth_always};
  return (depth.write ? kWriting : kReadOnly)[static_cast<size_t>(depth.func)];
}

// A depth test that lets everything through and stores nothing is no stage at all.
bool needs_depth(const DepthState& depth) {
  return depth.test && !(depth.func == CompareFunc::always && !depth.write);
}

// What a stencil test may do to the stencil values of fragments that do not pass the depth test.
bool marks_hidden(const StencilState& s) {
  const bool by_test = s.fail != StencilOp::keep && s.func != CompareFunc::always;
  return s.write_mask != 0 && (by_test || s.depth_fail != StencilOp::keep);
}
bool writes_stencil(const StencilState& s) {
  return s.test && (marks_hidden(s) || (s.write_mask != 0 && s.depth_pass != StencilOp::keep));
}
bool needs_stencil(const StencilState& s) { return s.test && (s.func != CompareFunc::always || writes_stencil(s)); }

bool needs_alpha_test(const AlphaTestState& test) { return test.enabled && test.func != CompareFunc::always; }

bool has_logic_op(const LogicOpState& s) { return s.enabled && s.op != LogicOp::copy; }

bool blends(const BlendState& blend) {
  return blend.enabled && !(blend.src == BlendFactor::one && blend.dst == BlendFactor::zero);
}

// Stages hand on doubles: the exact level of interpolation.
bool is_wide(const DrawState& state) { return state.accuracy.interpolation == Level::exact; }

// The divide by w of planes in float, in double: the exact level of the perspective axis.
bool divides_precisely(const DrawState& state, unsigned variant) {
  return state.accuracy.perspective == Level::exact && variant == 0;
}

StageId color_stage(const DrawState& state, const VertexLayout& layout, unsigned variant) {
  using enum StageId;
  if (layout.color < 0) return is_wide(state) ? color_constant_wide : color_constant;
  if (state.raster.flat_shading) return is_wide(state) ? color_flat_wide : color_flat;
  if (is_wide(state)) return color_wide;
  if (divides_precisely(state, variant)) return color_perspective_precise;
  constexpr StageId kSmooth[kVariantCount] = {color_perspective, color_affine, color_perspective_double,
                                              color_affine_double};
  return kSmooth[variant];
}

// The primary colour; that of a pixel rectangle is in its slots already.
void add_color(const DrawState& state, const VertexLayout& layout, unsigned variant, StageList& list) {
  if (!layout.given_color) list.add(color_stage(state, layout, variant));
}

StageId coord_stage(const DrawState& state, const VertexLayout& layout, unsigned variant) {
  using enum StageId;
  if (is_wide(state)) return layout.projective ? coord_projective_wide : coord_wide;
  if (layout.projective) return (variant & kDouble) != 0 ? coord_projective_double : coord_projective;
  if (divides_precisely(state, variant)) return coord_perspective_precise;
  constexpr StageId kCoord[kVariantCount] = {coord_perspective, coord_affine, coord_perspective_double,
                                             coord_affine_double};
  return kCoord[variant];
}

// Without mip levels and with one filter for both directions, lambda decides nothing.
bool needs_lambda(const TextureView& view) {
  return (view.sampler.mip != MipMode::none && view.level_count > 1) || view.sampler.mag != view.sampler.min ||
         view.sampler.mip == MipMode::nearest;
}

bool has_sizes_of_two(const TextureLevel& level) {
  const auto is_power = [](int size) { return (size & (size - 1)) == 0; };
  return is_power(level.width) && is_power(level.height);
}

// Coordinates that divide by w in float leave it to whoever comes later; whether these do.
bool leave_w(StageId& coord) {
  if (coord == StageId::coord_perspective) coord = StageId::coord_perspective_and_w;
  return coord == StageId::coord_perspective_and_w;
}

void add_level_lookup(const Accuracy& accuracy, bool projective, StageList& list) {
  using enum StageId;
  if (accuracy.lod == Level::exact) {
    list.add(projective ? lambda_projective_exact : lambda_exact);
  } else if (accuracy.lod == Level::draft) {
    list.add(lambda_of_primitive);
  } else if (leave_w(list.ids[static_cast<size_t>(list.count - 1)])) {
    list.add(lambda_at_w);
  } else {
    list.add(projective ? lambda_projective : lambda);
  }
  if (accuracy.filter == Level::exact) return list.add(sample_levels_exact);
  list.add(choose_level);
  list.add(accuracy.filter == Level::draft ? sample_levels_draft : sample_levels);
}

bool is_opaque(const TextureView& view) {
  bool opaque = true;
  for (int i = 0; i < view.level_count; ++i) opaque = opaque && view.levels[static_cast<size_t>(i)]->opaque;
  return opaque;
}

void add_lookup(const TextureView& view, const Accuracy& accuracy, bool projective, StageList& list) {
  using enum StageId;
  if (needs_lambda(view)) return add_level_lookup(accuracy, projective, list);
  if (accuracy.filter == Level::exact) return list.add(sample_exact);
  const bool repeat = view.sampler.wrap_s == Wrap::repeat && view.sampler.wrap_t == Wrap::repeat;
  if (view.sampler.mag == Filter::nearest) {
    list.add(repeat && has_sizes_of_two(*view.levels[0]) ? footprint_nearest_repeat : footprint_nearest);
    return list.add(sample_nearest);
  }
  if (accuracy.filter == Level::draft) {
    list.add(repeat && has_sizes_of_two(*view.levels[0]) ? footprint_draft_repeat : footprint_draft);
    return list.add(sample_linear_draft);
  }
  list.add(repeat ? footprint_repeat : footprint);
  list.add(is_opaque(view) ? sample_linear_opaque : sample_linear);
}

// `opaque`: alpha is 1 wherever the texture is looked up, so what multiplies by it or mixes with it need not.
StageId env_stage(EnvMode mode, BaseFormat format, bool opaque) {
  using enum StageId;
  const bool rgb = format != BaseFormat::alpha;
  const bool has_alpha = format != BaseFormat::rgb && format != BaseFormat::luminance;
  const bool alpha = has_alpha && !(opaque && rgb && (mode == EnvMode::modulate || mode == EnvMode::decal));
  auto pick = [&](StageId both, StageId rgb_only, StageId alpha_only) {
    return rgb ? (alpha ? both : rgb_only) : alpha_only;
  };
  switch (mode) {
    case EnvMode::modulate: return pick(modulate_rgba, modulate_rgb, modulate_alpha);
    case EnvMode::replace: return pick(replace_rgba, replace_rgb, replace_alpha);
    case EnvMode::decal: return alpha ? decal_rgba : decal_rgb;
    case EnvMode::blend: break;
  }
  return format == BaseFormat::intensity ? env_blend_intensity : pick(env_blend_rgba, env_blend_rgb, env_blend_alpha);
}

bool is_white(const Color& c) { return c.r == 1 && c.g == 1 && c.b == 1 && c.a == 1; }

void add_wide_texture_stages(const DrawState& state, const VertexLayout& layout, unsigned variant, StageList& list) {
  list.add(coord_stage(state, layout, variant));
  add_lookup(*state.texture.view, state.accuracy, layout.projective, list);
  add_color(state, layout, variant, list);
  list.add(StageId::env_wide);
}

// GL_MODULATE by constant white is GL_REPLACE; replacing everything needs no primary colour.
void add_texture_stages(const DrawState& state, const VertexLayout& layout, unsigned variant, StageList& list) {
  if (is_wide(state)) return add_wide_texture_stages(state, layout, variant, list);
  const TextureView& view = *state.texture.view;
  const bool white = layout.color < 0 && !layout.given_color && is_white(layout.constant_color);
  const EnvMode mode = white && state.texture.env == EnvMode::modulate ? EnvMode::replace : state.texture.env;
  const StageId env = env_stage(mode, view.base_format, is_opaque(view));
  StageId coord = coord_stage(state, layout, variant);
  StageId color = color_stage(state, layout, variant);
  if (color == StageId::color_perspective && env != StageId::replace_rgba && leave_w(coord))
    color = StageId::color_perspective_at_w;
  list.add(coord);
  add_lookup(view, state.accuracy, layout.projective, list);
  if (env != StageId::replace_rgba && !layout.given_color) list.add(color);
  list.add(env);
}

void scale_color(const Color& color, bool to_bytes, float* out) {
  out[0] = color_level(color.r, to_bytes);
  out[1] = color_level(color.g, to_bytes);
  out[2] = color_level(color.b, to_bytes);
  out[3] = color_level(color.a, to_bytes);
}

void set_texture_params(const DrawState& state, FragmentParams& params) {
  const TextureView& view = *state.texture.view;
  params.level_count = view.sampler.mip == MipMode::none ? 1 : view.level_count;
  params.sampler = view.sampler;
  for (int i = 0; i < params.level_count; ++i) {
    const TextureLevel& level = *view.levels[static_cast<size_t>(i)];
    params.levels[i] = {level.base,
                        level.stacked.get(),
                        level.pitch,
                        level.width,
                        level.height,
                        static_cast<float>(level.width),
                        static_cast<float>(level.height),
                        level.opaque};
  }
  // Spec 3.8.8: v(x, y) is 0 for a one-dimensional texture.
  params.lod_scale[0] = view.levels[0]->width;
  params.lod_scale[1] = view.sampler.one_dimensional ? 0 : view.levels[0]->height;
  // Spec 3.8.9: c = 0.5 if mag is LINEAR and min is NEAREST_MIPMAP_*, else 0.
  const bool half = view.sampler.mag == Filter::linear && view.sampler.min == Filter::nearest &&
                    view.sampler.mip != MipMode::none;
  params.magnify_below = half ? 0.5f : 0.0f;
  scale_color(state.texture.env_color, false, params.env_color);
}

FogCurve fog_curve(FogMode mode, Level level) {
  const bool draft = level == Level::draft;
  switch (mode) {
    case FogMode::exp: return draft ? FogCurve::exp_draft : FogCurve::exp;
    case FogMode::exp2: return draft ? FogCurve::exp2_draft : FogCurve::exp2;
    case FogMode::linear: break;
  }
  return FogCurve::linear;
}

void set_fog_params(const FogState& fog, const VertexLayout& layout, FragmentParams& params) {
  FogParams& out = params.fog;
  out.plane = 2 + layout.fog;
  out.curve = fog_curve(fog.mode, params.accuracy.fog);
  if (fog.mode == FogMode::linear) {
    // With start == end the fog is a wall: the largest float for its slope.
    const double span = static_cast<double>(fog.end) - static_cast<double>(fog.start);
    const double slope = span != 0 ? std::clamp(1 / span, -kSteepest, kSteepest) : kSteepest;
    out.origin = fog.end;
    out.slope = static_cast<float>(-slope);
  } else {
    out.origin = 0;
    out.slope = fog.density;
  }
  const float color[3] = {fog.color.r, fog.color.g, fog.color.b};
  for (int k = 0; k < 3; ++k) out.color[k] = color_level(color[k], params.rounds_to_bytes);
  out.level_span = 1 / (255.0 * std::max(std::fabs(static_cast<double>(out.slope)), 1e-30));
}

// A colour at the exact level: on bytes of a product by 255 nothing is lost.
template <size_t kCount>
void scale_exactly(const Color& color, double (&out)[kCount]) {
  const float c[4] = {color.r, color.g, color.b, color.a};
  for (size_t k = 0; k < kCount; ++k) out[k] = static_cast<double>(c[k]) * 255.0;
}

ExactParams make_exact_params(const DrawState& state, const VertexLayout& layout) {
  ExactParams out{};
  scale_exactly(layout.constant_color, out.constant_color);
  scale_exactly(state.texture.env_color, out.env_color);
  scale_exactly(state.fog.color, out.fog_color);
  const double start = static_cast<double>(state.fog.start), end = static_cast<double>(state.fog.end);
  const bool linear = state.fog.mode == FogMode::linear;
  out.fog_origin = linear ? end : 0;
  out.fog_slope = static_cast<double>(state.fog.density);
  if (linear) out.fog_slope = end != start ? std::clamp(1 / (start - end), -kSteepest, kSteepest) : -kSteepest;
  out.alpha_reference = std::clamp(static_cast<double>(state.alpha_test.reference), 0.0, 1.0) * 255.0;
  if (state.texture.view == nullptr) return out;
  const BaseFormat format = state.texture.view->base_format;
  out.env = state.texture.env;
  out.env_rgb = format != BaseFormat::alpha;
  out.env_alpha = format != BaseFormat::rgb && format != BaseFormat::luminance;
  out.env_mixes_alpha = out.env == EnvMode::blend && format == BaseFormat::intensity;
  return out;
}

// What the accuracy asks of set-up and of stages that look at the parameters.
void set_accuracy_params(const DrawState& state, const VertexLayout& layout, FragmentParams& params) {
  const Accuracy& accuracy = state.accuracy;
  params.accuracy = accuracy;
  if (accuracy == Accuracy()) return;
  if (accuracy.interpolation == Level::draft) params.plane_rule = PlaneRule::in_float;
  if (accuracy.interpolation == Level::exact) params.plane_rule = PlaneRule::in_double;
  params.one_lambda = accuracy.lod == Level::draft && state.texture.view != nullptr && layout.tex_coord >= 0 &&
                      needs_lambda(*state.texture.view);
  if (is_wide(state) || accuracy.fog == Level::exact) params.exact = make_exact_params(state, layout);
}

void set_params(const DrawState& state, const VertexLayout& layout, ColorFormat format, FragmentParams& params) {
  params.color_plane = 2 + layout.color;
  params.tex_plane = 2 + layout.tex_coord;
  params.rounds_to_bytes = format == ColorFormat::rgba8;
  scale_color(layout.constant_color, params.rounds_to_bytes, params.constant_color);
  params.alpha_func = state.alpha_test.func;
  // Like a colour: an alpha that equals the reference stays equal.
  params.alpha_reference = color_level(std::clamp(state.alpha_test.reference, 0.0f, 1.0f), params.rounds_to_bytes);
  params.blend_src = state.blend.src;
  params.blend_dst = state.blend.dst;
  params.logic_op = state.logic_op.op;
  params.stencil = state.stencil;
  params.depth = state.depth;
  set_accuracy_params(state, layout, params);
  if (layout.fog >= 0) set_fog_params(state.fog, layout, params);
  params.color_mask = byte_mask(state.color_mask);
  if (state.texture.view != nullptr) set_texture_params(state, params);
}

void add_depth_and_stencil(const DrawState& state, StageList& list) {
  const bool depth = needs_depth(state.depth);
  if (needs_stencil(state.stencil)) list.add(depth ? StageId::stencil_depth_test : StageId::stencil_test);
  else if (depth) list.add(depth_stage(state.depth));
}

StageId fog_stage(const DrawState& state, unsigned variant) {
  using enum StageId;
  if (is_wide(state) || state.accuracy.fog == Level::exact) return fog_wide;
  if (divides_precisely(state, variant)) return fog_perspective_precise;
  constexpr StageId kFog[kVariantCount] = {fog_perspective, fog_affine, fog_perspective_double, fog_affine_double};
  return kFog[variant];
}

// Where coordinates have divided by 1/w, fog need not.
void add_fog(const DrawState& state, unsigned variant, StageList& list) {
  StageId fog = fog_stage(state, variant);
  const auto last = list.ids.begin() + list.count;
  if (fog == StageId::fog_perspective && std::any_of(list.ids.begin(), last, leave_w))
    fog = StageId::fog_perspective_at_w;
  list.add(fog);
}

// A colour in perspective that comes before the last stage, modulated by what draft's filter has looked up,
// is less work as shares.
bool modulate_shares(StageList& list) {
  using enum StageId;
  if (list.count < 3) return false;
  StageId* const stages = list.ids.data() + list.count - 3;
  StageId &color = stages[1], &env = stages[2];
  const bool looked_up = stages[0] == sample_linear_draft || stages[0] == sample_levels_draft;
  const bool modulated = env == modulate_rgb || env == modulate_rgba;
  if (!looked_up || color != color_perspective_at_w || !modulated) return false;
  color = color_shares_at_w;
  env = env == modulate_rgb ? modulate_shares_rgb : modulate_shares_rgba;
  return true;
}

// Rounding holds colours to their range, so that a colour which comes right before it need not do so.
void add_rounding(StageList& list) {
  if (modulate_shares(list)) return list.add(StageId::round_to_even_rgba8);
  if (list.count > 0) {
    StageId& last = list.ids[static_cast<size_t>(list.count - 1)];
    if (last == StageId::color_affine) last = StageId::color_affine_open;
    if (last == StageId::color_perspective) last = StageId::color_perspective_open;
    const bool modulated = last == StageId::modulate_rgb || last == StageId::modulate_rgba;
    StageId& color = list.ids[static_cast<size_t>(std::max(list.count - 2, 0))];
    if (modulated && color == StageId::color_perspective_at_w) color = StageId::color_perspective_at_w_above;
  }
  list.add(StageId::round_rgba8);
}

StageId blend_stage(const BlendState& blend) {
  const bool over = blend.src == BlendFactor::src_alpha && blend.dst == BlendFactor::one_minus_src_alpha;
  return over ? StageId::blend_over_rgba8 : StageId::blend_rgba8;
}

bool writes_color(const DrawState& state) { return !state.color_mask.none() && state.color_targets != 0; }

}  // namespace

StageList list_stages(const DrawState& state, const VertexLayout& layout, ColorFormat format, unsigned variant) {
  StageList list;
  const bool alpha_test = needs_alpha_test(state.alpha_test);
  if (!alpha_test) add_depth_and_stencil(state, list);
  if (writes_color(state) || alpha_test) {
    if (state.texture.view != nullptr && layout.tex_coord >= 0)
      add_texture_stages(state, layout, variant, list);
    else
      add_color(state, layout, variant, list);
  }
  if (layout.fog >= 0 && (writes_color(state) || alpha_test)) add_fog(state, variant, list);
  const bool wide = is_wide(state);
  if (layout.coverage && (writes_color(state) || alpha_test))
    list.add(wide ? StageId::coverage_wide : StageId::coverage);
  if (alpha_test) {
    list.add(wide ? StageId::alpha_test_wide : StageId::alpha_test);
    add_depth_and_stencil(state, list);
  }
  list.tail = list.count;
  if (!writes_color(state)) return list;
  const bool rgba8 = format == ColorFormat::rgba8;
  // What is wide stays so up to memory; but a logical operation takes bytes.
  if (rgba8 && (!wide || has_logic_op(state.logic_op))) add_rounding(list);
  if (state.logic_op.enabled) {
    if (has_logic_op(state.logic_op)) list.add(rgba8 ? StageId::logic_op_rgba8 : StageId::logic_op_rgba32f);
  } else if (blends(state.blend)) {
    if (wide) list.add(rgba8 ? StageId::blend_rgba8_wide : StageId::blend_rgba32f_wide);
    else list.add(rgba8 ? blend_stage(state.blend) : StageId::blend_rgba32f);
  }
  // A logic op leaves whole levels in the floats.
  if (wide && !has_logic_op(state.logic_op)) list.add(rgba8 ? StageId::write_rgba8_wide : StageId::write_rgba32f_wide);
  else if (!rgba8) list.add(StageId::write_rgba32f);
  else list.add(state.color_mask.all() ? StageId::write_rgba8 : StageId::write_rgba8_masked);
  return list;
}

bool have_same_program(const DrawState& a, const DrawState& b) {
  const TextureUnitState &s = a.texture, &t = b.texture;
  if (s.view != t.view || s.env != t.env || !(s.env_color == t.env_color)) return false;
  if (a.rest_version == b.rest_version && a.rest_version != 0) return true;
  return a.raster.flat_shading == b.raster.flat_shading && a.polygon.stipple == b.polygon.stipple && a.fog == b.fog &&
         a.stencil == b.stencil && a.depth == b.depth && a.alpha_test == b.alpha_test && a.blend == b.blend &&
         a.logic_op == b.logic_op && a.color_mask == b.color_mask && a.color_targets == b.color_targets &&
         a.accuracy == b.accuracy;
}

void build_program(const DrawState& state, const VertexLayout& layout, ColorFormat format, bool fuse, CodeCache& cache,
                   PipelineProgram& program) {
  set_params(state, layout, format, program.params);
  program.writes_color = writes_color(state);
  program.plane = state.color_targets == kFrontPlane ? 1 : 0;
  program.both_planes = program.writes_color && state.color_targets == (kBackPlane | kFrontPlane);
  const bool depth = needs_depth(state.depth);
  program.depth = state.depth;
  program.depth.test = depth;
  const bool stencil = needs_stencil(state.stencil);
  const CompareFunc func = state.depth.func;
  const bool lowers = func == CompareFunc::less || func == CompareFunc::less_equal;
  CodeKey key;
  for (unsigned variant = 0; variant < kVariantCount; ++variant)
    key.lists[variant] = list_stages(state, layout, format, variant);
  program.flat_shading = state.raster.flat_shading;
  program.stippled = state.polygon.stipple;
  key.isa = current_isa();
  key.fuse = fuse;
  key.both_planes = program.both_planes;
  key.given_depth = layout.given_depth;
  key.may_pack =
      !needs_alpha_test(state.alpha_test) && !program.both_planes && !stencil && !state.polygon.stipple;
  key.tests_depth = depth;
  key.accepts_nearer = depth && lowers && !stencil && !needs_alpha_test(state.alpha_test);
  static_cast<ProgramCode&>(program) = cache.find(key);
  program.reads_depth = depth;
  program.reads_stencil = stencil;
  program.writes_depth = depth && state.depth.write;
  const bool one_plane = !layout.given_depth;  // fragments lie on it, so that a block's depth can be told beforehand
  program.accepts_nearer = key.accepts_nearer;
  program.rejects_deeper = depth && lowers && one_plane && !(stencil && marks_hidden(state.stencil));
  program.depth_may_grow = program.writes_depth && !lowers && func != CompareFunc::equal && func != CompareFunc::never;
  program.depth_pass_lowers =
      program.writes_depth && lowers && !needs_alpha_test(state.alpha_test) && !stencil && one_plane;
  const bool reaches_memory = program.writes_color || program.writes_depth;
  program.draws_nothing = !writes_stencil(state.stencil) && ((depth && func == CompareFunc::never) || !reaches_memory);
}

static_assert(static_cast<int>(StageId::count) <= kMaxStageIds);

std::string_view stage_name(int id) {
  static constexpr std::string_view kNames[] = {
#define STAGE(id, body, reads, writes) #id,
#include "raster/fragment/stages.def"
#undef STAGE
  };
  return id >= 0 && id < static_cast<int>(StageId::count) ? kNames[id] : std::string_view();
}

void BlockProgram::run_metered(BlockContext& block, int kernel, uint64_t fragments) const {
  using Clock = std::chrono::steady_clock;
  const auto at = static_cast<size_t>(kernel);
  const auto id = static_cast<size_t>(stages[at]);
  block.meter->fragments[id] += fragments;
  const Clock::time_point start = Clock::now();
  kernels[at](block);
  block.meter->nanoseconds[id] += static_cast<uint64_t>((Clock::now() - start) / std::chrono::nanoseconds(1));
}

}  // namespace halfspace::raster
