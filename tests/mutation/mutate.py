#!/usr/bin/env python3
"""Breaks one rule at a time and shows that some test notices.

    mutate.py --check SOURCE                 every mutation still applies: its text is there, once, and its test exists
    mutate.py --run SOURCE [--work FOLDER]   apply each to a copy of the sources, build the test it names, run it
              [--only REGEX] [--table FILE]  some of them; the result as Markdown

A mutation is killed when its test fails or the tests no longer compile; one that survives fails the run. The copy and
its build stay in FOLDER, so that a second run is quick.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

from mutations import MUTATIONS

HARD = "hard_cases"


def program_of(mutation):
    return mutation.catcher.split(":", 1)[0]


def problems(source):
    cases = (source / "tests/numerics/hard/cases.def").read_text()
    for mutation in MUTATIONS:
        path = source / mutation.file
        count = path.read_text().count(mutation.text) if path.exists() else 0
        if count != 1:
            yield f"{mutation.name}: its text is {count} times in {mutation.file}"
        if mutation.text == mutation.replacement:
            yield f"{mutation.name}: changes nothing"
        program, tests = mutation.catcher.split(":", 1)
        if program == HARD:
            for case in tests.split(","):
                if f"HARD_CASE({case}," not in cases:
                    yield f"{mutation.name}: there is no hard case {case}"
        elif not list(source.glob(f"tests/*/{program}.cpp")):
            yield f"{mutation.name}: there is no test {program}"
    names = [mutation.name for mutation in MUTATIONS]
    for name in sorted(set(n for n in names if names.count(n) > 1)):
        yield f"{name}: is there twice"


def tracked(source):
    listed = subprocess.run(["git", "-C", source, "ls-files", "-z"], check=True, capture_output=True).stdout
    return [name for name in listed.decode().split("\0") if name and (source / name).is_file()]


def copy_tree(source, tree):
    """Only what differs is written, so that the build stays valid."""
    names = tracked(source)
    for old in [p for p in tree.rglob("*") if p.is_file()] if tree.exists() else []:
        if old.relative_to(tree).as_posix() not in names:
            old.unlink()
    for name in names:
        target = tree / name
        if target.exists() and target.read_bytes() == (source / name).read_bytes():
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source / name, target)


class Workshop:
    def __init__(self, source, work):
        self.tree, self.build = work / "tree", work / "build"
        copy_tree(source, self.tree)
        self.env = dict(os.environ, CCACHE_BASEDIR=str(self.tree), CCACHE_NOHASHDIR="1")
        # Half of a mutation's time is compiling: -O1, and the scalar level alone, since every level is compiled from
        # the same bodies.
        subprocess.run(["cmake", "-S", self.tree, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", "-DHALFSPACE_LEVELS="], check=True, env=self.env, stdout=subprocess.DEVNULL)

    def compile(self, program):
        targets = [HARD, "halfspace_libosmesa"] if program == HARD else [program]
        return subprocess.run(["ninja", "-C", self.build, *targets], env=self.env, capture_output=True, text=True)

    def test(self, catcher):
        program, tests = catcher.split(":", 1)
        if program == HARD:
            command = [self.build / "tests/numerics/hard" / HARD, "--judge", *tests.split(",")]
        else:
            command = [self.build / "tests" / program, f"--gtest_filter={tests}", "--gtest_brief=1"]
        env = dict(self.env, LD_LIBRARY_PATH=str(self.build / "lib"))
        try:
            run = subprocess.run(command, env=env, capture_output=True, text=True, timeout=600)
        except subprocess.TimeoutExpired:
            return 1, "it never ended"
        return run.returncode, run.stdout + run.stderr

    def try_out(self, mutation):
        """(killed, how)"""
        path = self.tree / mutation.file
        original = path.read_text()
        path.write_text(original.replace(mutation.text, mutation.replacement))
        try:
            built = self.compile(program_of(mutation))
            if built.returncode:
                return None, built.stdout[-1500:]
            status, text = self.test(mutation.catcher)
            return status != 0, first_complaint(text)
        finally:
            path.write_text(original)


def first_complaint(text):
    lines = text.splitlines()
    for pattern in (r"\[  FAILED  \] (\S+)", r"^(\S+) +FAILS"):
        for line in lines:
            found = re.search(pattern, line)
            if found:
                return found.group(1)
    return lines[0] if lines else "ended without a word"


def check_unbroken(shop, mutations):
    """A test that fails by itself proves nothing."""
    bad = []
    for catcher in sorted({mutation.catcher for mutation in mutations}):
        built = shop.compile(catcher.split(":", 1)[0])
        status, text = (1, built.stdout[-1500:]) if built.returncode else shop.test(catcher)
        if status or " 0 tests" in text:
            bad.append(f"{catcher} fails with nothing broken: {text[-500:]}")
    return bad


def run(source, work, only, table):
    shop = Workshop(source, work)
    mutations = [mutation for mutation in MUTATIONS if not only or re.search(only, mutation.name)]
    bad = check_unbroken(shop, mutations)
    if bad:
        print("\n".join(bad))
        return 1
    rows, survivors = [], 0
    for mutation in mutations:
        started = time.monotonic()
        killed, how = shop.try_out(mutation)
        survivors += not killed
        word = "killed by" if killed else "DOES NOT COMPILE" if killed is None else "SURVIVES"
        print(f"{word:10} {mutation.name}: {how} ({time.monotonic() - started:.0f} s)", flush=True)
        rows.append(f"| {mutation.name} | `{mutation.file}` | {how if killed else word} |")
    if table:
        table.write_text("| broken | in | noticed by |\n|---|---|---|\n" + "\n".join(rows) + "\n")
    print(f"{len(rows) - survivors} of {len(rows)} mutations were noticed")
    return 1 if survivors else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", metavar="SOURCE", type=pathlib.Path)
    parser.add_argument("--run", metavar="SOURCE", type=pathlib.Path)
    parser.add_argument("--work", type=pathlib.Path, help="default: SOURCE/build/mutation")
    parser.add_argument("--only", help="regular expression over the mutations' names")
    parser.add_argument("--table", type=pathlib.Path)
    args = parser.parse_args()
    source = args.check or args.run
    if not source:
        parser.error("--check or --run")
    wrong = list(problems(source))
    print("\n".join(wrong) or f"{len(MUTATIONS)} mutations apply")
    if wrong or args.check:
        return 1 if wrong else 0
    return run(source.resolve(), (args.work or source / "build/mutation").resolve(), args.only, args.table)


if __name__ == "__main__":
    sys.exit(main())
