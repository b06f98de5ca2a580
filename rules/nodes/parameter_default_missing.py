"""ND015: parameters have a default."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.rclpy import Parameter, RclpyFile

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.declare_parameter({})\n"
)


class ParameterDefaultMissing(RclpyRule):
    """A parameter is declared without a default, or with an empty list.

    **Why.** Without a default, the value is None until it is set, and rclpy warns. rclpy takes an
    empty list for a byte array, and then rejects a list of strings.

    **Fix.** Pass a default, or the type: ``Parameter.Type.STRING_ARRAY``.

    **Source.** rclpy issue 1030; ``rclpy/parameter.py``: ``[]`` is a ``BYTE_ARRAY``.
    """

    code = "ND015"
    name = "parameter-default-missing"
    examples = (
        Example("with a default", {"talker.py": _NODE.format("'rate', 2.0")}),
        Example(
            "without a default",
            {"talker.py": _NODE.format("'rate'")},
            Report(
                "talker.py:7:32",
                "parameter 'rate' has no default: its value is None until it is set",
            ),
        ),
        Example(
            "an empty list",
            {"talker.py": _NODE.format("'names', []")},
            Report(
                "talker.py:7:32",
                "parameter 'names' becomes a byte array: the default is an empty list",
            ),
        ),
    )

    def check_file(self, facts: RclpyFile) -> Iterator[Diagnostic]:
        for parameter in facts.parameters:
            problem = self._problem(parameter)
            if problem:
                at = parameter.name_location
                yield self.report(at, problem)

    def _problem(self, parameter: Parameter) -> str | None:
        if not isinstance(parameter.name, str) or parameter.has_unknown_arguments:
            return None
        if parameter.declared_type is not None:
            return None
        if parameter.argument("descriptor") is not None:
            return None
        if parameter.default_node is None:
            return f"parameter {parameter.name!r} has no default: its value is None until it is set"
        if parameter.default in ([], ()):
            return (
                f"parameter {parameter.name!r} becomes a byte array: the default is an empty list"
            )
        return None
