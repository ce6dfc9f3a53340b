// An OSMesa context: a GL context, the surface it draws on, and what OSMesa's queries hand out.
#pragma once

#include <GL/osmesa.h>

#include <cstdint>
#include <vector>

#include "gl/osmesa/surface.h"
#include "state/context.h"

// The name is the header's.
struct osmesa_context {
  osmesa_context(GLenum format_name, const halfspace::gl::AncillaryBits& bits, osmesa_context* share);

  GLenum format_name;  // OSMESA_RGBA ...
  halfspace::gl::Surface surface;
  halfspace::state::Context state;
  std::vector<uint8_t> depth_copy;  // what OSMesaGetDepthBuffer returned; lives until the next call
};

namespace halfspace::gl {

// The calling thread's context, or null.
osmesa_context* current_osmesa_context();
// Makes `context` current for the calling thread, showing its picture in `user`. May throw std::bad_alloc;
// the context that was current then stays so, or none is when it was this one.
void bind(osmesa_context& context, const UserBuffer& user);
// Leaves the thread without a context; its picture is shown first.
void release();
// Destroys `context`. The user's buffer, which may be freed already, is not written to.
void destroy(osmesa_context* context);
// The depth buffer, lowest row first, in values of surface.depth_value_bytes(). May throw std::bad_alloc.
void* read_depth(osmesa_context& context);

}  // namespace halfspace::gl
