#include "state/immediate.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <utility>

#include "state/context.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace {

constexpr uint32_t kFirstBatchVertices = 1020;
static_assert(kFirstBatchVertices % 12 == 0 && kMaxBatchVertices % 12 == 0);

// Points the cursor behind `count` vertices at the start of the buffer.
void set_cursor(ImmediateState& im, uint32_t count) {
  const size_t capacity = im.buffer.size() / kTexturedVertexFloats;
  im.cursor = im.buffer.data() + size_t(count) * im.vertex_floats();
  im.limit = im.buffer.data() + capacity * im.vertex_floats();
}

float* vertex_at(ImmediateState& im, uint32_t i) { return im.buffer.data() + size_t(i) * im.vertex_floats(); }

void draw_gathered(Context& context, GLenum mode, uint32_t count) {
  if (count == 0) return;
  ImmediateState& im = context.immediate;
  const float* v = im.buffer.data();
  const size_t stride = im.vertex_floats() * sizeof(float);
  raster::DrawPacket packet;
  packet.state = im.state;
  packet.primitive = primitive_of(mode);
  packet.index_count = packet.batch.count = count;
  packet.batch.position = {v, stride, 4};
  packet.batch.color = {v + 4, im.color_varies ? stride : 0, 4};
  if (im.textured) packet.batch.tex_coord = {v + 8, stride, 4};
  submit(context, packet);
}

// What of a full batch the next one begins with, so that the drawing goes on as if it had not been parted:
// the centre of a fan, and the last vertices. A full batch is whole points, lines, triangles, quads, and
// pairs of a strip (its next triangle faces as the first one did), for its length is a multiple of 12.
struct Kept {
  bool first;
  uint32_t last;
};

Kept kept_vertices(GLenum mode) {
  switch (mode) {
    case GL_LINE_STRIP:
    case GL_LINE_LOOP:
      return {false, 1};
    case GL_TRIANGLE_STRIP:
    case GL_QUAD_STRIP:
      return {false, 2};
    case GL_TRIANGLE_FAN:
    case GL_POLYGON:
      return {true, 1};
    default:
      return {false, 0};
  }
}

void remember_loop_start(ImmediateState& im) {
  if (im.mode != GL_LINE_LOOP || im.loop_parted) return;
  std::copy_n(im.buffer.data(), im.vertex_floats(), im.loop_first);
  im.loop_parted = true;
}

// The mode the gathered vertices are drawn with: of a parted loop, a strip.
GLenum batch_mode(const ImmediateState& im) { return im.loop_parted ? GL_LINE_STRIP : im.mode; }

// Draws a full batch, and moves what the next one needs to the buffer's start.
void part_batch(Context& context) {
  ImmediateState& im = context.immediate;
  const uint32_t count = im.vertex_count();
  const Kept kept = kept_vertices(im.mode);
  remember_loop_start(im);
  draw_gathered(context, batch_mode(im), count);
  const uint32_t start = kept.first ? 1 : 0;
  std::memmove(vertex_at(im, start), vertex_at(im, count - kept.last),
               kept.last * im.vertex_floats() * sizeof(float));
  set_cursor(im, start + kept.last);
}

bool grow(ImmediateState& im) try {
  const size_t capacity = im.buffer.size() / kTexturedVertexFloats;
  if (capacity >= kMaxBatchVertices) return false;
  const uint32_t count = im.vertex_count();
  const size_t wanted = capacity ? std::min<size_t>(capacity * 4, kMaxBatchVertices) : kFirstBatchVertices;
  im.buffer.resize(wanted * kTexturedVertexFloats);
  set_cursor(im, count);
  return true;
} catch (const std::bad_alloc&) {
  return false;
}

// Called with the buffer full, or outside Begin/End, where a vertex has no meaning (spec 2.6.3: undefined).
bool make_room(Context& context) {
  ImmediateState& im = context.immediate;
  if (!im.inside) return false;
  if (!grow(im)) part_batch(context);
  return true;
}

// Vertices of one primitive, for modes whose primitives stand alone; 0: the others.
uint32_t separate_vertices(GLenum mode) {
  switch (mode) {
    case GL_POINTS:
      return 1;
    case GL_LINES:
      return 2;
    case GL_TRIANGLES:
      return 3;
    case GL_QUADS:
      return 4;
    default:
      return 0;
  }
}

void start_batch(Context& context, GLenum mode) {
  ImmediateState& im = context.immediate;
  flush_vertices(context);
  im.state = derive(context);
  im.mode = mode;
  im.textured = context.texture.enabled_1d || context.texture.enabled_2d;
  im.color_varies = im.loop_parted = false;
}

void close_loop(Context& context) {
  ImmediateState& im = context.immediate;
  if (!im.loop_parted) return;
  if (im.cursor == im.limit) part_batch(context);
  std::copy_n(im.loop_first, im.vertex_floats(), im.cursor);
  im.cursor += im.vertex_floats();
}

}  // namespace

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
  set_cursor(im, std::exchange(im.waiting, 0));
  set_table(context, kInsideBeginEndTable);
} catch (const std::bad_alloc&) {
  record_error(context, GL_OUT_OF_MEMORY, "begin");
}

void end(Context& context) {
  ImmediateState& im = context.immediate;
  if (!im.inside) return record_error(context, GL_INVALID_OPERATION);
  close_loop(context);
  const uint32_t count = im.vertex_count();
  im.inside = false;
  im.cursor = im.limit = nullptr;
  set_table(context, kExecuteTable);
  if (const uint32_t n = separate_vertices(im.mode)) {
    im.waiting = count - count % n;  // an unfinished primitive is dropped (spec 2.6.1)
  } else {
    draw_gathered(context, batch_mode(im), count);
  }
}

void vertex(Context& context, GLfloat x, GLfloat y, GLfloat z, GLfloat w) {
  ImmediateState& im = context.immediate;
  if (im.cursor == im.limit) [[unlikely]] {
    if (!make_room(context)) return;
  }
  float* v = im.cursor;
  v[0] = x;
  v[1] = y;
  v[2] = z;
  v[3] = w;
  std::memcpy(v + 4, context.current.color, 4 * sizeof(float));
  if (im.textured) std::memcpy(v + 8, context.current.tex_coord, 4 * sizeof(float));
  im.cursor = v + im.vertex_floats();
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
