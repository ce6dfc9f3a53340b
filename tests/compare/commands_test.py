"""The halfspace command as a user meets it: exit statuses, reports, frames captured, arguments handed on.

usage: commands_test.py HALFSPACE
"""

import html.parser
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HALFSPACE = ""


def write_ppm(path, pixels, width, height):
    """pixels: (red, green, blue) by rows from the top."""
    path.parent.mkdir(parents=True, exist_ok=True)
    data = bytes(level for pixel in pixels for level in pixel)
    path.write_bytes(b"P6\n%d %d\n255\n" % (width, height) + data)


def run(*arguments, **environment):
    return subprocess.run([HALFSPACE, *map(str, arguments)], capture_output=True, text=True, timeout=120,
                          env={**os.environ, **environment})


class WellFormed(html.parser.HTMLParser):
    """Fails on tags that do not nest, and keeps the sources of the pictures."""

    VOID = {"meta", "img", "br"}

    def __init__(self):
        super().__init__()
        self.open, self.images, self.text = [], [], ""

    def handle_starttag(self, tag, attributes):
        if tag == "img":
            self.images.append(dict(attributes)["src"])
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, f"</{tag}> closes {self.open[-1:]}"
        self.open.pop()

    def handle_data(self, data):
        self.text += data


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    def status(self, wanted, *arguments, **environment):
        done = run(*arguments, **environment)
        self.assertEqual(done.returncode, wanted, done.stdout + done.stderr)
        return done


class Compare(Case):
    def setUp(self):
        super().setUp()
        flat = [(100, 100, 100)] * 400
        off = list(flat)
        off[0], off[21], off[399] = (101, 100, 100), (100, 97, 100), (100, 100, 112)
        write_ppm(self.path / "a.ppm", flat, 20, 20)
        write_ppm(self.path / "b.ppm", off, 20, 20)
        write_ppm(self.path / "small.ppm", flat[:100], 10, 10)
        self.a, self.b = self.path / "a.ppm", self.path / "b.ppm"

    def test_any_difference_is_too_much_by_default(self):
        self.status(0, "compare", self.a, self.a)
        self.status(1, "compare", self.a, self.b)

    def test_stated_limits_decide(self):
        self.status(0, "compare", self.a, self.b, "--max-differing", 0.75)
        self.status(1, "compare", self.a, self.b, "--max-differing", 0.74)
        self.status(0, "compare", self.a, self.b, "--max-difference", 12)
        self.status(1, "compare", self.a, self.b, "--max-difference", 11)
        self.status(1, "compare", self.a, self.b, "--max-interior", 11)
        mask = [(0, 0, 0)] * 399 + [(255, 255, 255)]
        write_ppm(self.path / "mask.ppm", mask, 20, 20)
        self.status(0, "compare", self.a, self.b, "--max-interior", 3, "--mask", self.path / "mask.ppm")
        self.status(1, "compare", self.a, self.b, "--max-interior", 2, "--mask", self.path / "mask.ppm")

    def test_what_cannot_be_compared(self):
        for other in ("missing.ppm", "small.ppm", "."):
            self.status(2, "compare", self.a, self.path / other)
        (self.path / "noise.png").write_text("no picture")
        self.status(2, "compare", self.a, self.path / "noise.png")
        self.status(2, "compare", self.a)
        self.status(2, "compare", self.a, self.b, "--max-differing", "many")

    def test_json_has_the_known_numbers(self):
        self.status(1, "compare", self.a, self.b, "--json", self.path / "out" / "result.json")
        result = json.loads((self.path / "out" / "result.json").read_text())
        difference = result["pictures"][0]["difference"]
        self.assertEqual(result["status"], 1)
        self.assertEqual(difference["differing"], 3)
        self.assertEqual([difference[key] for key in ("above_1", "above_2", "above_8")], [2, 2, 1])
        self.assertEqual(difference["max"], 12)
        self.assertAlmostEqual(difference["channels"]["green"]["mean"], 3 / 400)
        self.assertEqual((difference["worst"]["x"], difference["worst"]["y"]), (19, 19))

    def test_html_stands_alone(self):
        self.status(1, "compare", self.a, self.b, "--html", self.path / "report.html")
        page = WellFormed()
        page.feed((self.path / "report.html").read_text())
        self.assertEqual(page.open, [])
        self.assertEqual(len(page.images), 5)
        for source in page.images:
            self.assertTrue(source.startswith("data:image/png;base64,"), source[:40])
        self.assertIn("3 pixels differ (0.75 %)", page.text)

    def test_folders_meet_by_name(self):
        first, second = self.path / "first", self.path / "second"
        write_ppm(first / "one.ppm", [(1, 2, 3)] * 4, 2, 2)
        write_ppm(second / "one.ppm", [(1, 2, 3)] * 4, 2, 2)
        write_ppm(first / "deep" / "two.ppm", [(1, 2, 3)], 1, 1)
        write_ppm(second / "deep" / "two.ppm", [(1, 2, 3)], 1, 1)
        (first / "notes.txt").write_text("no picture")
        self.status(0, "compare", first, second)
        write_ppm(second / "deep" / "two.ppm", [(1, 2, 4)], 1, 1)
        self.status(1, "compare", first, second)
        write_ppm(first / "three.ppm", [(1, 2, 3)], 1, 1)
        done = self.status(2, "compare", first, second)
        self.assertIn("three", done.stderr)

    def test_two_pictures_of_one_name_are_not_guessed(self):
        write_ppm(self.path / "x" / "one.ppm", [(1, 2, 3)], 1, 1)
        (self.path / "x" / "one.pnm").write_bytes((self.path / "x" / "one.ppm").read_bytes())
        self.status(2, "compare", self.path / "x", self.path / "x")


class Run(Case):
    def setUp(self):
        super().setUp()
        # Any folder with a file of the name will do: sh does not load it.
        self.library = self.path / "lib"
        self.library.mkdir()
        (self.library / "libGL.so.1").touch()

    def start(self, wanted, *arguments, **environment):
        return self.status(wanted, "run", "--library", self.library, *arguments, **environment)

    def test_hands_on_arguments_and_status(self):
        done = self.start(7, "sh", "-c", 'echo "$0|$1|$2"; exit 7', "--capture", "a b", "-x")
        self.assertEqual(done.stdout, "--capture|a b|-x\n")

    def test_two_dashes_end_our_options(self):
        done = self.start(7, "--", "sh", "-c", 'echo "$0|$1|$2"; exit 7', "--capture", "--", "-x")
        self.assertEqual(done.stdout, "--capture|--|-x\n")
        self.start(0, "--stats", "--", "true")
        self.start(2, "--")

    def test_our_folder_comes_first(self):
        done = self.start(0, "sh", "-c", "echo $LD_LIBRARY_PATH", LD_LIBRARY_PATH="/before:/that")
        self.assertEqual(done.stdout, f"{self.library}:/before:/that\n")

    def test_what_to_look_at_is_handed_on(self):
        for option, variable, value in (("--stats", "HALFSPACE_STATS", "1"), ("--stats=draws", "HALFSPACE_STATS", "draws"),
                                        ("--view=tiles", "HALFSPACE_VIEW", "tiles")):
            done = self.start(0, option, "--", "sh", "-c", f"echo ${variable}")
            self.assertEqual(done.stdout, value + "\n")
        self.start(2, "--view", "sideways", "true")

    def test_missing_things_are_named(self):
        self.start(127, "halfspace-no-such-program")
        self.start(126, "/etc/passwd")
        self.start(2)
        self.start(2, "--no-such-option", "true")
        done = self.status(2, "run", "--library", self.path, "true")
        self.assertIn("libGL.so.1", done.stderr)

    def frame_writer(self):
        return ("sh", "-c", r'for i in 0 1; do printf "P6\n1 1\n255\n\100\101\102" '
                            r'> "$HALFSPACE_CAPTURE/frame_0000$i.ppm"; done; exit 3')

    def test_captured_frames_are_converted(self):
        frames = self.path / "frames"
        self.start(3, "--capture", frames, *self.frame_writer())
        self.assertEqual(sorted(path.name for path in frames.iterdir()), ["frame_00000.png", "frame_00001.png"])
        write_ppm(self.path / "same.ppm", [(64, 65, 66)], 1, 1)
        self.status(0, "compare", frames / "frame_00001.png", self.path / "same.ppm")

    def test_frames_of_before_are_not_taken_for_new_ones(self):
        frames = self.path / "frames"
        self.start(3, "--capture", frames, *self.frame_writer())
        self.start(2, "--capture", frames, *self.frame_writer())
        done = self.start(0, "--capture", frames, "--force", "true")
        self.assertIn("no frame", done.stderr)
        self.assertEqual(list(frames.iterdir()), [])


if __name__ == "__main__":
    HALFSPACE = sys.argv.pop(1)
    unittest.main()
