// What an entry point is made of.
#pragma once

#define GL_GLEXT_PROTOTYPES 1
#include <GL/gl.h>
#include <GL/glext.h>

#include "state/context.h"
#include "state/operations.gen.h"

// UBSan: without a current context the reference is to nothing, and the operations of that table never look
// at it.
#ifdef __clang__
#define HALFSPACE_NO_NULL_CHECK __attribute__((no_sanitize("null")))
#else
#define HALFSPACE_NO_NULL_CHECK __attribute__((no_sanitize_undefined))
#endif

#define HALFSPACE_EXPORT __attribute__((visibility("default")))
#define HALFSPACE_ENTRY HALFSPACE_EXPORT HALFSPACE_NO_NULL_CHECK

// Calls an operation of the calling thread's table. One thread-local variable holds table and context; both
// are read once, and the call is a tail call.
#define HALFSPACE_CALL(operation, ...)                \
  halfspace::state::current_binding.table->operation( \
      *halfspace::state::current_binding.context __VA_OPT__(, ) __VA_ARGS__)
