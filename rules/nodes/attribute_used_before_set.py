"""ND062: constructors set attributes before they use them."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.python import is_handled
from scaffold.api.rclpy import NODE, NodeClass, RclpyFile, has

_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "{}"
)
_MAKE = "        self.pub = self.create_publisher(String, 'chatter', 10)\n"
_USE = "        self.pub.publish(String())\n"


_CALLED_BY_NODE = (
    *("get_name", "get_namespace", "get_logger", "get_clock", "create_publisher"),
    *("create_service", "declare_parameter", "declare_parameters", "has_parameter"),
    *("get_parameter", "add_on_set_parameters_callback"),
)
"""The methods that ``Node.__init__`` calls of the node that it makes."""


class AttributeUsedBeforeSet(RclpyRule):
    """The constructor of a node uses an attribute that it sets further down.

    **Why.** ``AttributeError: 'Talker' object has no attribute 'pub'`` at start.

    **Fix.** Set it first. A method such as ``get_name`` is called by the constructor of rclpy's
    Node: give it another name.

    **Source.** Python documentation, "Classes".
    """

    code = "ND062"
    name = "attribute-used-before-set"
    examples = (
        Example("set first", {"talker.py": _NODE.format(_MAKE + _USE)}),
        Example(
            "used first",
            {"talker.py": _NODE.format(_USE + _MAKE)},
            Report("8:9", "self.pub is used before it is set in line 9: AttributeError"),
        ),
        Example(
            "in a method that the constructor of rclpy's Node calls",
            {
                "talker.py": _NODE.format("        self.robot = 'robin'\n")
                + "\n    def get_name(self):\n        return self.robot\n"
            },
            Report(
                "11:16",
                "rclpy's Node calls get_name() while it is made, before self.robot "
                "is set in line 8: AttributeError; call the method otherwise",
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

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for node in file.classes:
            if node.constructor is None or node.base is not None or len(node.node.bases) != 1:
                continue
            for used, line in _used_early(file, node):
                message = (
                    f"self.{used.attr} is used before it is set in line {line}: AttributeError"
                )
                yield self.report(file.module.location(used), message)
            yield from self._check_overrides(file, node)

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
                        f"is set in line {line}: AttributeError; call the method otherwise"
                    )
                    yield self.report(file.module.location(used), message)
                    break


def _used_early(file: RclpyFile, node: NodeClass) -> Iterator[tuple[ast.Attribute, int]]:
    """Yield the first use of each attribute that is set only in later lines."""
    bound = file.module.index.bindings(node.node)
    reported: set[str] = set()
    first_lines: dict[str, int] = {}
    if node.constructor is None:
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
