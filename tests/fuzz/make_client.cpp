// What the client keeps: how pixels are stored, arrays, and their stack.
#include "maker.h"

namespace halfspace::fuzz {
namespace {

// Within a push and a pop, because nobody else expects rows of another length.
void add_stored_pixels(Maker& m) {
  if (m.in_list) return;
  using enum Command;
  m.call(glPushClientAttrib,
         {double(m.random.pick<GLenum>({GL_CLIENT_PIXEL_STORE_BIT, GL_CLIENT_ALL_ATTRIB_BITS}))});
  const auto store = [&](GLenum name, int value) { m.call(glPixelStorei, {double(name), double(value)}); };
  store(GL_UNPACK_ROW_LENGTH, m.random.chance(50) ? m.random.between(24, 40) : 0);
  store(GL_UNPACK_SKIP_ROWS, m.random.between(0, 3));
  store(GL_UNPACK_SKIP_PIXELS, m.random.between(0, 9));
  store(GL_UNPACK_ALIGNMENT, m.random.pick({1, 2, 4, 8}));
  store(GL_UNPACK_SWAP_BYTES, m.random.below(2));
  store(GL_UNPACK_LSB_FIRST, m.random.below(2));
  set_raster_position(m);
  const int width = m.random.between(1, 24), height = m.random.between(1, 16);
  if (m.random.chance(30)) {
    std::vector<uint8_t> bits(1024);
    for (uint8_t& byte : bits) byte = m.random.pick<uint8_t>({0x00, 0xFF, 0xF0, 0x0F});
    m.call(glBitmap, {double(width), double(height), 0, 0, m.random.real(-10, 10), 0, 0}, bits);
    m.call(glFlush);
  } else {
    // Big enough for any row, and even bytes are alike, so that swapped ones are different colours.
    std::vector<uint8_t> image(48 * 20 * 8);
    for (uint8_t& byte : image) byte = static_cast<uint8_t>(m.random.bits());
    const GLenum format = m.transfers ? GL_RGBA : m.random.pick<GLenum>({GL_RGB, GL_RGBA, GL_LUMINANCE});
    const GLenum type =
        m.exact ? GL_UNSIGNED_BYTE : m.random.pick<GLenum>({GL_UNSIGNED_BYTE, GL_UNSIGNED_SHORT});
    m.call(glDrawPixels, {double(width), double(height), double(format), double(type), 0}, image);
  }
  m.call(glPopClientAttrib);
}

// Arrays set between a push and a pop are forgotten; what is drawn afterwards comes from those before.
void add_pushed_arrays(Maker& m) {
  if (m.in_list) return;
  using enum Command;
  draw_with_arrays(m, random_shape(m));
  m.call(glPushClientAttrib, {double(GL_CLIENT_VERTEX_ARRAY_BIT)});
  draw_with_arrays(m, random_shape(m));
  if (m.random.chance(50)) m.call(glDisableClientState, {GL_VERTEX_ARRAY});
  m.call(glPopClientAttrib);
  m.call(glTranslatef, {0, 0, 0.0625});
  m.call(glDrawArrays, {double(m.random.pick<GLenum>({GL_POINTS, GL_LINES, GL_TRIANGLES})), 0, 3});
  reset_current(m);
}

}  // namespace

const std::vector<Feature>& client_features() {
  static const std::vector<Feature> kFeatures = {
      {.group = "client", .add = add_stored_pixels, .draws = true},
      {.group = "client", .add = add_pushed_arrays, .draws = true},
  };
  return kFeatures;
}

}  // namespace halfspace::fuzz
