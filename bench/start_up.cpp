#include "bench/start_up.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>

#include "bench/gl.h"
#include "bench/shapes.h"
#include "bench/workload.h"

namespace halfspace::bench {
namespace {

std::string start_up_library;

void draw_textured_triangle() {
  make_texture(256, 29, false);
  gl.Enable(GL_TEXTURE_2D);
  gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl.Begin(GL_TRIANGLES);
  gl.TexCoord2f(0, 0);
  gl.Vertex2f(-0.9F, -0.8F);
  gl.TexCoord2f(2, 0);
  gl.Vertex2f(0.8F, -0.9F);
  gl.TexCoord2f(1, 2);
  gl.Vertex2f(0.1F, 0.9F);
  gl.End();
  gl.Finish();
}

void run_process(const std::string& library) {
  std::string program = "/proc/self/exe", mode = kFirstFrame, path = library;
  char* const arguments[] = {program.data(), mode.data(), path.data(), nullptr};
  pid_t child = 0;
  if (const int error = posix_spawn(&child, program.c_str(), nullptr, nullptr, arguments, environ);
      error != 0)
    throw std::runtime_error("startup: no process to be had, error " + std::to_string(error));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (status != 0) throw std::runtime_error("startup: the process failed");
}

}  // namespace

void draw_first_frame(const std::string& library_path) {
  const Library library(library_path);
  const Context context(library, {});
  draw_textured_triangle();
  // What it takes to end is not part of the start.
  _exit(gl.GetError() == GL_NO_ERROR ? 0 : 1);
}

void set_start_up_library(const std::string& path) { start_up_library = path; }

Frame startup(Screen) {
  // For the picture.
  draw_textured_triangle();
  return [] { run_process(start_up_library); };
}

}  // namespace halfspace::bench
