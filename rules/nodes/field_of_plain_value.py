"""ND098: ``.value`` of a parameter is the value itself."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.python import is_handled
from scaffold.api.rclpy import FIELDS, PARAMETER, RclpyFile, class_of

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter('rate', 2.0)\n"
    "        self.rate = self.get_parameter('rate'){}.double_value\n"
)


class FieldOfPlainValue(RclpyRule):
    """A field of ``ParameterValue`` is read from ``.value``, which is the value itself.

    **Why.** ``AttributeError: 'float' object has no attribute 'double_value'``.

    **Fix.** ``.value`` alone, or ``.get_parameter_value().double_value``.

    **Source.** ``rclpy/parameter.py``.
    """

    code = "ND098"
    name = "field-of-plain-value"
    examples = (
        Example("a field of the message", {"talker.py": _NODE.format(".get_parameter_value()")}),
        Example(
            "a field of the value",
            {"talker.py": _NODE.format(".value")},
            Report("8:21", "'.value' is the value itself, without 'double_value': AttributeError"),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for field in FIELDS:
            for attribute in file.module.index.attributes(field):
                match file.evaluator.single_value(attribute.value):
                    case ast.Attribute(attr="value", value=parameter):
                        is_parameter = class_of(file, parameter) == PARAMETER
                    case _:
                        continue
                if is_parameter and not is_handled(file.module, attribute, "AttributeError"):
                    message = f"'.value' is the value itself, without {field!r}: AttributeError"
                    yield self.report(file.module.location(attribute), message)
