"""What a context that draws nothing takes beyond its colour buffer, and a frame of a million triangles beyond the
application's own memory.

usage: memory_test.py WORKLOADS LIBRARY
"""
import json
import os
import subprocess
import sys
import unittest

PROGRAM = LIBRARY = ""
COLOR_BUFFER_KIB = 1024 * 1024 * 4 // 1024


class Drawing:
    """bench/workloads, taking orders; bench/runner.h has them."""

    def __init__(self, threads):
        self.child = subprocess.Popen([PROGRAM, "--serve", "--library", LIBRARY], text=True, stdin=subprocess.PIPE,
                                      stdout=subprocess.PIPE, env=os.environ | {"HALFSPACE_THREADS": str(threads)})

    def order(self, line):
        print(line, file=self.child.stdin, flush=True)
        answer = json.loads(self.child.stdout.readline())
        assert "error" not in answer, answer
        return answer

    def close(self):
        self.child.communicate()


class MemoryTest(unittest.TestCase):
    def start(self, threads):
        drawing = Drawing(threads)
        self.addCleanup(drawing.close)
        return drawing

    def test_a_context_with_nothing_drawn(self):
        for threads in (1, 2, 16):
            drawing = self.start(threads)
            self.assertTrue(drawing.order("empty")["renderer"].startswith("Halfspace"))
            drawing.order("run 3")
            memory = drawing.order("memory")
            taken = memory["peak_kib"] - memory["unloaded_kib"] - COLOR_BUFFER_KIB
            print(f"nothing drawn, {threads} threads: {taken / 1024:.1f} MB beyond the colour buffer, library included")
            self.assertLess(taken, 6 * 1024)

    def test_a_frame_of_a_million_triangles(self):
        for threads in (1, 2, 16):
            drawing = self.start(threads)
            drawing.order("open mesh_indexed_1M")
            # The mesh is there, the picture as well, and nothing has been drawn.
            before = drawing.order("memory")["resident_kib"]
            for frames in (3, 20):  # nor does it grow
                drawing.order(f"run {frames}")
                taken = drawing.order("memory")["peak_kib"] - before
                print(f"a million triangles, {threads} threads: {taken / 1024:.1f} MB beyond the application's")
                # What the context took before is held to its own limit.
                self.assertLess(taken, (64 - 6) * 1024)


if __name__ == "__main__":
    PROGRAM, LIBRARY = sys.argv.pop(1), sys.argv.pop(1)
    unittest.main()
