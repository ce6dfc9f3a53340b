"""Writes the lists that halfspace_call_order (cmake/CallOrder.cmake) links by: the functions that the eight scenes call
when `halfspace bench scenes` runs them, each once, in the order of their first calls.

    call_order.py REF_APP_OSMESA LIBRARIES

Needs gdb, and a processor with AVX-512 for that level's functions.
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys

try:
    import gdb
except ImportError:
    gdb = None

TOP = pathlib.Path(__file__).resolve().parents[1]
HEADER = "# Written by bench/call_order.py: what the eight scenes call, in the order of their first calls.\n"


def functions(file):
    lines = subprocess.run(["nm", "--defined-only", file], check=True, capture_output=True, text=True).stdout.splitlines()
    return {int(address, 16): name for address, kind, name in map(str.split, lines) if kind in "tTwW"}


def load_address(file):
    for line in gdb.execute("info proc mappings", to_string=True).splitlines():
        if file in line:
            return int(line.split()[0], 16)
    return None


# Runs inside gdb: a breakpoint at each function of each file, taken away when it is met.
def trace(program, library):
    class Once(gdb.Breakpoint):
        def __init__(self, address, file, name):
            super().__init__(f"*{address:#x}", internal=True)
            self.line = f"{file} {name}\n"

        def stop(self):
            called.append(self.line)
            self.enabled = False
            return False

    called = []
    for setting in ("pagination off", "confirm off", "breakpoint always-inserted on", "auto-solib-add off",
                    "startup-with-shell off", "stop-on-solib-events 1"):
        gdb.execute("set " + setting)
    gdb.execute(f"file {program}")
    gdb.execute("set args --backend osmesa --size 1024x1024 --frames 2 --paint scene --json /dev/null --no-pictures "
                "--scene 1 2 3 4 5 6 7 8")
    gdb.execute("starti")
    while load_address(library) is None:
        gdb.execute("continue")
    gdb.execute("set stop-on-solib-events 0")
    for file in (program, library):
        base = load_address(file)
        for address, name in functions(file).items():
            Once(base + address, file, name)
    gdb.execute("continue")
    pathlib.Path(os.environ["CALLED"]).write_text("".join(called))


def traced(program, library, level):
    out = pathlib.Path(f"called.{os.getpid()}")
    environment = dict(os.environ, CALLED=str(out), PROGRAM=program, LIBRARY=library, HALFSPACE_ISA=level,
                       HALFSPACE_THREADS="1", HALFSPACE_ACCURACY="standard",
                       LD_LIBRARY_PATH=str(pathlib.Path(library).parent))
    try:
        subprocess.run(["gdb", "-batch", "-nx", "-x", __file__], env=environment, check=True, stdout=subprocess.DEVNULL)
        return [line.split(" ") for line in out.read_text().splitlines()]
    finally:
        out.unlink(missing_ok=True)


# For the linker: clones by what they are clones of, constructors whether or not they share their code with another.
def section_name(name):
    name = re.sub(r"\.(constprop|part|isra|cold)\b.*", "", name)
    name = re.sub(r"([CD])[12]([EI])", r"\1?\2", name)
    return re.sub(r"6N_AVX3|6N_AVX2|6N_SSE4|8N_SCALAR", "@", name)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("libraries")
    options = parser.parse_args()
    program = os.path.realpath(options.program)
    library = os.path.realpath(os.path.join(options.libraries, "libOSMesa.so.8"))
    calls = traced(program, library, "avx512") + traced(program, library, "avx2")
    for file, out in ((library, TOP / "gl/called.gen.txt"), (program, TOP / "ref_app/called.gen.txt")):
        names = dict.fromkeys(section_name(name) for called, name in calls if called == file)
        out.write_text(HEADER + "".join(name + "\n" for name in names))
        print(f"{out.relative_to(TOP)}: {len(names)} functions")
    return 0


if __name__ == "__main__":
    if gdb is None:
        sys.exit(main())
    trace(os.environ["PROGRAM"], os.environ["LIBRARY"])
