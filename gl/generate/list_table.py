"""The C text of the table that compiles display lists: how each op's arguments are kept."""

from overlay import OverlayError


def kept_argument(operation, parameter):
    """The expression for an argument as the list keeps it."""
    if not parameter.is_pointer:
        return parameter.name
    names = [p.name for p in operation.parameters]
    rule = operation.kept.get(parameter.name)
    if not rule and parameter.name == "params" and "pname" in names:
        rule = "pname_values(pname)"
    if not rule:
        raise OverlayError(
            f"op {operation.name} can be compiled into a display list: give it a line "
            f"'    list {parameter.name} = COUNT' with the number of elements to keep"
        )
    if rule.startswith("image("):
        return f"keep_image(context, {rule[len('image('):-1]}, {parameter.name})"
    return f"keep(context, {parameter.name}, {rule})"


def is_image(operation):
    return any(rule.startswith("image(") for rule in operation.kept.values())


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
    if operation.exception:
        body = f"  if ({operation.exception}) return {member}::pass({plain});\n" + body
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
