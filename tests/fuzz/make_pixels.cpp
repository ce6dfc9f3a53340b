// Pixel rectangles, bitmaps and what they go through.
#include "maker.h"

namespace halfspace::fuzz {
namespace {

void set_unpacking(Maker& m) {
  m.call(Command::glPixelStorei, {GL_UNPACK_ALIGNMENT, double(m.random.pick({1, 1, 2, 4, 8}))});
  m.call(Command::glPixelStorei, {GL_UNPACK_LSB_FIRST, double(m.random.below(2))});
}

void add_draw_pixels(Maker& m) {
  set_raster_position(m);
  const int width = m.random.between(1, 24), height = m.random.between(1, 16);
  // What a format does not have is mapped and scaled, too, but not by Mesa.
  const GLenum format = m.transfers
                            ? m.random.pick<GLenum>({GL_RGB, GL_RGBA})
                            : m.random.pick<GLenum>({GL_RGB, GL_RGBA, GL_LUMINANCE, GL_LUMINANCE_ALPHA,
                                                     GL_ALPHA, GL_RED, GL_GREEN, GL_BLUE});
  const GLenum type =
      m.random.pick<GLenum>({GL_UNSIGNED_BYTE, GL_UNSIGNED_BYTE, GL_UNSIGNED_SHORT, GL_FLOAT});
  const int components = format == GL_RGB ? 3 : format == GL_RGBA ? 4 : format == GL_LUMINANCE_ALPHA ? 2 : 1;
  m.call(Command::glPixelStorei, {GL_UNPACK_ALIGNMENT, 1});
  const auto count = static_cast<size_t>(width * height * components);
  std::vector<uint8_t> image;
  if (type == GL_FLOAT) {
    std::vector<float> numbers(count);
    for (float& n : numbers) n = static_cast<float>(m.exact ? m.random.level() : m.random.real(-0.25, 1.25));
    image = bytes_of(numbers);
  } else if (type == GL_UNSIGNED_SHORT) {
    std::vector<GLushort> numbers(count);
    for (GLushort& n : numbers) n = static_cast<GLushort>(m.random.below(256) * 257);
    image = bytes_of(numbers);
  } else {
    for (size_t i = 0; i < count; ++i) image.push_back(static_cast<uint8_t>(m.random.bits()));
  }
  m.call(Command::glDrawPixels, {double(width), double(height), double(format), double(type), 0}, image);
}

void add_bitmap(Maker& m) {
  set_raster_position(m);
  set_unpacking(m);
  const int width = m.random.between(1, 40), height = m.random.between(1, 16);
  std::vector<uint8_t> bits(static_cast<size_t>(((width + 63) / 64) * 8 * height));
  // In lumps: a bitmap may be a pixel off, positions being rounded down.
  for (uint8_t& byte : bits) byte = m.random.pick<uint8_t>({0x00, 0xFF, 0xF0, 0x0F});
  const int repeats = m.random.between(1, 3);
  for (int i = 0; i < repeats; ++i) {
    m.call(Command::glBitmap,
           {double(width), double(height), m.random.real(0, 4), m.random.real(0, 4), m.random.real(-10, 40),
            m.random.real(-4, 10), 0},
           bits);
    // Else Mesa gathers bitmaps, and draws once where they overlap.
    m.call(Command::glFlush);
  }
}

void add_copy_pixels(Maker& m) {
  set_raster_position(m);
  // Zoomed, an edge that is a pixel off would be several off.
  m.call(Command::glPixelZoom, {1, 1});
  m.call(Command::glCopyPixels, {double(m.random.below(60)), double(m.random.below(40)),
                                 double(m.random.between(1, 30)), double(m.random.between(1, 30)), GL_COLOR});
}

void add_stencil_pixels(Maker& m) {
  set_raster_position(m);
  const int width = m.random.between(1, 24), height = m.random.between(1, 16);
  std::vector<uint8_t> image(static_cast<size_t>(width * height));
  for (uint8_t& byte : image) byte = static_cast<uint8_t>(m.random.below(4));
  m.call(Command::glPixelStorei, {GL_UNPACK_ALIGNMENT, 1});
  m.call(Command::glDrawPixels, {double(width), double(height), GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, 0},
         image);
}

void add_depth_pixels(Maker& m) {
  set_raster_position(m);
  const int width = m.random.between(1, 24), height = m.random.between(1, 16);
  std::vector<float> image(static_cast<size_t>(width * height));
  for (float& depth : image) depth = static_cast<float>(m.random.real(0, 1));
  m.call(Command::glDrawPixels, {double(width), double(height), GL_DEPTH_COMPONENT, GL_FLOAT, 0}, image);
}

// Whole numbers: which of two rows is seen in one pixel, depends on where a corner is to the last bit.
void add_zoom(Maker& m) {
  const auto zoom = [&] { return m.random.pick({1.0, 2.0, 3.0, -1.0, -2.0}); };
  const double x = zoom(), y = zoom();
  m.call(Command::glPixelZoom, {x, y});
}

void add_transfer(Maker& m) {
  m.transfers = true;
  if (m.random.chance(70)) {
    const double name = m.random.pick({GL_RED_SCALE, GL_GREEN_SCALE, GL_BLUE_SCALE, GL_ALPHA_SCALE,
                                       GL_RED_BIAS, GL_GREEN_BIAS, GL_BLUE_BIAS, GL_ALPHA_BIAS});
    m.call(Command::glPixelTransferf, {name, m.random.real(-0.5, 1.5)});
    return;
  }
  const double map =
      m.random.pick({GL_PIXEL_MAP_R_TO_R, GL_PIXEL_MAP_G_TO_G, GL_PIXEL_MAP_B_TO_B, GL_PIXEL_MAP_A_TO_A});
  std::vector<float> table(static_cast<size_t>(1 << m.random.between(0, 4)));
  for (float& entry : table) entry = static_cast<float>(m.random.real(0, 1));
  m.call(Command::glPixelMapfv, {map, double(table.size()), 0}, table);
  m.call(Command::glPixelTransferi, {GL_MAP_COLOR, double(m.random.below(2))});
}

}  // namespace

void set_raster_position(Maker& m) {
  const std::vector<float> color = m.color();
  m.call(Command::glColor4f, {double(color[0]), double(color[1]), double(color[2]), double(color[3])});
  m.set_enabled(GL_LIGHTING, false);
  m.call(Command::glRasterPos3f,
         {m.random.real(-0.9, 0.7), m.random.real(-0.9, 0.7), m.random.real(-0.5, 0.5)});
  // Mesa does not texture what it copies, nor with the raster position's coordinates.
  m.set_enabled(GL_TEXTURE_1D, false);
  m.set_enabled(GL_TEXTURE_2D, false);
  // Nor does it take the raster position's distance for fog, light it as it lights a point, or mind the
  // colour mask when it copies.
  m.set_enabled(GL_FOG, false);
  m.call(Command::glColorMask, {1, 1, 1, 1});
}

const std::vector<Feature>& pixel_features() {
  static const std::vector<Feature> kFeatures = {
      {.group = "draw_pixels", .add = add_draw_pixels, .weight = 2, .draws = true},
      {.group = "bitmap", .add = add_bitmap, .draws = true},
      {.group = "copy_pixels", .add = add_copy_pixels, .draws = true},
      {.group = "stencil_pixels", .add = add_stencil_pixels, .draws = true},
      {.group = "depth_pixels", .add = add_depth_pixels, .draws = true},
      {"pixel_zoom", add_zoom},
      {.group = "pixel_transfer", .add = add_transfer, .exact = false},
  };
  return kFeatures;
}

}  // namespace halfspace::fuzz
