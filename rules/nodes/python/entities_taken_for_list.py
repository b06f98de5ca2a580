"""ND100: the entity properties of Node are iterated over, not used as lists."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule
from scaffold.api.python import is_expected
from scaffold.api.rclpy import NodeClass, RclpyFile

_PROPERTIES = (
    *("clients", "guards", "publishers", "services", "subscriptions", "timers", "waitables"),
)
_METHODS = frozenset({"append", "clear", "copy", "extend", "get", "items", "keys", "pop", "remove"})
_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        {}\n"
)


def _files(line: str) -> dict[str, str]:
    return {"talker.py": _NODE.format(line)}


class EntitiesTakenForList(RclpyRule):
    """``self.publishers``, ``self.timers`` and the like are used as lists or dictionaries.

    **Why.** They are properties of Node that return a generator: ``AttributeError: 'generator'
    object has no attribute 'append'``, ``TypeError: 'generator' object is not subscriptable``.

    **Fix.** Use another name, such as ``self.publishers_by_name``.

    **Source.** ``rclpy/node.py``, the properties of ``Node``.
    """

    code = "ND100"
    name = "entities-taken-for-list"
    examples = (
        Example("iterated over", _files("print([pub.topic for pub in self.publishers])")),
        Example("converted to a list", _files("print(list(self.timers)[0])")),
        Example(
            "overridden",
            {"talker.py": _NODE.format("self.timers.append(1)") + "\n    timers = []\n"},
        ),
        Example(
            "appended to",
            _files("self.publishers.append(self.create_publisher(String, 'a', 1))"),
            "8:9: 'publishers' is a property of Node that returns a generator: AttributeError",
        ),
        Example(
            "indexed",
            _files("self.clients['a'] = None"),
            "8:9: 'clients' is a property of Node that returns a generator: TypeError",
        ),
        Example(
            "len() of a property",
            _files("print(len(self.timers))"),
            "8:19: 'timers' is a property of Node that returns a generator: TypeError",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for name in _PROPERTIES:
            for attribute in file.module.index.attributes(name):
                error = _error(file, attribute)
                is_flaw = error and not is_expected(file.module, attribute, error)
                if is_flaw and _is_of_node(file, attribute):
                    message = f"{name!r} is a property of Node that returns a generator: {error}"
                    yield self.report(file.module.location(attribute), message)


def _error(file: RclpyFile, attribute: ast.Attribute) -> str:
    """Return the error that a use of a generator raises."""
    match file.module.parent(attribute):
        case ast.Attribute(attr=name) if name in _METHODS:
            return "AttributeError"
        case ast.Subscript(value=value) if value is attribute:
            return "TypeError"
        case ast.Call(func=ast.Name(id="len"), args=[given]) if given is attribute:
            return "TypeError"
    return ""


def _is_of_node(file: RclpyFile, attribute: ast.Attribute) -> bool:
    """Return whether the attribute is only that of Node: no class sets or defines it."""
    owner = file.owner_of(attribute.value)
    while isinstance(owner, NodeClass):
        bindings = owner.file.module.index.bindings(owner.node)
        if len(owner.node.bases) != 1 or attribute.attr in bindings:
            return False
        if owner.file.evaluator.stores(attribute.attr):
            return False
        if owner.base is None:
            base = owner.file.module.qualified_name(owner.node.bases[0]) or ""
            return base.startswith("rclpy.")
        owner = owner.base
    return False
