// From GL's state to the raster room's: what a draw needs, rebuilt only where something changed.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "raster/api/draw_packet.h"
#include "raster/api/draw_state.h"
#include "state/derive/reused.h"
#include "state/gl_types.h"

namespace halfspace::state {

struct Context;

// What a setter says it changed.
enum DirtyBits : uint32_t {
  kDirtyTransform = 1,  // modelview, projection
  kDirtyViewport = 2,   // viewport, depth range
  kDirtyRaster = 4,     // points, lines, polygons, shade model, scissor, hints
  kDirtyFragment = 8,   // alpha test, depth, blend, colour mask
  kDirtyTexture = 16,   // texture enables, bindings, objects, environment
  kDirtyLighting = 32,  // lights, materials, light model, colour material
  kDirtyClipPlanes = 64,
  kDirtyTexCoords = 128,  // texture matrix, generated coordinates
  kDirtyAll = 255,
};
inline constexpr int kDirtyGroups = 8;

// A draw's state, and which version of each group of DirtyBits it holds. One that is used again is brought up to date
// only where it differs: from draw to draw that is little of three kilobytes.
struct VersionedState : raster::DrawState {
  std::array<uint64_t, kDirtyGroups> versions{};  // 0: of none
  // Nobody can say when it is used again: it must not keep a texture until then.
  void retire();
};

struct DerivedState {
  uint32_t dirty = kDirtyAll;
  uint64_t texture_revision = 0;  // of the texture unit in `state`
  std::array<uint64_t, kDirtyGroups> versions{};  // of each group, as the context has it
  uint64_t last_version = 0;
  uint64_t rest_version = 0;  // of all groups but transform and texture
  Reused<VersionedState> states;
  std::shared_ptr<const raster::DrawState> state;
  VersionedState* latest = nullptr;  // `state`, unless that is null
};

// `bits`: DirtyBits.
void mark_dirty(Context& context, uint32_t bits);

// The draw state of the context as it is now. A draw keeps a reference; the next change makes a new one.
const std::shared_ptr<const raster::DrawState>& derive(Context& context);

// Which attributes beside position and colour vertices of `mode` need under the state as it is.
struct VertexNeeds {
  bool tex_coord, normal, edge_flag;
};
VertexNeeds vertex_needs(const Context& context, GLenum mode);

// `mode`: GL_POINTS .. GL_POLYGON.
raster::Primitive primitive_of(GLenum mode);

// Draws on what drawing goes to. A null `packet.state` means the context's own. Out of memory is
// recorded as GL_OUT_OF_MEMORY.
void submit(Context& context, raster::DrawPacket& packet);

}  // namespace halfspace::state
