"""ND017: the value of a parameter is asked for."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Rule
from scaffold.model.nodes import NodeFacts
from scaffold.model.scopes import FunctionNode

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.declare_parameter('rate', 2.0)\n"
    "        rate = self.get_parameter('rate'){}\n"
    "        self.create_timer(1.0 / rate, self.tick)\n\n"
    "    def tick(self):\n        pass\n"
)


class ParameterObjectUsed(Rule):
    """A Parameter is used in a calculation, instead of its value.

    **Why.** ``TypeError: unsupported operand type(s) for /: 'float' and 'Parameter'``.

    **Fix.** Append ``.value``.

    **Source.** ROS 2 documentation, "Using parameters in a class (Python)".
    """

    code = "ND017"
    name = "parameter-object-used"
    examples = (
        Example("the value", {"talker.py": _NODE.format(".value")}),
        Example(
            "the object",
            {"talker.py": _NODE.format("")},
            at=("talker.py:8",),
            fixed={"talker.py": _NODE.format(".value")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for facts in package.rclpy_files():
            for read in facts.parameter_reads:
                if read.method not in {"get_parameter", "declare_parameter"} or read.owner is None:
                    continue
                use = self._use(facts, read.call, read.variable, read.attribute)
                if use is None:
                    continue
                _, end = facts.module.span(read.call)
                fix = Fix("take the value", (Edit(facts.module.path, end, end, ".value"),))
                line = facts.module.location(use).line
                where = "" if line == read.location.line else f", used in line {line},"
                message = f"this is the Parameter{where} and not its value; append .value"
                yield self.report(read, message, fix)

    def _use(
        self, facts: NodeFacts, call: ast.Call, variable: str | None, attribute: str | None
    ) -> ast.AST | None:
        """Return a place where the object is calculated with."""
        if self._is_calculated(facts, call):
            return call
        if variable is None and attribute is None:
            return None
        function = facts.module.enclosing_function(call)
        scope: ast.AST = function or facts.module.tree
        if attribute is not None:
            scope = facts.module.enclosing_class(call) or scope
        uses = [node for node in ast.walk(scope) if _is_load(node, variable, attribute)]
        if any(_asks(facts, use) for use in uses) or _is_rebound(scope, variable, attribute):
            return None
        return next((use for use in uses if self._is_calculated(facts, use)), None)

    def _is_calculated(self, facts: NodeFacts, node: ast.AST) -> bool:
        parent = facts.module.parent(node)
        if isinstance(parent, ast.BinOp):
            return not (isinstance(parent.op, ast.Mod) and parent.right is node)
        if isinstance(parent, ast.UnaryOp):
            return not isinstance(parent.op, ast.Not)
        if isinstance(parent, ast.Call) and node in parent.args:
            if isinstance(parent.func, ast.Attribute) and parent.func.attr == "create_timer":
                return parent.args[0] is node
            return facts.module.qualified_name(parent.func) in {"float", "int", "range", "len"}
        return False


def _is_load(node: ast.AST, variable: str | None, attribute: str | None) -> bool:
    match node:
        case ast.Name(ctx=ast.Load()):
            return node.id == variable
        case ast.Attribute(value=ast.Name(id="self"), ctx=ast.Load()):
            return node.attr == attribute
        case _:
            return False


def _asks(facts: NodeFacts, use: ast.AST) -> bool:
    return isinstance(facts.module.parent(use), ast.Attribute)


def _is_rebound(scope: ast.AST | FunctionNode, variable: str | None, attribute: str | None) -> bool:
    stores = 0
    for node in ast.walk(scope):
        match node:
            case ast.Name(ctx=ast.Store()):
                stores += node.id == variable
            case ast.Attribute(value=ast.Name(id="self"), ctx=ast.Store()):
                stores += node.attr == attribute
    return stores > 1
