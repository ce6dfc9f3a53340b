#include "gl/osmesa/context.h"

#include <cstring>
#include <new>

using halfspace::gl::format_of_context;
using halfspace::gl::visual_of;

osmesa_context::osmesa_context(GLenum name, const halfspace::gl::AncillaryBits& bits,
                               osmesa_context* share)
    : format_name(name),
      surface(bits),
      state(visual_of(*format_of_context(name), bits), share ? &share->state : nullptr) {}

namespace halfspace::gl {
namespace {

constinit thread_local osmesa_context* current = nullptr;

// Ends the device's pass, so that the framebuffer it was on can go.
void leave_surface(osmesa_context& context) {
  context.surface.detach();
  if (current == &context) {
    state::make_current(nullptr, nullptr);
    current = nullptr;
  }
  context.state.device.begin_pass(nullptr);
}

}  // namespace

osmesa_context* current_osmesa_context() { return current; }

void bind(osmesa_context& context, const UserBuffer& user) {
  if (current == &context && context.surface.user() == user) return;
  if (context.surface.keeps_framebuffer(user)) {
    // The old buffer, if it is another one, is not written to: callers free it before they bring the new one.
    context.surface.attach(user);
  } else {
    leave_surface(context);
    context.surface.attach(user);
  }
  context.state.visual = context.surface.visual();
  state::make_current(&context.state, &context.surface);
  current = &context;
}

void release() {
  state::make_current(nullptr, nullptr);
  current = nullptr;
}

void destroy(osmesa_context* context) {
  if (!context) return;
  leave_surface(*context);
  delete context;
}

void* read_depth(osmesa_context& context) {
  const UserBuffer& user = context.surface.user();
  const size_t count = static_cast<size_t>(user.width) * static_cast<size_t>(user.height);
  std::vector<uint32_t> values(count);
  state::flush_vertices(context.state);
  context.state.device.begin_pass(&context.surface.framebuffer(raster::kBackPlane));
  context.state.device.read_depth({0, 0, user.width, user.height}, values.data());
  context.depth_copy.resize(count * static_cast<size_t>(context.surface.depth_value_bytes()));
  if (context.surface.depth_value_bytes() == 4) {
    std::memcpy(context.depth_copy.data(), values.data(), context.depth_copy.size());
    return context.depth_copy.data();
  }
  for (size_t i = 0; i < count; ++i) {
    // To the nearest of 2^16 - 1 steps.
    const auto value = static_cast<uint16_t>((uint64_t{values[i]} * 65535 + 0x7FFFFF) / 0xFFFFFF);
    std::memcpy(context.depth_copy.data() + 2 * i, &value, sizeof value);
  }
  return context.depth_copy.data();
}

}  // namespace halfspace::gl
