"""ND134: results of comparisons are used, and may be true or false."""

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
    """A comparison is not used, as in ``a == 1`` for ``a = 1``, or always has the same result.

    **Why.** Nothing is assigned, or the condition is always true, without an error. ``key in
    limits.items()`` is always false: the items are pairs.

    **Fix.** Write ``self.limit = msg.data``, ``if word in ('stop', 'halt'):``, or ``if key in
    limits:``.

    **Source.** Python language reference, "Expression statements"; Python library reference,
    "Dictionary view objects".
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
            "a pair among the items of a dictionary, and a key among its keys",
            {
                "limiter.py": _NODE.format(
                    "pair = (msg.data, 1)\n"
                    "        return pair in self.limits.items() or msg.data in self.limits"
                )
            },
        ),
        Example(
            "a key among the items of a dictionary",
            {
                "limiter.py": _NODE.format(
                    "for name in list(self.limits):\n"
                    "            if name not in self.names.items():\n"
                    "                del self.limits[name]\n"
                    "        return 'left' in self.names.items()"
                )
            },
            "13:16: always true: name is a key, and items() has pairs of key and value; write "
            "self.names without .items()",
            "15:16: always false: 'left' is a key, and items() has pairs of key and value; write "
            "self.names without .items()",
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
        yield from self._check_items(module)

    def _check_items(self, module: PythonModule) -> Iterator[Diagnostic]:
        for node in module.walk(ast.Compare):
            match node:
                case ast.Compare(
                    left=key,
                    ops=[ast.In() | ast.NotIn() as operator],
                    comparators=[
                        ast.Call(
                            func=ast.Attribute(attr="items", value=table), args=[], keywords=[]
                        )
                    ],
                ) if _is_key(module, key):
                    result = "false" if isinstance(operator, ast.In) else "true"
                    message = (
                        f"always {result}: {module.text(key)} is a key, and items() has pairs of "
                        f"key and value; write {module.text(table)} without .items()"
                    )
                    yield self.report(module.location(node), message)


def _is_key(module: PythonModule, node: ast.expr) -> bool:
    """Return whether a value is text, or a name that looks up other values in the function."""
    if isinstance(node, ast.JoinedStr):
        return True
    if isinstance(node, ast.Constant):
        return isinstance(node.value, str)
    function = module.enclosing_function(node)
    return (
        isinstance(node, ast.Name)
        and function is not None
        and any(
            isinstance(part.slice, ast.Name) and part.slice.id == node.id
            for part in module.below(function, ast.Subscript)
            if isinstance(part, ast.Subscript)
        )
    )


def _is_condition(module: PythonModule, node: ast.expr) -> bool:
    parent = module.parent(node)
    while isinstance(parent, ast.UnaryOp | ast.BoolOp):
        node, parent = parent, module.parent(parent)
    return isinstance(parent, ast.If | ast.While | ast.IfExp) and parent.test is node
