"""PF008: parameters that a node divides by are not zero."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Location, Package, Rule
from scaffold.api.launch import started_nodes, values_in_files
from scaffold.api.parameters import (
    Declared,
    declared_by,
    number_of,
    own_nodes,
    place_of,
)
from scaffold.api.programs import KnownNode

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        self.rate = self.declare_parameter('rate', {}).value\n"
    "        self.create_timer({}, print)\n"
)
_FILE = "talker:\n  ros__parameters:\n    rate: {}\n"


class DivisorZero(Rule):
    """A parameter that a node divides by is zero.

    **Why.** ``ZeroDivisionError: float division by zero``: the node fails at start, or in the
    callback that divides.

    **Fix.** Set another value; in the node, give the parameter a range or check it first.

    **Source.** Python documentation, "Built-in Exceptions".
    """

    code = "PF008"
    name = "divisor-zero"
    examples = (
        Example(
            "a nonzero value",
            {"talker.py": _NODE.format("2.0", "1.0 / self.rate"), "a.yaml": _FILE.format("1.0")},
        ),
        Example(
            "checked first",
            {
                "talker.py": _NODE.format("2.0", "1.0 / self.rate if self.rate else 1.0"),
                "a.yaml": _FILE.format("0.0"),
            },
        ),
        Example(
            "a default of zero that a file overrides",
            {"talker.py": _NODE.format("0.0", "1.0 / self.rate"), "a.yaml": _FILE.format("1.0")},
        ),
        Example(
            "zero in a parameter file",
            {"talker.py": _NODE.format("2.0", "1.0 / self.rate"), "a.yaml": _FILE.format("0.0")},
            "a.yaml:3:11: 'rate' is 0, and the node (talker.py:7) divides by it: ZeroDivisionError",
        ),
        Example(
            "a default of zero",
            {"talker.py": _NODE.format("0.0", "1.0 / self.rate")},
            "7:21: 'rate' is 0 by default, and the node divides by it: ZeroDivisionError",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for name, declarations, at in _zeros(package):
            for message in _messages(package, declarations, name):
                yield self.report(at, message)
        for own in own_nodes(package)[0]:
            for name, place in declared_by(own, package).places.items():
                is_number = isinstance(place.default, int | float)
                is_zero = is_number and place.default == 0 and place.default is not False
                if is_zero and place.divides and not _is_set(package, own, name):
                    message = (
                        f"{name!r} is 0 by default, and the node divides by it: ZeroDivisionError"
                    )
                    yield self.report(place.location, message)


def _is_set(package: Package, node: KnownNode, name: str) -> bool:
    """Return whether a launch file or a parameter file replaces a default."""
    declared = declared_by(node, package)
    if any(entry.name == name and declared in of for _, entry, of in values_in_files(package)):
        return True
    return any(
        started.owner(package) == node and any(given.name == name for given in started.parameters)
        for started in started_nodes(package)
    )


def _zeros(package: Package) -> Iterator[tuple[str, list[Declared], Location]]:
    """Yield the parameters that are set to zero, with their declarations and places."""
    for _, entry, declarations in values_in_files(package):
        if number_of(entry.value) == 0:
            yield entry.name, declarations, entry.value.location
    for node in started_nodes(package):
        owner = node.owner(package)
        for given in node.parameters if owner is not None else ():
            if owner is not None and given.value is not None and given.value.number == 0:
                yield given.name, [declared_by(owner, package)], given.location


def _messages(package: Package, declarations: list[Declared], name: str) -> Iterator[str]:
    """Yield the message for a zero parameter if its node divides by it."""
    for declared in declarations:
        place = declared.places.get(name)
        if place is not None and place.divides:
            where = place_of(place.package, place.location, package)
            yield f"{name!r} is 0, and the node ({where}) divides by it: ZeroDivisionError"
            return
