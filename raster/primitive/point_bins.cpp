#include "raster/primitive/point_bins.h"

namespace halfspace::raster {

uint32_t PointBins::open(uint32_t tile) {
  PointBin& bin = bins_[tile];
  Piece& piece = pieces_[tile];
  if (piece.run > first_run_) {  // the draw has filled one here
    PointRun& full = runs[piece.run - 1];
    full.count = static_cast<uint32_t>(bin.next - full.packets);
  }
  if (bin.next == piece.end) {
    bin.next = reinterpret_cast<PointPacket*>(memory_.allocate(kPiece * sizeof(PointPacket)));
    piece.end = bin.next + kPiece;
  }
  runs.push_back({bin.next, 0, tile});
  piece.run = runs.size();
  bin.limit = piece.end;
  return static_cast<uint32_t>(runs.size() - 1);
}

size_t PointBins::finish_draw() {
  size_t count = 0;
  for (size_t i = first_run_; i < runs.size(); ++i) {
    PointRun& run = runs[i];
    PointBin& bin = bins_[run.tile];
    if (pieces_[run.tile].run == i + 1) {
      run.count = static_cast<uint32_t>(bin.next - run.packets);
      bin.limit = bin.next;
    }
    count += run.count;
  }
  first_run_ = runs.size();
  return count;
}

void PointBins::clear() {
  for (const PointRun& run : runs) bins_[run.tile] = {}, pieces_[run.tile] = {};
  runs.clear();
  first_run_ = 0;
  memory_.reset();
}

}  // namespace halfspace::raster
