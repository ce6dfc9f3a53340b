"""Instructions a frame of the eight scenes takes with each of two builds of libOSMesa, by callgrind.

    instructions.py REF_APP_OSMESA OLD_LIBRARIES NEW_LIBRARIES [--scenes 1 2 ...] [--limit PERCENT]

A frame is what is left when a run of two frames is taken from one of four, halved. Exit status 1 if any scene takes more
than the limit (3 %) over the old build.
"""
import argparse
import concurrent.futures
import os
import sys
import tempfile

import callgrind


def count(program, libraries, scene, frames):
    with tempfile.TemporaryDirectory() as folder:
        return callgrind.instructions([program, "--scene", scene, "--frames", frames, "--no-pictures", "--out", folder],
                                      {"LD_LIBRARY_PATH": libraries}, "Halfspace avx2")


def frame(program, libraries, scene):
    return (count(program, libraries, scene, 4) - count(program, libraries, scene, 2)) / 2


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--scenes", type=int, nargs="*", default=range(1, 9))
    parser.add_argument("--limit", type=float, default=3, help="per cent")
    options = parser.parse_args()
    print("scene        old        new   change")
    worst = 0.0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        rows = [(scene, [pool.submit(frame, options.program, libraries, scene)
                         for libraries in (options.old, options.new)]) for scene in options.scenes]
        for scene, (old, new) in rows:
            change = 100 * (new.result() / old.result() - 1)
            worst = max(worst, change)
            print(f"{scene:5} {old.result() / 1e6:8.2f} M {new.result() / 1e6:8.2f} M {change:+7.2f} %", flush=True)
    return 1 if worst > options.limit else 0


if __name__ == "__main__":
    sys.exit(main())
