// A landscape from a height map, and the texture that dresses it.
#pragma once

#include "ref_app/gapi.h"

namespace ref_app {

inline constexpr int kHeightMapSize = 256;
inline constexpr int kTerrainTextureSize = 1024;
inline constexpr int kTerrainTriangles = 131072;  // 256 x 256 quads

// Heights are in the red channel, 0 lowest. Grey.
Image make_height_map();
// Grass, rock and snow by height and slope, with the light already on it.
Image make_terrain_texture(const Image& heights);

// 257 x 257 vertices over [-1, 1] in x and z, y in [0, height]; white, texture coordinates 0 to 1 (t grows
// towards -z).
Geometry make_terrain(const Image& heights, float height);

}  // namespace ref_app
