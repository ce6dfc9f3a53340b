#!/usr/bin/env python3
"""One image: the random scenes built by every compiler, level of optimisation and processor there is, and run on every
instruction set, with several numbers of threads and with every variant of the C library's mathematics.

    one_image.py SOURCE [--work FOLDER] [--only REGEX]

The builds stay in FOLDER (SOURCE/build/one_image). A compiler or an emulator that is not installed is left out and named;
the cross build takes Debian's g++-aarch64-linux-gnu and qemu-user.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys

# name: (compiler, flags, how to run it)
BUILDS = {
    "g++ -O0": ("g++", "-O0", []),
    "g++ -O3": ("g++", "-O3", []),
    "g++ -O3 -march=native": ("g++", "-O3 -march=native", []),
    "clang++ -O0": ("clang++", "-O0", []),
    "clang++ -O3": ("clang++", "-O3", []),
    "aarch64 g++ -O2": ("aarch64-linux-gnu-g++", "-O2", ["qemu-aarch64"]),
}
# What glibc takes its exp, pow and sin by; the second line is how releases before 2.33 spell it.
TUNABLES = {
    "": "",
    "glibc without AVX-512": "-AVX512F,-AVX512VL",
    "glibc without AVX2 and FMA": "-AVX2,-FMA,-FMA4,-AVX2_Usable,-FMA_Usable,-FMA4_Usable",
    "glibc with SSE2 only": "-AVX2,-FMA,-FMA4,-AVX,-SSE4_1,-SSE4_2,-SSSE3,"
                            "-AVX2_Usable,-FMA_Usable,-FMA4_Usable,-AVX_Usable",
}


def configure(source, folder, compiler, flags):
    command = ["cmake", "-S", source / "tests/golden/one_image", "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=None",
               f"-DCMAKE_CXX_COMPILER={compiler}", f"-DCMAKE_CXX_FLAGS={flags}"]
    if compiler.startswith("aarch64"):
        # Highway is headers only; /usr/include as a whole is of another processor.
        headers = folder / "headers"
        headers.mkdir(parents=True, exist_ok=True)
        if not (headers / "hwy").exists():
            (headers / "hwy").symlink_to("/usr/include/hwy")
        command += ["-DCMAKE_SYSTEM_NAME=Linux", "-DCMAKE_SYSTEM_PROCESSOR=aarch64", f"-DHWY_INCLUDE_DIR={headers}"]
    return subprocess.run(command, capture_output=True, text=True)


def run(program, emulator, golden, tunables):
    env = dict(os.environ)
    if tunables:
        env["GLIBC_TUNABLES"] = f"glibc.cpu.hwcaps={tunables}"
    return subprocess.run([*emulator, program, golden], env=env, capture_output=True, text=True)


def report(name, result):
    print(f"{name}: {'the published images' if result.returncode == 0 else 'FAILS'}")
    for line in (result.stdout + result.stderr).splitlines():
        print(f"  {line}")
    sys.stdout.flush()
    return result.returncode == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("--work", type=pathlib.Path)
    parser.add_argument("--only", default="", help="regular expression over the builds' names")
    args = parser.parse_args()
    source = args.source.resolve()
    work = (args.work or source / "build/one_image").resolve()
    golden = source / "tests/golden/image_hashes.txt"
    good, left_out = True, []
    for name, (compiler, flags, emulator) in BUILDS.items():
        if not re.search(args.only, name):
            continue
        missing = [tool for tool in (compiler, *emulator) if not shutil.which(tool)]
        if missing:
            left_out.append(f"{name}: {missing[0]} is not installed")
            continue
        folder = work / re.sub(r"\W+", "_", name)
        for step in (lambda: configure(source, folder, compiler, flags),
                     lambda: subprocess.run(["ninja", "-C", folder], capture_output=True, text=True)):
            result = step()
            if result.returncode:
                break
        if result.returncode:
            good = report(f"{name}: does not build", result) and good
            continue
        for what, tunables in TUNABLES.items():
            if tunables and (emulator or flags != "-O3"):
                continue
            title = f"{name}, {what}" if what else name
            good = report(title, run(folder / "image_hashes", emulator, golden, tunables)) and good
    for line in left_out:
        print("left out:", line)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
