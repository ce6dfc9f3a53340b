#!/usr/bin/env python3
"""Checks that what glGetString(GL_EXTENSIONS) promises can be called: every command that gl.xml lists for one of these
extensions is in the table of the commands we implement.

    extensions_test.py LIBOSMESA GL_XML PROC_TABLE
"""

import ctypes
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

OSMESA_RGBA, GL_UNSIGNED_BYTE, GL_EXTENSIONS = 0x1908, 0x1401, 0x1F03


def advertised(library):
    """The names that a context of the library gives."""
    gl = ctypes.CDLL(library)
    gl.OSMesaCreateContext.restype = ctypes.c_void_p
    gl.OSMesaMakeCurrent.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_uint, ctypes.c_int, ctypes.c_int]
    gl.glGetString.restype = ctypes.c_char_p
    pixels = ctypes.create_string_buffer(4 * 4)
    context = gl.OSMesaCreateContext(OSMESA_RGBA, None)
    if not gl.OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, 2, 2):
        sys.exit("no context")
    return gl.glGetString(GL_EXTENSIONS).decode().split()


def commands_of(registry):
    """Extension name -> its commands. The registry leaves out GL_EXT_texture_edge_clamp, which has none."""
    return {
        extension.get("name"): [command.get("name") for command in extension.iter("command")]
        for extension in ElementTree.parse(registry).getroot().find("extensions")
    }


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    library, registry, table = sys.argv[1:]
    implemented = set(re.findall(r'"(gl\w+)"', Path(table).read_text(encoding="utf-8")))
    known = commands_of(registry)
    wrong = 0
    names = advertised(library)
    for name in names:
        missing = [command for command in known.get(name, []) if command not in implemented]
        if missing:
            wrong += 1
            print(f"{name}: {' '.join(missing)} cannot be called")
    if names != sorted(set(names)):
        wrong += 1
        print("the names are not in order, or some come twice:", " ".join(names))
    print(f"{len(names)} extensions, {wrong} wrong")
    sys.exit(1 if wrong or not names else 0)


if __name__ == "__main__":
    main()
