"""ND013: a node does not overwrite what it inherits."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.node_owners import NodeClass

PROPERTIES = frozenset(
    {"clients", "context", "default_callback_group", "executor", "guards", "handle", "publishers"}
    | {"services", "subscriptions", "timers", "waitables", "callback_groups"}
)
_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.{} = []\n"
)


class AttributeOfNodeReplaced(Rule):
    """A node assigns to an attribute that Node has as a property.

    **Why.** ``AttributeError: property 'publishers' of 'Talker' object has no setter``; an
    ``executor`` of another kind fails with ``has no attribute 'add_node'``.

    **Fix.** Choose another name, such as ``self._publishers``.

    **Source.** ``rclpy/node.py``, the properties of ``Node``.
    """

    code = "ND013"
    name = "attribute-of-node-replaced"
    examples = (
        Example("a name of its own", {"talker.py": _NODE.format("my_publishers")}),
        Example("a property", {"talker.py": _NODE.format("publishers")}, at=("talker.py:7",)),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for facts in package.rclpy_files():
            for node in facts.classes:
                for target in _targets(node):
                    at = facts.module.location(target)
                    message = f"Node has a property {target.attr!r}, which this assignment replaces"
                    yield self.report(at, message)


def _targets(node: NodeClass) -> Iterator[ast.Attribute]:
    """Yield where the methods of a class assign to a property of Node."""
    own = {
        name
        for name, binding in node.facts.module.index.bindings(node.node).items()
        if binding and name in PROPERTIES
    }
    for method in node.methods.values():
        for inner in ast.walk(method):
            if (
                isinstance(inner, ast.Attribute)
                and isinstance(inner.ctx, ast.Store)
                and isinstance(inner.value, ast.Name)
                and inner.value.id == "self"
                and inner.attr in PROPERTIES - own
                and not _is_executor(node, inner)
            ):
                yield inner


def _is_executor(node: NodeClass, target: ast.Attribute) -> bool:
    """Tell whether ``self.executor`` is given an executor of rclpy, or something unknown."""
    if target.attr != "executor":
        return False
    parent = node.facts.module.parent(target)
    value = parent.value if isinstance(parent, ast.Assign | ast.AnnAssign) else None
    if not isinstance(value, ast.Call):
        return True
    name = node.facts.module.qualified_name(value.func) or ""
    return not name.startswith("concurrent.futures.")
