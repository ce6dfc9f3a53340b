#include "raster/primitive/packet_bins.h"

namespace halfspace::raster {
namespace {
constexpr size_t kAlignment = 8;  // of packets
}

uint32_t PacketBins::open(uint32_t tile) {
  PacketBin& bin = bins_[tile];
  Piece& piece = pieces_[tile];
  if (piece.run > first_run_) {  // the draw has filled one here
    PacketRun& full = runs[piece.run - 1];
    full.bytes = static_cast<uint32_t>(bin.next - full.packets);
  }
  // The draw before had packets of another size, maybe.
  bin.next += -reinterpret_cast<uintptr_t>(bin.next) % kAlignment;
  if (static_cast<size_t>(piece.end - bin.next) < largest_) {
    bin.next = memory_.allocate(piece_bytes_);
    piece.end = bin.next + piece_bytes_;
  }
  runs.push_back({bin.next, 0, tile});
  piece.run = runs.size();
  // Whole packets, since whoever fills it may look only for the end.
  const size_t room = static_cast<size_t>(piece.end - bin.next);
  bin.limit = bin.next + room / largest_ * largest_;
  return static_cast<uint32_t>(runs.size() - 1);
}

size_t PacketBins::finish_draw() {
  size_t bytes = 0;
  for (size_t i = first_run_; i < runs.size(); ++i) {
    PacketRun& run = runs[i];
    PacketBin& bin = bins_[run.tile];
    if (pieces_[run.tile].run == i + 1) {
      run.bytes = static_cast<uint32_t>(bin.next - run.packets);
      bin.limit = bin.next;
    }
    bytes += run.bytes;
  }
  first_run_ = runs.size();
  return bytes;
}

void PacketBins::clear() {
  for (const PacketRun& run : runs) bins_[run.tile] = {}, pieces_[run.tile] = {};
  runs.clear();
  first_run_ = 0;
  memory_.reset();
}

}  // namespace halfspace::raster
