"""PF031: parameter values are in the range of their descriptor."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.launch import started_nodes, values_in_files
from scaffold.api.parameters import (
    Declared,
    declared_by,
    number_of,
    place_of,
)

_NODE = (
    "from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor\n"
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        limits = FloatingPointRange(from_value=0.0, to_value=1.0, step=0.1)\n"
    "        descriptor = ParameterDescriptor(floating_point_range=[limits])\n"
    "        self.declare_parameter('gain', 0.5, descriptor)\n"
)
_FILE = "talker:\n  ros__parameters:\n    gain: {}\n"


class ParameterOutOfRange(Rule):
    """A parameter is set to a value outside the range that the node declares.

    **Why.** The node ends at start: ``InvalidParameterValueException: Invalid parameter value (2.0)
    for parameter. Reason: Parameter gain out of range Min: 0.0, Max: 1.0, value: 2.0``; likewise
    for a value between two steps.

    **Fix.** Change the value or the range.

    **Source.** ``rclpy/node.py``, ``_apply_floating_point_range`` and ``_apply_integer_range``.
    """

    code = "PF031"
    name = "parameter-out-of-range"
    examples = (
        Example("on a step", {"talker.py": _NODE, "a.yaml": _FILE.format("0.3")}),
        Example("at the upper bound", {"talker.py": _NODE, "a.yaml": _FILE.format("1.0")}),
        Example(
            "too large; between two steps",
            {"talker.py": _NODE, "a.yaml": _FILE.format("1.5"), "b.yaml": _FILE.format("0.25")},
            Report(
                "a.yaml:3:11",
                "1.5 is outside the range 0.0 to 1.0 in steps of 0.1 of 'gain' "
                "(talker.py:10): InvalidParameterValueException",
            ),
            Report(
                "b.yaml:3:11",
                "0.25 is outside the range 0.0 to 1.0 in steps of 0.1 of 'gain' "
                "(talker.py:10): InvalidParameterValueException",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for _, entry, declarations in values_in_files(package):
            message = _message(package, declarations, entry.name, number_of(entry.value))
            if message:
                yield self.report(entry.value, message)
        for node in started_nodes(package):
            numbers = [x for x in node.parameters if x.value and x.value.number is not None]
            owner = node.owner(package) if numbers else None
            declarations = [declared_by(owner, package)] if owner is not None else []
            for given in numbers:
                number = given.value.number if given.value is not None else None
                message = _message(package, declarations, given.name, number)
                if message:
                    yield self.report(given, message)


def _message(package: Package, declarations: list[Declared], name: str, value: float | None) -> str:
    """Return the message for a value outside the range that its nodes declare."""
    kind = "integer" if isinstance(value, int) else "double"
    for declared in declarations if value is not None else ():
        place = declared.places.get(name)
        descriptor = place.descriptor if place is not None else None
        if place is None or descriptor is None or declared.types.get(name) != kind:
            continue
        for limits in descriptor.ranges:
            if value is not None and limits.type == kind and not limits.allows(value):
                where = place_of(place.package, place.location, package)
                return (
                    f"{value} is outside the range {limits.text} of {name!r} "
                    f"({where}): InvalidParameterValueException"
                )
    return ""
