#!/usr/bin/env python3
"""Dependencies run one way: gl -> state -> raster/api <- raster, and GL's own headers stay out of raster and compare.

    includes_test.py SOURCE_DIR
"""
import pathlib
import re
import sys
import tempfile

# Room -> prefixes of what its files may include of ours.
MAY_INCLUDE = {
    "raster/api": ("raster/api/",),
    "raster": ("raster/",),
    "state": ("state/", "raster/api/"),
    "gl": ("gl/", "state/", "raster/api/"),
    "ref_app": ("ref_app/",),
    "compare": ("compare/", "raster/api/"),
    # A second opinion is worth nothing if it comes from the first.
    "tests/oracle": ("tests/oracle/", "raster/api/"),
}
# One file draws the reference scenes straight through the contract.
EXCEPTIONS = {"ref_app/raster_backend.cpp": ("ref_app/", "raster/api/")}
ROOMS = ("gl", "state", "raster", "ref_app", "compare", "tests", "bench")
NO_GL = ("raster", "compare")

SUFFIXES = {".h", ".cpp", ".c", ".inl", ".def", ".in"}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
GL_WORD = re.compile(r"\b(GL(enum|int|uint|float|double|sizei|boolean|void|ubyte|bitfield)|GL_[A-Z][A-Z0-9_]+)\b")


def rules_for(path):
    """The prefixes `path` may include, or None when it may include everything."""
    if path in EXCEPTIONS:
        return EXCEPTIONS[path]
    for room, allowed in MAY_INCLUDE.items():
        if path.startswith(room + "/"):
            return allowed
    return None


def check_file(root, path):
    text = (root / path).read_text(errors="replace")
    room = path.split("/")[0]
    problems = []
    for kind, name in INCLUDE.findall(text):
        ours = name.split("/")[0] in ROOMS and (root / name.split("/")[0]).is_dir()
        if kind == '"' and not ours and not (root / path).parent.joinpath(name).exists():
            problems.append(f'{path}: "{name}" is not named from the root')
        relative = kind == '"' and not ours and (root / path).parent.joinpath(name).exists()
        if relative:
            # Named from the file's own folder; what counts is where it leads.
            name = str((root / path).parent.joinpath(name).resolve().relative_to(root.resolve()))
            ours = True
        allowed = rules_for(path)
        if ours and allowed is not None and not name.startswith(allowed):
            problems.append(f"{path}: may not include {name}")
        if room in NO_GL and name.startswith(("GL/", "EGL/", "GLES")):
            problems.append(f"{path}: GL's headers stop before {room} ({name})")
    if room == "raster":
        for word in GL_WORD.findall(COMMENT.sub("", text)):
            problems.append(f"{path}: there is no GL in raster ({word[0]})")
    return problems


def check_tree(root):
    problems, files = [], 0
    for room in ROOMS:
        for file in sorted((root / room).rglob("*")) if (root / room).is_dir() else []:
            if file.suffix in SUFFIXES and file.is_file():
                files += 1
                problems += check_file(root, file.relative_to(root).as_posix())
    return files, problems


def self_test():
    """Each rule catches a tree that breaks it, and a tree that keeps them all passes."""
    good = {
        "raster/api/device.h": '#include <memory>\n#include "raster/api/types.h"\n',
        "raster/api/types.h": "// GL_TRIANGLES may be spoken of\n",
        "raster/device.cpp": '#include "raster/tile/tile.h"\n',
        "raster/tile/tile.h": "",
        "state/context.h": '#include <GL/gl.h>\n#include "raster/api/device.h"\n',
        "gl/api.cpp": '#include "state/context.h"\n',
        "ref_app/raster_backend.cpp": '#include "raster/api/device.h"\n',
        "tests/oracle/device.cpp": '#include "raster/api/device.h"\n',
    }
    bad = [
        ("raster/api/types.h", '#include "raster/tile/tile.h"\n'),
        ("raster/device.cpp", '#include "state/context.h"\n'),
        ("raster/device.cpp", "#include <GL/gl.h>\n"),
        ("raster/device.cpp", "int mode = GL_TRIANGLES;\n"),
        ("raster/tile/tile.h", '#include "../../state/context.h"\n'),
        ("state/context.h", '#include "raster/tile/tile.h"\n'),
        ("state/context.h", '  #  include "gl/api.h"\n'),
        ("gl/api.cpp", '#include "raster/tile/tile.h"\n'),
        ("ref_app/main.cpp", '#include "raster/api/device.h"\n'),
        ("ref_app/raster_backend.cpp", '#include "state/context.h"\n'),
        ("compare/main.cpp", '#include "state/context.h"\n'),
        ("tests/oracle/clip.cpp", '#include "raster/tile/tile.h"\n'),
        ("tests/oracle/contract/device.cpp", '#include "tests/support/canvas.h"\n'),
        ("compare/main.cpp", "#include <GL/gl.h>\n"),
    ]
    for broken in [None, *bad]:
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            files = dict(good)
            files.setdefault("gl/api.h", "")
            if broken:
                files[broken[0]] = broken[1]
            for name, text in files.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            problems = check_tree(root)[1]
            if bool(problems) != bool(broken):
                sys.exit(f"self-test: {broken}: {problems}")


def main():
    self_test()
    files, problems = check_tree(pathlib.Path(sys.argv[1]))
    if files < 100:
        problems.append(f"only {files} files found")
    print("\n".join(problems) or f"{files} files, dependencies run one way")
    return 1 if problems else 0


sys.exit(main())
