// Pixels on their way in and out.
#include <memory>

#include "bench/gl.h"
#include "bench/shapes.h"
#include "bench/workload.h"

namespace halfspace::bench {
namespace {

std::vector<uint32_t> random_pixels(Screen screen) {
  Numbers numbers(23);
  std::vector<uint32_t> pixels;
  const int count = screen.width * screen.height;
  for (int i = 0; i < count; ++i)
    pixels.push_back(static_cast<uint32_t>(numbers.bits() & 0x7f7f7fu) + static_cast<uint32_t>(i));
  return pixels;
}

void draw_textured_screen() {
  gl.Begin(GL_QUADS);
  gl.TexCoord2f(0, 0);
  gl.Vertex2f(-1, -1);
  gl.TexCoord2f(1, 0);
  gl.Vertex2f(1, -1);
  gl.TexCoord2f(1, 1);
  gl.Vertex2f(1, 1);
  gl.TexCoord2f(0, 1);
  gl.Vertex2f(-1, 1);
  gl.End();
}

}  // namespace

Frame readpixels(Screen screen) {
  const auto pixels = std::make_shared<std::vector<uint32_t>>(random_pixels(screen));
  return [pixels, screen] {
    gl.Clear(GL_COLOR_BUFFER_BIT);
    for (int i = 0; i < 8; ++i) {
      const float x = static_cast<float>(i) / 8;
      gl.Color4f(1, x, 0.5F, 1);
      gl.Begin(GL_TRIANGLES);
      gl.Vertex2f(x, -0.5F);
      gl.Vertex2f(x + 0.1F, -0.5F);
      gl.Vertex2f(x, 0.5F);
      gl.End();
      gl.ReadPixels(0, 0, screen.width, screen.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels->data());
    }
    gl.Finish();
  };
}

Frame teximage(Screen screen) {
  const auto pixels = std::make_shared<std::vector<uint32_t>>(random_pixels(screen));
  make_texture(1, 1, false);
  gl.Enable(GL_TEXTURE_2D);
  return [pixels, screen] {
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    // Not the same picture twice.
    ++(*pixels)[static_cast<size_t>(screen.width) * 10];
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, screen.width, screen.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                  pixels->data());
    draw_textured_screen();
    gl.Finish();
  };
}

}  // namespace halfspace::bench
