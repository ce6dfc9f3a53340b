#include "raster/waiting_draws.h"

#include <array>
#include <cstring>
#include <vector>

#include "raster/batch.h"
#include "raster/draw_area.h"
#include "raster/primitive/assembly.h"
#include "raster/vertex/vertex_stage.h"

namespace halfspace::raster {
namespace {

// Draws of more than these are better shaded where their vertices are: to copy them would take as long as to
// read them.
constexpr uint32_t kSmallVertices = 16, kSmallIndices = 48;

bool is_small(const DrawPacket& packet) {
  return packet.batch.count <= kSmallVertices && packet.index_count <= kSmallIndices;
}

bool draws_faces(const DrawPacket& packet) {
  return packet.primitive != Primitive::points && packet.primitive != Primitive::lines &&
         packet.primitive != Primitive::line_loop && packet.primitive != Primitive::line_strip;
}

// Whether the vertex stage looks at more of a state than draws of one `rest_version` share, but for
// clip_from_object.
bool looks_at_matrices(const DrawState& state) {
  return state.lighting.enabled || state.fog.enabled || state.tex_gen.any();
}

enum Stream : uint8_t { kPosition, kColor, kTexCoord, kNormal, kStreams };

// What is kept of a draw, at the start of its memory. These follow, each from a multiple of eight bytes on:
// the matrix, the streams, the indices, the material of each vertex, the materials.
struct KeptDraw {
  const DrawProgram* program;
  const DrawState* state;
  uint32_t count, index_count, primitives, materials;
  Primitive primitive;
  bool joins;  // draws with its program all have this state
  bool has_matrix, has_indices;
  struct {
    uint8_t size = 0;  // 0: there is none
    bool bytes = false, varies = false;
  } streams[kStreams];

  size_t element_bytes(Stream s) const {
    return size_t{streams[s].size} * (streams[s].bytes ? 1 : sizeof(float));
  }
  uint32_t elements(Stream s) const { return streams[s].varies ? count : 1; }
};

size_t room(size_t bytes) { return (bytes + 7) & ~size_t{7}; }

// Elements of a stream one behind the other. `bytes` known when it is compiled: then no element costs a call.
template <size_t bytes>
void copy_elements(const AttributeStream& stream, uint32_t count, std::byte* to) {
  const auto* from = static_cast<const std::byte*>(stream.data);
  for (uint32_t i = 0; i < count; ++i, from += stream.stride, to += bytes) std::memcpy(to, from, bytes);
}

void copy_elements(const AttributeStream& stream, size_t bytes, uint32_t count, std::byte* to) {
  switch (bytes) {
    case 4:
      return copy_elements<4>(stream, count, to);
    case 8:
      return copy_elements<8>(stream, count, to);
    case 12:
      return copy_elements<12>(stream, count, to);
    default:
      return copy_elements<16>(stream, count, to);
  }
}

// Of the packet's streams those that the vertex stage will read.
std::array<AttributeStream, kStreams> streams_read(const DrawPacket& packet, const VertexLayout& layout) {
  const VertexBatch& batch = packet.batch;
  std::array<AttributeStream, kStreams> read;
  read[kPosition] = batch.position;
  if (layout.color >= 0) read[kColor] = batch.color;
  if (layout.tex_coord >= 0) read[kTexCoord] = batch.tex_coord;
  if (looks_at_matrices(*packet.state)) read[kNormal] = batch.normal;
  return read;
}

// Where everything lies that was kept of a draw.
struct KeptStreams {
  const double* clip_from_object;
  VertexBatch batch;
  const uint32_t* indices = nullptr;
  std::span<const MaterialPair> materials;

  explicit KeptStreams(const KeptDraw& draw) : clip_from_object(draw.state->clip_from_object.data()) {
    const auto* at = reinterpret_cast<const std::byte*>(&draw) + room(sizeof draw);
    const auto next = [&at](size_t size) {
      const std::byte* found = at;
      at += room(size);
      return found;
    };
    if (draw.has_matrix)
      clip_from_object = reinterpret_cast<const double*>(next(sizeof draw.state->clip_from_object));
    batch.count = draw.count;
    AttributeStream* const streams[kStreams] = {&batch.position, &batch.color, &batch.tex_coord,
                                                &batch.normal};
    for (uint8_t s = 0; s < kStreams; ++s) {
      const auto& stream = draw.streams[s];
      if (stream.size == 0) continue;
      const size_t bytes = draw.element_bytes(Stream(s));
      *streams[s] = {next(draw.elements(Stream(s)) * bytes), stream.varies ? bytes : 0, stream.size,
                     stream.bytes};
    }
    if (draw.has_indices)
      indices = reinterpret_cast<const uint32_t*>(next(draw.index_count * sizeof(uint32_t)));
    if (draw.materials == 0) return;
    batch.material_index = reinterpret_cast<const uint32_t*>(next(draw.count * sizeof(uint32_t)));
    materials = {reinterpret_cast<const MaterialPair*>(at), draw.materials};
  }
};

// While it lives, vertices that several draws share are those from `first_vertex` on alone, with room for
// their outcodes. What was made of them meanwhile is told afterwards where they stand among all.
class OneOfJoined {
 public:
  OneOfJoined(ShadedVertices& vertices, uint32_t first_vertex, Segment& segment,
              std::vector<uint16_t>& outcodes)
      : vertices_(vertices),
        all_(vertices.records),
        first_vertex_(first_vertex),
        segment_(segment),
        first_primitive_(segment.primitives.size()),
        first_source_(segment.plane_sources.size()),
        outcodes_(outcodes) {
    vertices_.records += first_vertex * vertices_.layout.stride();
    vertices_.outcodes.swap(outcodes_);
  }
  ~OneOfJoined() {
    vertices_.outcodes.swap(outcodes_);
    vertices_.clip = {};
    vertices_.records = all_;
    if (first_vertex_ != 0) renumber();
  }
  OneOfJoined(const OneOfJoined&) = delete;
  OneOfJoined& operator=(const OneOfJoined&) = delete;

 private:
  void renumber() {
    for (size_t i = first_primitive_; i < segment_.primitives.size(); ++i) {
      PrimitiveRef& ref = segment_.primitives[i];
      if (ref.cut) continue;
      for (uint32_t& v : ref.v) v += first_vertex_;
    }
    for (size_t i = first_source_; i < segment_.plane_sources.size(); ++i)
      segment_.plane_sources[i].provoking += first_vertex_;
  }

  ShadedVertices& vertices_;
  std::byte* const all_;
  const uint32_t first_vertex_;
  Segment& segment_;
  const size_t first_primitive_, first_source_;
  std::vector<uint16_t>& outcodes_;
};

}  // namespace

bool WaitingDraws::may_wait(const DrawPacket& packet, const ShapePlan& shape, const DrawProgram& program,
                            bool gathered) {
  const bool small = is_small(packet);
  if (!small && !(gathered && packet.gathered)) return false;
  if (!draws_faces(packet) || shape.general || packet.batch.edge_flag != nullptr) return false;
  const DrawState& state = *packet.state;
  if (state.clip_planes.enabled != 0 || state.accuracy.transform == Level::exact) return false;
  // Were each of many to keep a state of its own, these would not fit the cache.
  return !small || !looks_at_matrices(state) || packet.state == program.state;
}

void WaitingDraws::add(const DrawPacket& packet, const DrawProgram& program, uint32_t primitives) {
  const std::array<AttributeStream, kStreams> streams = streams_read(packet, program.layout);
  KeptDraw draw;
  draw.program = &program;
  draw.count = packet.batch.count;
  draw.index_count = packet.index_count;
  draw.primitives = primitives;
  draw.primitive = packet.primitive;
  draw.has_indices = packet.indices != nullptr;
  const bool has_materials = packet.batch.material_index != nullptr && looks_at_matrices(*packet.state);
  draw.materials = has_materials ? uint32_t(packet.materials.size()) : 0;
  const DrawState* own = packet.state.get();
  const bool keeps_state = own != program.state.get() && looks_at_matrices(*own);
  draw.state = keeps_state ? own : program.state_after_vertices(packet.state).get();
  draw.joins = draw.state == program.state.get();
  draw.has_matrix = draw.state != own;
  if (!draw.has_matrix && own != program.state.get()) states_.push_back(packet.state);

  size_t bytes = room(sizeof draw) + (draw.has_matrix ? sizeof own->clip_from_object : 0);
  for (uint8_t s = 0; s < kStreams; ++s) {
    if (streams[s].data == nullptr) continue;
    draw.streams[s] = {streams[s].size, streams[s].bytes, streams[s].stride != 0};
    bytes += room(draw.elements(Stream(s)) * draw.element_bytes(Stream(s)));
  }
  const size_t index_bytes = draw.has_indices ? draw.index_count * sizeof(uint32_t) : 0;
  bytes += room(index_bytes);
  if (has_materials) bytes += room(draw.count * sizeof(uint32_t)) + packet.materials.size_bytes();

  std::byte* at = kept_.allocate(bytes);
  draws_.push_back(at);
  const auto keep = [&at](const void* from, size_t size) {
    std::memcpy(at, from, size);
    at += room(size);
  };
  keep(&draw, sizeof draw);
  if (draw.has_matrix) keep(own->clip_from_object.data(), sizeof own->clip_from_object);
  for (uint8_t s = 0; s < kStreams; ++s) {
    if (streams[s].data == nullptr) continue;
    const uint32_t elements = draw.elements(Stream(s));
    copy_elements(streams[s], draw.element_bytes(Stream(s)), elements, at);
    at += room(elements * draw.element_bytes(Stream(s)));
  }
  if (draw.has_indices) keep(packet.indices, index_bytes);
  if (has_materials) {
    keep(packet.batch.material_index, draw.count * sizeof(uint32_t));
    keep(packet.materials.data(), packet.materials.size_bytes());
  }
  primitives_ += primitives;
}

// How many vertices each program's draws have together. To look at all of them first also brings them here.
void WaitingDraws::count_vertices() {
  joined_.assign(joined_.size(), {});
  for (size_t i = taken_up_; i < draws_.size(); ++i) {
    const KeptDraw& draw = *static_cast<const KeptDraw*>(draws_[i]);
    if (!draw.joins) continue;
    if (joined_.size() <= draw.program->number) joined_.resize(draw.program->number + 1);
    joined_[draw.program->number].vertices += draw.count;
  }
}

WaitingDraws::Joined& WaitingDraws::joined_for(const void* kept, const Framebuffer::Impl& target,
                                               Arena& arena) {
  const KeptDraw& draw = *static_cast<const KeptDraw*>(kept);
  if (!draw.joins) single_ = {nullptr, draw.count, 0};
  Joined& joined = draw.joins ? joined_[draw.program->number] : single_;
  if (joined.record != nullptr) return joined;
  DrawRecord& record = records_.emplace_back();
  // Held by the program or by `states_`.
  record.state = std::shared_ptr<const DrawState>(std::shared_ptr<const DrawState>(), draw.state);
  record.bounds = draw_bounds(*draw.state, target);
  record.window = draw_window(*draw.state, target);
  record.program = &draw.program->program;
  record.shape = plan_shapes(*draw.state, draw.primitive);
  record.vertices.layout = draw.program->layout;
  record.vertices.layout.low = -1;  // the program may have come with a draw at the exact level
  record.vertices.count = joined.vertices;
  record.vertices.records = arena.allocate(joined.vertices * record.vertices.layout.stride());
  joined.record = &record;
  return joined;
}

void WaitingDraws::take_up(const void* kept, const Framebuffer::Impl& target, Segment& segment,
                           Arena& arena) {
  const KeptDraw& draw = *static_cast<const KeptDraw*>(kept);
  const KeptStreams streams(draw);
  Joined& joined = joined_for(kept, target, arena);
  if (outcodes_.size() < draw.count) outcodes_.resize(draw.count);
  const OneOfJoined one(joined.record->vertices, joined.taken_up, segment, outcodes_);
  joined.taken_up += draw.count;
  joined.record->vertices.clip = {streams.batch.position, streams.clip_from_object};
  shade_vertices(*draw.state, streams.clip_from_object, streams.batch, streams.materials, 0, draw.count,
                 joined.record->vertices);
  assemble(*joined.record, draw.primitive, streams.indices, draw.index_count, 0, draw.primitives, segment);
}

void WaitingDraws::take_up(const Framebuffer::Impl& target, Segment& segment, Arena& arena) {
  if (taken_up_ == 0) records_.clear();
  primitives_ = 0;
  count_vertices();
  while (taken_up_ < draws_.size())
    take_up(draws_[taken_up_++], target, segment, arena);  // one that fails is not tried again
}

void WaitingDraws::clear() {
  draws_.clear();
  taken_up_ = 0;
  states_.clear();
  kept_.reset();
  primitives_ = 0;
}

}  // namespace halfspace::raster
