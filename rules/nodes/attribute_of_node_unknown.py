"""ND046: what a node uses of itself exists."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.handlers import is_harmless
from scaffold.model.near import nearest
from scaffold.model.node_owners import NodeClass
from scaffold.model.nodes import NodeFacts
from scaffold.model.rclpy_names import NODE, has, known_names

_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.pub = self.create_publisher(String, 'chatter', 10)\n"
    "        self.create_timer(1.0, self.{})\n\n"
    "    def on_timer(self):\n"
    "        self.{}.publish(String())\n"
)
_ELSEWHERE = {
    "advertise": "create_publisher",
    "create_server": "create_service",
    "create_subscriber": "create_subscription",
    "create_wall_timer": "create_timer",
    "get_param": "get_parameter",
    "logger": "get_logger()",
    "now": "get_clock().now()",
    "set_parameter": "set_parameters",
    "spin": "rclpy.spin(...)",
}
"""What other libraries call it."""


class AttributeOfNodeUnknown(Rule):
    """A node uses an attribute or method of itself that nobody defines.

    **Why.** ``AttributeError: 'Talker' object has no attribute 'create_subscriber'`` when the line
    is reached, for a callback in the constructor, else at the first message.

    **Fix.** Spell it as it is defined, or define it.

    **Source.** ``rclpy/node.py``, ``Node``.
    """

    code = "ND046"
    name = "attribute-of-node-unknown"
    examples = (
        Example("defined", {"talker.py": _NODE.format("on_timer", "pub")}),
        Example(
            "never reached",
            {
                "talker.py": _NODE.format("on_timer", "pub")
                + "\n    def stop(self):\n        return\n        self.client.cancel()\n"
            },
        ),
        Example(
            "misspelt",
            {"talker.py": _NODE.format("on_tick", "publisher")},
            at=("talker.py:9", "talker.py:12"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        bases = package.remember("names_of_bases", lambda: _names_of_bases(package))
        given = package.remember("attributes_given", lambda: _given(package))
        for facts in package.rclpy_files():
            used = _used(facts) if facts.classes else {}
            for node in facts.classes:
                if node.node in used and node.name not in bases and _is_plain(node):
                    yield from self._check(package, node, given, used[node.node])

    def _check(
        self, package: Package, node: NodeClass, given: frozenset[str], used: list[ast.Attribute]
    ) -> Iterator[Diagnostic]:
        defined = _defined(node)
        names: set[str] = set()
        for attribute in used:
            name = attribute.attr
            if name in defined or name in given or _may_fail(node.facts, attribute):
                continue
            names = names or {*defined, *given, *_names_of_rclpy()}
            near = _ELSEWHERE.get(name) or _near(package, name, names)
            hint = f"; {near!r} is meant" if near else ""
            message = f"neither {node.name} nor rclpy's Node has {name!r}{hint}: AttributeError"
            yield self.report(node.facts.module.location(attribute), message)


def _used(facts: NodeFacts) -> dict[ast.ClassDef, list[ast.Attribute]]:
    """Return what classes read of themselves, but for what the file sets on whatever object."""
    module = facts.module
    read: list[ast.Attribute] = []
    stored: set[str] = set()
    for attribute in module.walk(ast.Attribute):
        if isinstance(attribute.ctx, ast.Load) or isinstance(
            module.parent(attribute), ast.AugAssign
        ):
            read.append(attribute)
        else:
            stored.add(attribute.attr)
    found: dict[ast.ClassDef, list[ast.Attribute]] = {}
    for attribute in read:
        if attribute.attr not in stored and not has(NODE, attribute.attr):
            class_ = _owner(facts, attribute)
            if class_ is not None:
                found.setdefault(class_, []).append(attribute)
    return found


def _owner(facts: NodeFacts, attribute: ast.Attribute) -> ast.ClassDef | None:
    """Return the class of which an attribute is read: of ``self``, or of what a variable holds."""
    class_ = facts.evaluator.self_class(attribute.value)
    if class_ is None and isinstance(attribute.value, ast.Name):
        made = facts.evaluator.single_value(attribute.value)
        if isinstance(made, ast.Call):
            class_ = facts.evaluator.named_class(made.func)
    return class_


def _names_of_rclpy() -> Iterator[str]:
    return (one.removesuffix("()") for one in known_names()[NODE])


def _near(package: Package, name: str, names: set[str]) -> str:
    # rclpy's own attributes start with an underscore: nobody means those.
    hidden = "__" if name.startswith("_") else "_"
    return nearest(package, name, [one for one in names if not one.startswith(hidden)], 0.7)


def _names_of_bases(package: Package) -> frozenset[str]:
    """Return the classes of the package that others inherit from: those may define the rest."""
    return frozenset(
        base.attr if isinstance(base, ast.Attribute) else base.id
        for module in package.modules()
        for class_ in module.walk(ast.ClassDef)
        for base in class_.bases
        if isinstance(base, ast.Attribute | ast.Name)
    )


def _given(package: Package) -> frozenset[str]:
    """Return the attributes that code of the package sets on other objects than ``self``."""
    return frozenset(
        node.attr
        for module in package.modules()
        for node in module.walk(ast.Attribute)
        if isinstance(node.ctx, ast.Store)
        and isinstance(node.value, ast.Name)
        and node.value.id != "self"
    )


def _is_plain(node: NodeClass) -> bool:
    """Tell whether a class and its bases are read in full, and make no names at run time."""
    owner: NodeClass | None = node
    while owner is not None:
        bindings = owner.facts.module.index.bindings(owner.node)
        if len(owner.node.bases) != 1 or owner.node.keywords or owner.node.decorator_list:
            return False
        if owner.is_lifecycle or "__getattr__" in bindings or "__getattribute__" in bindings:
            return False
        if owner.facts.module.mentions("setattr(", "__dict__", "vars(self"):
            return False
        owner = owner.base
    return True


def _defined(node: NodeClass) -> set[str]:
    """Return what a class and its bases define, in methods and on ``self``."""
    found: set[str] = set()
    owner: NodeClass | None = node
    while owner is not None:
        found |= set(owner.facts.module.index.bindings(owner.node))
        for attribute in ast.walk(owner.node):
            if not isinstance(attribute, ast.Attribute) or isinstance(attribute.ctx, ast.Load):
                continue
            parent = owner.facts.module.parent(attribute)
            if not isinstance(parent, ast.AugAssign):  # which needs a value to begin with
                found.add(attribute.attr)
        owner = owner.base
    return found


def _may_fail(facts: NodeFacts, node: ast.Attribute) -> bool:
    """Tell whether the code is ready for the attribute not to be there."""
    if is_harmless(facts.module, node, "AttributeError"):
        return True
    return f"'{node.attr}'" in facts.module.source.text or (
        f'"{node.attr}"' in facts.module.source.text
    )
