"""The fuzzer's tables: the commands it may call, and the names of the values they take."""

import xml.etree.ElementTree as ElementTree

VERSIONS = ("GL_VERSION_1_0", "GL_VERSION_1_1")


def required_names(root, kind):
    """What the versions ask for, in the registry's order, each once."""
    names = {}
    for feature in root.findall("feature"):
        if feature.get("name") in VERSIONS:
            for require in feature.findall("require"):
                names |= {node.get("name"): None for node in require.findall(kind)}
    return list(names)


# What GL writes to these is looked at by the player itself.
CAPTURE_BUFFERS = ("glFeedbackBuffer", "glSelectBuffer")


def is_sendable(command):
    """It can be sent to another process: no answer through a pointer, no pointer but one to data that is read."""
    if command.name in CAPTURE_BUFFERS:
        return True
    pointers = [p for p in command.parameters if p.is_pointer]
    return len(pointers) <= 1 and all(p.type.startswith("const ") for p in pointers)


def groups_of(root):
    """command -> the groups of values its parameters take, "" where none is named."""
    found = {}
    for command in root.findall("commands/command"):
        found[command.findtext("proto/name")] = [p.get("group", "") for p in command.findall("param")]
    return found


def fuzz_commands(gl_xml, registry, notice):
    root = ElementTree.parse(gl_xml).getroot()
    groups = groups_of(root)
    lines = [
        f'HALFSPACE_COMMAND({name}, "{",".join(groups[name])}")'
        for name in sorted(required_names(root, "command"))
        if is_sendable(registry[name])
    ]
    return f"{notice}\n// Command, groups of the values its parameters take.\n" + "\n".join(lines) + "\n"


def fuzz_values(gl_xml, notice):
    root = ElementTree.parse(gl_xml).getroot()
    groups = {enum.get("name"): enum.get("group", "") for enum in root.findall("enums/enum")}
    lines = [f'HALFSPACE_VALUE({name}, ",{groups[name]},")' for name in required_names(root, "enum")]
    return f"{notice}\n// Value, groups it is in.\n" + "\n".join(lines) + "\n"
