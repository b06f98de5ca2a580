"""ND013: nodes do not replace inherited attributes."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Example, RclpyRule, Report, Severity
from scaffold.api.python import FunctionNode
from scaffold.api.rclpy import NodeClass, RclpyFile

PROPERTIES = frozenset(
    {"clients", "context", "default_callback_group", "executor", "guards", "handle", "publishers"}
    | {"services", "subscriptions", "timers", "waitables"}
)
_LISTS = frozenset({"clients", "guards", "services", "subscriptions", "timers", "waitables"})
"""Properties that an executor iterates over."""
_ASKED = frozenset({"get_clock", "get_logger", "get_name", "get_namespace"})
"""Methods that rclpy calls without arguments."""
_CALLED: Mapping[str, int] = {
    "add_on_set_parameters_callback": 1,
    "create_publisher": 3,
    "create_service": 3,
    "declare_parameter": 2,
    "declare_parameters": 3,
    "get_parameter": 1,
    "has_parameter": 1,
}
"""Methods that the constructor of Node calls, with the number of arguments that it passes."""
_PRIVATE = frozenset(
    {"_clients", "_clock", "_context", "_descriptors", "_guards", "_logger", "_parameters"}
    | {"_publishers", "_services", "_subscriptions", "_timers", "_waitables"}
)
"""Private attributes of Node."""
_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.{} = []\n"
)
_NODE_DESTROY = (
    "from rclpy.node import Node\n\n\n"
    "class Driver(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('driver')\n\n"
    "    def destroy_node(self):\n"
    "        self.port.close()\n"
    "        {}\n"
)


class AttributeOfNodeReplaced(RclpyRule):
    """A node assigns to a property of Node, or overrides a method that rclpy calls.

    **Why.** ``AttributeError: property 'publishers' of 'Talker' object has no setter``; an
    ``executor`` of another type fails with ``has no attribute 'add_node'``. If ``destroy_node``
    does not call ``super()``, the node stays in the graph, and its callbacks use closed resources.

    **Fix.** Choose another name, such as ``self._publishers``; end ``destroy_node`` with
    ``super().destroy_node()``.

    **Source.** ``rclpy/node.py``, the properties of ``Node`` and ``destroy_node``.
    """

    code = "ND013"
    name = "attribute-of-node-replaced"
    other_severities = {
        Severity.WARNING: "it is ``destroy_node`` without ``super().destroy_node()``"
    }
    examples = (
        Example("another name", {"talker.py": _NODE.format("my_publishers")}),
        Example(
            "a property",
            {"talker.py": _NODE.format("publishers")},
            "7:9: 'publishers' is an attribute of rclpy's Node: AttributeError; choose another "
            "name",
        ),
        Example(
            "a private attribute, and a method",
            {
                "talker.py": _NODE.format("_timers").replace("[]", "{}")
                + "\n    def timers(self):\n        return []\n"
            },
            "7:9: '_timers' is an attribute of rclpy's Node: rclpy fails later; choose another "
            "name",
            "9:9: 'timers' overrides an attribute of rclpy's Node; choose another name",
        ),
        Example(
            "a method that the constructor of Node calls with arguments",
            {
                "talker.py": _NODE.format("rates") + "        self.declare_parameters()\n\n"
                "    def declare_parameters(self):\n"
                "        self.declare_parameter('rate', 1.0)\n",
                "relay.py": _NODE.format("rates")
                + "\n    def declare_parameters(self, namespace, parameters, *others):\n"
                "        return super().declare_parameters(namespace, parameters, *others)\n",
            },
            "talker.py:10:9: 'declare_parameters' overrides a method of rclpy's Node, whose "
            "constructor passes it 3 arguments: TypeError; choose another name",
        ),
        Example(
            "destroy_node with super()",
            {"driver.py": _NODE_DESTROY.format("super().destroy_node()")},
        ),
        Example(
            "destroy_node without super()",
            {"driver.py": _NODE_DESTROY.format("self.port = None")},
            Report(
                "8:9",
                "super().destroy_node() is not called: publishers, timers and "
                "subscriptions stay; call it at the end",
                severity=Severity.WARNING,
            ),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self._check_destroy(file)
        for node in file.classes:
            for target in _targets(node):
                at = file.module.location(target)
                effect = "rclpy fails later" if target.attr in _PRIVATE else "AttributeError"
                subject = f"{target.attr!r} is an attribute of rclpy's Node"
                yield self.report(at, f"{subject}: {effect}; choose another name")
            for name, method in node.methods.items():
                problem = "an attribute of rclpy's Node" if _breaks_node(name, method) else ""
                if _takes_too_few(name, method):
                    problem = (
                        f"a method of rclpy's Node, whose constructor passes it {_CALLED[name]} "
                        f"argument{'s' * (_CALLED[name] > 1)}: TypeError"
                    )
                if problem:
                    at = file.module.name_location(method)
                    yield self.report(at, f"{name!r} overrides {problem}; choose another name")

    def _check_destroy(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for node in file.classes:
            method = node.methods.get("destroy_node")
            if method is None or method.decorator_list or any(map(_raises, method.body)):
                continue
            calls = [
                func
                for reached in file.reached(method)
                for func in file.module.below(reached, ast.Attribute)
                if func.attr in {"destroy_node", "__getattribute__"}
            ]
            if not calls and not file.module.mentions("super(Node", "super().__getattr"):
                message = (
                    "super().destroy_node() is not called: publishers, timers and subscriptions "
                    "stay; call it at the end"
                )
                at = file.module.name_location(method)
                yield self.report(at, message, severity=Severity.WARNING)


def _breaks_node(name: str, method: FunctionNode) -> bool:
    """Return whether a method overrides an attribute of Node in a way rclpy cannot use."""
    if name in _LISTS:
        return not method.decorator_list
    arguments = [*method.args.posonlyargs, *method.args.args]
    return name in _ASKED and len(arguments) - len(method.args.defaults) > 1


def _takes_too_few(name: str, method: FunctionNode) -> bool:
    """Return whether a method cannot be called with the arguments that rclpy passes."""
    given = method.args
    if name not in _CALLED or given.vararg is not None or method.decorator_list:
        return False
    return len(given.posonlyargs) + len(given.args) - 1 < _CALLED[name]


def _targets(node: NodeClass) -> Iterator[ast.Attribute]:
    """Yield the assignments to a property of Node in the methods of a class."""
    own = {
        name
        for name, binding in node.file.module.index.bindings(node.node).items()
        if binding and name in PROPERTIES
    }
    names = (PROPERTIES | _PRIVATE) - own
    for method in node.methods.values():
        for inner in node.file.module.below(method, ast.Attribute):
            if (
                inner.attr in names
                and isinstance(inner.ctx, ast.Store)
                and isinstance(inner.value, ast.Name)
                and inner.value.id == "self"
                and not _is_usable(node, inner)
            ):
                yield inner


def _is_usable(node: NodeClass, target: ast.Attribute) -> bool:
    """Return whether the assigned value works for Node, or is unknown."""
    if target.attr in _PRIVATE:
        parent = node.file.module.parent(target)
        value = parent.value if isinstance(parent, ast.Assign | ast.AnnAssign) else None
        is_list = isinstance(value, ast.List) and target.attr not in {"_clock", "_parameters"}
        return is_list or not isinstance(value, ast.Constant | ast.Dict | ast.Set | ast.List)
    if target.attr != "executor":
        return False
    parent = node.file.module.parent(target)
    value = parent.value if isinstance(parent, ast.Assign | ast.AnnAssign) else None
    if not isinstance(value, ast.Call):
        return True
    name = node.file.module.qualified_name(value.func) or ""
    return not name.startswith("concurrent.futures.")


def _raises(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Raise)
