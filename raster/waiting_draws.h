// Draws that are put aside as they come: another thread than the one that makes the calls shades and
// assembles them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "raster/api/draw_packet.h"
#include "raster/arena.h"
#include "raster/primitive/segment.h"
#include "raster/recycled.h"
#include "raster/surface/framebuffer.h"

namespace halfspace::raster {

struct DrawProgram;  // raster/batch.h

// Of one batch. Who makes the draws adds them; all are then taken up at once, by one thread at a time. What
// one of the two writes and the other reads is as little as can be, since cores may share no cache.
class WaitingDraws {
 public:
  // Whether the draw may wait. It must be worth it: `gathered` says whether larger draws are, which the
  // caller took vertex by vertex.
  static bool may_wait(const DrawPacket& packet, const ShapePlan& shape, const DrawProgram& program,
                       bool gathered);
  // Keeps what take_up() needs of it. The program has to stay until all is drawn.
  void add(const DrawPacket& packet, const DrawProgram& program, uint32_t primitives);
  // Shades and assembles all that have not been yet, in their order; records of vertices come from `arena`.
  void take_up(const Framebuffer::Impl& target, Segment& segment, Arena& arena);
  void clear();

  // All that were added; the others are about those that still wait.
  size_t size() const { return draws_.size(); }
  bool empty() const { return taken_up_ == draws_.size(); }
  size_t primitives() const { return primitives_; }
  size_t bytes_in_use() const { return kept_.bytes_in_use(); }
  // visit(begin, bytes) for the memory that one thread writes and another reads.
  template <class Visit>
  void for_each_used(Visit visit) const {
    kept_.for_each_used(visit);
  }

 private:
  // Of who adds them.
  Arena kept_;
  std::vector<const void*> draws_;                        // in kept_
  size_t taken_up_ = 0;                                   // of these
  std::vector<std::shared_ptr<const DrawState>> states_;  // that programs do not hold
  size_t primitives_ = 0;
  // Draws that go through one program with one state are one to the tiles: they share a record, and their
  // vertices lie one behind the other.
  struct Joined {
    DrawRecord* record = nullptr;
    uint32_t vertices = 0, taken_up = 0;
  };
  void count_vertices();
  void take_up(const void* draw, const Framebuffer::Impl& target, Segment& segment, Arena& arena);
  Joined& joined_for(const void* draw, const Framebuffer::Impl& target, Arena& arena);

  // Of who takes them up.
  std::vector<Joined> joined_;  // by the programs' numbers
  Joined single_;               // for a draw with a state of its own
  Recycled<DrawRecord> records_;
  std::vector<uint16_t> outcodes_;
};

}  // namespace halfspace::raster
