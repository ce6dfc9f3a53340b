// What a fragment program works on: one primitive on one 8x8 block.
#pragma once

#include <cstddef>
#include <cstdint>

#include "raster/api/draw_state.h"
#include "raster/fragment/stage_meter.h"
#include "raster/surface/framebuffer.h"
#include "raster/tile/setup_batch.h"

namespace halfspace::raster {

// A texture level as the samplers read it: texel (i, j) at texels[(j + 1) * pitch + i + 1], -1 <= i <= width.
struct LevelRef {
  const uint32_t* texels;
  const uint32_t* stacked;  // TextureLevel::stacked
  int32_t pitch;
  int32_t width_i, height_i;
  float width, height;
  bool opaque;  // every texel, skirt included, has alpha 255
};

// Fog: with u = (distance - origin) * slope, the share of the fragment's own colour is u, e^-u or e^-(u * u).
enum class FogCurve : uint8_t { linear, exp, exp2, exp_draft, exp2_draft };
struct FogParams {
  int plane = 0;  // of the distance
  FogCurve curve = FogCurve::exp;
  float origin = 0, slope = 1;
  float color[3] = {};    // 0..255
  double level_span = 0;  // distance over which a colour changes by a level, at least
};

// What the exact level has in double or asks for at run time. Colours in levels; filled for that level only.
struct ExactParams {
  double constant_color[4], env_color[4], fog_color[3];
  double fog_origin, fog_slope, alpha_reference;
  EnvMode env;
  bool env_rgb, env_alpha;  // whether the texture's base format has them
  bool env_mixes_alpha;     // GL_BLEND with an intensity texture
};

// Which planes a primitive is interpolated by, beside the bound of PlaneMaker.
enum class PlaneRule : uint8_t { by_bound, in_float, in_double };

// What holds for all fragments of a draw; values only, the code is in the program's stage list.
struct FragmentParams {
  LevelRef levels[kMaxTextureLevels];
  int level_count = 0;
  Sampler sampler;
  double lod_scale[2] = {};  // texels of level 0 that s and t in [0, 1] span, as far as they count for lambda
  float magnify_below = 0;  // lambda at or under which mag is used: 0 or 0.5 (spec 3.8.9)
  int color_plane = 0;      // first of four planes
  int tex_plane = 0;        // s, t [, q]
  bool rounds_to_bytes = true;  // the surface is rgba8
  float constant_color[4] = {255, 255, 255, 255};
  float env_color[4] = {};   // 0..255
  float alpha_reference = 0;  // 0..255
  CompareFunc alpha_func = CompareFunc::always;
  BlendFactor blend_src = BlendFactor::one, blend_dst = BlendFactor::zero;
  LogicOp logic_op = LogicOp::copy;
  StencilState stencil;
  DepthState depth;  // where the stencil stage makes the depth test
  FogParams fog;
  uint32_t color_mask = ~0u;  // bytes to write, as packed
  Accuracy accuracy;
  PlaneRule plane_rule = PlaneRule::by_bound;
  bool one_lambda = false;  // the lookup wants SetupBatch::lambda
  ExactParams exact;
};

// Values handed from stage to stage, one array of 64 a slot. Colours are in 0..255, unrounded; kOffset holds int32;
// kW is clip-space w. kMipKey is the mip level, or -1 for the magnification filter where that is another one; kMipBlend
// the share of the level after. kPixel: the bytes of an 8-bit pixel. kLow...: what the float leaves of a double (wide.inl).
enum Slot {
  kR, kG, kB, kA, kS, kT, kOffset, kW, kTexR, kTexG, kTexB, kTexA, kLambda, kMipKey, kMipBlend, kPixel,
  kLowR, kLowG, kLowB, kLowA, kLowS, kLowT, kLowTexR, kLowTexG, kLowTexB, kLowTexA, kLowLambda, kSlotCount
};

// Fragments of small triangles waiting to be shaded together. Filled by raster/tile/packing.inl.
struct alignas(64) PixelQueue {
  static constexpr int kCapacity = 4 * kBlockPixels;
  static constexpr int kSlack = 16;  // a whole vector may be stored at the last place
  float plane[kMaxPlanes][kCapacity + kSlack];                 // values of planes 1 and up
  int32_t offset[kCapacity + kSlack];                          // pixel in the tile
  int count = 0;
};

// Pixels of lines on their way to a tile's memory.
struct alignas(64) LinePixels {
  static constexpr int kCapacity = 256, kSlack = 16;  // measured best of 64 and 256
  uint32_t color[kCapacity + kSlack];
  int32_t offset[kCapacity + kSlack];  // pixel in the tile
};

// Of the pixels of two rows of a block, in order: column and row.
template <class T>
struct TwoRows {
  alignas(64) T column[16] = {0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7};
  alignas(64) T row[16] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1};
};
template <class T>
inline constexpr TwoRows<T> kTwoRows;

// As many pixels of a tile as a kernel has lanes. From the lowest bit on: three that are 0, the how many-th
// such group of the tile it is, from bit 13 on the primitive it is of, as a lane of its batch; then which
// pixels are live.
struct TileGroup {
  static constexpr int kIndexShift = 3, kLaneShift = 13, kLiveShift = 16;
  uint32_t bits;
  unsigned index() const { return bits >> kIndexShift & ((1u << (kLaneShift - kIndexShift)) - 1); }
  int lane() const { return static_cast<int>(bits >> kLaneShift) % kSetupLanes; }
  unsigned live() const { return bits >> kLiveShift; }
  TileGroup with(unsigned live) const { return {(bits & 0xffff) | live << kLiveShift}; }
  // Without a branch, which could not be guessed.
  unsigned count() const { return bits >= 1u << kLiveShift ? 1 : 0; }
};

// Of a batch's primitives, for the columns and the rows of a tile where groups of theirs lie: where from the anchor,
// and the products of the depth planes. A window of columns or rows may begin with any in the tile and reach beyond.
struct GroupTables {
  static constexpr int kColumns = 32, kRows = 16;  // of a window
  static constexpr int kLaneValues = 2 * kTileSize;
  static constexpr int at(int lane, int pixel) { return lane * kLaneValues + pixel; }
  alignas(64) double across[kSetupLanes * kLaneValues], row[kSetupLanes * kLaneValues];
  alignas(64) float dx[kSetupLanes * kLaneValues], dy[kSetupLanes * kLaneValues];
};

// Blocks side by side that a list of kernels takes in turn, each kernel all of them: what it works out ahead serves all.
inline constexpr int kRowBlocks = kTileSize / kBlockSize;
// A line of the cache more than a row has: or else slots would share the same few sets.
inline constexpr int kSlotPixels = kRowBlocks * kBlockPixels + 16;

// Products of a triangle's planes along the rows and the columns of a tile, as raster/fragment/tile_lanes.inl lays them
// out: for all kernels that take the triangle's whole blocks. A plane is worked out when the first of them asks for it.
struct alignas(64) TilePlanes {
  struct alignas(64) Single {
    float across[2 * kTileSize];
    float row[kTileSize];
    float rows[8 * kTileSize];  // each as a vector of rows has it
  };
  Single single[kMaxPlanes];
  struct alignas(64) Double {
    double across[kTileSize], row[kTileSize];
  };
  Double wide[kMaxPlanes];
  uint32_t has_single, has_double;  // bits of planes
  alignas(64) float lod_columns[kTileSize];  // LambdaAtW's of each column
  bool has_lod_columns;
  int begin, end;                   // rows of the tile that are asked for
};

struct alignas(64) BlockContext {
  float slot[kSlotCount][kSlotPixels];
  const FragmentParams* params;
  const SetupBatch* setup;
  int lane;               // of the batch
  double dx, dy;          // centre of the block's lowest-left pixel minus the anchor
  uint64_t blocks;        // whole blocks of a tile; then (dx, dy), colour and depth are the tile's, else the block's
  int first_slot = 0;       // of the block at hand among a row's
  uint64_t row_live[kRowBlocks];  // of such a row of whole blocks, what `live` is of one
  TilePlanes* planes;     // with `blocks`
  uint64_t live;          // bit (y % 8) * 8 + x % 8
  uint32_t* depth;        // the block's 64 pixels
  uint8_t* stencil;       // likewise
  const uint32_t* given_depth;  // where fragments bring their own: 24 bits each
  uint32_t* color;        // rgba8; with a queue, of the tile
  float* color_planes;    // rgba32f
  const float* coverage;  // of the block's pixels, in [0, 1]; where the program asks for it
  const PixelQueue* queue;  // packed fragments instead of the block's, or unused
  TileGroup* groups;        // what primitives cover of a tile; then colour and depth are the tile's
  int group_count;
  TileGroup group;          // that at hand
  unsigned group_lanes;     // bits of the lanes that the groups' primitives have in the batch
  const GroupTables* group_tables;  // where groups may be of several primitives
  const std::byte *lines, *lines_end;  // packets (raster/primitive/line_packet.h); colour is the tile's
  int first_line_plane;                // that stands in them
  const float* line_planes;            // of the line at hand
  alignas(64) float line_dx[16], line_dy[16];  // pixels at hand minus its anchor
  LinePixels* line_pixels;
  uint64_t line_fragments;      // kernels add to it
  StageMeter* meter = nullptr;  // null: nothing is counted
};

using BlockFunction = void (*)(BlockContext&);

}  // namespace halfspace::raster
