// The OSMesa* functions: arguments are checked here, as GL/osmesa.h documents them; bad ones are refused with
// a line on stderr, and nothing changes.
#include <GL/osmesa.h>

#include <cstring>
#include <new>
#include <optional>

#include "gl/entry.h"
#include "gl/osmesa/context.h"
#include "gl/proc_address.h"
#include "state/report.h"

using halfspace::gl::BufferFormat;
using halfspace::gl::current_osmesa_context;
using halfspace::gl::UserBuffer;
using halfspace::state::report;

namespace {

constexpr int kMaxSize = halfspace::raster::kMaxSurfaceSize;
// What glGetString(GL_VERSION) begins with. A context of a later version cannot be had yet.
constexpr int kMajorVersion = 1, kMinorVersion = 1;

// OSMesaCreateContextAttribs' list, with the documented defaults.
struct ContextAttributes {
  int format = OSMESA_RGBA;
  halfspace::gl::AncillaryBits bits;
  int profile = OSMESA_COMPAT_PROFILE;
  int major = 1, minor = 0;

  // The member an attribute sets; null for an unknown one.
  int* find(int name) {
    switch (name) {
      case OSMESA_FORMAT:
        return &format;
      case OSMESA_DEPTH_BITS:
        return &bits.depth;
      case OSMESA_STENCIL_BITS:
        return &bits.stencil;
      case OSMESA_ACCUM_BITS:
        return &bits.accum;
      case OSMESA_PROFILE:
        return &profile;
      case OSMESA_CONTEXT_MAJOR_VERSION:
        return &major;
      case OSMESA_CONTEXT_MINOR_VERSION:
        return &minor;
      default:
        return nullptr;
    }
  }
};

std::optional<ContextAttributes> read_attributes(const int* list) {
  ContextAttributes attributes;
  for (; list && list[0]; list += 2) {
    int* const member = attributes.find(list[0]);
    if (!member) {
      report("OSMesaCreateContextAttribs: unknown attribute 0x%x", static_cast<unsigned>(list[0]));
      return std::nullopt;
    }
    *member = list[1];
  }
  return attributes;
}

// Says why a context of these attributes cannot be had; null when it can.
const char* reason_to_refuse(const ContextAttributes& a) {
  if (!halfspace::gl::format_of_context(static_cast<GLenum>(a.format))) return "the format is not supported";
  if (a.bits.depth < 0 || a.bits.stencil < 0 || a.bits.accum < 0) return "a number of bits is negative";
  if (a.profile == OSMESA_CORE_PROFILE) return "there is no core profile";
  if (a.profile != OSMESA_COMPAT_PROFILE) return "the profile is unknown";
  if (a.major < 1 || a.minor < 0) return "there is no such version";
  if (a.major > kMajorVersion || (a.major == kMajorVersion && a.minor > kMinorVersion))
    return "the version is later than the one we have";
  return nullptr;
}

OSMesaContext create_context(const char* caller, const ContextAttributes& attributes, OSMesaContext share) {
  if (const char* reason = reason_to_refuse(attributes)) {
    report("%s: %s", caller, reason);
    return nullptr;
  }
  try {
    return new osmesa_context(static_cast<GLenum>(attributes.format), attributes.bits, share);
  } catch (const std::bad_alloc&) {
    report("%s: out of memory", caller);
    return nullptr;
  }
}

// The buffer as a UserBuffer; nothing, with a line on stderr, when it cannot be drawn to.
std::optional<UserBuffer> user_buffer(const osmesa_context& context, void* buffer, GLenum type, GLsizei width,
                                      GLsizei height) {
  if (!buffer || width < 1 || height < 1 || width > kMaxSize || height > kMaxSize) {
    report("OSMesaMakeCurrent: a buffer of %d x %d pixels at %p cannot be drawn to (at most %d x %d)", width,
           height, buffer, kMaxSize, kMaxSize);
    return std::nullopt;
  }
  const std::optional<BufferFormat> format = halfspace::gl::format_of_buffer(context.format_name, type);
  if (!format) {
    report("OSMesaMakeCurrent: type 0x%x does not go with the context's format", type);
    return std::nullopt;
  }
  return UserBuffer{buffer, type, *format, width, height};
}

struct NamedProc {
  const char* name;
  OSMESAproc proc;
};

}  // namespace

extern "C" {

HALFSPACE_EXPORT OSMesaContext OSMesaCreateContext(GLenum format, OSMesaContext sharelist) {
  ContextAttributes attributes;
  attributes.format = static_cast<int>(format);
  attributes.bits.depth = 24;
  attributes.bits.stencil = 8;
  return create_context("OSMesaCreateContext", attributes, sharelist);
}

HALFSPACE_EXPORT OSMesaContext OSMesaCreateContextExt(GLenum format, GLint depthBits, GLint stencilBits,
                                                      GLint accumBits, OSMesaContext sharelist) {
  ContextAttributes attributes;
  attributes.format = static_cast<int>(format);
  attributes.bits.depth = depthBits;
  attributes.bits.stencil = stencilBits;
  attributes.bits.accum = accumBits;
  return create_context("OSMesaCreateContextExt", attributes, sharelist);
}

HALFSPACE_EXPORT OSMesaContext OSMesaCreateContextAttribs(const int* attribList, OSMesaContext sharelist) {
  const std::optional<ContextAttributes> attributes = read_attributes(attribList);
  return attributes ? create_context("OSMesaCreateContextAttribs", *attributes, sharelist) : nullptr;
}

HALFSPACE_EXPORT void OSMesaDestroyContext(OSMesaContext ctx) { halfspace::gl::destroy(ctx); }

HALFSPACE_EXPORT GLboolean OSMesaMakeCurrent(OSMesaContext ctx, void* buffer, GLenum type, GLsizei width,
                                             GLsizei height) {
  if (!ctx && !buffer) {
    halfspace::gl::release();
    return GL_TRUE;
  }
  if (!ctx) {
    report("OSMesaMakeCurrent: a buffer, but no context");
    return GL_FALSE;
  }
  const std::optional<UserBuffer> user = user_buffer(*ctx, buffer, type, width, height);
  if (!user) return GL_FALSE;
  try {
    halfspace::gl::bind(*ctx, *user);
    return GL_TRUE;
  } catch (const std::bad_alloc&) {
    report("OSMesaMakeCurrent: no memory for %d x %d pixels", width, height);
    return GL_FALSE;
  }
}

HALFSPACE_EXPORT OSMesaContext OSMesaGetCurrentContext(void) { return current_osmesa_context(); }

HALFSPACE_EXPORT void OSMesaPixelStore(GLint pname, GLint value) {
  osmesa_context* const context = current_osmesa_context();
  if (!context) {
    report("OSMesaPixelStore: no current context");
  } else if (pname == OSMESA_ROW_LENGTH && value >= 0) {
    context->surface.set_row_length(value);
  } else if (pname == OSMESA_Y_UP) {
    context->surface.set_y_up(value != 0);
  } else {
    report("OSMesaPixelStore: 0x%x cannot be %d", static_cast<unsigned>(pname), value);
  }
}

HALFSPACE_EXPORT void OSMesaGetIntegerv(GLint pname, GLint* value) {
  const osmesa_context* const context = current_osmesa_context();
  switch (pname) {
    case OSMESA_WIDTH:
      *value = context ? context->surface.width() : 0;
      return;
    case OSMESA_HEIGHT:
      *value = context ? context->surface.height() : 0;
      return;
    case OSMESA_FORMAT:
      *value = context ? static_cast<GLint>(context->format_name) : 0;
      return;
    case OSMESA_TYPE:
      *value = context ? static_cast<GLint>(context->surface.user().type) : 0;
      return;
    case OSMESA_ROW_LENGTH:
      *value = context ? context->surface.row_length() : 0;
      return;
    case OSMESA_Y_UP:
      *value = context ? context->surface.y_up() : 1;
      return;
    case OSMESA_MAX_WIDTH:
    case OSMESA_MAX_HEIGHT:
      *value = kMaxSize;
      return;
    default:
      report("OSMesaGetIntegerv: unknown name 0x%x", static_cast<unsigned>(pname));
      return;
  }
}

HALFSPACE_EXPORT GLboolean OSMesaGetDepthBuffer(OSMesaContext c, GLint* width, GLint* height,
                                                GLint* bytesPerValue, void** buffer) {
  void* values = nullptr;
  if (c && c->surface.user().data && c->surface.has_depth()) {
    try {
      values = halfspace::gl::read_depth(*c);
    } catch (const std::bad_alloc&) {
      report("OSMesaGetDepthBuffer: out of memory");
    }
  }
  *width = values ? c->surface.width() : 0;
  *height = values ? c->surface.height() : 0;
  *bytesPerValue = values ? c->surface.depth_value_bytes() : 0;
  *buffer = values;
  return values ? GL_TRUE : GL_FALSE;
}

HALFSPACE_EXPORT GLboolean OSMesaGetColorBuffer(OSMesaContext c, GLint* width, GLint* height, GLint* format,
                                                void** buffer) {
  const bool attached = c && c->surface.user().data;
  *width = attached ? c->surface.width() : 0;
  *height = attached ? c->surface.height() : 0;
  *format = attached ? static_cast<GLint>(c->format_name) : 0;
  *buffer = attached ? c->surface.user().data : nullptr;
  return attached ? GL_TRUE : GL_FALSE;
}

// Colours are clamped to [0, 1] in any case: GL 1.x clamps clear colours and fragments (spec 3.10, 4.2.3) in
// float buffers too, so both settings show the same picture.
HALFSPACE_EXPORT void OSMesaColorClamp(GLboolean) {}

// Gallium's filters on the finished picture (antialiasing, celshading): there are none here, and without the
// program asking for one the picture is the same.
HALFSPACE_EXPORT void OSMesaPostprocess(OSMesaContext, const char* filter, unsigned enable_value) {
  if (enable_value)
    report("OSMesaPostprocess: there is no filter \"%s\"; the picture stays as drawn", filter ? filter : "");
}

HALFSPACE_EXPORT OSMESAproc OSMesaGetProcAddress(const char* funcName) {
  static const NamedProc kOwn[] = {
#define NAMED(name) {#name, reinterpret_cast<OSMESAproc>(name)}
      NAMED(OSMesaColorClamp),        NAMED(OSMesaCreateContext),  NAMED(OSMesaCreateContextAttribs),
      NAMED(OSMesaCreateContextExt),  NAMED(OSMesaDestroyContext), NAMED(OSMesaGetColorBuffer),
      NAMED(OSMesaGetCurrentContext), NAMED(OSMesaGetDepthBuffer), NAMED(OSMesaGetIntegerv),
      NAMED(OSMesaGetProcAddress),    NAMED(OSMesaMakeCurrent),    NAMED(OSMesaPixelStore),
      NAMED(OSMesaPostprocess),
#undef NAMED
  };
  if (!funcName) return nullptr;
  for (const NamedProc& own : kOwn)
    if (std::strcmp(own.name, funcName) == 0) return own.proc;
  return halfspace::gl::get_proc_address(funcName);
}

}  // extern "C"
