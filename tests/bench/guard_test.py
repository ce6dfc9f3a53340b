"""The guard's judgement, on counts made up here.

usage: guard_test.py SOURCE_DIR
"""
import contextlib
import io
import sys
import unittest

sys.path.insert(0, sys.argv.pop(1) + "/bench")
import guard


def judge(now, before, limit=5):
    with contextlib.redirect_stdout(io.StringIO()) as text:
        return *guard.judge(now, before, limit), text.getvalue()


class Judgement(unittest.TestCase):
    def test_within_the_limit_either_way(self):
        self.assertEqual(judge({"a": 105, "b": 95}, {"a": 100, "b": 100})[:2], ([], []))

    def test_slower_and_faster_are_told_apart(self):
        slower, faster, text = judge({"a": 1051, "b": 949}, {"a": 1000, "b": 1000})
        self.assertEqual((slower, faster), (["a"], ["b"]))
        self.assertIn("+5.10 %  SLOWER", text)

    def test_what_is_not_on_record_fails(self):
        self.assertEqual(judge({"new": 1}, {})[0], ["new"])


if __name__ == "__main__":
    unittest.main()
