// GLXFBConfig: what a context and a drawable are made for. One X visual carries several of them.
#pragma once

#include <GL/glx.h>

#include <vector>

#include "raster/api/framebuffer.h"
#include "state/drawable.h"

namespace halfspace::gl::glx {

struct FbConfig {
  int id = 0;  // GLX_FBCONFIG_ID, unique within the display
  int screen = 0;
  Visual* visual = nullptr;
  VisualID visual_id = 0;
  int depth = 0;                                           // of the visual and of pixmaps that go with it
  int bits_per_pixel = 0;                                  // in an XImage of that depth
  raster::PixelLayout layout = raster::PixelLayout::bgrx;  // of such an XImage
  state::VisualConfig bits;

  // No alpha: what is seen (and, for a 32-bit visual, blended by a compositor) is opaque.
  bool opaque() const { return bits.alpha_bits == 0; }
};

// GLX_BAD_ATTRIBUTE for an attribute GLX 1.4 does not know, or 0.
int config_attribute(const FbConfig& config, int attribute, int* value);

// Whether drawing made for `a` may go to a drawable made for `b` (GLX 1.4, 2.1 "compatible").
bool compatible(const FbConfig& a, const FbConfig& b);

// All configs of a screen: every TrueColor visual whose pixels we know how to write, each with and without
// alpha, double and single buffered. The default visual comes first, translucent (32-bit) visuals last: with
// all else equal a program gets what needs no colormap of its own. Ids are given from `first_id` on.
std::vector<FbConfig> make_configs(Display* display, int screen, int first_id);

}  // namespace halfspace::gl::glx
