#include "raster/primitive/cut_faces.h"

#include <algorithm>
#include <utility>

#include "raster/tile/settled_planes.h"

namespace halfspace::raster {

CutFaces::CutFaces(const DrawRecord& draw, const Clipper& clipper, const FacingRule& facing, Segment& segment)
    : draw_(draw),
      clipper_(clipper),
      facing_(facing),
      segment_(segment),
      window_(make_window_transform(draw.state->viewport)) {
  job_.count = 0;
}

void CutFaces::add(const uint32_t* v, unsigned outcodes, uint8_t provoking) {
  Face& face = faces_[count_++];
  std::copy_n(v, 3, face.v);
  for (int k = 0; k < 3; ++k) face.clip[k] = draw_.vertices.clip[v[k]];
  face.outcodes = outcodes;
  face.provoking = v[provoking];
  face.pieces = {0, 0, false};
}

void CutFaces::cut() {
  segment_.clipped += count_;
  uint32_t at_depth[kCutLanes], waiting = 0;
  for (uint32_t i = 0; i < count_; ++i) {
    if (!crosses_depth_alone(faces_[i].outcodes)) {
      cut_by_all(i);
      continue;
    }
    at_depth[waiting++] = i;
    if (waiting == kCutLanes) cut_at_depth(at_depth, std::exchange(waiting, 0));
  }
  if (waiting != 0) cut_at_depth(at_depth, waiting);
  make_planes();
  count_ = asked_ = 0;
}

void CutFaces::cut_at_depth(const uint32_t* faces, uint32_t count) {
  DepthCut cut;
  cut.count = count;
  for (uint32_t lane = 0; lane < count; ++lane) {
    const Face& face = faces_[faces[lane]];
    std::copy_n(face.v, 3, cut.v[lane]);
    cut.clip[lane] = face.clip;
    cut.far[lane] = (face.outcodes & kOutFar) != 0;
  }
  functions_.cut_at_depth(draw_.vertices, window_, cut);
  for (uint32_t lane = 0; lane < count; ++lane) {
    const uint32_t face = faces[lane];
    if (cut.not_cut >> lane & 1) {
      cut_by_all(face);
      continue;
    }
    const auto area = int64_t(cut.area[lane]);
    if (facing_.is_culled(area)) {
      ++segment_.culled;
      continue;
    }
    take(face, area, cut.x[0][lane], cut.y[0][lane]);
    for (int piece = 0; piece < 2; ++piece) {
      if ((cut.has_piece[piece] >> lane & 1) == 0) continue;
      const auto corner = [&](int k) { return k == 0 ? 0 : k + piece; };
      CutTriangle triangle;
      for (int k = 0; k < 3; ++k)
        triangle.x[k] = cut.x[corner(k)][lane], triangle.y[k] = cut.y[corner(k)][lane];
      add_piece(face, triangle);
    }
    if (job_.count == kCutLanes) make_planes();
  }
}

void CutFaces::cut_by_all(uint32_t face) {
  Clipper::Polygon polygon;
  clipper_.clip_triangle(faces_[face].v, faces_[face].outcodes, polygon);
  if (polygon.count < 3 || facing_.is_culled(polygon.area)) {
    ++segment_.culled;
    return;
  }
  const int lowest = polygon.lowest();
  take(face, polygon.area, polygon.x[lowest], polygon.y[lowest]);
  for (int i = 0; i < polygon.triangle_count; ++i) {
    const CutTriangle piece = polygon.triangle_at(i, 0);
    if (triangle_area(piece.x, piece.y) != 0) add_piece(face, piece);
  }
  if (job_.count == kCutLanes) make_planes();
}

// Something is left of the face.
void CutFaces::take(uint32_t face, int64_t area, int32_t anchor_x, int32_t anchor_y) {
  Face& of = faces_[face];
  of.pieces = {uint32_t(segment_.cut_triangles.size()), 0, facing_.is_back(area)};
  const uint32_t lane = job_.count++;
  of_job_[lane] = face;
  std::copy_n(of.v, 3, job_.v[lane]);
  job_.clip[lane] = of.clip;
  job_.back[lane] = of.pieces.back;
  job_.anchor_x[lane] = anchor_x, job_.anchor_y[lane] = anchor_y;
}

// Of the face taken last.
void CutFaces::add_piece(uint32_t face, const CutTriangle& piece) {
  segment_.cut_triangles.push_back(piece);
  ++faces_[face].pieces.count;
}

// What has no usable planes leaves no pieces.
void CutFaces::make_planes() {
  if (job_.count == 0) return;
  functions_.make_planes(draw_.vertices, window_, job_);
  const uint32_t first = faces_[of_job_[0]].pieces.first;
  uint32_t kept = first;
  for (uint32_t lane = 0; lane < job_.count; ++lane) {
    Face& face = faces_[of_job_[lane]];
    Pieces& pieces = face.pieces;
    if (!(job_.usable >> lane & 1)) {
      ++segment_.culled;
      pieces.count = 0;
      continue;
    }
    CutTriangle* const all = segment_.cut_triangles.data();
    for (uint32_t i = 0; i < pieces.count; ++i) {
      all[kept + i] = all[pieces.first + i];
      all[kept + i].source = lane;
    }
    pieces.first = std::exchange(kept, kept + pieces.count);
    job_.planes[lane].provoking = face.provoking;
  }
  segment_.cut_triangles.resize(kept);
  settle_pieces(draw_, PrimitiveKind::triangle, first, job_.planes, segment_);
  job_.count = 0;
}

}  // namespace halfspace::raster
