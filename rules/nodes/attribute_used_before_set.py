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


class AttributeUsedBeforeSet(RclpyRule):
    """The constructor of a node uses an attribute that it sets further down.

    **Why.** ``AttributeError: 'Talker' object has no attribute 'pub'`` at start.

    **Fix.** Set it first.

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
