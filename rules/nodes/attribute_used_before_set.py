"""ND062: constructors set attributes before they use them."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule, Report, Severity
from scaffold.api.programs import phases_of
from scaffold.api.python import conditions_on, is_handled
from scaffold.api.rclpy import (
    NODE,
    NodeClass,
    RclpyFile,
    Subscription,
    Synchronizer,
    Timer,
    given_from_outside,
    has,
    is_read_in_full,
    names_of_bases,
)

from ._helpers import too_early

_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "{}"
)
_MAKE = "        self.pub = self.create_publisher(String, 'chatter', 10)\n"
_USE = "        self.pub.publish(String())\n"
_TIMER = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n{}"
    "        self.create_subscription(String, 'chatter', self.hear, 12)\n"
    "        self.create_timer(1.0, self.tick)\n\n"
    "    def tick(self):\n"
    "        print({})\n\n"
    "    def hear(self, msg):\n"
    "        self.last = msg\n"
)

_CALLED_BY_NODE = (
    *("get_name", "get_namespace", "get_logger", "get_clock", "create_publisher"),
    *("create_service", "declare_parameter", "declare_parameters", "has_parameter"),
    *("get_parameter", "add_on_set_parameters_callback"),
)
"""The methods that ``Node.__init__`` calls of the node that it makes."""


class AttributeUsedBeforeSet(RclpyRule):
    """A node uses an attribute before it is set: further down, or by a later message.

    **Why.** ``AttributeError: 'Talker' object has no attribute 'pub'`` at start. A timer may run
    before the first message.

    **Fix.** Set it first, in the constructor: to ``None`` where only a message brings a value. A
    method such as ``get_name`` is called by the constructor of rclpy's Node: give it another name.

    **Source.** Python documentation, "Classes";
    https://github.com/4am-robotics/cob_command_tools/issues/95.
    """

    code = "ND062"
    name = "attribute-used-before-set"
    other_severities = {Severity.WARNING: "it depends on what comes first, a timer or a message"}
    examples = (
        Example("set first", {"talker.py": _NODE.format(_MAKE + _USE)}),
        Example(
            "set under names that a table has",
            {
                "talker.py": _NODE.format(
                    "        for name, value in {'rate': 1.0}.items():\n"
                    "            setattr(self, name, value)\n"
                    "        if self.rate < 0.0:\n            self.rate = 0.0\n"
                )
            },
        ),
        Example(
            "used first",
            {"talker.py": _NODE.format(_USE + _MAKE)},
            "8:9: self.pub is used before it is set in line 9: AttributeError",
        ),
        Example(
            "in a method that the constructor of rclpy's Node calls",
            {
                "talker.py": _NODE.format("        self.robot = 'robin'\n")
                + "\n    def get_name(self):\n        return self.robot\n"
            },
            "11:16: rclpy's Node calls get_name() while it is made, before self.robot is set in "
            "line 8: AttributeError; rename the method",
        ),
        Example(
            "in a method that the constructor calls, also before the one of the base class",
            {
                "talker.py": _NODE.format("        self.say('first')\n" + _MAKE)
                + "        self.say('then')\n        self.greet()\n\n"
                "    def say(self, text):\n"
                "        self.pub.publish(String(data=text))\n\n"
                "    def greet(self):\n"
                "        if self.is_polite:\n            self.say(self.polite)\n\n\n"
                "class Loud(Talker):\n"
                "    def __init__(self):\n"
                "        self.say('early')\n"
                "        super().__init__()\n"
                "        self.say('late')\n"
                "        self.is_polite = False\n",
                "other.py": _NODE.format("").replace(
                    "        super", "        self.setup()\n        super"
                )
                + "\n    def setup(self):\n        self.create_publisher(String, 'a', 1)\n",
            },
            "other.py:7:9: setup() uses self.create_publisher() before super().__init__() in line "
            "8: AttributeError",
            "talker.py:8:9: say() uses self.pub, which is set later, in line 9: AttributeError",
            "talker.py:23:9: say() uses self.pub, which is set later, in line 24: AttributeError",
        ),
        Example(
            "a timer that uses what a message brings",
            {
                "talker.py": _TIMER.format("", "self.last"),
                "set.py": _TIMER.format("        self.last = None\n", "self.last"),
                "asked.py": _TIMER.format("", "getattr(self, 'last', None)"),
                "tried.py": _TIMER.format("", "self.heard and self.last").replace(
                    "12)\n", "12)\n        self.heard = False\n"
                ),
            },
            Report(
                "talker.py:12:15",
                "self.last is only set by the callback 'hear', and the timer may "
                "run before the first message: AttributeError; set it in the "
                "constructor",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "in a method with a name of its own",
            {
                "talker.py": _NODE.format("        self.robot = 'robin'\n")
                + "\n    def robot_name(self):\n        return self.robot\n"
            },
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        for node in file.classes:
            for call, message in too_early(file, node):
                yield self.report(file.module.location(call), message)
            if node.base is None and node.name not in names_of_bases(package):
                yield from self._check_timers(package, file, node)
            if node.constructor is None or node.base is not None or len(node.node.bases) != 1:
                continue
            for used, line in _used_early(file, node):
                message = (
                    f"self.{used.attr} is used before it is set in line {line}: AttributeError"
                )
                yield self.report(file.module.location(used), message)
            yield from self._check_overrides(file, node)

    def _check_timers(
        self, package: Package, file: RclpyFile, node: NodeClass
    ) -> Iterator[Diagnostic]:
        """Check what timers use that only messages set."""
        methods = {method: name for name, method in node.methods.items()}
        by_messages = {
            callback.function
            for entity, callback in file.callbacks
            if isinstance(entity, Subscription | Synchronizer)
        } - phases_of(file).constructing
        reported: set[str] = set()
        for entity, callback in file.callbacks:
            timed = callback.function
            if not isinstance(entity, Timer) or timed not in methods or not is_read_in_full(node):
                continue
            if file.function_of(entity.call) is not node.constructor:
                continue
            for used in file.module.below(timed, ast.Attribute):
                name = used.attr
                if name in reported or name in given_from_outside(package):
                    continue
                setters = _setters(file, node, used)
                if not setters or not setters <= by_messages or timed in setters:
                    continue
                if file.function_of(used) is timed and _is_always_used(file, used):
                    reported.add(name)
                    setter = next(methods[item] for item in methods if item in setters)
                    message = (
                        f"self.{name} is only set by the callback {setter!r}, and the timer may "
                        "run before the first message: AttributeError; set it in the constructor"
                    )
                    location = file.module.location(used)
                    yield self.report(location, message, severity=Severity.WARNING)

    def _check_overrides(self, file: RclpyFile, node: NodeClass) -> Iterator[Diagnostic]:
        """Check what the constructor of rclpy's Node calls, if the class has methods of its own."""
        call = node.super_init
        for name in _CALLED_BY_NODE if call is not None else ():
            method = node.methods.get(name)
            if method is not None and "attr(" in file.module.text(method):
                continue  # it asks: `hasattr(self, 'robot')`
            for used in file.module.below(method, ast.Attribute) if method is not None else ():
                if call is None or not isinstance(used.ctx, ast.Load):
                    continue
                if has(NODE, used.attr) or used.attr in file.module.index.bindings(node.node):
                    continue
                if file.evaluator.self_class(used.value) is not node.node:
                    continue
                line = _first_line(file, node, used.attr)
                is_handled_there = is_handled(file.module, used, "AttributeError")
                if line > (call.end_lineno or call.lineno) and not is_handled_there:
                    message = (
                        f"rclpy's Node calls {name}() while it is made, before self.{used.attr} "
                        f"is set in line {line}: AttributeError; rename the method"
                    )
                    yield self.report(file.module.location(used), message)
                    break


def _setters(file: RclpyFile, node: NodeClass, used: ast.Attribute) -> set[ast.AST | None]:
    """Return the methods that set an attribute of a node; empty if the class has it anyway."""
    if not isinstance(used.ctx, ast.Load) or has(NODE, used.attr):
        return set()
    if used.attr in file.module.index.bindings(node.node):
        return set()
    if file.evaluator.self_class(used.value) is not node.node:
        return set()
    return {file.function_of(store.node) for store in file.evaluator.stores(used.attr)}


def _is_always_used(file: RclpyFile, used: ast.Attribute) -> bool:
    """Tell whether a function uses an attribute whatever is so, and does not ask for it."""
    in_loop = any(
        isinstance(parent, ast.For | ast.While | ast.comprehension)
        for parent in file.module.parents(used)
    )
    is_asked = f"'{used.attr}'" in file.module.source.text or (
        f'"{used.attr}"' in file.module.source.text
    )
    if in_loop or is_asked or conditions_on(file.module, used):
        return False
    return not is_handled(file.module, used, "AttributeError")


def _used_early(file: RclpyFile, node: NodeClass) -> Iterator[tuple[ast.Attribute, int]]:
    """Yield the first use of each attribute that is set only in later lines."""
    bound = file.module.index.bindings(node.node)
    reported: set[str] = set()
    first_lines: dict[str, int] = {}
    if node.constructor is None or not is_read_in_full(node):
        return
    for used in file.module.below(node.constructor, ast.Attribute):
        if not isinstance(used.ctx, ast.Load):
            continue
        if used.attr in reported or used.attr in bound or has(NODE, used.attr):
            continue
        if file.evaluator.self_class(used.value) is not node.node:
            continue
        if used.attr not in first_lines:
            first_lines[used.attr] = _first_line(file, node, used.attr)
        line = first_lines[used.attr]
        if used.lineno >= line or file.function_of(used) is not node.constructor:
            continue
        in_loop = any(
            isinstance(parent, ast.For | ast.While) for parent in file.module.parents(used)
        )
        if not in_loop and not is_handled(file.module, used, "AttributeError"):
            reported.add(used.attr)
            yield used, line


def _first_line(file: RclpyFile, node: NodeClass, name: str) -> int:
    """Return the first line that sets an attribute; 0 unless only the constructor sets it."""
    stores = file.evaluator.stores(name)
    if {file.function_of(store.node) for store in stores} != {node.constructor}:
        return 0
    return min(store.node.lineno for store in stores)
