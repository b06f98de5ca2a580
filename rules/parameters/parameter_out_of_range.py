"""PF031: values of parameters are in the range of their descriptor."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.declared_parameters import Declared, declared_by
from scaffold.model.handlers import is_harmless
from scaffold.model.launch_nodes import started_nodes
from scaffold.model.launch_values import value_given
from scaffold.model.node_entities import Parameter
from scaffold.model.parameter_files import number_of, parameter_file, parameter_paths
from scaffold.model.parameter_use import nodes_for

_NODE = (
    "from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor\n"
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        limits = FloatingPointRange(from_value=0.0, to_value=1.0{})\n"
    "        descriptor = ParameterDescriptor(floating_point_range=[limits])\n"
    "        self.declare_parameter('gain', {}, descriptor)\n"
)
_FILE = "talker:\n  ros__parameters:\n    gain: {}\n"


class ParameterOutOfRange(Rule):
    """A parameter has a value outside of the range of its descriptor, or between its steps.

    **Why.** The node ends at start: ``InvalidParameterValueException: Invalid parameter value (2.0)
    for parameter. Reason: Parameter gain out of range Min: 0.0, Max: 1.0, value: 2.0``. The range
    of another type of numbers is not looked at.

    **Fix.** Change the value or the range.

    **Source.** ``rclpy/node.py``, ``_apply_floating_point_range`` and ``_apply_integer_range``.
    """

    code = "PF031"
    name = "parameter-out-of-range"
    examples = (
        Example(
            "in the range, at its end, on a step",
            {
                "talker.py": _NODE.format(", step=0.1", "1.0"),
                "a.yaml": _FILE.format("0.3"),
            },
        ),
        Example(
            "the default, and a value in a file",
            {"talker.py": _NODE.format("", "5.0"), "a.yaml": _FILE.format("1.5")},
            at=("a.yaml:3", "talker.py:10"),
        ),
        Example(
            "between two steps; an integer",
            {
                "talker.py": _NODE.format(", step=0.1", "0.25"),
                "other.py": _NODE.format("", "1").replace("talker", "other"),
            },
            at=("other.py:10", "talker.py:10"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._in_code(package)
        for path in parameter_paths(package):
            file = parameter_file(package, path)
            for section in file.sections if file else ():
                known = [declared_by(owner, package) for owner in nodes_for(package, path, section)]
                for entry in section.entries:
                    message = _message(known, entry.name, number_of(entry.value))
                    if message:
                        yield self.report(entry.value, message)
        for node in started_nodes(package):
            owner = node.owner
            for name, _, given in node.parameter_dicts if owner is not None else ():
                found = value_given(node.launch, given)
                if owner is not None and found is not None and found.number is not None:
                    message = _message([declared_by(owner, package)], name, found.number)
                    if message:
                        yield self.report(node.launch.location(given), message)

    def _in_code(self, package: Package) -> Iterator[Diagnostic]:
        for facts in package.rclpy_files():
            for one in facts.parameters:
                message = _default_problem(one) if one.default_node is not None else ""
                if message and not is_harmless(
                    facts.module, one.call, "InvalidParameterValueException"
                ):
                    yield self.report(facts.module.location(one.default_node or one.call), message)


def _default_problem(parameter: Parameter) -> str:
    """Return what is wrong about the default of a parameter, by its own descriptor."""
    default, kind = parameter.default, parameter.type
    ranges = parameter.descriptor.ranges if parameter.descriptor is not None else []
    if not isinstance(default, int | float) or isinstance(default, bool):
        return ""
    for limits in ranges:
        if limits.type == kind and not limits.allows(default):
            return f"the default {default} is not in the range of the descriptor, {limits.text}"
    if ranges and all(limits.type != kind for limits in ranges):
        right = "integer_range" if kind == "integer" else "floating_point_range"
        return (
            f"the default {default} is {_article(kind)}, so the descriptor's range of "
            f"{ranges[0].type}s is ignored: there is {right}"
        )
    return ""


def _message(known: list[Declared], name: str, value: float | None) -> str:
    """Return what is wrong about a value, by the descriptor of the nodes that get it."""
    kind = "integer" if isinstance(value, int) else "double"
    for one in known if value is not None else ():
        place = one.places.get(name)
        descriptor = place.descriptor if place is not None else None
        if place is None or descriptor is None or one.types.get(name) != kind:
            continue
        for limits in descriptor.ranges:
            if value is not None and limits.type == kind and not limits.allows(value):
                at = place.location
                where = f"{name} ({at.path}:{at.line})"
                return f"{where} is in the range {limits.text}, and {value} is not: the node dies"
    return ""


def _article(kind: str | None) -> str:
    return f"an {kind}" if kind == "integer" else f"a {kind}"
