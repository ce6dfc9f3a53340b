// glXUseXFont (GLX 1.3, 3.3.12): a display list with a glBitmap for each character of an X font.
#include <memory>
#include <vector>

#include "gl/glx/entry.h"
#include "state/list_compile.h"
#include "state/operations.gen.h"
#include "state/out_of_memory.h"

using namespace halfspace;
using namespace halfspace::gl::glx;

namespace {

struct DestroyImage {
  void operator()(XImage* image) const { XDestroyImage(image); }
};

struct Glyph {
  XCharStruct metrics{};
  std::vector<GLubyte> rows;  // from the lowest up, a bit a pixel, the highest first; none: nothing to see
  int width() const { return metrics.rbearing - metrics.lbearing; }
  int height() const { return metrics.ascent + metrics.descent; }
};

XChar2b char_of(int character) {
  return {static_cast<unsigned char>(character >> 8), static_cast<unsigned char>(character)};
}

// One character as the server draws it.
std::unique_ptr<XImage, DestroyImage> draw_character(Display* display, Font font, int character,
                                                     const Glyph& glyph) {
  const unsigned width = unsigned(glyph.width()), height = unsigned(glyph.height());
  const Pixmap pixmap = XCreatePixmap(display, DefaultRootWindow(display), width, height, 1);
  XGCValues values{};
  values.font = font;
  const GC gc = XCreateGC(display, pixmap, GCFont, &values);
  XSetForeground(display, gc, 0);
  XFillRectangle(display, pixmap, gc, 0, 0, width, height);
  XSetForeground(display, gc, 1);
  const XChar2b text = char_of(character);
  XDrawString16(display, pixmap, gc, -glyph.metrics.lbearing, glyph.metrics.ascent, &text, 1);
  std::unique_ptr<XImage, DestroyImage> image(XGetImage(display, pixmap, 0, 0, width, height, 1, XYPixmap));
  XFreeGC(display, gc);
  XFreePixmap(display, pixmap);
  return image;
}

std::vector<GLubyte> rows_of(XImage& image, int width, int height) {
  const size_t row_bytes = (size_t(width) + 7) / 8;
  std::vector<GLubyte> rows(row_bytes * size_t(height));
  for (int y = 0; y < height; ++y) {
    GLubyte* row = rows.data() + size_t(height - 1 - y) * row_bytes;
    for (int x = 0; x < width; ++x) {
      if (XGetPixel(&image, x, y)) row[x / 8] = GLubyte(row[x / 8] | 0x80 >> x % 8);
    }
  }
  return rows;
}

// Without metrics, and for characters the font lacks: an empty list's advance of nothing.
Glyph read_glyph(Display* display, Font font, int character) {
  Glyph glyph;
  int direction, ascent, descent;
  const XChar2b text = char_of(character);
  XQueryTextExtents16(display, font, &text, 1, &direction, &ascent, &descent, &glyph.metrics);
  if (glyph.width() <= 0 || glyph.height() <= 0) return glyph;
  if (const auto image = draw_character(display, font, character, glyph))
    glyph.rows = rows_of(*image, glyph.width(), glyph.height());
  return glyph;
}

void compile(state::Context& context, GLuint name, const Glyph& glyph) {
  const bool visible = !glyph.rows.empty();
  state::op::new_list(context, name, GL_COMPILE);
  state::kCompileTable.bitmap(context, visible ? glyph.width() : 0, visible ? glyph.height() : 0,
                              GLfloat(-glyph.metrics.lbearing), GLfloat(glyph.metrics.descent),
                              GLfloat(glyph.metrics.width), 0.0f, glyph.rows.data());
  state::op::end_list(context);
}

}  // namespace

extern "C" {

HALFSPACE_EXPORT void glXUseXFont(Font font, int first, int count, int list_base) {
  GlxContext* context = current_context();
  if (!context || !context->display || context->gl->lists.compiler.active()) return;  // GLXBadContextState
  const state::KeptImageStore packed_rows(*context->gl);
  state::guard_memory(*context->gl, [&] {
    for (int i = 0; i < count; ++i)
      compile(*context->gl, GLuint(list_base + i), read_glyph(context->display, font, first + i));
  });
}

}  // extern "C"
