#!/usr/bin/env python3
"""Writes docs/hard-cases.md's table and its pictures again: every hard case, drawn by us, held against the oracle.

    page.py SOURCE --program hard_cases --library libOSMesa.so.8 --oracle libOSMesa.so.8 [--truth FOLDER]

The text before and after the table is docs/hard-cases.md's own. What the oracle has drawn once is kept in FOLDER; its
million triangles alone take it minutes.
"""
import argparse
import os
import pathlib
import re
import subprocess
import tempfile

# Too much even for a patient oracle; the case itself knows the exact integers.
WITHOUT_ORACLE = ("thousand_blends",)
LEVELS = ("draft", "standard", "exact")
BEGIN, END = "<!-- table: page.py -->", "<!-- /table -->"


def call(args, library, words, **variables):
    env = dict(os.environ, LD_LIBRARY_PATH=str(library.resolve().parent), **variables)
    return subprocess.run([args.program.resolve(), *words], env=env, check=True, capture_output=True, text=True).stdout


def errors(args, name, truth):
    """level -> (colour, depth), against the oracle"""
    folder = truth / name
    if not list(folder.glob("*.truth")):
        folder.mkdir(parents=True, exist_ok=True)
        call(args, args.oracle, ["--draw", name], HALFSPACE_TRUTH=str(folder))
    found = {}
    for level in LEVELS:
        text = call(args, args.library, ["--draw", name, "--truth", str(folder)], HALFSPACE_ACCURACY=level)
        found[level] = re.search(r"colour +([\d.]+) +depth +([\d.]+)", text).groups()
    return found


def picture(args, name, folder):
    with tempfile.TemporaryDirectory() as scratch:
        call(args, args.library, ["--draw", name, "--show", "--out", scratch])
        subprocess.run(["convert", f"{scratch}/{name}.ppm", "-filter", "Box", "-resize", "128x128", "-dither", "None", "-colors", "96",
                        "-strip", f"PNG8:{folder}/{name}.png"], check=True)


def table(args, truth):
    pictures = args.source / "docs/hard-cases"
    pictures.mkdir(exist_ok=True)
    yield "| | case | what could go wrong | what holds | colour: draft, standard, exact | depth |"
    yield "|---|---|---|---|---|---|"
    for line in call(args, args.library, ["--list"]).splitlines():
        name, _, hazard, claim = line.split("\t")
        picture(args, name, pictures)
        if name in WITHOUT_ORACLE:
            yield f"| ![{name}](hard-cases/{name}.png) | `{name}` | {hazard} | {claim} | | |"
            continue
        error = errors(args, name, truth)
        colors = ", ".join(f"{float(error[level][0]):.3f}" for level in LEVELS)
        depth = max(float(error[level][1]) for level in LEVELS)
        yield (f"| ![{name}](hard-cases/{name}.png) | `{name}` | {hazard} | {claim} | {colors} | {depth:.3f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", type=pathlib.Path)
    for name in ("--program", "--library", "--oracle"):
        parser.add_argument(name, type=pathlib.Path, required=True)
    parser.add_argument("--truth", type=pathlib.Path)
    args = parser.parse_args()
    page = args.source / "docs/hard-cases.md"
    text = page.read_text()
    before, rest = text.split(BEGIN)
    after = rest.split(END)[1]
    with tempfile.TemporaryDirectory() as scratch:
        rows = list(table(args, args.truth or pathlib.Path(scratch)))
    page.write_text(before + BEGIN + "\n" + "\n".join(rows) + "\n" + END + after)


if __name__ == "__main__":
    main()
