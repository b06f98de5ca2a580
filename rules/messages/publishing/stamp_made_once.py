"""MS012: stamps are set when messages are published."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report, Severity
from scaffold.api.programs import Phases, phases_of
from scaffold.api.rclpy import RclpyFile

_NODE = (
    "from rclpy.node import Node\nfrom sensor_msgs.msg import Temperature\n\n\n"
    "class Sensor(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('sensor')\n"
    "        self.publisher = self.create_publisher(Temperature, 'temperature', {})\n"
    "        self.stamp = self.get_clock().now().to_msg()\n"
    "        self.reading = Temperature()\n"
    "        self.create_timer(1.0, self.tick)\n\n"
    "    def tick(self):\n"
    "        self.reading.header.stamp = {}\n"
    "        self.publisher.publish(self.reading)\n"
)


class StampMadeOnce(RclpyRule):
    """A callback stamps its messages with a time that was read once in the constructor.

    **Why.** All messages have the start time of the node: tf2 no longer has transforms for that
    time, ``message_filters`` finds no match, and RViz drops them.

    **Fix.** Read the time for each message: ``msg.header.stamp = self.get_clock().now().to_msg()``.

    **Source.** ``std_msgs/msg/Header``.
    """

    code = "MS012"
    name = "stamp-made-once"
    other_severities = {
        Severity.WARNING: "a message is created and stamped once, but published repeatedly"
    }
    examples = (
        Example(
            "stamp read in the callback",
            {"sensor.py": _NODE.format("10", "self.get_clock().now().to_msg()")},
        ),
        Example(
            "stamp read in the constructor",
            {"sensor.py": _NODE.format("10", "self.stamp")},
            "14:37: self.stamp is only set in the constructor: all messages have the start time "
            "of the node; use self.get_clock().now().to_msg()",
        ),
        Example(
            "stamp updated in the callback",
            {
                "sensor.py": _NODE.format("10", "self.stamp")
                + "        self.stamp = self.get_clock().now().to_msg()\n"
            },
        ),
        Example(
            "message created and stamped in the constructor",
            {
                "sensor.py": _NODE.format("10", "self.stamp")
                .replace("        self.reading.header.stamp = self.stamp\n", "")
                .replace(
                    "= Temperature()",
                    "= Temperature()\n        self.reading.header.stamp = self.stamp",
                )
            },
            Report(
                "11:9",
                "this stamp is never updated: all messages have the start time of the "
                "node; set header.stamp where the message is published",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "transient local publisher",
            {
                "sensor.py": "from rclpy.qos import QoSProfile\n"
                + _NODE.format("QoSProfile(depth=1, durability='TRANSIENT_LOCAL')", "self.stamp")
            },
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        if not file.module.mentions("stamp") or file.module.in_tests:
            return
        if file.module.mentions(*_STATIC):
            return
        phases = phases_of(file)
        for node, value in _stamped(file):
            function = file.function_of(node)
            if function in phases.running and _is_made_once(file, phases, value):
                message = (
                    f"{file.module.text(value)} is only set in the constructor: all messages have "
                    f"the start time of the node; use self.get_clock().now().to_msg()"
                )
                yield self.report(file.module.location(value), message)
            elif (
                isinstance(node, ast.Attribute)
                and _is_time(file, value)
                and _is_sent_again(file, phases, node)
            ):
                message = (
                    "this stamp is never updated: all messages have the start time of the node; "
                    "set header.stamp where the message is published"
                )
                at = file.module.location(node)
                yield self.report(at, message, severity=Severity.WARNING)


def _stamped(file: RclpyFile) -> Iterator[tuple[ast.AST, ast.expr]]:
    """Yield the assignments of stamps and headers, with the values."""
    for name in ("stamp", "header"):
        for store in file.evaluator.stores(name):
            if store.value is not None:
                yield store.node, store.value
    for word in file.module.walk(ast.keyword):
        if word.arg in {"stamp", "header"}:
            yield word, word.value


_STATIC = ("StaticTransformBroadcaster", "TRANSIENT_LOCAL", "TransientLocal", "transient_local")
"""Latched publishers, whose messages keep their stamp."""


def _is_time(file: RclpyFile, node: ast.expr) -> bool:
    """Return whether an expression is the time at which it is evaluated."""
    origins = file.evaluator.origins(node)
    for origin in origins:
        match origin:
            case ast.Call(func=ast.Attribute(attr="to_msg", value=inner)):
                if not any(_is_now(x) for x in file.evaluator.origins(inner)):
                    return False
            case _:
                return False
    return bool(origins)


def _is_now(node: ast.expr) -> bool:
    return isinstance(node, ast.Call) and ast.unparse(node.func).endswith(".now")


def _is_made_once(file: RclpyFile, phases: Phases, node: ast.expr) -> bool:
    """Return whether a stamp or a header is an attribute that only constructors set."""
    match node:
        case ast.Call(func=ast.Attribute(attr="to_msg", value=time), args=[]):
            return _is_set_once(file, phases, time, _is_now)
    return _is_set_once(file, phases, node, lambda x: _is_time(file, x))


def _is_set_once(
    file: RclpyFile, phases: Phases, node: ast.expr, fits: Callable[[ast.expr], bool]
) -> bool:
    if not isinstance(node, ast.Attribute) or file.evaluator.self_class(node.value) is None:
        return False
    stores = [store for store in file.evaluator.stores(node.attr) if store.class_ is not None]
    return _set_in_constructor(file, phases, node.attr) and all(
        store.value is not None and all(map(fits, file.evaluator.origins(store.value)))
        for store in stores
    )


_HEADER = "std_msgs.msg.Header"


def _set_in_constructor(file: RclpyFile, phases: Phases, attribute: str) -> bool:
    functions = {
        file.function_of(store.node)
        for store in file.evaluator.stores(attribute)
        if store.class_ is not None
    }
    return bool(functions) and functions <= phases.constructing - phases.running


def _is_sent_again(file: RclpyFile, phases: Phases, target: ast.Attribute) -> bool:
    """Return whether callbacks publish a message with this stamp without renewing it."""
    match target.value:
        case ast.Attribute(attr="header", value=ast.Attribute(value=ast.Name("self")) as message):
            pass
        case _:
            return False
    if not _set_in_constructor(file, phases, message.attr):
        return False
    if file.function_of(target) not in phases.constructing:
        return False
    sent = False
    for use in file.module.index.attributes(message.attr):
        function = file.function_of(use)
        parent = file.module.parent(use)
        if function in phases.constructing - phases.running:
            continue
        match parent:
            case ast.Call(func=ast.Attribute(attr="publish"), args=[given]) if given is use:
                sent = sent or function in phases.running
            case ast.Attribute(attr=name) if name not in {"header", "stamp"}:
                continue
            case _:
                return False
    return sent
