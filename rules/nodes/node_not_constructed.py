"""ND054: node constructors call Node's constructor with a name, first."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.rclpy import NODE, NodeClass, RclpyFile, has

_MISSPELLED = frozenset({"_init_", "__init", "_init__", "__init_", "init", "__int__", "__intit__"})
_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def {}(self):\n"
    "{}"
    "        self.create_timer(1.0, print)\n"
)
_INIT = "        super().__init__('talker')\n"


class NodeNotConstructed(RclpyRule):
    """A node constructor passes no name, calls Node's constructor too late, or is misspelled.

    **Why.** ``TypeError: Node.__init__() missing 1 required positional argument: 'node_name'``,
    or ``AttributeError: 'Talker' object has no attribute '_Node__...'`` when the node is used.

    **Fix.** Start ``def __init__(self):`` with ``super().__init__('talker')``.

    **Source.** ``rclpy/node.py``, ``Node.__init__``; Python documentation, ``super``.
    """

    code = "ND054"
    name = "node-not-constructed"
    examples = (
        Example("called first", {"talker.py": _NODE.format("__init__", _INIT)}),
        Example(
            "without a name",
            {"talker.py": _NODE.format("__init__", _INIT.replace("'talker'", ""))},
            Report("6:9", "Node.__init__() is called without a node name: TypeError"),
        ),
        Example(
            "without parentheses",
            {"talker.py": _NODE.format("__init__", _INIT.replace("super()", "super"))},
            Report("6:9", "'super' is not called: TypeError; write super().__init__(...)"),
        ),
        Example(
            "too late",
            {"talker.py": _NODE.format("__init__", "") + _INIT},
            Report(
                "6:9", "self.create_timer is used before Node.__init__() in line 7: AttributeError"
            ),
        ),
        Example(
            "misspelled",
            {"talker.py": _NODE.format("_init_", _INIT)},
            Report("5:9", "'_init_' is never called as a constructor; did you mean '__init__'?"),
        ),
        Example(
            "without self",
            {"talker.py": _NODE.format("__init__", _INIT.replace("super()", "Node"))},
            Report(
                "6:9",
                "Node.__init__() is called without self: TypeError; write super().__init__(...)",
            ),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for node in file.classes:
            yield from self._check(file, node)

    def _check(self, file: RclpyFile, node: NodeClass) -> Iterator[Diagnostic]:
        for name, method in node.methods.items():
            if name in _MISSPELLED and node.constructor is None and _calls_init(method):
                message = f"{name!r} is never called as a constructor; did you mean '__init__'?"
                yield self.report(file.module.name_location(method), message)
        call = node.super_init
        if call is None or node.base is not None or not isinstance(call.func, ast.Attribute):
            return
        at, value = file.module.location(call), call.func.value
        is_call = isinstance(value, ast.Call)
        if isinstance(value, ast.Name) and value.id == "super":
            yield self.report(at, "'super' is not called: TypeError; write super().__init__(...)")
        elif not is_call and file.is_node_class(value) and _is_text(call.args[:1]):
            yield self.report(
                at, "Node.__init__() is called without self: TypeError; write super().__init__(...)"
            )
        elif is_call and not call.args and not call.keywords and len(node.node.bases) == 1:
            yield self.report(at, "Node.__init__() is called without a node name: TypeError")
        for used in _used_before(file, node, call):
            message = f"self.{used.attr} is used before Node.__init__() in line {at.line}"
            yield self.report(file.module.location(used), f"{message}: AttributeError")


def _is_text(nodes: list[ast.expr]) -> bool:
    return any(isinstance(node, ast.Constant) and isinstance(node.value, str) for node in nodes)


def _calls_init(method: ast.AST) -> bool:
    return any(
        isinstance(node, ast.Attribute) and node.attr == "__init__" for node in ast.walk(method)
    )


def _used_before(file: RclpyFile, node: NodeClass, call: ast.Call) -> list[ast.Attribute]:
    """Return the first method of Node that the constructor calls before Node's constructor."""
    own = set(file.module.index.bindings(node.node))
    for other in file.calls_in(node.constructor) if node.constructor else ():
        func = other.func
        if other.lineno < call.lineno and isinstance(func, ast.Attribute) and func.attr not in own:
            is_self = file.evaluator.self_class(func.value) is node.node
            if is_self and has(NODE, func.attr) and not file.is_conditional(call):
                return [func]
    return []
