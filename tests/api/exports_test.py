#!/usr/bin/env python3
"""Checks what our libraries export: exactly the names of the committed lists, nothing missing and nothing else; and
that the lists hold every name the system's own libraries export, when those are installed.

    exports_test.py LIST LIBRARY [LIST LIBRARY ...]
"""

import re
import subprocess
import sys
from pathlib import Path

API_NAME = re.compile(r"(gl|OSMesa)\w+$")


def exported(library):
    """The dynamic symbols a library defines, version tags cut off."""
    output = subprocess.run(
        ["nm", "-D", "--defined-only", "--format=posix", library], check=True, capture_output=True, text=True
    ).stdout
    return {line.split()[0].partition("@")[0] for line in output.splitlines()}


def listed(path):
    return set(Path(path).read_text(encoding="utf-8").split())


def system_library(soname, ours):
    """The library a program would get without us, or None."""
    output = subprocess.run(["/sbin/ldconfig", "-p"], check=False, capture_output=True, text=True).stdout
    for line in output.splitlines():
        name, _, path = line.strip().partition(" => ")
        if name.split()[0] == soname and path and Path(path).resolve() != Path(ours).resolve():
            return path
    return None


def soname(library):
    output = subprocess.run(["readelf", "-d", library], check=True, capture_output=True, text=True).stdout
    return re.search(r"SONAME.*\[(.*)\]", output)[1]


def complain(names, what):
    if names:
        print(f"{len(names)} {what}: {' '.join(sorted(names)[:20])}")
    return bool(names)


def check(list_path, library):
    """True when something is wrong."""
    wanted, found, name = listed(list_path), exported(library), soname(library)
    wrong = complain(wanted - found, f"names of {list_path} are missing from {library}")
    wrong |= complain(found - wanted, f"names are exported from {library} that {list_path} does not have")
    system = system_library(name, library)
    if system:
        names = {symbol for symbol in exported(system) if API_NAME.match(symbol)}
        wrong |= complain(names - wanted, f"names of {system} are missing from {list_path}")
    print(f"{name}: {len(found)} names; compared with {system or 'no system library'}")
    return wrong


def main():
    arguments = sys.argv[1:]
    if not arguments or len(arguments) % 2:
        sys.exit(__doc__)
    results = [check(path, library) for path, library in zip(arguments[::2], arguments[1::2])]
    sys.exit(1 if any(results) else 0)


if __name__ == "__main__":
    main()
