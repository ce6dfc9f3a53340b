#include "state/capability.h"

#include <array>
#include <atomic>
#include <utility>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"
#include "state/report.h"

namespace halfspace::state {
namespace {

#define LIVE(cap, field, dirty)                                    \
  {                                                                \
    cap, #cap, [](Context& c) -> bool* { return &c.field; }, dirty \
  }
#define IDLE(cap) \
  { cap, #cap, nullptr, 0 }

constexpr Capability kCapabilities[] = {
    LIVE(GL_ALPHA_TEST, color_buffer.alpha_test, kDirtyFragment),
    LIVE(GL_BLEND, color_buffer.blend, kDirtyFragment),
    LIVE(GL_CULL_FACE, polygon.cull, kDirtyRaster),
    LIVE(GL_DEPTH_TEST, depth_buffer.test, kDirtyFragment),
    LIVE(GL_DITHER, color_buffer.dither, 0),
    LIVE(GL_SCISSOR_TEST, scissor.test, kDirtyRaster),
    LIVE(GL_TEXTURE_1D, texture.enabled_1d, kDirtyTexture),
    LIVE(GL_TEXTURE_2D, texture.enabled_2d, kDirtyTexture),
    LIVE(GL_TEXTURE_GEN_S, tex_gen.coord[0].enabled, kDirtyTexCoords | kDirtyTransform),
    LIVE(GL_TEXTURE_GEN_T, tex_gen.coord[1].enabled, kDirtyTexCoords | kDirtyTransform),
    LIVE(GL_TEXTURE_GEN_R, tex_gen.coord[2].enabled, kDirtyTexCoords),
    LIVE(GL_TEXTURE_GEN_Q, tex_gen.coord[3].enabled, kDirtyTexCoords),
    LIVE(GL_COLOR_MATERIAL, lighting.color_material, kDirtyLighting),
    LIVE(GL_LIGHT0, lighting.lights[0].enabled, kDirtyLighting),
    LIVE(GL_LIGHT1, lighting.lights[1].enabled, kDirtyLighting),
    LIVE(GL_LIGHT2, lighting.lights[2].enabled, kDirtyLighting),
    LIVE(GL_LIGHT3, lighting.lights[3].enabled, kDirtyLighting),
    LIVE(GL_LIGHT4, lighting.lights[4].enabled, kDirtyLighting),
    LIVE(GL_LIGHT5, lighting.lights[5].enabled, kDirtyLighting),
    LIVE(GL_LIGHT6, lighting.lights[6].enabled, kDirtyLighting),
    LIVE(GL_LIGHT7, lighting.lights[7].enabled, kDirtyLighting),
    LIVE(GL_LIGHTING, lighting.enabled, kDirtyLighting | kDirtyTransform),
    LIVE(GL_NORMALIZE, transform.normalize, kDirtyTransform),
    LIVE(GL_COLOR_LOGIC_OP, color_buffer.color_logic_op, kDirtyFragment),
    LIVE(GL_FOG, fog.enabled, kDirtyFragment),
    LIVE(GL_INDEX_LOGIC_OP, color_buffer.index_logic_op, 0),
    LIVE(GL_STENCIL_TEST, stencil_buffer.test, kDirtyFragment),
    LIVE(GL_CLIP_PLANE0, clip_plane.enabled[0], kDirtyClipPlanes),
    LIVE(GL_CLIP_PLANE1, clip_plane.enabled[1], kDirtyClipPlanes),
    LIVE(GL_CLIP_PLANE2, clip_plane.enabled[2], kDirtyClipPlanes),
    LIVE(GL_CLIP_PLANE3, clip_plane.enabled[3], kDirtyClipPlanes),
    LIVE(GL_CLIP_PLANE4, clip_plane.enabled[4], kDirtyClipPlanes),
    LIVE(GL_CLIP_PLANE5, clip_plane.enabled[5], kDirtyClipPlanes),
    LIVE(GL_LINE_SMOOTH, line.smooth, kDirtyRaster),
    LIVE(GL_LINE_STIPPLE, line.stipple, kDirtyRaster),
    LIVE(GL_POINT_SMOOTH, point.smooth, kDirtyRaster),
    LIVE(GL_POLYGON_OFFSET_FILL, polygon.offset_fill, kDirtyRaster),
    LIVE(GL_POLYGON_OFFSET_LINE, polygon.offset_line, kDirtyRaster),
    LIVE(GL_POLYGON_OFFSET_POINT, polygon.offset_point, kDirtyRaster),
    LIVE(GL_POLYGON_SMOOTH, polygon.smooth, kDirtyRaster),
    LIVE(GL_POLYGON_STIPPLE, polygon.stipple, kDirtyRaster),
    LIVE(GL_AUTO_NORMAL, evaluator.auto_normal, 0),
    LIVE(GL_MAP1_COLOR_4, evaluator.map1[kMapColor], 0),
    LIVE(GL_MAP1_INDEX, evaluator.map1[kMapIndex], 0),
    LIVE(GL_MAP1_NORMAL, evaluator.map1[kMapNormal], 0),
    LIVE(GL_MAP1_TEXTURE_COORD_1, evaluator.map1[kMapTexCoord1], 0),
    LIVE(GL_MAP1_TEXTURE_COORD_2, evaluator.map1[kMapTexCoord2], 0),
    LIVE(GL_MAP1_TEXTURE_COORD_3, evaluator.map1[kMapTexCoord3], 0),
    LIVE(GL_MAP1_TEXTURE_COORD_4, evaluator.map1[kMapTexCoord4], 0),
    LIVE(GL_MAP1_VERTEX_3, evaluator.map1[kMapVertex3], 0),
    LIVE(GL_MAP1_VERTEX_4, evaluator.map1[kMapVertex4], 0),
    LIVE(GL_MAP2_COLOR_4, evaluator.map2[kMapColor], 0),
    LIVE(GL_MAP2_INDEX, evaluator.map2[kMapIndex], 0),
    LIVE(GL_MAP2_NORMAL, evaluator.map2[kMapNormal], 0),
    LIVE(GL_MAP2_TEXTURE_COORD_1, evaluator.map2[kMapTexCoord1], 0),
    LIVE(GL_MAP2_TEXTURE_COORD_2, evaluator.map2[kMapTexCoord2], 0),
    LIVE(GL_MAP2_TEXTURE_COORD_3, evaluator.map2[kMapTexCoord3], 0),
    LIVE(GL_MAP2_TEXTURE_COORD_4, evaluator.map2[kMapTexCoord4], 0),
    LIVE(GL_MAP2_VERTEX_3, evaluator.map2[kMapVertex3], 0),
    LIVE(GL_MAP2_VERTEX_4, evaluator.map2[kMapVertex4], 0),
};
#undef LIVE
#undef IDLE

constexpr size_t kCapabilityCount = std::size(kCapabilities);
static_assert(kCapabilityCount <= kMaxCapabilities);

const Capability* find_capability(GLenum name) {
  for (const Capability& capability : kCapabilities) {
    if (capability.name == name) return &capability;
  }
  return nullptr;
}

size_t index_of(const Capability& capability) { return size_t(&capability - kCapabilities); }

void report_idle(const Capability& capability) {
  static std::atomic<uint64_t> reported{0};
  const uint64_t bit = uint64_t{1} << index_of(capability);
  if (!(reported.fetch_or(bit) & bit)) report("glEnable(%s) has no effect yet", capability.text);
}

void set_capability(Context& context, GLenum name, bool on, const char* operation) {
  const Capability* capability = find_capability(name);
  if (!capability) {
    // Client arrays too: before they had commands of their own (GL_EXT_vertex_array) they went by glEnable, and
    // programs of that time, and others' libraries, still hold to it.
    ClientArray* array = find_client_array(context.vertex_array, name);
    if (!array) return record_error(context, GL_INVALID_ENUM, operation);
    array->enabled = on;
    return;
  }
  if (!capability->bit) {
    context.capability.idle[index_of(*capability)] = on;
    if (on) report_idle(*capability);
    return;
  }
  bool& bit = *capability->bit(context);
  if (bit == on) return;
  if (name == GL_COLOR_MATERIAL) settle_color_material(context);  // the material keeps its last colour
  bit = on;
  mark_dirty(context, capability->dirty);
}

template <size_t kIndex>
void read_capability(const Context& context, double* out) {
  *out = capability_enabled(context, kCapabilities[kIndex]);
}

template <size_t... kIndex>
constexpr std::array<GetRow, sizeof...(kIndex)> capability_rows(std::index_sequence<kIndex...>) {
  return {GetRow{kCapabilities[kIndex].name, GetKind::boolean, 1, read_capability<kIndex>}...};
}

}  // namespace

std::span<const Capability> all_capabilities() { return kCapabilities; }

bool capability_enabled(const Context& context, const Capability& capability) {
  // The accessor hands out a pointer to write through; here it is only read.
  if (capability.bit) return *capability.bit(const_cast<Context&>(context));
  return context.capability.idle[index_of(capability)];
}

std::span<const GetRow> capability_get_rows() {
  static constexpr auto kRows = capability_rows(std::make_index_sequence<kCapabilityCount>());
  return kRows;
}

namespace op {

void enable(Context& context, GLenum cap) { set_capability(context, cap, true, "enable"); }

void disable(Context& context, GLenum cap) { set_capability(context, cap, false, "disable"); }

// Client arrays can be asked for as well (spec 6.1.1).
GLboolean is_enabled(Context& context, GLenum cap) {
  if (const Capability* capability = find_capability(cap)) return capability_enabled(context, *capability);
  if (const ClientArray* array = find_client_array(context.vertex_array, cap)) return array->enabled;
  record_error(context, GL_INVALID_ENUM);
  return GL_FALSE;
}

}  // namespace op
}  // namespace halfspace::state
