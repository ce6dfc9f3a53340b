#!/usr/bin/env python3
"""Compares gl_commands.gen.def with what gl.xml (Debian: khronos-api) says of OpenGL 1.0 and 1.1, or writes it.

    gl_commands.py [--write] [--gl-xml FILE]
"""

import argparse
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

FILE = Path(__file__).resolve().parent / "gl_commands.gen.def"
HEAD = "// OpenGL 1.0 and 1.1 as gl.xml lists them; written by gl_commands.py.\n"


def text(gl_xml):
    """GL_COMMAND(name, how many parameters are enumerations) and GL_GET_NAME(what glGet knows)."""
    root = ElementTree.parse(gl_xml).getroot()
    features = [f for f in root.findall("feature") if f.get("name") in ("GL_VERSION_1_0", "GL_VERSION_1_1")]
    commands = {node.get("name") for feature in features for node in feature.iter("command")}
    enums = {node.get("name") for feature in features for node in feature.iter("enum")}
    lines = []
    for command in root.findall("commands/command"):
        name = command.findtext("proto/name")
        if name in commands:
            count = sum(parameter.findtext("ptype") == "GLenum" for parameter in command.findall("param"))
            lines.append(f"GL_COMMAND({name}, {count})\n")
    for enum in root.findall("enums/enum"):
        if enum.get("name") in enums and "GetPName" in enum.get("group", "").split(","):
            lines.append(f"GL_GET_NAME({enum.get('name')})\n")
    return HEAD + "".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--gl-xml", default="/usr/share/khronos-api/gl.xml")
    arguments = parser.parse_args()
    wanted = text(arguments.gl_xml)
    if arguments.write:
        FILE.write_text(wanted, encoding="utf-8")
    elif FILE.read_text(encoding="utf-8") != wanted:
        sys.exit(f"{FILE.name} is not what gl.xml says; run gl_commands.py --write and give new commands their rows")


if __name__ == "__main__":
    main()
