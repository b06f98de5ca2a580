"""ND037: parameter values are read from the field of their type."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, RclpyRule, Report, Safety
from scaffold.api.parameters import declared_by
from scaffold.api.python import UNKNOWN
from scaffold.api.rclpy import FIELDS, RclpyFile, is_listed_parameter, name_asked, parameter_read

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.declare_parameter('period', 0.2)\n"
    "        self.period = self.get_parameter('period').get_parameter_value().{}\n"
)
_VARIABLES = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.parameter = self.declare_parameter('period', 0.2)\n"
    "        value = self.parameter.get_parameter_value()\n"
    "        self.period = value.{}\n"
)


class ParameterFieldDiffers(RclpyRule):
    """A parameter is read from a field of ParameterValue that belongs to another type.

    **Why.** No error: the other fields are 0, False or empty, whatever the parameter is set to.

    **Fix.** Read the field of the declared type, or ``.value``.

    **Source.** ``rcl_interfaces/msg/ParameterValue.msg``.
    """

    code = "ND037"
    name = "parameter-field-differs"
    examples = (
        Example("the field of its type", {"talker.py": _NODE.format("double_value")}),
        Example(
            "another field as a fallback",
            {
                "talker.py": _VARIABLES.format("double_value").replace(
                    "        self.period = value.double_value\n",
                    "        try:\n            self.period = value.double_value\n"
                    "        except AttributeError:\n"
                    "            self.period = value.integer_value\n",
                )
            },
        ),
        Example(
            "another field",
            {"talker.py": _NODE.format("integer_value")},
            Report(
                "8:23",
                "'period' is declared as double: integer_value is always empty; use double_value",
                unsafe_fix="read the field of the declared type",
            ),
            fixed={"talker.py": _NODE.format("double_value")},
        ),
        Example(
            "through variables",
            {"talker.py": _VARIABLES.format("string_value")},
            Report(
                "9:23",
                "'period' is declared as double: string_value is always empty; use double_value",
                unsafe_fix="read the field of the declared type",
            ),
            fixed={"talker.py": _VARIABLES.format("double_value")},
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        for name in FIELDS:
            for field in file.module.index.attributes(name):
                read, declared = _read(package, file, field)
                if not declared or field.attr == f"{declared}_value":
                    continue
                parents = file.module.parents(field)
                if any(isinstance(parent, ast.ExceptHandler) for parent in parents):
                    continue  # a fallback
                _, end = file.module.span(field)
                edit = Edit(file.module.path, end - len(field.attr), end, f"{declared}_value")
                message = f"{read!r} is declared as {declared}: {field.attr} is always empty; "
                message += f"use {declared}_value"
                fix = Fix("read the field of the declared type", (edit,), Safety.UNSAFE)
                yield self.report(file.module.location(field), message, fix)


def _read(package: Package, file: RclpyFile, field: ast.Attribute) -> tuple[str, str]:
    """Return name and declared type of the parameter that a field is read from.

    Both are empty if that is not certain.
    """
    match file.evaluator.single_value(field.value):
        case ast.Call(func=ast.Attribute(attr="get_parameter_value", value=parameter)):
            owner, name = parameter_read(file, parameter)
            if isinstance(parameter, ast.Name) and is_listed_parameter(file, parameter):
                class_ = file.module.enclosing_class(field)
                owner = file.node_class(class_) if class_ is not None else None
                name = name_asked(file, field, parameter.id) or UNKNOWN
            if owner is not None and isinstance(name, str):
                declared = declared_by(owner, package)
                return name, declared.types.get(name) or ""
    return "", ""
