"""The C text of the table that compiles display lists: how each op's arguments are kept."""

from overlay import OverlayError


# What is kept of a parameter of that name, where the overlay does not say otherwise.
USUAL = {
    "bitmap": "image(width, height, GL_COLOR_INDEX, GL_BITMAP)",
    "equation": "4",
    "m": "16",
    "mask": "image(32, 32, GL_COLOR_INDEX, GL_BITMAP)",
    "names": "count_of(n)",
    "params": "pname_values(pname)",
    "pixels": "image(width, height, format, type)",
    "priorities": "count_of(n)",
    "values": "count_of(size)",
}


def rule_of(operation, parameter):
    rule = operation.kept.get(parameter.name) or USUAL.get(parameter.name)
    if not rule:
        raise OverlayError(
            f"op {operation.name} can be compiled into a display list: give it a line "
            f"'    list {parameter.name} = COUNT' with the number of elements to keep"
        )
    # A row is an image too.
    return rule if any(p.name == "height" for p in operation.parameters) else rule.replace("height", "1")


def kept_argument(operation, parameter):
    """The expression for an argument as the list keeps it."""
    if not parameter.is_pointer:
        return parameter.name
    rule = rule_of(operation, parameter)
    if rule.startswith("image("):
        return f"keep_image(context, {rule[len('image('):-1]}, {parameter.name})"
    return f"keep(context, {parameter.name}, {rule})"


def is_image(operation):
    return any(rule_of(operation, p).startswith("image(") for p in operation.parameters if p.is_pointer)


def asks_only(operation):
    """Whether a proxy target makes a question of the op: it is then executed at once (spec 5.4)."""
    return {"target", "internal_format", "pixels"} <= {parameter.name for parameter in operation.parameters}


def compile_function(operation):
    """The function that compiles an op with pointers; empty when the template does."""
    if "client" in operation.flags or "gathered" in operation.flags:
        return ""
    if not any(parameter.is_pointer for parameter in operation.parameters):
        return ""
    member = f"Compiled<&OperationTable::{operation.name}>"
    plain = ", ".join(["context"] + [p.name for p in operation.parameters])
    kept = ", ".join(["context"] + [kept_argument(operation, p) for p in operation.parameters])
    record = "record_image" if is_image(operation) else "record"
    signature = operation.signature.replace("Context&", "Context& context", 1)
    body = f"  compiling(context, [&] {{ {member}::{record}({kept}); }});\n  {member}::execute({plain});\n"
    if asks_only(operation):
        body = f"  if (is_proxy(target)) return {member}::pass({plain});\n" + body
    return f"void {operation.name}({signature}) {{\n{body}}}\n"


def table_row(operation):
    member = f"Compiled<&OperationTable::{operation.name}>"
    if "client" in operation.flags:
        return f"    .{operation.name} = {member}::pass,"
    if "gathered" in operation.flags or any(parameter.is_pointer for parameter in operation.parameters):
        return f"    .{operation.name} = compile::{operation.name},"
    return f"    .{operation.name} = {member}::compile,"


def list_table_source(notice, operations):
    functions = "\n".join(filter(None, map(compile_function, operations)))
    rows = "\n".join(map(table_row, operations))
    return f"""{notice}
#include "state/list_compile.h"

namespace halfspace::state {{
namespace compile {{
namespace {{

{functions}
}}  // namespace
}}  // namespace compile

const OperationTable kCompileTable = {{
{rows}
}};

}}  // namespace halfspace::state
"""
