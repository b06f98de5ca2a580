"""ND057: what is spun is a node that lives, and executors spin what they hold."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.executors import Shutdowns, used_of_executor
from scaffold.model.node_entities import RclpyCall
from scaffold.model.nodes import NodeFacts
from scaffold.model.rclpy_names import class_of

_NODE = (
    "import rclpy\nfrom rclpy.executors import SingleThreadedExecutor\n"
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_timer(1.0, print)\n\n\n"
    "def main():\n    rclpy.init()\n    node = Talker()\n{}"
)
_EXECUTOR = "    executor = SingleThreadedExecutor()\n{}"


class SpunWrongly(Rule):
    """Something else than a node is spun, a node too late, or an executor without nodes.

    **Why.** ``rclpy.spin(Talker)`` fails with ``TypeError: 'property' object is not iterable``;
    an executor without nodes waits for ever; after ``rclpy.shutdown()`` nothing is spun any more.

    **Fix.** ``rclpy.spin(node)``, or ``executor.add_node(node)`` and ``executor.spin()``.

    **Source.** ``rclpy/__init__.py``, ``rclpy/executors.py``.
    """

    code = "ND057"
    name = "spun-wrongly"
    examples = (
        Example("a node", {"talker.py": _NODE.format("    rclpy.spin(node)\n")}),
        Example(
            "an executor",
            {
                "talker.py": _NODE.format(
                    _EXECUTOR.format("    executor.add_node(node)\n    executor.spin()\n")
                )
            },
        ),
        Example(
            "a class",
            {"talker.py": _NODE.format("    rclpy.spin(Talker)\n")},
            at=("talker.py:15",),
        ),
        Example(
            "a class in an executor",
            {
                "talker.py": _NODE.format(
                    _EXECUTOR.format("    executor.add_node(Talker)\n    executor.spin()\n")
                )
            },
            at=("talker.py:16",),
        ),
        Example(
            "an executor without nodes",
            {"talker.py": _NODE.format(_EXECUTOR.format("    executor.spin()\n"))},
            at=("talker.py:16",),
        ),
        Example(
            "an executor that nobody spins",
            {"talker.py": _NODE.format(_EXECUTOR.format("    executor.add_node(node)\n"))},
            at=("talker.py:15",),
        ),
        Example(
            "after shutdown",
            {"talker.py": _NODE.format("    rclpy.shutdown()\n    rclpy.spin(node)\n")},
            at=("talker.py:16",),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for facts in package.rclpy_files():
            shutdowns = Shutdowns(facts)
            for call in facts.spin_calls:
                problem = _problem(facts, call, shutdowns)
                if problem:
                    yield self.report(call, problem)
            yield from self._check_executors(facts)

    def _check_executors(self, facts: NodeFacts) -> Iterator[Diagnostic]:
        for call in facts.module.walk(ast.Call):
            added = _added_class(facts, call)
            if added:
                message = f"this adds the class {added}: make a node of it, {added}()"
                yield self.report(facts.module.location(call.args[0]), message)
            used = used_of_executor(facts, call)
            if used is None:
                continue
            is_spun = any(name.startswith("spin") for name in used)
            if is_spun and "add_node" not in used:
                spin = used["spin"] if "spin" in used else next(iter(used.values()))
                message = "this executor has no node: nothing is ever called; add_node() first"
                yield self.report(facts.module.location(spin), message)
            elif "add_node" in used and not is_spun and not facts.spin_calls:
                message = "nothing spins this executor: the callbacks of its nodes never run"
                yield self.report(facts.module.location(call), message)


def _added_class(facts: NodeFacts, call: ast.Call) -> str:
    """Return the class of nodes that is handed to ``add_node``, if it is no node."""
    match call:
        case ast.Call(func=ast.Attribute(attr="add_node"), args=[ast.Name() as node]):
            class_ = facts.evaluator.named_class(node)
            if class_ is not None and facts.node_class(class_) is not None:
                return class_.name
    return ""


def _problem(facts: NodeFacts, call: RclpyCall, shutdowns: Shutdowns) -> str:
    """Return what is wrong about a call of a function of rclpy that spins."""
    if call.name.startswith("executor.") or not call.call.args:
        return ""
    node = call.call.args[0]
    value = facts.evaluator.single_value(node)
    class_ = facts.evaluator.named_class(value)
    if class_ is not None and facts.node_class(class_) is not None:
        return f"this spins the class {class_.name}: make a node of it, {class_.name}()"
    if (class_of(facts, node) or "").endswith("Executor"):
        return "this spins an executor, not a node: call its own spin()"
    other = shutdowns.before(call.call)
    if other is not None:
        return f"rclpy is shut down in line {other.location.line} already: nothing is spun"
    return ""
