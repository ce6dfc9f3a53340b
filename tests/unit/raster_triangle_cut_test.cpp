// Eight triangles at once are cut as the clipper cuts each: the same pieces, bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "raster/primitive/clip.h"
#include "raster/primitive/triangle_cut.h"
#include "tests/unit/raster_front.h"

namespace halfspace::raster {
namespace {

using test::Front;

using Piece = std::array<std::array<int32_t, 2>, 3>;

void add_piece(const int32_t (&x)[3], const int32_t (&y)[3], std::vector<Piece>& pieces) {
  if (triangle_area(x, y) == 0) return;
  Piece piece;
  for (size_t k = 0; k < 3; ++k) piece[k] = {x[k], y[k]};
  std::sort(piece.begin(), piece.end());
  pieces.push_back(piece);
}

std::vector<Piece> sorted(std::vector<Piece> pieces) {
  std::sort(pieces.begin(), pieces.end());
  return pieces;
}

std::vector<Piece> pieces_of(const Clipper::Polygon& polygon) {
  std::vector<Piece> pieces;
  for (int i = 0; i < polygon.triangle_count; ++i) {
    const CutTriangle piece = polygon.triangle_at(i, 0);
    add_piece(piece.x, piece.y, pieces);
  }
  return sorted(pieces);
}

std::vector<Piece> pieces_of(const DepthCut& cut, uint32_t lane) {
  std::vector<Piece> pieces;
  for (int piece = 0; piece < 2; ++piece) {
    const int second = 1 + piece, third = 2 + piece;
    const int32_t x[3] = {cut.x[0][lane], cut.x[second][lane], cut.x[third][lane]};
    const int32_t y[3] = {cut.y[0][lane], cut.y[second][lane], cut.y[third][lane]};
    EXPECT_EQ(cut.has_piece[piece] >> lane & 1, triangle_area(x, y) != 0 ? 1u : 0u);
    add_piece(x, y, pieces);
  }
  return sorted(pieces);
}

// Triangles of some pixels' size or less around the near or the far plane; `w`: of either sign where it is
// not 1.
void add_triangle(Front& f, std::mt19937& random, bool perspective) {
  std::uniform_real_distribution<float> unit(-1, 1);
  const float size = std::pow(10.0F, -1.5F + 1.5F * unit(random)), side = unit(random) < 0 ? -1.0F : 1.0F;
  const float x = unit(random), y = unit(random);
  for (int k = 0; k < 3; ++k) {
    const float w = perspective ? 1 + 1.2F * unit(random) : 1;
    f.add((x + size * unit(random)) * w, (y + size * unit(random)) * w, side * w + size * unit(random), w);
  }
}

uint32_t outcodes_of(const Front& f, const uint32_t* v) {
  const auto& codes = f.record.vertices.outcodes;
  return uint32_t{codes[v[0]]} | codes[v[1]] | codes[v[2]];
}

// How many of the triangles were cut.
uint32_t compare(const Front& f, DepthCut& cut) {
  const Clipper clipper(f.record);
  ClipVertex clip[kCutLanes][3];
  for (uint32_t lane = 0; lane < cut.count; ++lane) {
    for (int k = 0; k < 3; ++k) clip[lane][k] = f.record.vertices.clip[cut.v[lane][k]];
    cut.clip[lane] = clip[lane];
  }
  triangle_cut_functions().cut_at_depth(f.record.vertices, make_window_transform(f.state->viewport), cut);
  uint32_t compared = 0;
  for (uint32_t lane = 0; lane < cut.count; ++lane) {
    if (cut.not_cut >> lane & 1) continue;
    Clipper::Polygon polygon;
    clipper.clip_triangle(cut.v[lane], outcodes_of(f, cut.v[lane]), polygon);
    EXPECT_EQ(polygon.area, int64_t(cut.area[lane]));
    EXPECT_EQ(pieces_of(polygon), pieces_of(cut, lane));
    if (polygon.count >= 3) {
      const int lowest = polygon.lowest();
      EXPECT_EQ(polygon.x[lowest], cut.x[0][lane]);
      EXPECT_EQ(polygon.y[lowest], cut.y[0][lane]);
    }
    ++compared;
  }
  return compared;
}

void compare_many(bool perspective, uint32_t at_least) {
  std::mt19937 random(perspective ? 5 : 3);
  uint32_t compared = 0, crossing = 0;
  for (int round = 0; round < 200; ++round) {
    Front f;
    for (int i = 0; i < 40; ++i) add_triangle(f, random, perspective);
    f.shade();
    DepthCut cut{};
    for (uint32_t v = 0; v < f.vertex_count(); v += 3) {
      const uint32_t corners[3] = {v, v + 1, v + 2};
      if (!crosses_depth_alone(outcodes_of(f, corners))) continue;
      cut.far[cut.count] = (outcodes_of(f, corners) & kOutFar) != 0;
      std::copy_n(corners, 3, cut.v[cut.count]);
      ++crossing;
      // Now and then lanes are left over.
      if (++cut.count == (round % 3 == 0 ? 5 : kCutLanes)) compared += compare(f, cut), cut = {};
    }
    compared += compare(f, cut);
  }
  EXPECT_GT(compared, at_least);
  EXPECT_GT(compared, crossing / 4);
}

TEST(TriangleCut, PiecesAreTheClippers) { compare_many(false, 3000); }
TEST(TriangleCut, PiecesOfPerspectiveAreTheClippers) { compare_many(true, 1000); }

// What has no corner left, and what has no corner cut off.
TEST(TriangleCut, LeavesWhatDoesNotCross) {
  Front f;
  for (float z : {-2.0F, -0.5F}) f.add(-0.5F, 0, z), f.add(0.5F, 0, z), f.add(0, 0.5F, z);
  f.add(-0.5F, 0, -0.5F), f.add(0.5F, 0, -0.5F), f.add(0, 0.5F, -2.0F);
  f.shade();
  DepthCut cut{};
  for (uint32_t lane = 0; lane < 3; ++lane)
    for (uint32_t k = 0; k < 3; ++k) cut.v[lane][k] = 3 * lane + k;
  cut.count = 3;
  EXPECT_EQ(compare(f, cut), 1u);
  EXPECT_EQ(cut.not_cut, 3u);
}

}  // namespace
}  // namespace halfspace::raster
