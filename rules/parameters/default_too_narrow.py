"""PF034: defaults have the type that parameter files set."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.launch import values_in_files
from scaffold.api.parameters import (
    a_type,
    agreed_type,
    narrow_default,
    value_type,
)

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter('rate', {})\n"
)
_FILE = "talker:\n  ros__parameters:\n    rate: {}\n"


def _files(default: str, value: str) -> dict[str, str]:
    return {"talker.py": _NODE.format(default), "a.yaml": _FILE.format(value)}


class DefaultTooNarrow(Rule):
    """A default is an integer or a quoted number, but a parameter file sets a double.

    **Why.** The node ends at start: ``InvalidParameterTypeException: Trying to set parameter
    'rate' to '2.5' of type 'DOUBLE', expecting type 'INTEGER'``. The default alone sets the type.

    **Fix.** ``self.declare_parameter('rate', 1.0)``; write numbers without quotes.

    **Source.** ``rclpy/node.py``, ``declare_parameters``.
    """

    code = "PF034"
    name = "default-too-narrow"
    examples = (
        Example("doubles", _files("1.0", "2.5")),
        Example(
            "an integer",
            _files("1", "2.5"),
            Report(
                "talker.py:7:9",
                "default is an integer, but a.yaml:3 sets a double: "
                "InvalidParameterTypeException; declare a double",
            ),
        ),
        Example(
            "a quoted number",
            _files("'1'", "2"),
            Report(
                "talker.py:7:9",
                "default is a string, but a.yaml:3 sets an integer: "
                "InvalidParameterTypeException; declare an integer",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for _, entry, declarations in values_in_files(package):
            kind, _ = agreed_type(package, declarations, entry.name)
            given = value_type(entry.value)
            if not kind or not given or given == kind:
                continue
            default = narrow_default(package, declarations, entry.name, given)
            if default is not None:
                at = entry.value.location
                message = (
                    f"default is {a_type(kind)}, but {at.path}:{at.line} sets "
                    f"{a_type(given)}: InvalidParameterTypeException; "
                    f"declare {a_type(given)}"
                )
                yield self.report(default, message)
