"""ND057: what is spun is a node that lives, and executors spin what they hold."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.node_entities import RclpyCall
from scaffold.model.nodes import NodeFacts
from scaffold.model.rclpy_names import class_of

_Shutdowns = dict[tuple[ast.AST, str], dict[int, RclpyCall]]
_FAR = 200  # statements in between: what they do is not looked at
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
            shutdowns = _by_block(facts)
            for call in facts.spin_calls:
                problem = _problem(facts, call, shutdowns)
                if problem:
                    yield self.report(call, problem)
            yield from self._check_executors(facts)

    def _check_executors(self, facts: NodeFacts) -> Iterator[Diagnostic]:
        for call in facts.module.walk(ast.Call):
            used = _used(facts, call)
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


def _problem(facts: NodeFacts, call: RclpyCall, shutdowns: _Shutdowns) -> str:
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
    other = _shutdown_before(facts, shutdowns, call.call)
    if other is not None:
        return f"rclpy is shut down in line {other.location.line} already: nothing is spun"
    return ""


def _by_block(facts: NodeFacts) -> _Shutdowns:
    """Return the calls that are statements, by what holds them, with their places there."""
    found: _Shutdowns = {}
    for call in facts.shutdown_calls:
        statement = facts.module.parent(call.call)
        holder = facts.module.parent(statement) if isinstance(statement, ast.Expr) else None
        if statement is not None and holder is not None:
            block, number = facts.module.index.place(statement)
            found.setdefault((holder, block), {})[number] = call
    return found


def _shutdown_before(facts: NodeFacts, shutdowns: _Shutdowns, call: ast.Call) -> RclpyCall | None:
    """Return the last one ahead of a statement in its block, unless rclpy may have begun anew."""
    statement = facts.module.parent(call)
    holder = facts.module.parent(statement) if isinstance(statement, ast.Expr) else None
    if statement is None or holder is None:
        return None
    block, number = facts.module.index.place(statement)
    there = shutdowns.get((holder, block), {})
    for at in range(number - 1, max(number - _FAR, 0) - 1, -1) if there else ():
        if at in there:
            return there[at]
        if "init" in ast.unparse(getattr(holder, block)[at]):
            return None
    return None


def _used(facts: NodeFacts, call: ast.Call) -> dict[str, ast.AST] | None:
    """Return what is used of an executor held in a local variable and given to nobody."""
    name = facts.module.qualified_name(call.func) or ""
    parent = facts.module.parent(call)
    if not name.startswith("rclpy.executors.") or not name.endswith("Executor"):
        return None
    if not isinstance(parent, ast.Assign) or not isinstance(parent.targets[0], ast.Name):
        return None
    variable = parent.targets[0]
    scope = facts.module.index.lookup(variable.id, variable)
    found: dict[str, ast.AST] = {}
    for other in facts.module.index.names(variable.id):
        if other is variable:
            continue
        around = facts.module.parent(other)
        if not scope or not isinstance(around, ast.Attribute):
            return None
        looked_up = facts.module.index.lookup(other.id, other)
        if looked_up is None or looked_up[0] is not scope[0]:
            return None
        found[around.attr] = around
    return found
