"""ND134: results of comparisons are used."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, PythonRule
from scaffold.api.python import PythonModule

_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import Float64\n\n\n"
    "class Limiter(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('limiter')\n"
    "        self.limit = 1.0\n"
    "        self.create_subscription(Float64, 'limit', self.on_limit, 10)\n\n"
    "    def on_limit(self, msg):\n"
    "        {}\n"
)


class ComparisonWithoutEffect(PythonRule):
    """The result of a comparison is not used: ``==`` instead of ``=``, or ``a == 1 or 2``.

    **Why.** Nothing is assigned, or the condition is always true, without an error.

    **Fix.** Write ``self.limit = msg.data``, or ``if word in ('stop', 'halt'):``.

    **Source.** Python language reference, "Expression statements".
    """

    code = "ND134"
    name = "comparison-without-effect"
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example("assigned", {"limiter.py": _NODE.format("self.limit = msg.data")}),
        Example("a condition", {"limiter.py": _NODE.format("return self.limit == msg.data")}),
        Example(
            "compared",
            {"limiter.py": _NODE.format("self.limit == msg.data")},
            "12:9: self.limit is compared, but the result is not used; write self.limit = ...",
        ),
        Example(
            "one of two words",
            {"limiter.py": _NODE.format("return 1 if msg.data == 'a' or msg.data == 'b' else 2")},
        ),
        Example(
            "a word, or another variable as a condition",
            {"limiter.py": _NODE.format("return 1 if msg.data == 'a' or 'b' else 2")},
            "12:40: or 'b' makes this condition always true; write msg.data in (...)",
        ),
        Example(
            "compared in a test, which TS043 reports",
            {"test_limit.py": "def test_limit():\n    limit = 1\n    limit == 1\n"},
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        if module.in_tests:
            return
        for statement in module.walk(ast.Expr):
            match statement.value:
                case ast.Compare(left=ast.Name() | ast.Attribute() as left, ops=[ast.Eq()]):
                    text = module.text(left)
                    message = f"{text} is compared, but the result is not used; write {text} = ..."
                    yield self.report(module.location(statement), message)
        for choice in module.walk(ast.BoolOp):
            match choice:
                case ast.BoolOp(
                    op=ast.Or(),
                    values=[ast.Compare(left=asked, ops=[ast.Eq()]), *_, ast.Constant() as last],
                ) if last.value and _is_condition(module, choice):
                    message = f"or {module.text(last)} makes this condition always true"
                    hint = f"write {module.text(asked)} in (...)"
                    yield self.report(module.location(last), f"{message}; {hint}")


def _is_condition(module: PythonModule, node: ast.expr) -> bool:
    parent = module.parent(node)
    while isinstance(parent, ast.UnaryOp | ast.BoolOp):
        node, parent = parent, module.parent(parent)
    return isinstance(parent, ast.If | ast.While | ast.IfExp) and parent.test is node
