// What the contract's opaque types are made of here.
#pragma once

#include "raster/api/framebuffer.h"
#include "raster/api/texture.h"
#include "tests/oracle/target.h"
#include "tests/oracle/texture.h"

namespace halfspace::raster {

struct TextureLevel {
  oracle::Level level;
  BaseFormat base_format = BaseFormat::rgba;
};

struct Framebuffer::Impl {
  oracle::Target target;
  Impl(int width, int height, ColorFormat format, int planes) : target(width, height, format, planes) {}
};

}  // namespace halfspace::raster
