"""The overlay: which commands fold to which operation, and how. operations.overlay describes its own syntax."""

import re
from dataclasses import dataclass, field

from registry import Parameter, tidy_type

OP_LINE = re.compile(r"op (?P<name>\w+)\((?P<parameters>.*)\)(?: -> (?P<result>[\w\s*]+?))?(?: : (?P<flags>[\w ]+))?$")
LIST_LINE = re.compile(r"\s+list (?P<parameter>\w+) = (?P<rule>.+)$")
KNOWN_FLAGS = {"begin", "client", "gathered"}
KNOWN_CONVERSIONS = {"normalize", "pad", "scalar", "drop", "by"}


class OverlayError(Exception):
    """A line of the overlay that does not say what it must."""


@dataclass
class Operation:
    """One meaning: a function of namespace halfspace::state::op."""

    name: str
    parameters: list
    return_type: str
    flags: set
    commands: dict = field(default_factory=dict)  # command name -> {conversion: [words]}
    kept: dict = field(default_factory=dict)  # parameter name -> what a display list keeps of it

    @property
    def signature(self):
        return ", ".join(["Context&"] + [str(parameter) for parameter in self.parameters])


def read_parameters(text):
    """'GLint x, const GLfloat* v' as Parameters."""
    parameters = []
    for part in filter(None, (part.strip() for part in text.split(","))):
        type_name, name = re.fullmatch(r"(.*?[\s*])(\w+)", part).groups()
        parameters.append(Parameter(tidy_type(type_name), name))
    return parameters


def read_operation(line):
    match = OP_LINE.match(line)
    if not match:
        raise OverlayError(f"not an op: {line}")
    flags = set((match["flags"] or "").split())
    if flags - KNOWN_FLAGS:
        raise OverlayError(f"unknown flag in: {line}")
    return Operation(match["name"], read_parameters(match["parameters"]), tidy_type(match["result"] or "void"), flags)


def expand_braces(pattern):
    """'glRect{s,i}{,v}' as glRects, glRectsv, glRecti, glRectiv."""
    match = re.search(r"\{([^{}]*)\}", pattern)
    if not match:
        return [pattern]
    head, tail = pattern[: match.start()], pattern[match.end() :]
    return [name for choice in match[1].split(",") for name in expand_braces(head + choice + tail)]


def read_conversions(text):
    conversions = {}
    for words in filter(None, (part.split() for part in text.split(","))):
        if words[0] not in KNOWN_CONVERSIONS:
            raise OverlayError(f"unknown conversion: {' '.join(words)}")
        conversions[words[0]] = words[1:]
    return conversions


def read_list_rule(operation, line):
    match = LIST_LINE.match(line)
    if not match or match["parameter"] not in [parameter.name for parameter in operation.parameters]:
        raise OverlayError(f"not a list rule of op {operation.name}: {line.strip()}")
    operation.kept[match["parameter"]] = match["rule"]


def read_overlay(path):
    """The operations, in the order of the file."""
    operations = []
    with open(path, encoding="utf-8") as file:
        for line in (line.rstrip() for line in file):
            if not line or line.startswith("#"):
                continue
            if line.startswith("op "):
                operations.append(read_operation(line))
                continue
            if line.lstrip().startswith("list "):
                read_list_rule(operations[-1], line)
                continue
            patterns, _, conversions = line.partition(" = ")
            for pattern in patterns.split():
                for name in expand_braces(pattern):
                    operations[-1].commands[name] = read_conversions(conversions)
    return operations


def bind_commands(operations, registry, exported):
    """Adds the commands that need no line: those of an op's own name, and aliases that somebody exports."""
    by_lower_name = {name.lower(): name for name in registry}
    for operation in operations:
        own_name = by_lower_name.get("gl" + operation.name.replace("_", ""))
        if own_name:
            operation.commands.setdefault(own_name, {})
        for name in operation.commands:
            if name not in registry:
                raise OverlayError(f"gl.xml has no command {name}, listed under op {operation.name}")
    owners = {name: operation for operation in operations for name in operation.commands}
    for command in registry.values():
        owner = owners.get(command.alias)
        if owner and command.name not in owners and command.name in exported and command.desktop:
            owner.commands[command.name] = owner.commands[command.alias]
