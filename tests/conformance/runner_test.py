"""The runner must not take for a pass what is none."""
import os
import stat
import sys
import tempfile
import unittest
from pathlib import Path

import piglit
import run


class Judgement(unittest.TestCase):
    def test_the_worst_report_counts(self):
        ok, bad = 'PIGLIT: {"result": "pass" }\n', 'PIGLIT: {"subtest": {"a b": "fail"}}\n'
        self.assertEqual(piglit.judge(0, "text" + ok), ("pass", {}))
        self.assertEqual(piglit.judge(0, bad + ok), ("fail", {"a b": "fail"}))
        self.assertEqual(piglit.judge(0, 'PIGLIT: {"result": "skip" }')[0], "skip")
        self.assertEqual(piglit.judge(0, 'PIGLIT: {"subtest": {"x": "warn"}}\n' + ok)[0], "warn")
        self.assertEqual(piglit.judge(0, 'PIGLIT: {"subtest": {"x": "something new"}}\n' + ok)[0], "something new")

    def test_what_ends_otherwise_does_not_pass(self):
        ok = 'PIGLIT: {"result": "pass" }\n'
        self.assertEqual(piglit.judge(-11, ok)[0], "crash")
        self.assertEqual(piglit.judge(1, ok)[0], "warn")
        self.assertEqual(piglit.judge(0, "all is well\n")[0], "none")
        self.assertEqual(piglit.judge(0, "PIGLIT: {broken\n")[0], "none")

    def test_exceptions_hold_for_failures_only(self):
        reasons = {"named": "a reason"}
        self.assertEqual(run.verdict(piglit.Result("named", "skip"), reasons), "")
        self.assertTrue(run.verdict(piglit.Result("named", "pass"), reasons))
        self.assertEqual(run.verdict(piglit.Result("other", "skip"), reasons), "skip")
        self.assertEqual(run.verdict(piglit.Result("other", "pass"), reasons), "")


class Running(unittest.TestCase):
    def result_of(self, script, timeout=30):
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder) / "bin" / "test"
            program.parent.mkdir()
            program.write_text(f"#!/bin/sh\n{script}\n")
            program.chmod(program.stat().st_mode | stat.S_IXUSR)
            return piglit.run(Path(folder), "name", ["test", "a b"], dict(os.environ), timeout)

    def test_a_program_that_hangs_is_stopped(self):
        result = self.result_of("exec sleep 60", timeout=0.2)
        self.assertEqual(result.status, "timeout")
        self.assertLess(result.seconds, 30)

    def test_arguments_and_output_get_through(self):
        result = self.result_of("""echo "$1/$2"; echo 'PIGLIT: {"result": "pass"}'""")
        self.assertEqual((result.status, result.output.splitlines()[0]), ("pass", "a b/-auto"))

    def test_a_signal_is_a_crash(self):
        self.assertEqual(self.result_of("kill -SEGV $$").status, "crash")


class Lists(unittest.TestCase):
    def test_every_exception_is_in_the_list_and_has_a_reason(self):
        names = run.read_list(run.HERE / "gl-1.0-1.1.txt")
        self.assertEqual(len(names), len(set(names)))
        self.assertEqual(set(run.read_exceptions(run.HERE / "exceptions.txt")) - set(names), set())

    def test_an_exception_without_a_reason_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "exceptions.txt"
            path.write_text("# a comment\nspec@x = \n")
            self.assertRaises(SystemExit, run.read_exceptions, path)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
