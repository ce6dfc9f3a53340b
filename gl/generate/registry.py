"""What gl.xml says about commands: return type, parameters, vector lengths, aliases."""

import re
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Parameter:
    """One parameter: `length` is the number of elements behind a pointer when it is fixed, else 0."""

    type: str
    name: str
    length: int = 0

    @property
    def is_pointer(self):
        return self.type.endswith("*")

    @property
    def element(self):
        """The type pointed to, without const."""
        return self.type.removesuffix("*").replace("const", "").strip()

    def __str__(self):
        return f"{self.type} {self.name}"


@dataclass
class Command:
    """A C function of the API."""

    name: str
    return_type: str
    parameters: list = field(default_factory=list)
    alias: str = ""
    desktop: bool = False  # of OpenGL, not of OpenGL ES only


def tidy_type(text):
    """Writes a C type the way the house does: 'const GLfloat*'. What is pointed to is GLvoid, as in the overlay."""
    text = re.sub(r"\bvoid(?=\s*\*)", "GLvoid", text)
    return re.sub(r"\s*\*", "*", re.sub(r"\s+", " ", text)).strip()


def text_without_name(node):
    """The type in front of <name> in a <proto> or <param>."""
    parts = [node.text or ""]
    for child in node:
        if child.tag != "name":
            parts.append(child.text or "")
        parts.append(child.tail or "")
    return tidy_type("".join(parts))


def read_parameter(node):
    length = node.get("len", "")
    return Parameter(text_without_name(node), node.findtext("name"), int(length) if length.isdigit() else 0)


def read_command(node):
    proto = node.find("proto")
    alias = node.find("alias")
    return Command(
        name=proto.findtext("name"),
        return_type=text_without_name(proto),
        parameters=[read_parameter(parameter) for parameter in node.findall("param")],
        alias=alias.get("name") if alias is not None else "",
    )


def desktop_names(root):
    """The commands some version or extension of OpenGL asks for."""
    requirers = [node for node in root.findall("feature") if node.get("api") == "gl"]
    requirers += [node for node in root.findall("extensions/extension") if "gl" in node.get("supported").split("|")]
    return {
        command.get("name")
        for requirer in requirers
        for require in requirer.findall("require")
        if require.get("api", "gl") == "gl"
        for command in require.findall("command")
    }


def read_registry(path):
    """All commands of gl.xml, by name."""
    root = ElementTree.parse(path).getroot()
    commands = {command.name: command for command in map(read_command, root.findall("commands/command"))}
    for name in desktop_names(root):
        commands[name].desktop = True
    return commands
