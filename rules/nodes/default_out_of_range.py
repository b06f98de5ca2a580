"""ND082: parameter defaults are in the range of their descriptor."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.python import is_handled
from scaffold.api.rclpy import Parameter, RclpyFile, is_of_node

_RIGHT = {"integer": "integer_range", "double": "floating_point_range"}
_NODE = (
    "from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor\n"
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        limits = FloatingPointRange(from_value=0.0, to_value=1.0{})\n"
    "        descriptor = ParameterDescriptor(floating_point_range=[limits])\n"
    "        self.declare_parameter('gain', {}, descriptor)\n"
)


class DefaultOutOfRange(RclpyRule):
    """The default of a parameter is outside the range in its descriptor.

    **Why.** The node ends at start: ``InvalidParameterValueException: Invalid parameter value (5.0)
    for parameter. Reason: Parameter gain out of range Min: 0.0, Max: 1.0, value: 5.0``. A range
    for the other number type is ignored: any value is accepted.

    **Fix.** Change the default or the range; write ``1.0`` for a floating_point_range.

    **Source.** ``rclpy/node.py``, ``_apply_descriptor``.
    """

    code = "ND082"
    name = "default-out-of-range"
    examples = (
        Example("in the range", {"talker.py": _NODE.format("", "0.55")}),
        Example("on a step", {"talker.py": _NODE.format(", step=0.1", "0.7")}),
        Example(
            "too large",
            {"talker.py": _NODE.format("", "5.0")},
            Report(
                "10:40",
                "default 5.0 is outside the range 0.0 to 1.0 of the descriptor: "
                "InvalidParameterValueException",
            ),
        ),
        Example(
            "between two steps",
            {"talker.py": _NODE.format(", step=0.1", "0.25")},
            Report(
                "10:40",
                "default 0.25 is outside the range 0.0 to 1.0 in steps of 0.1 of "
                "the descriptor: InvalidParameterValueException",
            ),
        ),
        Example(
            "an integer with a range of doubles",
            {"talker.py": _NODE.format("", "1")},
            Report(
                "10:40",
                "default 1 is an integer: the double range of the descriptor is "
                "ignored; use integer_range",
            ),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for parameter in (p for p in file.parameters if is_of_node(file, p)):
            message = _problem(parameter) if parameter.default_node is not None else ""
            if message and not is_handled(
                file.module, parameter.call, "InvalidParameterValueException"
            ):
                at = parameter.default_node or parameter.call
                yield self.report(file.module.location(at), message)


def _problem(parameter: Parameter) -> str:
    default, kind = parameter.default, parameter.type
    ranges = parameter.descriptor.ranges if parameter.descriptor is not None else []
    if not isinstance(default, int | float) or kind not in _RIGHT:
        return ""
    for limits in ranges:
        if limits.type == kind and not limits.allows(default):
            return (
                f"default {default} is outside the range {limits.text} of the descriptor: "
                "InvalidParameterValueException"
            )
    if ranges and all(limits.type != kind for limits in ranges):
        article = "an" if kind == "integer" else "a"
        return (
            f"default {default} is {article} {kind}: the {ranges[0].type} range of the "
            f"descriptor is ignored; use {_RIGHT[kind]}"
        )
    return ""
