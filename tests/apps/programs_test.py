"""Programs that were built for the system's libGL run on ours: by library path, preloaded, and as libglvnd's vendor.

    programs_test.py DIRECTORY_OF_OUR_LIBGL GLUT_PICTURE

GLUT_PICTURE draws and writes what X shows; the picture must be the same either way, and the system's libGL's, too,
wherever it can draw at all. Run on an X server (with_xvfb.sh).
"""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

OURS = Path(sys.argv[1]).resolve()
GLUT_PICTURE = sys.argv[2]


def environment(**extra):
    clean = {k: v for k, v in os.environ.items() if not k.startswith(("LD_", "HALFSPACE_", "LIBGL", "MESA"))}
    return clean | {k: str(v) for k, v in extra.items()}


BY_PATH = environment(LD_LIBRARY_PATH=OURS)
PRELOADED = environment(LD_PRELOAD=OURS / "libGL.so.1")
BY_VENDOR = environment(LD_LIBRARY_PATH=OURS / "glvnd", __GLX_VENDOR_LIBRARY_NAME="halfspace")
SYSTEM = environment(LIBGL_ALWAYS_SOFTWARE="1")


def run(command, env):
    return subprocess.run([str(c) for c in command], env=env, capture_output=True, text=True, timeout=120)


def read_ppm(path):
    data = Path(path).read_bytes()
    magic, size, top, pixels = data.split(b"\n", 3)
    assert (magic, top) == (b"P6", b"255"), path
    width, height = map(int, size.split())
    assert len(pixels) == width * height * 3, path
    return width, height, pixels


class Programs(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def picture(self, env, name):
        path = self.folder / name
        result = run([GLUT_PICTURE, path], env)
        self.assertEqual(result.returncode, 0, result.stderr)
        if env is not SYSTEM and "HALFSPACE_CAPTURE" not in env:
            self.assertEqual(result.stderr, "")
        return result.stdout, read_ppm(path)

    def test_path_preload_and_vendor_show_the_same(self):
        renderer, by_path = self.picture(BY_PATH, "path.ppm")
        self.assertTrue(renderer.startswith("Halfspace"), renderer)
        renderer, preloaded = self.picture(PRELOADED, "preload.ppm")
        self.assertTrue(renderer.startswith("Halfspace"), renderer)
        self.assertEqual(by_path, preloaded)
        renderer, by_vendor = self.picture(BY_VENDOR, "vendor.ppm")
        self.assertTrue(renderer.startswith("Halfspace"), renderer)
        self.assertEqual(by_path, by_vendor)
        self.assertGreater(len(set(zip(*[iter(by_path[2])] * 3))), 100, "the picture has no content")

    def test_the_system_shows_the_same(self):
        renderer, ours = self.picture(BY_PATH, "ours.ppm")
        self.assertTrue(renderer.startswith("Halfspace"), renderer)
        try:
            renderer, theirs = self.picture(SYSTEM, "theirs.ppm")
        except AssertionError as error:
            self.skipTest(f"the system's libGL does not draw here: {error}")
        self.assertFalse(renderer.startswith("Halfspace"), renderer)
        self.assertEqual(ours[:2], theirs[:2])
        off = [abs(a - b) for a, b in zip(ours[2], theirs[2])]
        # Colours may round apart by one level; a pixel covered by one of the two only would be off by far more.
        self.assertLessEqual(max(off), 1, f"{sum(o > 1 for o in off)} components differ")

    def test_capture_writes_the_swapped_frame(self):
        frames = self.folder / "frames"
        frames.mkdir()
        _, shown = self.picture(BY_PATH | {"HALFSPACE_CAPTURE": str(frames)}, "shown.ppm")
        self.assertEqual([p.name for p in frames.iterdir()], ["frame_00000.ppm"])
        self.assertEqual(read_ppm(frames / "frame_00000.ppm"), shown)

    def test_capture_that_cannot_write_says_so_once(self):
        result = run([GLUT_PICTURE, self.folder / "x.ppm"], BY_PATH | {"HALFSPACE_CAPTURE": "/nonexistent"})
        self.assertEqual(result.returncode, 0)
        self.assertEqual(result.stderr.count("HALFSPACE_CAPTURE"), 1, result.stderr)

    @unittest.skipUnless(shutil.which("glxinfo"), "glxinfo is not installed")
    def test_glxinfo(self):
        for env in (BY_PATH, PRELOADED, BY_VENDOR):
            result = run(["glxinfo"], env)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("OpenGL renderer string: Halfspace", result.stdout)
            self.assertIn("direct rendering: Yes", result.stdout)
            self.assertIn("GLX version: 1.4", result.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
