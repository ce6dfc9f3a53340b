// Everything that decides how a primitive becomes pixels. Immutable once handed to Device::draw.
#pragma once

#include <array>
#include <memory>

#include "raster/api/accuracy.h"
#include "raster/api/clip_plane.h"
#include "raster/api/fog.h"
#include "raster/api/lighting.h"
#include "raster/api/logic_op.h"
#include "raster/api/shape.h"
#include "raster/api/stencil.h"
#include "raster/api/tex_gen.h"
#include "raster/api/texture.h"
#include "raster/api/types.h"

namespace halfspace::raster {

// Window coordinates (spec 2.10.1): x, y in pixels with y up; depth near/far in [0, 1], possibly reversed.
struct Viewport {
  int x = 0, y = 0, width = 0, height = 0;
  double depth_near = 0, depth_far = 1;
  bool operator==(const Viewport&) const = default;
};

struct DepthState {
  bool test = false;
  CompareFunc func = CompareFunc::less;
  bool write = true;  // only while `test` is on, as GL says
  bool operator==(const DepthState&) const = default;
};

struct BlendState {
  bool enabled = false;
  BlendFactor src = BlendFactor::one, dst = BlendFactor::zero;
  bool operator==(const BlendState&) const = default;
};

struct AlphaTestState {
  bool enabled = false;
  CompareFunc func = CompareFunc::always;
  float reference = 0;
  bool operator==(const AlphaTestState&) const = default;
};

struct ColorMask {
  bool r = true, g = true, b = true, a = true;
  bool all() const { return r && g && b && a; }
  bool none() const { return !(r || g || b || a); }
  bool operator==(const ColorMask&) const = default;
};

// A texture unit that is off has a null view.
struct TextureUnitState {
  std::shared_ptr<const TextureView> view;
  EnvMode env = EnvMode::modulate;
  Color env_color;
  std::array<double, 16> matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  // column-major
  bool matrix_is_identity = true;
};

struct RasterState {
  bool cull_front = false, cull_back = false;
  bool front_is_ccw = true;
  bool flat_shading = false;
  bool scissor_test = false;
  Rect scissor;
};

struct DrawState {
  // Projection * modelview, column-major, multiplied in double from the float stacks.
  std::array<double, 16> clip_from_object{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  // Modelview, and the inverse transpose of its upper 3x3 (column-major); looked at where lighting, texgen,
  // fog or user clip planes are on.
  std::array<double, 16> eye_from_object{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  std::array<double, 9> normal_from_object{1, 0, 0, 0, 1, 0, 0, 0, 1};
  bool normalize = false;  // GL_NORMALIZE
  // States with the same number, unless that is 0, differ at most in what stands above, and in the texture's
  // view and environment. Compared before all the rest is.
  uint64_t rest_version = 0;
  LightingState lighting;
  TexGenState tex_gen;
  ClipPlaneState clip_planes;
  Viewport viewport;
  RasterState raster;
  PointState point;
  LineState line;
  PolygonState polygon;
  FogState fog;
  StencilState stencil;
  DepthState depth;
  AlphaTestState alpha_test;
  BlendState blend;
  LogicOpState logic_op;
  ColorMask color_mask;
  uint8_t color_targets = kBackPlane;  // bits of ColorPlane that are drawn to
  TextureUnitState texture;
  Accuracy accuracy;
};

}  // namespace halfspace::raster
