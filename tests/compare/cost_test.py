"""halfspace cost on the libraries of this build, at sizes that take seconds.

The oracle judges, so what is asserted of the pixels is what the numeric contract promises of standard and exact.

usage: cost_test.py HALFSPACE REF_APP_OSMESA
"""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

HALFSPACE = REF_APP = ""


def run(*arguments):
    return subprocess.run([HALFSPACE, "cost", *map(str, arguments)], capture_output=True, text=True, timeout=600)


class Cost(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = pathlib.Path(folder.name) / "out"

    def test_levels_of_two_scenes(self):
        done = run("--scenes", "4,5", "--no-axes", "--size", "64x48", "--rounds", 2, "--frames", 1, "--out", self.out)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        result = json.loads((self.out / "cost.json").read_text())
        self.assertTrue(result["oracle"].startswith("Halfspace oracle"))
        self.assertEqual([scene["scene"] for scene in result["scenes"]], ["4 textured cube", "5 solids on a plane"])
        for scene in result["scenes"]:
            points = {point["setting"]: point for point in scene["points"]}
            self.assertEqual(set(points), {"draft", "standard", "exact", "llvmpipe", "llvmpipe, float filter", "softpipe"})
            for level, limit in ("standard", 0.55), ("exact", 0.5001):
                error = points[level]["error"]
                self.assertEqual(error["pixels"], 64 * 48)
                self.assertLessEqual(error["max_levels"], limit)
                self.assertFalse(error["coverage_is_inferred"])
            for level in "draft", "standard", "exact":
                self.assertEqual(points[level]["error"]["coverage"], 0)
            # 8-bit filter weights show, so the pictures are not all of one renderer.
            self.assertGreater(points["llvmpipe"]["error"]["wrong"], points["standard"]["error"]["wrong"])
            self.assertGreater(points["standard"]["ms"]["median"], 0)
            self.assertGreater(points["standard"]["error"]["texels"]["pixels"], 0)
            self.assertLess(points["standard"]["error"]["texels"]["max"], 1 / 64)
        with open(self.out / "cost.csv", newline="") as file:
            self.assertEqual(len(list(csv.DictReader(file))), 12)
        self.assertTrue((self.out / "cost.svg").read_text().startswith("<svg "))

    def test_effects_that_are_off_do_nothing(self):
        done = run("--effects", "--size", "64x64", "--rounds", 1, "--frames", 1, "--out", self.out)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        result = json.loads((self.out / "effects.json").read_text())
        self.assertEqual(result["done_while_off"], 0)
        self.assertEqual(result["idle"]["fragments_by_stage"], result["steps"][0]["fragments_by_stage"])
        self.assertEqual([step["name"] for step in result["steps"]][-1], "alpha_test")

    def test_a_program(self):
        done = run("--no-axes", "--no-mesa", "--frame", 1, "--rounds", 1, "--out", self.out, "--", REF_APP, "--scene", 4,
                   "--size", "64x48", "--frames", 2, "--no-pictures")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        [scene] = json.loads((self.out / "cost.json").read_text())["scenes"]
        points = {point["setting"]: point for point in scene["points"]}
        self.assertEqual(set(points), {"draft", "standard", "exact"})
        for level, limit in ("standard", 0.55), ("exact", 0.5001):
            self.assertEqual(points[level]["error"]["pixels"], 64 * 48)
            self.assertLessEqual(points[level]["error"]["max_levels"], limit)
        self.assertGreater(points["draft"]["error"]["wrong"], 0)

    def test_a_program_that_shows_too_few_frames(self):
        done = run("--no-axes", "--no-mesa", "--frame", 9, "--rounds", 1, "--out", self.out, "--", REF_APP, "--scene", 4,
                   "--size", "64x48", "--frames", 2, "--no-pictures")
        self.assertEqual(done.returncode, 2)
        self.assertIn("there is no frame 9", done.stderr)

    def test_a_scene_there_is_not(self):
        done = run("--scenes", "9", "--out", self.out)
        self.assertEqual(done.returncode, 2)
        self.assertIn("there is no scene 9", done.stderr)


if __name__ == "__main__":
    HALFSPACE, REF_APP = sys.argv.pop(1), sys.argv.pop(1)
    unittest.main()
