"""ND037: a parameter's value is read from the field that its type fills."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Rule, Safety
from scaffold.model.node_entities import ParameterRead
from scaffold.model.nodes import NodeFacts

FIELDS = frozenset(
    {"bool_value", "integer_value", "double_value", "string_value", "byte_array_value"}
    | {"bool_array_value", "integer_array_value", "double_array_value", "string_array_value"}
)
_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.declare_parameter('period', 0.2)\n"
    "        self.period = self.get_parameter('period').get_parameter_value().{}\n"
)


class ParameterFieldDiffers(Rule):
    """A parameter is read from a field of ParameterValue that its type does not fill.

    **Why.** No error: the other fields are 0, False or empty, whatever the parameter is set to.

    **Fix.** Read the field of the declared type, or ``.value``.

    **Source.** ``rcl_interfaces/msg/ParameterValue.msg``.
    """

    code = "ND037"
    name = "parameter-field-differs"
    examples = (
        Example("the field of its type", {"talker.py": _NODE.format("double_value")}),
        Example(
            "another field",
            {"talker.py": _NODE.format("integer_value")},
            at=("talker.py:8",),
            fixed={"talker.py": _NODE.format("double_value")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for facts in package.rclpy_files():
            for read in facts.parameter_reads:
                field = _field_read(facts, read)
                declared = _declared(facts, read) if field is not None else ""
                if field is None or not declared or field.attr == f"{declared}_value":
                    continue
                _, end = facts.module.span(field)
                edit = Edit(facts.module.path, end - len(field.attr), end, f"{declared}_value")
                message = f"{read.name!r} is declared as {declared}, so {field.attr} stays empty"
                fix = Fix("read the field of its type", (edit,), Safety.UNSAFE)
                yield self.report(facts.module.location(field), message, fix)


def _field_read(facts: NodeFacts, read: ParameterRead) -> ast.Attribute | None:
    """Return ``....get_parameter_value().integer_value`` around a read."""
    asked = facts.module.parent(read.call)
    called = facts.module.parent(asked) if asked else None
    field = facts.module.parent(called) if called else None
    match field:
        case ast.Attribute(
            attr=name, value=ast.Call(func=ast.Attribute(attr="get_parameter_value", value=value))
        ) if name in FIELDS and value is read.call and read.method == "get_parameter":
            return field
    return None


def _declared(facts: NodeFacts, read: ParameterRead) -> str:
    """Return the type that the one declaration in the file gives; empty if that is not sure."""
    if read.owner is None:
        return ""
    found = [item for item in facts.parameters if item.name == read.name]
    if len(found) != 1 or found[0].owner is not read.owner or found[0].argument("descriptor"):
        return ""
    return found[0].type or ""
