// GL's types and constants, from the system's header. Nothing below state/derive sees them.
#pragma once

#include <GL/gl.h>
#include <GL/glext.h>
