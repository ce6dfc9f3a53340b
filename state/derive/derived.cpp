#include "state/derive/derived.h"

#include <algorithm>
#include <bit>
#include <new>
#include <utility>

#include "state/context.h"

namespace halfspace::state {
namespace {

using raster::BlendFactor;
using raster::CompareFunc;
using raster::DrawState;
using raster::Primitive;

static_assert(int(Primitive::points) == GL_POINTS && int(Primitive::line_loop) == GL_LINE_LOOP &&
              int(Primitive::triangle_fan) == GL_TRIANGLE_FAN && int(Primitive::polygon) == GL_POLYGON);
static_assert(int(CompareFunc::less) == GL_LESS - GL_NEVER &&
              int(CompareFunc::greater_equal) == GL_GEQUAL - GL_NEVER &&
              int(CompareFunc::always) == GL_ALWAYS - GL_NEVER);

static_assert(int(raster::LogicOp::copy) == GL_COPY - GL_CLEAR &&
              int(raster::LogicOp::xor_) == GL_XOR - GL_CLEAR && int(raster::LogicOp::set) == GL_SET - GL_CLEAR);

CompareFunc compare_func_of(GLenum func) { return CompareFunc(func - GL_NEVER); }

// A visual without alpha has Ad = 1 wherever it is asked for (spec 4.1.7).
BlendFactor without_destination_alpha(BlendFactor factor) {
  switch (factor) {
    case BlendFactor::dst_alpha:
      return BlendFactor::one;
    case BlendFactor::one_minus_dst_alpha:
    case BlendFactor::src_alpha_saturate:
      return BlendFactor::zero;
    default:
      return factor;
  }
}

BlendFactor blend_factor_of(GLenum factor, bool has_alpha) {
  const auto find = [factor] {
    switch (factor) {
      case GL_ZERO:
        return BlendFactor::zero;
      case GL_SRC_COLOR:
        return BlendFactor::src_color;
      case GL_ONE_MINUS_SRC_COLOR:
        return BlendFactor::one_minus_src_color;
      case GL_DST_COLOR:
        return BlendFactor::dst_color;
      case GL_ONE_MINUS_DST_COLOR:
        return BlendFactor::one_minus_dst_color;
      case GL_SRC_ALPHA:
        return BlendFactor::src_alpha;
      case GL_ONE_MINUS_SRC_ALPHA:
        return BlendFactor::one_minus_src_alpha;
      case GL_DST_ALPHA:
        return BlendFactor::dst_alpha;
      case GL_ONE_MINUS_DST_ALPHA:
        return BlendFactor::one_minus_dst_alpha;
      case GL_SRC_ALPHA_SATURATE:
        return BlendFactor::src_alpha_saturate;
      default:
        return BlendFactor::one;
    }
  };
  return has_alpha ? find() : without_destination_alpha(find());
}

std::array<double, 16> widen(const Matrix& m) {
  std::array<double, 16> wide;
  std::copy(m.begin(), m.end(), wide.begin());
  return wide;
}

bool needs_normals(const Context& context) {
  return context.lighting.enabled || generates_from_normals(context.tex_gen);
}

void derive_transform(const Context& context, DrawState& out) {
  const TransformState& t = context.transform;
  out.eye_from_object = widen(t.modelview.top());
  out.clip_from_object = multiply(widen(t.projection.top()).data(), out.eye_from_object.data());
  out.normalize = t.normalize;
  if (needs_normals(context)) out.normal_from_object = normal_matrix(t.modelview.top());
}

void derive_viewport(const Context& context, DrawState& out) {
  const ViewportState& v = context.viewport;
  out.viewport = {v.x, v.y, v.width, v.height, v.depth_near, v.depth_far};
}

void derive_raster(const Context& context, DrawState& out) {
  const PolygonState& p = context.polygon;
  out.raster.cull_front = p.cull && p.cull_face != GL_BACK;
  out.raster.cull_back = p.cull && p.cull_face != GL_FRONT;
  out.raster.front_is_ccw = p.front_face == GL_CCW;
  out.raster.flat_shading = context.lighting.shade_model == GL_FLAT;
  out.raster.scissor_test = context.scissor.test;
  out.raster.scissor = context.scissor.rect();
}

void derive_color_material(const LightingState& lighting, raster::LightingState& out) {
  const GLenum mode = lighting.color_material_mode;
  const bool both = mode == GL_AMBIENT_AND_DIFFUSE;
  const raster::LightingState::ColorMaterial tracked{both || mode == GL_AMBIENT, both || mode == GL_DIFFUSE,
                                                     mode == GL_SPECULAR, mode == GL_EMISSION};
  out.color_material_front = out.color_material_back = {};
  if (!lighting.color_material) return;
  if (lighting.color_material_face != GL_BACK) out.color_material_front = tracked;
  if (lighting.color_material_face != GL_FRONT) out.color_material_back = tracked;
}

void derive_lighting(const Context& context, DrawState& out) {
  const LightingState& lighting = context.lighting;
  out.lighting.enabled = lighting.enabled;
  if (!lighting.enabled) return;
  out.lighting.local_viewer = lighting.local_viewer;
  out.lighting.two_sided = lighting.two_side;
  out.lighting.model_ambient = lighting.model_ambient;
  out.lighting.lights = lighting.lights;
  out.lighting.material = material_pair(lighting);
  derive_color_material(lighting, out.lighting);
}

raster::PolygonMode polygon_mode_of(GLenum mode) {
  static_assert(int(raster::PolygonMode::line) == GL_LINE - GL_POINT &&
                int(raster::PolygonMode::fill) == GL_FILL - GL_POINT);
  return raster::PolygonMode(mode - GL_POINT);
}

void derive_shapes(const Context& context, DrawState& out) {
  const PolygonState& p = context.polygon;
  out.point = {context.point.size, context.point.smooth, {}};
  const LineState& line = context.line;
  out.line = {line.width, line.smooth, line.stipple, line.pattern, line.repeat, {}};
  // HALFSPACE_VIEW=wireframe: what would be filled shows its edges.
  const auto mode = [&](GLenum m) {
    return context.wireframe && m == GL_FILL ? raster::PolygonMode::line : polygon_mode_of(m);
  };
  out.polygon = {mode(p.mode[0]),
                 mode(p.mode[1]),
                 p.smooth,
                 p.stipple,
                 context.polygon_stipple.pattern,
                 p.offset_fill,
                 p.offset_line,
                 p.offset_point,
                 p.offset_factor,
                 p.offset_units,
                 {}};
}

void derive_accuracy(const Context& context, DrawState& out) {
  const HintState& hint = context.hint;
  out.accuracy = hinted_accuracy(hint);
  const auto coverage = [&](GLenum mode) -> std::optional<raster::Level> {
    if (mode == GL_DONT_CARE) return std::nullopt;
    return hinted_level(mode, out.accuracy.coverage);
  };
  out.point.coverage = coverage(hint.point_smooth);
  out.line.coverage = coverage(hint.line_smooth);
  out.polygon.coverage = coverage(hint.polygon_smooth);
}

void derive_clip_planes(const Context& context, DrawState& out) {
  out.clip_planes.enabled = 0;
  for (int i = 0; i < raster::kMaxClipPlanes; ++i) {
    if (context.clip_plane.enabled[i]) out.clip_planes.enabled |= uint8_t(1 << i);
  }
  out.clip_planes.planes = context.clip_plane.planes;
}

void derive_fragment(const Context& context, DrawState& out) {
  const DepthBufferState& d = context.depth_buffer;
  const ColorBufferState& c = context.color_buffer;
  const bool has_alpha = context.visual.alpha_bits > 0;
  // Without a depth buffer the test always passes (spec 4.1.6).
  out.depth = {d.test && context.visual.depth_bits > 0, compare_func_of(d.func), d.write};
  out.alpha_test = {c.alpha_test, compare_func_of(c.alpha_func), c.alpha_reference};
  out.blend = {c.blend, blend_factor_of(c.blend_src, has_alpha), blend_factor_of(c.blend_dst, has_alpha)};
  out.stencil = derive_stencil(context);
  out.fog = derive_fog(context);
  out.logic_op = {c.color_logic_op, raster::LogicOp(c.logic_op - GL_CLEAR)};
  out.color_mask = c.mask;
  out.color_targets = draw_planes(context);
}

void derive_texture(Context& context, DrawState& out) {
  raster::TextureUnitState& unit = out.texture;
  unit.view = current_texture_view(context);
  unit.env = texture_env_mode(context);
  unit.env_color = texture_env_color(context);
}

void derive_tex_coords(const Context& context, DrawState& out) {
  raster::TextureUnitState& unit = out.texture;
  const Matrix& matrix = context.transform.texture.top();
  unit.matrix = widen(matrix);
  unit.matrix_is_identity = matrix == kIdentity;
  out.tex_gen = derive_tex_gen(context.tex_gen);
}

}  // namespace

void VersionedState::retire() {
  texture.view.reset();
  versions[std::countr_zero(uint32_t{kDirtyTexture})] = 0;
}

void mark_dirty(Context& context, uint32_t bits) { context.derived.dirty |= bits; }

raster::Primitive primitive_of(GLenum mode) { return Primitive(mode); }

// Edge flags count for separate triangles, quads and polygons only (spec 2.6.2).
bool has_edge_flags(GLenum mode) { return mode == GL_TRIANGLES || mode == GL_QUADS || mode == GL_POLYGON; }

VertexNeeds vertex_needs(const Context& context, GLenum mode) {
  const PolygonState& polygon = context.polygon;
  const bool textured =
      context.texture.enabled_1d || context.texture.enabled_2d || feedback_needs_tex_coord(context);
  const bool outlined = polygon.mode[0] != GL_FILL || polygon.mode[1] != GL_FILL;
  return {textured, needs_normals(context), outlined && has_edge_flags(mode)};
}

const std::shared_ptr<const DrawState>& derive(Context& context) {
  DerivedState& derived = context.derived;
  // Textures also change behind the context's back, by another one that shares them.
  const uint64_t revision = texture_revision(context);
  if (revision != derived.texture_revision) derived.dirty |= kDirtyTexture;
  if (derived.dirty == 0) return derived.state;
  for (int group = 0; group < kDirtyGroups; ++group)
    if (derived.dirty >> group & 1) derived.versions[size_t(group)] = ++derived.last_version;
  if ((derived.dirty & ~uint32_t{kDirtyTransform | kDirtyTexture}) != 0) derived.rest_version = derived.last_version;
  // One that nothing refers to but this: no draw that was made of it needs its matrices any more.
  const bool in_place = derived.state.use_count() == 1;
  const std::shared_ptr<VersionedState> other = in_place ? nullptr : derived.states.take();
  VersionedState* const next = in_place ? derived.latest : other.get();
  const auto bring_up_to_date = [&](uint32_t bit, auto&&... derive_groups) {
    const auto group = size_t(std::countr_zero(bit));
    if (next->versions[group] == derived.versions[group]) return;
    (derive_groups(context, *next), ...);
    next->versions[group] = derived.versions[group];
  };
  bring_up_to_date(kDirtyTransform, derive_transform);
  bring_up_to_date(kDirtyViewport, derive_viewport);
  bring_up_to_date(kDirtyRaster, derive_raster, derive_shapes, derive_accuracy);
  bring_up_to_date(kDirtyClipPlanes, derive_clip_planes);
  bring_up_to_date(kDirtyLighting, derive_lighting);
  bring_up_to_date(kDirtyFragment, derive_fragment);
  bring_up_to_date(kDirtyTexture, derive_texture);
  bring_up_to_date(kDirtyTexCoords, derive_tex_coords);
  next->rest_version = derived.rest_version;
  derived.texture_revision = revision;
  derived.dirty = 0;
  if (!in_place) derived.state = other, derived.latest = next;
  return derived.state;
}

void submit(Context& context, raster::DrawPacket& packet) try {
  if (!packet.state) packet.state = derive(context);
  flush_vertices(context);  // what waits was drawn before
  if (!context.render_mode.renders()) [[unlikely]]
    return capture_draw(context, packet);
  if (!context.drawable) return;
  context.device.begin_pass(&context.drawable->framebuffer(packet.state->color_targets));
  context.device.draw(packet);
} catch (const std::bad_alloc&) {
  record_error(context, GL_OUT_OF_MEMORY, "a draw");
}

}  // namespace halfspace::state
