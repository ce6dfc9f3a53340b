"""The C text of one entry point: conversions, then a call through the current table."""

from dataclasses import dataclass

from overlay import OverlayError

# Types that are the same to the compiler.
SAME = {
    "GLclampf": "GLfloat",
    "GLclampd": "GLdouble",
    "GLsizei": "GLint",
    "GLbitfield": "GLuint",
    "GLenum": "GLuint",
    "GLboolean": "GLubyte",
    "void": "GLvoid",
}
INTEGERS = {"GLbyte", "GLshort", "GLint", "GLubyte", "GLushort", "GLuint"}


@dataclass
class Value:
    """An argument on its way to the op: its C type and the expression for it."""

    type: str
    text: str


def canonical(type_name):
    return SAME.get(type_name, type_name)


def convert_number(value, wanted, conversions):
    have, want = canonical(value.type), canonical(wanted)
    if have == want:
        return value.text
    if "normalize" in conversions and have in INTEGERS and want == "GLfloat":
        return f"normalized({value.text})"
    return f"static_cast<{wanted}>({value.text})"


class Builder:
    """Walks a command's parameters beside the op's, collecting statements and arguments."""

    def __init__(self, command, operation, conversions):
        self.command, self.operation, self.conversions = command, operation, conversions
        self.statements, self.arguments = [], []

    def fail(self, reason):
        raise OverlayError(f"{self.command.name} does not fit op {self.operation.name}: {reason}")

    def wanted(self):
        if len(self.arguments) == len(self.operation.parameters):
            self.fail("too many arguments")
        return self.operation.parameters[len(self.arguments)]

    def add_number(self, value):
        self.arguments.append(convert_number(value, self.wanted().type, self.conversions))

    def add_vector(self, parameter):
        """A pointer the op takes as a pointer: as it is, or through a converted copy."""
        wanted = self.wanted()
        if wanted.element in ("GLvoid", "void") or canonical(wanted.element) == canonical(parameter.element):
            self.arguments.append(parameter.name)
        elif "by" in self.conversions:
            self.statements.append(f"const auto converted = {self.conversions['by'][0]}(pname, {parameter.name});")
            self.arguments.append("converted.data()")
        elif parameter.length:
            copy = f"converted<{wanted.element}, {parameter.length}>({parameter.name})"
            self.statements.append(f"const auto copy = {copy};")
            self.arguments.append("copy.data()")
        else:
            self.fail(f"no conversion for the vector {parameter.name}")

    def add_scalar_as_vector(self, parameter):
        wanted = self.wanted()
        text = convert_number(Value(parameter.type, parameter.name), wanted.element, self.conversions)
        self.statements.append(f"const {wanted.element} value = {text};")
        self.arguments.append("&value")

    def add(self, parameter):
        wanted = self.wanted()
        if parameter.is_pointer and wanted.is_pointer:
            self.add_vector(parameter)
        elif parameter.is_pointer:
            if not parameter.length:
                self.fail(f"length of {parameter.name} unknown")
            for i in range(parameter.length):
                self.add_number(Value(parameter.element, f"{parameter.name}[{i}]"))
        elif wanted.is_pointer:
            self.add_scalar_as_vector(parameter)
        elif parameter.name == "pname" and "scalar" in self.conversions:
            names = ", ".join(self.conversions["scalar"])
            self.arguments.append(f"scalar_pname<{names}>(pname)")
        else:
            self.add_number(Value(parameter.type, parameter.name))

    def pad(self):
        values = self.conversions.get("pad", [])
        for parameter in self.operation.parameters[len(self.arguments) :]:
            if len(self.arguments) >= len(values):
                self.fail(f"nothing for parameter {parameter.name}")
            self.arguments.append(values[len(self.arguments)] + ".0f")

    def build(self):
        dropped = self.conversions.get("drop", [])
        for parameter in self.command.parameters:
            if parameter.name not in dropped:
                self.add(parameter)
        self.pad()
        return self


def named_parameters(command, conversions):
    """The C parameter list; a dropped parameter loses its name, so that it is not an unused one."""
    dropped = conversions.get("drop", [])
    return ", ".join(p.type if p.name in dropped else str(p) for p in command.parameters)


def entry_point(command, operation, conversions):
    """The definition of `command` as a call of `operation`."""
    built = Builder(command, operation, conversions).build()
    call = "HALFSPACE_CALL(" + ", ".join([operation.name] + built.arguments) + ");"
    if command.return_type != "void":
        call = "return " + call
    body = "\n".join(f"  {line}" for line in built.statements + [call])
    parameters = named_parameters(command, conversions)
    return f"HALFSPACE_ENTRY {command.return_type} GLAPIENTRY {command.name}({parameters}) {{\n{body}\n}}\n"
