#!/usr/bin/env python3
"""Runs piglit's tests of OpenGL 1.0 and 1.1 on our libGL.so.1, under X servers of its own.

    run.py --library DIR [--reference] [--filter REGEX] [--out DIR] [...]

What has to pass is a list of piglit's names; exceptions.txt says which of it does not, and why. Anything but "pass" is
a failure: skip, warn, crash, no answer. A table of all results is written as text and as JSON. The last line has ctest's
form; the exit status is 1 if anything failed.
"""
import argparse
import concurrent.futures
import datetime
import json
import os
import queue
import re
import subprocess
import sys
from pathlib import Path

import piglit

HERE = Path(__file__).resolve().parent


def read_list(path):
    lines = (line.strip() for line in path.read_text(encoding="utf-8").splitlines())
    return [line for line in lines if line and not line.startswith("#")]


def read_exceptions(path):
    reasons = {}
    for line in read_list(path):
        name, found, reason = line.partition(" = ")
        if not found or not reason.strip():
            raise SystemExit(f"{path}: an exception needs a reason: {line}")
        reasons[name.strip()] = reason.strip()
    return reasons


class Display:
    """An X server of its own: tests in windows disturb each other on a shared one."""

    def __init__(self):
        reader, writer = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writer), "-screen", "0", "1280x1024x24", "-nolisten", "tcp", "-noreset"],
            pass_fds=[writer], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as number:
            self.name = ":" + number.readline().strip()
        if self.name == ":":
            raise SystemExit("Xvfb did not start")

    def close(self):
        self.server.terminate()
        self.server.wait()


def environment(display, library):
    """What a test sees: nothing that would lead it to another libGL, or ours to another mode."""
    strange = ("LD_", "LIBGL", "MESA", "GALLIUM", "HALFSPACE_", "PIGLIT", "WAYLAND", "DISPLAY", "__GLX")
    env = {k: v for k, v in os.environ.items() if not k.startswith(strange)}
    env |= {"DISPLAY": display, "PIGLIT_PLATFORM": "glx"}
    return env | ({"LD_LIBRARY_PATH": str(library)} if library else {"LIBGL_ALWAYS_SOFTWARE": "1"})


def renderer(installation, display, library):
    result = piglit.run(installation, "glinfo", ["glinfo"], environment(display, library), 60)
    found = re.search(r"GL_RENDERER *= *(.*)", result.output)
    return found.group(1).strip() if found else f"no renderer: {result.output.strip()[-400:]}"


def run_all(installation, tests, displays, library, timeout, tell):
    """name -> Result, one test a display at a time."""
    free = queue.SimpleQueue()
    for display in displays:
        free.put(display)

    def run_one(item):
        display = free.get()
        try:
            result = piglit.run(installation, *item, environment(display.name, library), timeout)
        finally:
            free.put(display)
        tell(result)
        return result

    with concurrent.futures.ThreadPoolExecutor(len(displays)) as pool:
        return {result.name: result for result in pool.map(run_one, tests.items())}


def verdict(result, reasons):
    """"" if all is well, else what is wrong."""
    if result.name in reasons:
        return "named as an exception, but passes" if result.status == "pass" else ""
    return "" if result.status == "pass" else result.status


def write_table(out, ours, theirs, reasons, who):
    failures = [r for r in ours.values() if verdict(r, reasons)]
    lines = [f"# Conformance: {who}", "",
             f"{datetime.date.today()}: {len(ours)} tests, {sum(r.status == 'pass' for r in ours.values())} pass, "
             f"{sum(r.name in reasons for r in ours.values())} exceptions, {len(failures)} failures.", "",
             "| test | result | s |" + (" Mesa |" if theirs else ""), "|---|---|---:|" + ("---|" if theirs else "")]
    for r in ours.values():
        status = r.status + (f" ({reasons[r.name]})" if r.name in reasons else "")
        lines.append(f"| {r.name} | {status} | {r.seconds:.1f} |" + (f" {theirs[r.name].status} |" if theirs else ""))
    (out / "table.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    as_json = {r.name: {"result": r.status, "seconds": round(r.seconds, 2), "subtests": r.subtests}
               | ({"mesa": theirs[r.name].status} if theirs else {}) for r in ours.values()}
    (out / "table.json").write_text(json.dumps(as_json, indent=1) + "\n", encoding="utf-8")
    for old in out.glob("*.log"):
        old.unlink()
    for r in failures:
        (out / (re.sub(r"\W+", "_", r.name) + ".log")).write_text(r.output, encoding="utf-8")
    return failures


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--library", type=Path, required=True, help="the folder of our libGL.so.1")
    parser.add_argument("--list", type=Path, default=HERE / "gl-1.0-1.1.txt")
    parser.add_argument("--exceptions", type=Path, default=HERE / "exceptions.txt")
    parser.add_argument("--out", type=Path, default=HERE.parent.parent / "out" / "conformance")
    parser.add_argument("--reference", action="store_true", help="run the system's libGL, too, for comparison")
    parser.add_argument("-R", "--filter", default="", help="only the names this expression is found in")
    parser.add_argument("-j", "--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--timeout", type=float, default=300, help="seconds a test may take")
    parser.add_argument("-v", "--verbose", action="store_true", help="tell of tests that pass, too")
    return parser.parse_args()


def select_tests(arguments, known):
    names = [name for name in read_list(arguments.list) if re.search(arguments.filter, name)]
    if not names:
        raise SystemExit("no test is chosen")
    unknown = [name for name in names if name not in known]
    if unknown:
        raise SystemExit("this piglit does not know: " + ", ".join(unknown))
    return {name: known[name] for name in names}


def main():
    arguments = parse_arguments()
    installation = piglit.find_installation()
    if not installation:
        raise SystemExit("piglit is not installed (Debian: piglit)")
    tests = select_tests(arguments, piglit.commands(installation))
    reasons = read_exceptions(arguments.exceptions)
    arguments.out.mkdir(parents=True, exist_ok=True)

    def tell(result):
        wrong = verdict(result, reasons)
        if wrong or arguments.verbose:
            print(f"{result.seconds:7.1f} s  {result.status:8}{result.name}"
                  + (f": {wrong}" if wrong and wrong != result.status else ""), flush=True)

    displays = [Display() for _ in range(max(1, arguments.jobs))]
    try:
        library = arguments.library.resolve()
        who = renderer(installation, displays[0].name, library)
        if not who.startswith("Halfspace"):
            raise SystemExit(f"the tests would not run on our library but on {who}")
        ours = run_all(installation, tests, displays, library, arguments.timeout, tell)
        theirs = arguments.reference and run_all(installation, tests, displays, None, arguments.timeout, lambda _: None)
    finally:
        for display in displays:
            display.close()
    failures = write_table(arguments.out, ours, theirs, reasons, who)
    passed = len(ours) - len(failures)
    print(f"\n{arguments.out / 'table.md'}\n"
          f"{100 * passed // len(ours)}% tests passed, {len(failures)} tests failed out of {len(ours)}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
