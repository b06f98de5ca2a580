"""ND110: callbacks survive a missing transform."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Severity
from scaffold.api.programs import phases_of
from scaffold.api.python import FunctionNode, caught_around, conditions_on
from scaffold.api.rclpy import Lookup, RclpyFile, lookups_in

_USUAL = ("LookupException", "ConnectivityException", "ExtrapolationException")
_ALL = frozenset({"TransformException", "Exception", "BaseException"})
_NODE = (
    "from rclpy.node import Node\nfrom rclpy.time import Time\n"
    "from tf2_ros import Buffer, LookupException\nfrom tf2_ros import TransformException\n"
    "from tf2_ros import TransformListener\n\n\n"
    "class Follower(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('follower')\n"
    "        self.buffer = Buffer()\n"
    "        self.listener = TransformListener(self.buffer, self)\n"
    "        self.create_timer(0.1, self.tick)\n\n"
    "    def tick(self):\n"
    "        try:\n"
    "            self.buffer.lookup_transform('map', 'base_link', Time())\n"
    "        except {}:\n"
    "            return\n"
)


class TransformErrorUncaught(RclpyRule):
    """A transform lookup may raise exceptions that are not caught.

    **Why.** At start, frames are unknown (``LookupException``), then not connected
    (``ConnectivityException``), then not available at the requested time
    (``ExtrapolationException``): an exception in a callback ends the node.

    **Fix.** Catch ``TransformException``, the base class of all three.

    **Source.** ``tf2_py``; ROS 2 documentation, "Writing a listener (Python)".
    """

    code = "ND110"
    name = "transform-error-uncaught"
    severity = Severity.WARNING
    examples = (
        Example("all exceptions", {"follower.py": _NODE.format("TransformException")}),
        Example(
            "one of them",
            {"follower.py": _NODE.format("LookupException")},
            "17:13: lookup_transform() may raise ConnectivityException or ExtrapolationException, "
            "which nothing catches: the node ends; catch TransformException",
        ),
        Example(
            "another error",
            {"follower.py": _NODE.format("ValueError")},
            "17:13: lookup_transform() may raise TransformException, which nothing catches: the "
            "node ends; catch TransformException",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        if file.module.in_tests:
            return
        lookups = [x for x in lookups_in(file) if x.method in {"lookup_transform", "transform"}]
        running = phases_of(file).running if lookups else frozenset()
        for lookup in lookups:
            function = file.function_of(lookup.call)
            if function not in running or _asks_first(file, lookup):
                continue
            caught = caught_around(file.module, lookup.call)
            if not isinstance(function, ast.Lambda) and function is not None:
                caught |= _caught_outside(file, function)
            missing = [name for name in _USUAL if name not in caught]
            if not missing or caught & _ALL:
                continue
            names = " or ".join(missing) if len(missing) < len(_USUAL) else "TransformException"
            message = (
                f"{lookup.method}() may raise {names}, which nothing catches: the node ends; "
                "catch TransformException"
            )
            yield self.report(file.module.location(lookup.call), message)


def _asks_first(file: RclpyFile, lookup: Lookup) -> bool:
    """Return whether a condition checks the transform before it is looked up."""
    return any(
        isinstance(part, ast.Attribute) and "can_transform" in part.attr
        for condition in conditions_on(file.module, lookup.call)
        for part in ast.walk(condition)
    ) or file.module.mentions("wait_for_transform_async")


def _caught_outside(file: RclpyFile, function: FunctionNode) -> frozenset[str]:
    """Return the exceptions that callers of a function in the file catch."""
    result: frozenset[str] = frozenset()
    seen = {function}
    pending = [function]
    while pending:
        current = pending.pop()
        for node in (
            *file.module.index.attributes(current.name),
            *file.module.index.names(current.name),
        ):
            result |= caught_around(file.module, node)
            caller = file.module.enclosing_function(node)
            if caller is not None and caller not in seen:
                seen.add(caller)
                pending.append(caller)
    return result
