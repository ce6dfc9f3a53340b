#include "gl/glx/fb_config.h"

#include <X11/Xutil.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <span>

namespace halfspace::gl::glx {
namespace {

using raster::PixelLayout;

struct XFreeDeleter {
  void operator()(void* memory) const { XFree(memory); }
};

// How pixels with these masks lie in memory, given that the least significant byte comes first in an XImage
// of ours.
std::optional<PixelLayout> layout_of(const XVisualInfo& info, int bits_per_pixel) {
  const bool red_high = info.red_mask == 0xff0000 && info.blue_mask == 0xff;
  const bool red_low = info.red_mask == 0xff && info.blue_mask == 0xff0000;
  if (info.green_mask == 0xff00 && (red_high || red_low)) {
    if (bits_per_pixel == 32) return red_high ? PixelLayout::bgra : PixelLayout::rgba;
    if (bits_per_pixel == 24) return red_high ? PixelLayout::bgr : PixelLayout::rgb;
  }
  const bool is_565 = info.red_mask == 0xf800 && info.green_mask == 0x7e0 && info.blue_mask == 0x1f;
  if (is_565 && bits_per_pixel == 16) return PixelLayout::rgb565;
  return std::nullopt;
}

int bits_per_pixel_of(Display* display, int depth) {
  int count = 0;
  const std::unique_ptr<XPixmapFormatValues[], XFreeDeleter> formats(XListPixmapFormats(display, &count));
  for (const XPixmapFormatValues& format : std::span(formats.get(), size_t(count))) {
    if (format.depth == depth) return format.bits_per_pixel;
  }
  return 0;
}

std::vector<XVisualInfo> true_color_visuals(Display* display, int screen) {
  XVisualInfo wanted{};
  wanted.screen = screen;
  wanted.c_class = TrueColor;
  int count = 0;
  const std::unique_ptr<XVisualInfo[], XFreeDeleter> found(
      XGetVisualInfo(display, VisualScreenMask | VisualClassMask, &wanted, &count));
  std::vector<XVisualInfo> visuals(found.get(), found.get() + count);
  const VisualID preferred = XVisualIDFromVisual(DefaultVisual(display, screen));
  const auto rank = [preferred](const XVisualInfo& info) {
    return info.visualid == preferred ? 0 : info.depth == 32 ? 2 : 1;
  };
  std::stable_sort(visuals.begin(), visuals.end(),
                   [&](const XVisualInfo& a, const XVisualInfo& b) { return rank(a) < rank(b); });
  return visuals;
}

int color_bits(const FbConfig& config) {
  const state::VisualConfig& bits = config.bits;
  return bits.red_bits + bits.green_bits + bits.blue_bits + bits.alpha_bits;
}

}  // namespace

std::vector<FbConfig> make_configs(Display* display, int screen, int first_id) {
  std::vector<FbConfig> configs;
  for (const XVisualInfo& info : true_color_visuals(display, screen)) {
    FbConfig config;
    config.screen = screen;
    config.visual = info.visual;
    config.visual_id = info.visualid;
    config.depth = info.depth;
    config.bits_per_pixel = bits_per_pixel_of(display, info.depth);
    const std::optional<PixelLayout> layout = layout_of(info, config.bits_per_pixel);
    if (!layout) continue;
    config.layout = *layout;
    // Buffers hold 8 bits a component whatever the screen shows, and 24 bits of depth whatever is asked for. None
    // costs anything before it is used, so every config has them all.
    config.bits.stencil_bits = 8;
    config.bits.accum_bits = 16;
    for (const bool double_buffered : {true, false}) {
      for (const int alpha_bits : {0, 8}) {
        config.id = first_id + int(configs.size());
        config.bits.double_buffered = double_buffered;
        config.bits.alpha_bits = alpha_bits;
        configs.push_back(config);
      }
    }
  }
  return configs;
}

int config_attribute(const FbConfig& config, int attribute, int* value) {
  const state::VisualConfig& bits = config.bits;
  switch (attribute) {
    case GLX_FBCONFIG_ID:
      *value = config.id;
      return 0;
    case GLX_VISUAL_ID:
      *value = int(config.visual_id);
      return 0;
    case GLX_SCREEN:
      *value = config.screen;
      return 0;
    case GLX_BUFFER_SIZE:
      *value = color_bits(config);
      return 0;
    case GLX_DOUBLEBUFFER:
      *value = bits.double_buffered;
      return 0;
    case GLX_RED_SIZE:
      *value = bits.red_bits;
      return 0;
    case GLX_GREEN_SIZE:
      *value = bits.green_bits;
      return 0;
    case GLX_BLUE_SIZE:
      *value = bits.blue_bits;
      return 0;
    case GLX_ALPHA_SIZE:
      *value = bits.alpha_bits;
      return 0;
    case GLX_DEPTH_SIZE:
      *value = bits.depth_bits;
      return 0;
    case GLX_STENCIL_SIZE:
      *value = bits.stencil_bits;
      return 0;
    case GLX_ACCUM_RED_SIZE:
    case GLX_ACCUM_GREEN_SIZE:
    case GLX_ACCUM_BLUE_SIZE:
      *value = bits.accum_bits;
      return 0;
    case GLX_ACCUM_ALPHA_SIZE:
      *value = bits.alpha_bits ? bits.accum_bits : 0;
      return 0;
    case GLX_RENDER_TYPE:
      *value = GLX_RGBA_BIT;
      return 0;
    case GLX_DRAWABLE_TYPE:
      *value = GLX_WINDOW_BIT | GLX_PIXMAP_BIT | GLX_PBUFFER_BIT;
      return 0;
    case GLX_X_VISUAL_TYPE:
      *value = GLX_TRUE_COLOR;
      return 0;
    case GLX_CONFIG_CAVEAT:
      *value = GLX_NONE;
      return 0;
    case GLX_TRANSPARENT_TYPE:
      *value = GLX_NONE;
      return 0;
    case GLX_MAX_PBUFFER_WIDTH:
    case GLX_MAX_PBUFFER_HEIGHT:
      *value = raster::kMaxSurfaceSize;
      return 0;
    case GLX_MAX_PBUFFER_PIXELS:
      *value = raster::kMaxSurfaceSize * raster::kMaxSurfaceSize;
      return 0;
    case GLX_USE_GL:
    case GLX_RGBA:
    case GLX_X_RENDERABLE:
      *value = True;
      return 0;
    case GLX_LEVEL:
    case GLX_STEREO:
    case GLX_AUX_BUFFERS:
    case GLX_SAMPLE_BUFFERS:
    case GLX_SAMPLES:
    case GLX_TRANSPARENT_INDEX_VALUE:
    case GLX_TRANSPARENT_RED_VALUE:
    case GLX_TRANSPARENT_GREEN_VALUE:
    case GLX_TRANSPARENT_BLUE_VALUE:
    case GLX_TRANSPARENT_ALPHA_VALUE:
      *value = 0;
      return 0;
    default:
      return GLX_BAD_ATTRIBUTE;
  }
}

bool compatible(const FbConfig& a, const FbConfig& b) {
  return a.screen == b.screen && a.depth == b.depth && a.layout == b.layout &&
         a.bits.red_bits == b.bits.red_bits && a.bits.green_bits == b.bits.green_bits &&
         a.bits.blue_bits == b.bits.blue_bits && a.bits.alpha_bits == b.bits.alpha_bits &&
         a.bits.depth_bits == b.bits.depth_bits && a.bits.stencil_bits == b.bits.stencil_bits &&
         a.bits.accum_bits == b.bits.accum_bits;
}

}  // namespace halfspace::gl::glx
