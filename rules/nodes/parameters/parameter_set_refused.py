"""ND086: nodes set their parameters to values that rclpy accepts."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule
from scaffold.api.parameters import Declared, a_type, declared_by
from scaffold.api.rclpy import ParameterMade, RclpyFile, parameters_set

_NODE = (
    "from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor\n"
    "from rclpy.node import Node\nfrom rclpy.parameter import Parameter\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter('rate', 1.0{})\n\n"
    "    def on_timer(self):\n"
    "        self.set_parameters([Parameter('rate', {})])\n"
)
_FIXED = ", ParameterDescriptor(read_only=True)"
_RANGE = (
    "ParameterDescriptor(floating_point_range=[FloatingPointRange(from_value=0.0, to_value=9.0)])"
)


class ParameterSetRefused(RclpyRule):
    """A node sets one of its parameters to a value that rclpy rejects.

    **Why.** There is no error: ``set_parameters`` returns ``successful=False`` and the reason,
    ``Wrong parameter type``, ``Trying to set a read-only parameter`` or ``out of range``, and the
    parameter keeps its value. Undeclaring a read-only parameter raises
    ``ParameterImmutableException``.

    **Fix.** Use a value of the declared type and range; remove read_only from the descriptor.

    **Source.** ``rclpy/node.py``, ``_apply_descriptor``.
    """

    code = "ND086"
    name = "parameter-set-refused"
    examples = (
        Example("accepted", {"talker.py": _NODE.format("", "Parameter.Type.DOUBLE, 2.0")}),
        Example(
            "another type",
            {"talker.py": _NODE.format("", "value=2")},
            "12:30: 'rate' (talker.py:9) is declared as double, but this is an integer: the value "
            "does not change",
        ),
        Example(
            "read-only",
            {"talker.py": _NODE.format(_FIXED, "value=2.0")},
            "12:30: 'rate' (talker.py:9) is read-only: the value does not change",
        ),
        Example(
            "no value",
            {"talker.py": _NODE.format("", "")},
            "12:30: 'rate' (talker.py:9) is declared as double, but this has no value: the value "
            "does not change",
        ),
        Example(
            "out of range, undeclared although read-only",
            {
                "far.py": _NODE.format(f", {_RANGE}", "value=20.0"),
                "fixed.py": _NODE.format(_FIXED, "value=1.0")
                + "        self.undeclare_parameter('rate')\n",
            },
            "far.py:12:30: 20.0 is outside the range 0.0 to 9.0 of 'rate' (far.py:9): the value "
            "does not change",
            "fixed.py:12:30: 'rate' (fixed.py:9) is read-only: the value does not change",
            "fixed.py:13:9: parameter 'rate' is read-only: ParameterImmutableException",
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        for owner, made in parameters_set(file):
            problem = _problem(declared_by(owner, package), made)
            if problem:
                yield self.report(file.module.location(made.node), problem)
        for attribute in file.module.index.attributes("undeclare_parameter"):
            problem = _undeclared(package, file, attribute)
            if problem:
                yield self.report(file.module.location(attribute), problem)


def _problem(declared: Declared, made: ParameterMade) -> str:
    place = declared.places.get(made.name)
    kind = declared.types.get(made.name)
    if place is None or kind is None:
        return ""
    at = f"{made.name!r} ({place.location.path}:{place.location.line})"
    descriptor = place.descriptor
    if descriptor is not None and descriptor.is_read_only:
        return f"{at} is read-only: the value does not change"
    if made.type is not None and made.type != kind:
        given = "has no value" if made.type == "not_set" else f"is {a_type(made.type)}"
        return f"{at} is declared as {kind}, but this {given}: the value does not change"
    value = made.value
    if descriptor is not None and isinstance(value, int | float) and made.type == kind:
        for limits in descriptor.ranges:
            if limits.type == kind and not limits.allows(value):
                return (
                    f"{value} is outside the range {limits.text} of {at}: the value does not change"
                )
    return ""


def _undeclared(package: Package, file: RclpyFile, attribute: ast.Attribute) -> str:
    """Return the message for undeclaring a read-only parameter."""
    call, owner = file.module.call_with(attribute), file.owner_of(attribute.value)
    if owner is None or call is None:
        return ""
    name = file.evaluator.text(call.args[0]) if call.args else None
    place = declared_by(owner, package).places.get(name) if isinstance(name, str) else None
    if place is None or place.descriptor is None or not place.descriptor.is_read_only:
        return ""
    return f"parameter {name!r} is read-only: ParameterImmutableException"
