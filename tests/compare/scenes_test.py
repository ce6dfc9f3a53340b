"""demo and bench on the libraries of this build: they run, and their reports hold what was drawn.

What the reports judge (differences, speed) is not judged here.

usage: scenes_test.py HALFSPACE
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

from commands_test import WellFormed

HALFSPACE = ""


def run(*arguments):
    return subprocess.run([HALFSPACE, *map(str, arguments)], capture_output=True, text=True, timeout=600)


def system_library_folder():
    """Where the dynamic linker finds libOSMesa.so.8, the system's."""
    listing = subprocess.run(["/sbin/ldconfig", "-p"], capture_output=True, text=True, check=True).stdout
    line = next(line for line in listing.splitlines() if "libOSMesa.so.8 " in line)
    return pathlib.Path(line.split("=>")[1].strip()).parent


class Scenes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = pathlib.Path(folder.name) / "out"

    def test_demo(self):
        done = run("demo", "--scene", 1, "--scene", 4, "--frames", 1, "--out", self.out)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        result = json.loads((self.out / "demo.json").read_text())
        self.assertTrue(result["ours"]["renderer"].startswith("Halfspace"))
        self.assertIn("llvmpipe", result["osmesa"]["renderer"])
        self.assertEqual([scene["scene"] for scene in result["scenes"]], [1, 4])
        for scene in result["scenes"]:
            self.assertGreater(scene["ours_ms"], 0)
            # Another picture altogether would differ in most pixels by more than a level.
            self.assertLess(scene["standard_to_osmesa_float"]["above_8"], 10000)
            # They agree on all but a few pixels' triangle, and where they do on the colour.
            self.assertLess(scene["other_triangle"], 20)
            self.assertLessEqual(scene["standard_to_osmesa_float"]["max_interior"], 1)
        page = WellFormed()
        page.feed((self.out / "report.html").read_text())
        self.assertEqual((page.open, len(page.images)), ([], 8))

    def test_report_again_from_pictures(self):
        run("demo", "--scene", 2, "--frames", 1, "--out", self.out)
        before = json.loads((self.out / "demo.json").read_text())
        (self.out / "demo.json").unlink()
        self.assertEqual(run("demo", "--again", "--out", self.out).returncode, 0)
        self.assertEqual(json.loads((self.out / "demo.json").read_text()), before)
        (self.out / "osmesa" / "scene_2.png").unlink()
        self.assertEqual(run("demo", "--again", "--out", self.out).returncode, 2)

    def test_another_library_is_not_taken_for_ours(self):
        done = run("demo", "--scene", 1, "--frames", 1, "--library", system_library_folder(), "--out", self.out)
        self.assertEqual(done.returncode, 2)
        self.assertIn("drew", done.stderr)

    def assert_is_ratio(self, ratio, values, divisors):
        """It is a median of pairs, so it lies between what the furthest of them could give."""
        self.assertGreaterEqual(ratio, values["lowest"] / divisors["highest"])
        self.assertLessEqual(ratio, values["highest"] / divisors["lowest"])

    def test_bench(self):
        done = run("bench", "scenes", "--scene", 1, "--pairs", 2, "--frames", 1, "--out", self.out)
        self.assertIn(done.returncode, (0, 1), done.stdout + done.stderr)
        result = json.loads((self.out / "scenes.json").read_text())
        self.assertEqual(len(result["scenes"]), 1)
        self.assertEqual(len(result["others"]), 4)
        self.assertEqual(result["good"], done.returncode == 0)
        row = result["scenes"][0]
        self.assertEqual(row["ours"]["count"], 2)
        self.assert_is_ratio(row["ratio"], row["ours"], row["theirs"])
        self.assertEqual(row["good"], row["ratio"] <= row["target"])
        memory = result["others"][-1]
        self.assertGreater(memory["theirs"]["median"], memory["ours"]["median"])
        self.assertTrue((self.out / "scenes.svg").read_text().startswith("<svg "))

    def test_workloads(self):
        done = run("bench", "--only", "clear,tri_1000px,startup", "--rounds", 2, "--no-threads", "--out", self.out)
        self.assertIn(done.returncode, (0, 1), done.stdout + done.stderr)
        result = json.loads((self.out / "workloads.json").read_text())
        self.assertTrue(result["ours"]["renderer"].startswith("Halfspace"))
        self.assertIn("llvmpipe", result["theirs"]["renderer"])
        self.assertEqual([row["name"] for row in result["workloads"]], ["clear", "tri_1000px", "startup"])
        for row in result["workloads"]:
            ours, theirs = row["ours"]["cpu_ms"], row["theirs"]["cpu_ms"]
            self.assertEqual((ours["count"], theirs["count"]), (2, 2))
            self.assert_is_ratio(row["ratio"], theirs, ours)
            self.assertTrue(row["same_picture"], row)
            self.assertEqual(row["good"], row["ratio"] >= row["target"])
            self.assertEqual("limit_ms" in row, row["name"] != "startup")
        self.assertTrue((self.out / "ours" / "startup.png").exists())

    def test_limits(self):
        done = run("bench", "limits", "--seconds", 0.01, "--out", self.out)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        limits = json.loads((self.out / "limits.json").read_text())["per_second"]
        self.assertGreater(limits["bytes_set/16"], limits["bytes_set/262144"] / 2)
        self.assertGreater(limits["pixel_stored"], limits["pixel_interpolated"])

    def test_scale(self):
        done = run("bench", "scale", "--only", "triangles,pixels", "--most", 1000, "--rounds", 1, "--out", self.out)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        curves = json.loads((self.out / "scale.json").read_text())["curves"]
        self.assertEqual([curve["name"] for curve in curves], ["triangles", "pixels"])
        pixels = curves[1]["points"]
        self.assertEqual([point["amount"] for point in pixels], [64, 128, 256, 512])
        # 64 times as many pixels are more work for anyone.
        for who in ("ours", "theirs"):
            self.assertGreater(pixels[3][who]["cpu_ms"], 4 * pixels[0][who]["cpu_ms"])
        self.assertTrue((self.out / "scale_pixels.svg").read_text().startswith("<svg "))

    def test_cores(self):
        done = run("bench", "cores", "--only", "tri_1000px", "--cores", "1,2,16", "--frames", 2, "--out", self.out)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        row = json.loads((self.out / "cores.json").read_text())["workloads"][0]
        # Triangles of that size are shared by tiles; that much any schedule has to find.
        self.assertLess(row["frame_ms"][2], row["frame_ms"][1])
        self.assertLess(row["frame_ms"][1], row["frame_ms"][0])
        self.assertGreater(row["frame_ms"][1], row["work_ms"][1] / 2.001)

    def test_two_builds(self):
        """A build against itself: the same pictures to the bit. A folder without a library is an error."""
        library = pathlib.Path(HALFSPACE).parent.parent
        done = run("bench", "--only", "tri_1000px", "--rounds", 2, "--against", library, "--slower", 300, "--out", self.out)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        row = json.loads((self.out / "against.json").read_text())["workloads"][0]
        self.assertEqual(row["picture"]["differing"], 0)
        self.assertEqual(run("bench", "--against", self.out, "--out", self.out).returncode, 2)
        self.assertEqual(run("bench", "--only", "no_such", "--out", self.out).returncode, 2)


if __name__ == "__main__":
    HALFSPACE = sys.argv.pop(1)
    unittest.main()
