#!/usr/bin/env python3
"""The hard cases at every accuracy, instruction set and thread count.

--golden FILE        the standard level's hashes have to be those in FILE; --bless writes them
--scenes PROGRAM     ref_app_osmesa's eight scenes at sizes nobody has: 16x16, 1x16384, 4096x4096
--oracle LIBRARY     the oracle's picture of every case, and how far standard and exact are from it

Otherwise: each case's own claim at each level at which it holds, and the same bytes of every case from each
instruction set and thread count. HALFSPACE_LONG_TESTS=1 tries them all with each other, and makes sweeps whole.
"""
import argparse
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import tempfile

LEVELS = ("draft", "standard", "exact")
ISAS = ("scalar", "sse4", "avx2", "avx512")
LONG = os.environ.get("HALFSPACE_LONG_TESTS", "0") not in ("", "0")
LINE = re.compile(r"(\w+) +colour +([\d.]+) +depth +([\d.]+) .* (\d+) wrong at edges")
# What the oracle, which computes each pixel in rationals and MPFR, needs minutes for.
SLOW_FOR_ORACLE = ("mesh_dust", "mesh_viewport_16384", "thousand_blends")
# Levels of colour, units of depth (2^-24 of the range).
BOUNDS = {"standard": (0.55, 1.0), "exact": (0.5001, 0.5001)}
# What a machine lacks is not forced on it: HALFSPACE_ISA falls back to the best there is.
SMALL_RUNS = [("scalar", 1), ("sse4", 2), ("avx2", 3), ("avx512", 8)]
RUNS = [(isa, threads) for isa in ISAS for threads in (1, 2, 3, 8)] if LONG else SMALL_RUNS


def environment(library, level, isa="", threads=0):
    env = dict(os.environ, LD_LIBRARY_PATH=str(library.parent), HALFSPACE_ACCURACY=level, HALFSPACE_ISA=isa)
    env.pop("HALFSPACE_THREADS", None)
    if threads:
        env["HALFSPACE_THREADS"] = str(threads)
    return env


def output(command, env):
    run = subprocess.run(command, env=env, capture_output=True, text=True)
    return run.stdout, run.stderr, run.returncode


class Judge:
    def __init__(self, args):
        self.program, self.library = str(args.program), args.library
        self.failures = 0

    def fail(self, text):
        self.failures += 1
        print("FAILED:", text)

    def cases(self):
        text, _, _ = output([self.program, "--list"], os.environ)
        return [line.split("\t")[:2] for line in text.splitlines()]

    def hashes(self, level, isa="", threads=0):
        text, errors, status = output([self.program, "--hash", "all"], environment(self.library, level, isa, threads))
        if status or "drawn by Halfspace" not in errors:
            self.fail(f"{level} {isa} {threads}: status {status}, {errors.strip()}")
        return dict(line.split() for line in text.splitlines())

    def expect_same(self, what, want, got):
        for name in sorted(set(want) | set(got)):
            if want.get(name) != got.get(name):
                self.fail(f"{what}: {name} is {got.get(name)}, not {want.get(name)}")

    def claims(self):
        for place, level in enumerate(LEVELS):
            names = [name for name, least in self.cases() if LEVELS.index(least) <= place]
            command = [self.program, "--judge", *names] + (["--sweep"] if LONG or level == "standard" else [])
            text, errors, status = output(command, environment(self.library, level))
            held = text.count(" holds\n")
            print(f"{level}: {held} of {len(names)} claims hold")
            if status or held != len(names):
                self.fail(f"{level}: {text}{errors}")

    def one_image(self):
        for level in LEVELS:
            runs = RUNS if LONG or level == "standard" else RUNS[:1] + RUNS[-1:]
            first = self.hashes(level, *runs[0])
            for isa, threads in runs[1:]:
                self.expect_same(f"{level}, {isa}, {threads} threads", first, self.hashes(level, isa, threads))
            print(f"{level}: {len(first)} cases are the same in {len(runs)} runs")

    def golden(self, path, bless):
        now = self.hashes("standard")
        if bless:
            path.write_text("".join(f"{name} {value}\n" for name, value in sorted(now.items())))
            return
        self.expect_same("golden", dict(line.split() for line in path.read_text().splitlines()), now)
        print(f"{len(now)} cases compared with {path.name}")

    def against_oracle(self, oracle, size):
        names = [name for name, _ in self.cases() if LONG or name not in SLOW_FOR_ORACLE]
        with tempfile.TemporaryDirectory() as folder:
            env = dict(environment(oracle, "standard"), HALFSPACE_TRUTH=folder)
            text, errors, status = output([self.program, "--judge", *names, "--size", size], env)
            if status or "Halfspace oracle" not in errors:
                self.fail(f"the oracle itself: {text}{errors}")
                return
            for level, bounds in BOUNDS.items():
                text, errors, status = output([self.program, "--draw", *names, "--size", size, "--truth", folder],
                                              environment(self.library, level))
                print(f"{level}:\n{text}", end="")
                errors_of = [self.error_of(line, level, bounds) for line in text.splitlines()]
                if status or len(errors_of) != len(names):
                    self.fail(f"{level}: status {status}, {len(errors_of)} of {len(names)} cases, {errors.strip()}")

    def error_of(self, line, level, bounds):
        found = LINE.match(line)
        name, color, depth, wrong = found.group(1), float(found.group(2)), float(found.group(3)), int(found.group(4))
        if color > bounds[0] or depth > bounds[1] or wrong > 0:
            self.fail(f"{level}: {line}")
        return name

    def scene_digest(self, scenes, size, level, isa, threads):
        with tempfile.TemporaryDirectory() as folder:
            _, errors, status = output(
                [scenes, "--backend", "osmesa", "--size", size, "--frames", "1", "--format", "png", "--out", folder],
                environment(self.library, level, isa, threads))
            pictures = sorted(pathlib.Path(folder).glob("*.png"))
            if status or len(pictures) != 8:
                self.fail(f"scenes at {size}, {level}: status {status}, {len(pictures)} pictures, {errors.strip()}")
            return {p.name: hashlib.sha256(p.read_bytes()).hexdigest()[:16] for p in pictures}

    def scenes(self, program):
        for size in ("16x16", "1x16384") + (("4096x4096",) if LONG else ()):
            for level in LEVELS if LONG else ("standard",):
                first = self.scene_digest(program, size, level, *RUNS[0])
                for isa, threads in RUNS[1:] if LONG else RUNS[-1:]:
                    self.expect_same(f"scenes at {size}, {level}, {isa}, {threads} threads", first,
                                     self.scene_digest(program, size, level, isa, threads))
            print(f"scenes at {size} are the same everywhere")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("library", type=pathlib.Path, help="our libOSMesa.so.8")
    parser.add_argument("--golden", type=pathlib.Path)
    parser.add_argument("--bless", action="store_true")
    parser.add_argument("--scenes", help="ref_app_osmesa")
    parser.add_argument("--oracle", type=pathlib.Path, help="the oracle's libOSMesa.so.8")
    parser.add_argument("--size", default="64x64", help="of the pictures compared with the oracle's")
    args = parser.parse_args()
    judge = Judge(args)
    if args.golden:
        judge.golden(args.golden, args.bless)
    elif args.oracle:
        judge.against_oracle(args.oracle, args.size)
    elif args.scenes:
        judge.scenes(args.scenes)
    else:
        judge.claims()
        judge.one_image()
    return 1 if judge.failures else 0


if __name__ == "__main__":
    sys.exit(main())
