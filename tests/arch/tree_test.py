#!/usr/bin/env python3
"""What the tree holds: no file too long to read, no path of somebody's machine.

    tree_test.py SOURCE_DIR
"""
import pathlib
import re
import shutil
import subprocess
import sys

MOST_LINES = 600
CODE = {".h", ".cpp", ".c", ".inl", ".def", ".py", ".cmake", ".sh", ".txt"}
# Written so that this file does not match itself.
MACHINE_PATH = re.compile(r"(?<![\w.}$)-])/(?:work|root|home|Users)/[A-Za-z]|(?<![\w.}$)-])/tmp/[a-z]")
# Written by a program from a list, not by hand.
GENERATED = re.compile(r"\.gen\.|\.exports$|golden/")


def tracked_files(root):
    """Paths git knows; without git (an unpacked archive) every file outside build folders."""
    git = None
    if shutil.which("git"):
        git = subprocess.run(["git", "-C", str(root), "ls-files", "-z"], capture_output=True)
    if git and git.returncode == 0:
        return [name for name in git.stdout.decode().split("\0") if name and (root / name).is_file()]
    skipped = {"build", "out", ".git"}
    return [p.relative_to(root).as_posix() for p in root.rglob("*")
            if p.is_file() and p.relative_to(root).parts[0] not in skipped]


def problems_of(name, text):
    lines = text.split("\n")
    if pathlib.PurePath(name).suffix in CODE and not GENERATED.search(name) and len(lines) - 1 > MOST_LINES:
        yield f"{name}: {len(lines) - 1} lines; {MOST_LINES} at most"
    for number, line in enumerate(lines, 1):
        if MACHINE_PATH.search(line):
            yield f"{name}:{number}: a path of one machine: {line.strip()[:100]}"


def self_test():
    slash = "/"
    assert not list(problems_of("a.cpp", "x\n" * 600))
    assert list(problems_of("a.cpp", "x\n" * 601))
    assert not list(problems_of("a.gen.cpp", "x\n" * 5000))
    for path in (f"{slash}work{slash}main", f'"{slash}home{slash}me', f"{slash}tmp{slash}build", f"{slash}root{slash}x"):
        assert list(problems_of("README.md", f"see {path}")), path
    assert not list(problems_of("README.md", f"src{slash}work{slash}main, https:{slash}{slash}a.org{slash}home{slash}b "
                                          f"$HOME{slash}tmp{slash}x"))


def main():
    self_test()
    root = pathlib.Path(sys.argv[1])
    problems, files = [], tracked_files(root)
    for name in files:
        try:
            problems += problems_of(name, (root / name).read_text())
        except UnicodeDecodeError:
            pass  # a picture
    print("\n".join(problems) or f"{len(files)} files")
    return 1 if problems else 0


sys.exit(main())
