// Pictures of the work itself, for those who want to see how a frame comes to be: HALFSPACE_VIEW.
#pragma once

#include <cstdint>
#include <vector>

#include "raster/fragment/block.h"
#include "raster/surface/framebuffer.h"

namespace halfspace::raster {

// overdraw: how many fragments were made at each pixel. levels: which level of its texture's pyramid it was looked up
// on. tiles: in which way its block was drawn last.
enum class View : uint8_t { none, overdraw, levels, tiles };

// HALFSPACE_VIEW. What is no view is named on stderr; wireframe is one, but drawn by other means.
View view_from_environment();

enum class FragmentPath : uint8_t { none, packed, part, whole, filled };

struct PixelNote {
  uint16_t fragments = 0;
  uint8_t level = 0;  // and one; 0: no pyramid was looked at
  FragmentPath path = FragmentPath::none;
};

// Fragments of one primitive at the pixels of `mask`, in the block whose first pixel is (x, y) of the tile. `pixels`:
// of the tile, row by row. `projective`: texture coordinates come with a q of their own.
void note_fragments(PixelNote* pixels, const SetupBatch& setup, int lane, const FragmentParams& params, bool projective,
                    int x, int y, uint64_t mask, FragmentPath path);

// What was noted of a framebuffer since it was last shown.
class ViewNotes {
 public:
  explicit ViewNotes(View view) : view_(view) {}
  // Starts anew where that is another framebuffer.
  void attend(const Framebuffer::Impl& framebuffer);
  void forget();
  PixelNote* tile(uint32_t tile) { return notes_.data() + size_t{tile} * kTilePixels; }
  // Paints the view over the tile's colours, and forgets its notes.
  void paint_tile(Framebuffer::Impl& framebuffer, uint32_t tile, int plane);

 private:
  const View view_;
  const Framebuffer::Impl* of_ = nullptr;
  std::vector<PixelNote> notes_;
};

}  // namespace halfspace::raster
