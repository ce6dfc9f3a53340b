#include "state/attribute_stack.h"

#include <array>

#include "state/attribute_groups.h"
#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"

namespace halfspace::state {

struct SavedAttributes {
  GLbitfield mask;
  AttributeGroups groups;
};

namespace {

void save(const Context& context, GLbitfield mask, SavedAttributes& out) {
  out.mask = mask;
  const auto save_group = [&](auto& group) {
    if (mask & group.kBits) group.saved.save(context);
  };
  std::apply([&](auto&... group) { (save_group(group), ...); }, out.groups);
}

void restore(Context& context, const SavedAttributes& saved) {
  const auto restore_group = [&](const auto& group) {
    if (!(saved.mask & group.kBits)) return;
    group.saved.restore(context);
    mark_dirty(context, group.kDirty);
  };
  std::apply([&](const auto&... group) { (restore_group(group), ...); }, saved.groups);
}

// What a level keeps alive must not wait for the next push.
void release(SavedAttributes& saved) {
  const auto release_group = [](auto& group) {
    if constexpr (requires { group.saved.release(); }) group.saved.release();
  };
  std::apply([&](auto&... group) { (release_group(group), ...); }, saved.groups);
}

// Client arrays without what drawing keeps beside them.
constexpr ClientArray VertexArrayState::*kArrays[] = {
    &VertexArrayState::vertex, &VertexArrayState::color,     &VertexArrayState::tex_coord,
    &VertexArrayState::normal, &VertexArrayState::edge_flag, &VertexArrayState::index,
};

}  // namespace

struct SavedClientAttributes {
  GLbitfield mask;
  PixelStoreState pixel_store;
  std::array<ClientArray, std::size(kArrays)> arrays;
};

AttributeStackState::AttributeStackState() = default;
AttributeStackState::~AttributeStackState() = default;

namespace {

// The level at `depth`, made when it is first reached. May throw std::bad_alloc.
template <class Saved>
Saved& level_at(std::vector<std::unique_ptr<Saved>>& levels, size_t depth) {
  if (depth == levels.size()) levels.push_back(std::make_unique<Saved>());
  return *levels[depth];
}

void save_client(const Context& context, GLbitfield mask, SavedClientAttributes& out) {
  out.mask = mask;
  out.pixel_store = context.pixel_store;
  for (size_t i = 0; i < out.arrays.size(); ++i) out.arrays[i] = context.vertex_array.*kArrays[i];
}

void restore_client(Context& context, const SavedClientAttributes& saved) {
  if (saved.mask & GL_CLIENT_PIXEL_STORE_BIT) context.pixel_store = saved.pixel_store;
  if (!(saved.mask & GL_CLIENT_VERTEX_ARRAY_BIT)) return;
  for (size_t i = 0; i < saved.arrays.size(); ++i) context.vertex_array.*kArrays[i] = saved.arrays[i];
}

}  // namespace

void copy_attributes(const Context& from, Context& to, GLbitfield mask) {
  const GLenum draw_buffer = to.color_buffer.draw_buffer, read_buffer = to.color_buffer.read_buffer;
  SavedAttributes saved;
  save(from, mask, saved);
  restore(to, saved);
  // A buffer the other visual lacks stays out.
  if (from.was_current && from.visual.double_buffered == to.visual.double_buffered) return;
  to.color_buffer.draw_buffer = draw_buffer;
  to.color_buffer.read_buffer = read_buffer;
}

namespace op {

void push_attrib(Context& context, GLbitfield mask) {
  AttributeStackState& stack = context.attribute_stack;
  if (stack.server_depth == kMaxAttributeDepth) return record_error(context, GL_STACK_OVERFLOW);
  guard_memory(context, [&] {
    settle_color_material(context);
    save(context, mask, level_at(stack.server, stack.server_depth));
    ++stack.server_depth;
  });
}

void pop_attrib(Context& context) {
  AttributeStackState& stack = context.attribute_stack;
  if (stack.server_depth == 0) return record_error(context, GL_STACK_UNDERFLOW);
  guard_memory(context, [&] {
    // Waiting vertices have been given their colour; that it changes now is nothing they would notice.
    flush_vertices(context);
    settle_color_material(context);
    SavedAttributes& saved = *stack.server[stack.server_depth - 1];
    restore(context, saved);
    release(saved);
    --stack.server_depth;
  });
}

void push_client_attrib(Context& context, GLbitfield mask) {
  AttributeStackState& stack = context.attribute_stack;
  if (stack.client_depth == kMaxClientAttributeDepth) return record_error(context, GL_STACK_OVERFLOW);
  guard_memory(context, [&] {
    save_client(context, mask, level_at(stack.client, stack.client_depth));
    ++stack.client_depth;
  });
}

void pop_client_attrib(Context& context) {
  AttributeStackState& stack = context.attribute_stack;
  if (stack.client_depth == 0) return record_error(context, GL_STACK_UNDERFLOW);
  restore_client(context, *stack.client[--stack.client_depth]);
}

}  // namespace op

std::span<const GetRow> attribute_stack_get_rows() {
  static constexpr GetRow kRows[] = {
      {GL_ATTRIB_STACK_DEPTH, GetKind::integer, 1,
       [](const Context& c, double* out) { *out = double(c.attribute_stack.server_depth); }},
      {GL_CLIENT_ATTRIB_STACK_DEPTH, GetKind::integer, 1,
       [](const Context& c, double* out) { *out = double(c.attribute_stack.client_depth); }},
      {GL_MAX_ATTRIB_STACK_DEPTH, GetKind::integer, 1,
       [](const Context&, double* out) { *out = double(kMaxAttributeDepth); }},
      {GL_MAX_CLIENT_ATTRIB_STACK_DEPTH, GetKind::integer, 1,
       [](const Context&, double* out) { *out = double(kMaxClientAttributeDepth); }},
  };
  return kRows;
}

}  // namespace halfspace::state
