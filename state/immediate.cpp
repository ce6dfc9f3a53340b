#include "state/immediate.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <utility>

#include "state/context.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace {

constexpr uint32_t kFirstBatchVertices = 1020;
static_assert(kFirstBatchVertices % 12 == 0 && kMaxBatchVertices % 12 == 0);

// How many vertices the buffer has room for, whatever their format.
size_t buffer_capacity(const ImmediateState& im) { return im.buffer.size() / kMaxVertexFloats; }

// Points the cursor behind `count` vertices at the start of the buffer.
void set_cursor(ImmediateState& im, uint32_t count) {
  const size_t capacity = std::min<size_t>(buffer_capacity(im), im.longest);
  im.cursor = im.buffer.data() + size_t(count) * im.format.floats;
  im.limit = im.buffer.data() + capacity * im.format.floats;
  im.most_given = uint32_t(capacity);
  if (im.shared.given() == capacity) im.limit = im.cursor;
}

// How many vertices the primitives have that are gathered.
uint32_t given_count(const ImmediateState& im) {
  return im.shared.active() ? im.shared.given() : im.vertex_count();
}

// Of points, lines and strips few vertices come again, and edge flags and materials are kept vertex by
// vertex.
bool may_share(const ImmediateState& im) {
  return (im.mode == GL_TRIANGLES || im.mode == GL_QUADS) && !im.format.rare;
}

// Room for what is gathered aside of `capacity` vertices. May throw std::bad_alloc.
void size_side_arrays(ImmediateState& im, size_t capacity) {
  if (im.format.edge_flag && im.edge_flags.size() < capacity) im.edge_flags.resize(capacity);
  if (!im.materials.empty() && im.material_index.size() < capacity) im.material_index.resize(capacity);
  // Also where nothing is looked for now: the batch may be parted, and its next part be shared.
  if (may_share(im) || im.shared.active()) im.shared.reserve(capacity);
}

float* vertex_at(ImmediateState& im, uint32_t i) { return im.buffer.data() + size_t(i) * im.format.floats; }

void draw_gathered(Context& context, GLenum mode, uint32_t count) {
  if (count == 0) return;
  ImmediateState& im = context.immediate;
  const float* v = im.buffer.data();
  const size_t stride = im.format.floats * sizeof(float);
  raster::DrawPacket packet;
  packet.state = im.state;
  packet.primitive = primitive_of(mode);
  packet.continues = im.strip_goes_on;
  packet.gathered = true;
  packet.index_count = packet.batch.count = count;
  if (im.shared.active()) {
    packet.indices = im.shared.indices();
    packet.batch.count = im.shared.distinct();
  }
  packet.batch.position = {v, stride, 4};
  packet.batch.color = {v + 4, im.color_varies ? stride : 0, 4};
  if (im.format.tex_coord) packet.batch.tex_coord = {v + im.format.tex_coord, stride, 4};
  if (im.format.normal) packet.batch.normal = {v + im.format.normal, stride, 3};
  if (im.format.edge_flag) packet.batch.edge_flag = im.edge_flags.data();
  if (!im.materials.empty()) {
    packet.batch.material_index = im.material_index.data();
    packet.materials = im.materials;
  }
  im.shared.note_drawn(count);
  submit(context, packet);
}

// What of a full batch the next one begins with, so that the drawing goes on as if it had not been parted:
// the centre of a fan, and the last vertices. A full batch is whole points, lines, triangles, quads, and
// pairs of a strip (its next triangle faces as the first one did), for its length is a multiple of 12.
struct Kept {
  uint32_t first, last;  // how many
};

Kept kept_vertices(GLenum mode) {
  switch (mode) {
    case GL_LINE_STRIP:
    case GL_LINE_LOOP:
      return {0, 1};
    case GL_TRIANGLE_STRIP:
    case GL_QUAD_STRIP:
      return {0, 2};
    case GL_TRIANGLE_FAN:
    case GL_POLYGON:
      return {1, 1};
    default:
      return {0, 0};
  }
}

void remember_loop_start(ImmediateState& im) {
  if (im.mode != GL_LINE_LOOP || im.loop_parted) return;
  std::copy_n(im.buffer.data(), im.format.floats, im.loop_first);
  if (!im.materials.empty()) im.loop_first_material = im.material_index[0];
  im.loop_parted = true;
}

// The mode the gathered vertices are drawn with: of a parted loop, a strip.
GLenum batch_mode(const ImmediateState& im) { return im.loop_parted ? GL_LINE_STRIP : im.mode; }

template <class T>
void keep_in(std::vector<T>& values, const Kept& kept, uint32_t count) {
  std::copy_n(values.begin() + (count - kept.last), kept.last, values.begin() + kept.first);
}

// Forgets the materials that only vertices already drawn had, so that a long primitive does not pile them up.
void trim_materials(ImmediateState& im, uint32_t kept) {
  std::array<raster::MaterialPair, 4> pairs;
  if (im.materials.size() <= pairs.size()) return;
  for (uint32_t i = 0; i < kept; ++i) {
    pairs[i] = im.materials[im.material_index[i]];
    im.material_index[i] = i;
  }
  if (im.loop_parted) pairs[2] = im.materials[std::exchange(im.loop_first_material, 2u)];
  pairs[3] = im.materials.back();  // the one that counts now
  im.materials.assign(pairs.begin(), pairs.end());
}

// Draws a full batch, and moves what the next one needs to the buffer's start.
void part_batch(Context& context) {
  ImmediateState& im = context.immediate;
  const uint32_t count = given_count(im);
  const Kept kept = kept_vertices(im.mode);
  remember_loop_start(im);
  draw_gathered(context, batch_mode(im), count);
  std::memmove(vertex_at(im, kept.first), vertex_at(im, count - kept.last),
               kept.last * im.format.floats * sizeof(float));
  if (!im.materials.empty()) {
    keep_in(im.material_index, kept, count);
    trim_materials(im, kept.first + kept.last);
  }
  im.strip_goes_on = im.mode == GL_LINE_STRIP || im.mode == GL_LINE_LOOP;
  im.shared.start(may_share(im));
  set_cursor(im, kept.first + kept.last);
}

bool grow(ImmediateState& im) try {
  const size_t capacity = buffer_capacity(im);
  if (capacity >= im.longest) return false;
  const uint32_t count = im.vertex_count();
  const size_t wanted = capacity ? std::min<size_t>(capacity * 4, im.longest) : kFirstBatchVertices;
  size_side_arrays(im, wanted);  // first: where there is no memory for it, vertices stay where they are
  im.buffer.resize(wanted * kMaxVertexFloats);
  set_cursor(im, count);
  return true;
} catch (const std::bad_alloc&) {
  return false;
}

// Called with the buffer full, or outside Begin/End, where a vertex has no meaning (spec 2.6.3: undefined).
bool make_room(Context& context) {
  ImmediateState& im = context.immediate;
  if (!im.inside) return false;
  if (grow(im)) return true;
  if (im.longest != kMaxBatchVertices) {
    record_error(context, GL_OUT_OF_MEMORY, "vertex");
    return false;
  }
  part_batch(context);
  return true;
}

// Of a polygon that is drawn as an outline, as points or to feedback, everything is the whole's: which way it
// faces, its offset, its edges, its token. Filled, it is as good as its triangles.
bool may_part(const Context& context, GLenum mode, const VertexFormat& format) {
  return mode != GL_POLYGON || (!format.edge_flag && context.render_mode.renders());
}

void start_batch(Context& context, GLenum mode) {
  ImmediateState& im = context.immediate;
  flush_vertices(context);
  im.state = derive(context);
  im.mode = mode;
  im.format = vertex_format(context, mode);
  im.longest = may_part(context, mode, im.format) ? kMaxBatchVertices : kMaxWholeVertices;
  im.color_varies = im.loop_parted = im.strip_goes_on = false;
  im.materials.clear();
  im.shared.start(may_share(im));
  size_side_arrays(im, buffer_capacity(im));
}

void close_loop(Context& context) {
  ImmediateState& im = context.immediate;
  if (!im.loop_parted) return;
  if (im.cursor == im.limit) part_batch(context);
  if (!im.materials.empty()) im.material_index[im.vertex_count()] = im.loop_first_material;
  std::copy_n(im.loop_first, im.format.floats, im.cursor);
  im.cursor += im.format.floats;
}

// Kept out of op::vertex, whose common path is short: what else the last vertex has.
[[gnu::noinline]] void gather_rare(Context& context) {
  ImmediateState& im = context.immediate;
  const uint32_t last = im.vertex_count() - 1;
  if (im.format.edge_flag) im.edge_flags[last] = context.current.edge_flag;
  if (!im.materials.empty()) im.material_index[last] = uint32_t(im.materials.size() - 1);
}

// Whether `other` is what a vertex here would be, bit by bit.
bool is_same(const ImmediateState& im, Quad position, const CurrentState& current, const float* other) {
  QuadBits differs = difference(position, other) | difference(load_quad(current.color), other + 4);
  if (im.format.tex_coord) differs |= difference(load_quad(current.tex_coord), other + 8);
  if (im.format.normal) differs |= difference(load_quad(current.normal), other + im.format.normal);
  return (differs[0] | differs[1]) == 0;
}

// Kept out of op::vertex, too: called where the buffer is full.
[[gnu::noinline]] void vertex_without_room(Context& context, GLfloat x, GLfloat y, GLfloat z, GLfloat w) {
  if (make_room(context)) op::vertex(context, x, y, z, w);
}

}  // namespace

VertexFormat vertex_format(const Context& context, GLenum mode) {
  const VertexNeeds needs = vertex_needs(context, mode);
  VertexFormat format;
  if (needs.tex_coord) {
    format.tex_coord = format.floats;
    format.floats += 4;
  }
  if (needs.normal) {
    format.normal = format.floats;
    format.floats += 4;
  }
  format.edge_flag = needs.edge_flag;
  format.rare = needs.edge_flag;
  return format;
}

void gather_material(Context& context, const raster::MaterialPair& pair) {
  ImmediateState& im = context.immediate;
  if (!im.inside || !im.state->lighting.enabled) return;
  const uint32_t count = im.vertex_count();
  if (im.materials.empty()) {
    const size_t capacity = buffer_capacity(im);
    if (im.material_index.size() < capacity) im.material_index.resize(capacity);
    im.materials.push_back(im.state->lighting.material);
    std::fill_n(im.material_index.begin(), count, 0u);
    im.format.rare = true;
    im.shared.find_no_more();
  }
  // A pair no vertex has is replaced.
  const bool used =
      im.materials.size() == 1 || (count > 0 && im.material_index[count - 1] == im.materials.size() - 1);
  if (used)
    im.materials.push_back(pair);
  else
    im.materials.back() = pair;
}

void forget_state(Context& context) {
  ImmediateState& im = context.immediate;
  if (!im.inside && im.waiting == 0) im.state.reset();
  context.derived.state.reset();
  mark_dirty(context, kDirtyAll);
}

void flush_vertices(Context& context) {
  const uint32_t count = std::exchange(context.immediate.waiting, 0);
  draw_gathered(context, context.immediate.mode, count);
}

namespace op {

void begin(Context& context, GLenum mode) try {
  ImmediateState& im = context.immediate;
  if (im.inside) return record_error(context, GL_INVALID_OPERATION);
  if (mode > GL_POLYGON) return record_error(context, GL_INVALID_ENUM);
  if (im.buffer.empty() && !grow(im)) throw std::bad_alloc();
  // A colour that changed since End has been noticed by op::color.
  const bool goes_on = im.waiting && im.mode == mode && im.state == derive(context);
  if (!goes_on) start_batch(context, mode);
  im.inside = true;
  const uint32_t waiting = std::exchange(im.waiting, 0);
  set_cursor(im, im.shared.active() ? im.shared.distinct() : waiting);
  set_table(context, kInsideBeginEndTable);
} catch (const std::bad_alloc&) {
  context.immediate.cursor = context.immediate.limit = nullptr;  // outside, after all
  record_error(context, GL_OUT_OF_MEMORY, "begin");
}

void end(Context& context) {
  ImmediateState& im = context.immediate;
  if (!im.inside) return record_error(context, GL_INVALID_OPERATION);
  close_loop(context);
  const uint32_t count = given_count(im);
  im.inside = false;
  im.cursor = im.limit = nullptr;
  set_table(context, kExecuteTable);
  if (const uint32_t n = raster::separate_vertices(primitive_of(im.mode))) {
    im.waiting = count - count % n;  // an unfinished primitive is dropped (spec 2.6.1)
    im.shared.truncate(im.waiting);
  } else {
    draw_gathered(context, batch_mode(im), count);
  }
}

void vertex(Context& context, GLfloat x, GLfloat y, GLfloat z, GLfloat w) {
  ImmediateState& im = context.immediate;
  float* const v = im.cursor;
  if (v == im.limit) [[unlikely]]
    return vertex_without_room(context, x, y, z, w);
  const Quad position{x, y, z, w};
  if (im.shared.active()) {
    const SharedVertices::Place place = im.shared.look(position);
    if (place.exists && is_same(im, position, context.current, vertex_at(im, place.slot))) {
      im.shared.add_again(place);
      if (im.shared.given() == im.most_given) [[unlikely]]
        im.limit = im.cursor;
      return;
    }
    im.shared.add_new(place);
  }
  store_quad(position, v);
  store_quad(load_quad(context.current.color), v + 4);
  if (im.format.tex_coord) store_quad(load_quad(context.current.tex_coord), v + 8);
  if (im.format.normal) store_quad(load_quad(context.current.normal), v + im.format.normal);
  im.cursor = v + im.format.floats;
  if (im.shared.given() == im.most_given) [[unlikely]]
    im.limit = im.cursor;
  if (im.format.rare) [[unlikely]]
    gather_rare(context);
}

// Spec 2.11: a polygon of these four vertices; as a quad it joins its neighbours.
void rect(Context& context, GLfloat x1, GLfloat y1, GLfloat x2, GLfloat y2) {
  if (context.immediate.inside) return record_error(context, GL_INVALID_OPERATION);
  begin(context, GL_QUADS);
  vertex(context, x1, y1, 0, 1);
  vertex(context, x2, y1, 0, 1);
  vertex(context, x2, y2, 0, 1);
  vertex(context, x1, y2, 0, 1);
  end(context);
}

}  // namespace op
}  // namespace halfspace::state
