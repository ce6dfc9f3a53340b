#!/usr/bin/env python3
"""The shipped libraries ask for nothing but libc, libm and, for GLX, libX11 and libXext.

    libraries_test.py LIBGL.SO LIBOSMESA.SO LIBGLX_HALFSPACE.SO
"""
import re
import subprocess
import sys

ALWAYS = {"libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}
X11 = {"libX11.so.6", "libXext.so.6"}
SHIPPED = [("libGL.so.1", ALWAYS | X11), ("libOSMesa.so.8", ALWAYS), ("libGLX_halfspace.so.0", ALWAYS | X11)]


def problems_of(soname, allowed, dynamic):
    """`dynamic`: output of readelf -d."""
    needed = set(re.findall(r"\(NEEDED\).*\[(.*)\]", dynamic))
    for name in sorted(needed - allowed):
        yield f"{soname} needs {name}"
    if re.findall(r"\(SONAME\).*\[(.*)\]", dynamic) != [soname]:
        yield f"{soname} has another SONAME"
    for tag in ("RPATH", "RUNPATH", "TEXTREL"):
        if f"({tag})" in dynamic:
            yield f"{soname} has a {tag}"


def self_test():
    good = "0x1 (NEEDED) Shared library: [libc.so.6]\n0xe (SONAME) Library soname: [libOSMesa.so.8]\n"
    soname, allowed = SHIPPED[1]
    assert not list(problems_of(soname, allowed, good))
    for more in ("0x1 (NEEDED) Shared library: [libstdc++.so.6]", "0x1 (NEEDED) Shared library: [libX11.so.6]",
                 "0x1d (RUNPATH) Library runpath: [x]"):
        assert list(problems_of(soname, allowed, good + more)), more
    assert list(problems_of(soname, allowed, good.replace("OSMesa.so.8", "OSMesa.so.6")))


def main():
    self_test()
    problems = []
    for (soname, allowed), path in zip(SHIPPED, sys.argv[1:4], strict=True):
        dynamic = subprocess.run(["readelf", "-d", path], check=True, capture_output=True, text=True,
                                 env={"LC_ALL": "C", "PATH": "/usr/bin:/bin"}).stdout
        problems += problems_of(soname, allowed, dynamic)
    print("\n".join(problems) or "libraries need only what is everywhere")
    return 1 if problems else 0


sys.exit(main())
