"""ND016: parameters are declared once."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.rclpy import RclpyFile

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.declare_parameter('rate', 2.0)\n"
    "        self.declare_parameter('{}', 1.0)\n"
)


class ParameterRepeated(RclpyRule):
    """A node declares a parameter twice, or ``use_sim_time``, which every node has.

    **Why.** ``rclpy.exceptions.ParameterAlreadyDeclaredException`` at start.

    **Fix.** Remove the second declaration, and that of ``use_sim_time``.

    **Source.** ``rclpy/node.py``, ``declare_parameters``; ``rclpy/time_source.py``.
    """

    code = "ND016"
    name = "parameter-repeated"
    examples = (
        Example("two parameters", {"talker.py": _NODE.format("period")}),
        Example(
            "one parameter twice",
            {"talker.py": _NODE.format("rate")},
            Report(
                "8:32",
                "parameter 'rate' is already declared in line 7: ParameterAlreadyDeclaredException",
            ),
        ),
        Example(
            "a parameter of every node",
            {"talker.py": _NODE.format("use_sim_time")},
            Report(
                "8:32",
                "'use_sim_time' is already declared by rclpy: ParameterAlreadyDeclaredException",
            ),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for parameter in file.parameters:
            if parameter.name != "use_sim_time" or parameter.owner is None:
                continue
            if not parameter.is_conditional:
                message = "'use_sim_time' is already declared by rclpy: "
                message += "ParameterAlreadyDeclaredException"
                yield self.report(parameter.name_location, message)
        for node in file.nodes:
            first: dict[str, int] = {}
            for parameter in node.parameters:
                name = parameter.name
                if not isinstance(name, str) or parameter.is_conditional:
                    continue
                at = parameter.name_location
                if name in first:
                    message = (
                        f"parameter {name!r} is already declared in line {first[name]}: "
                        "ParameterAlreadyDeclaredException"
                    )
                    yield self.report(at, message)
                else:
                    first[name] = at.line
