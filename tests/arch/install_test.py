#!/usr/bin/env python3
"""Installs the build into a fresh prefix and builds clients against it: by pkg-config, and by find_package.

    install_test.py CMAKE BUILD_DIR C_COMPILER
"""
import os
import pathlib
import subprocess
import sys
import tempfile

# Triangle over the left half, red 51 of 255; prints the renderer, and a pixel of either half.
OSMESA_CLIENT = r"""
#include <GL/osmesa.h>
#include <stdio.h>

static unsigned char image[32 * 16 * 4];

int main(void) {
  OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, NULL);
  if (!context || !OSMesaMakeCurrent(context, image, GL_UNSIGNED_BYTE, 32, 16)) return 1;
  glClearColor(0, 0, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glColor4ub(51, 102, 153, 255);
  glBegin(GL_QUADS);
  glVertex2f(-1, -1);
  glVertex2f(0, -1);
  glVertex2f(0, 1);
  glVertex2f(-1, 1);
  glEnd();
  glFinish();
  printf("%s\n", (const char*)glGetString(GL_RENDERER));
  for (int x = 5; x < 32; x += 20) {
    const unsigned char* p = image + 4 * (32 * 8 + x);
    printf("%d %d %d %d\n", p[0], p[1], p[2], p[3]);
  }
  OSMesaDestroyContext(context);
  return glGetError() != GL_NO_ERROR;
}
"""
OSMESA_OUTPUT = ["51 102 153 255", "0 0 255 255"]

GL_CLIENT = r"""
#include <GL/glx.h>
#include <stdio.h>

int main(void) {
  printf("%d %d\n", glXGetProcAddressARB((const GLubyte*)"glDrawElements") != NULL,
         glXGetProcAddressARB((const GLubyte*)"glNoSuchName") != NULL);
  return 0;
}
"""

CMAKE_PROJECT = """
cmake_minimum_required(VERSION 3.16)
project(Client C)
find_package(Halfspace REQUIRED)
add_executable(osmesa_client osmesa_client.c)
target_link_libraries(osmesa_client PRIVATE Halfspace::OSMesa)
add_executable(gl_client gl_client.c)
target_link_libraries(gl_client PRIVATE Halfspace::GL)
"""

INSTALLED = ["lib/libGL.so.1", "lib/libGL.so", "lib/libOSMesa.so.8", "lib/libOSMesa.so",
             "lib/glvnd/libGLX_halfspace.so.0", "bin/halfspace", "lib/pkgconfig/gl.pc",
             "lib/pkgconfig/osmesa.pc", "lib/cmake/Halfspace/HalfspaceConfig.cmake"]


class Failure(Exception):
    pass


def run(*command, env=None, cwd=None):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, cwd=cwd,
                          env={**os.environ, **(env or {})})
    if done.returncode != 0:
        raise Failure(f"{' '.join(map(str, command))}: status {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def check_client(program, prefix, expect):
    env = {"LD_LIBRARY_PATH": str(prefix / "lib"), "LD_PRELOAD": ""}
    used = run("ldd", program, env=env)
    if str(prefix / "lib") not in used:
        raise Failure(f"{program} does not use the installed library:\n{used}")
    lines = run(program, env=env).splitlines()
    if not expect(lines):
        raise Failure(f"{program} said {lines}")


def is_our_picture(lines):
    return len(lines) == 3 and "Halfspace" in lines[0] and lines[1:] == OSMESA_OUTPUT


def is_our_gl(lines):
    return lines == ["1 0"]


def check_by_pkg_config(prefix, work, compiler):
    env = {"PKG_CONFIG_PATH": str(prefix / "lib/pkgconfig")}
    for module, source, expect in (("osmesa", "osmesa_client.c", is_our_picture), ("gl", "gl_client.c", is_our_gl)):
        flags = run("pkg-config", "--cflags", "--libs", module, env=env).split()
        program = work / f"{module}_by_pkg_config"
        run(compiler, work / source, "-o", program, *flags)
        check_client(program, prefix, expect)


def check_by_find_package(prefix, work, cmake, compiler):
    (work / "CMakeLists.txt").write_text(CMAKE_PROJECT)
    run(cmake, "-G", "Ninja", "-S", work, "-B", work / "build", f"-DCMAKE_PREFIX_PATH={prefix}", f"-DCMAKE_C_COMPILER={compiler}")
    run(cmake, "--build", work / "build")
    check_client(work / "build/osmesa_client", prefix, is_our_picture)
    check_client(work / "build/gl_client", prefix, is_our_gl)


def check_installation(cmake, build, compiler, folder):
    prefix, work = folder / "prefix", folder / "client"
    work.mkdir()
    run(cmake, "--install", build, "--prefix", prefix)
    missing = [name for name in INSTALLED if not (prefix / name).exists()]
    if missing:
        raise Failure(f"not installed: {missing}")
    (work / "osmesa_client.c").write_text(OSMESA_CLIENT)
    (work / "gl_client.c").write_text(GL_CLIENT)
    run(prefix / "bin/halfspace", "--version")
    check_by_pkg_config(prefix, work, compiler)
    check_by_find_package(prefix, work, cmake, compiler)


def main():
    cmake, build, compiler = sys.argv[1:4]
    with tempfile.TemporaryDirectory() as folder:
        try:
            check_installation(cmake, pathlib.Path(build), compiler, pathlib.Path(folder).resolve())
        except Failure as failure:
            print(failure)
            return 1
    print("installed, and used by pkg-config and by find_package")
    return 0


sys.exit(main())
