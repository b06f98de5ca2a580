"""ND136: code after a guard can use the value that the guard is about."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from scaffold.api import Diagnostic, Example, PythonRule
from scaffold.api.python import PythonModule, is_handled
from scaffold.api.rclpy import LOG_METHODS

_NODE = (
    "from rclpy.node import Node\nfrom sensor_msgs.msg import LaserScan\n\n\n"
    "class Nearest(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('nearest')\n"
    "        self.scan = None\n"
    "        self.create_subscription(LaserScan, 'scan', self.on_scan, 10)\n"
    "        self.create_timer(1.0, self.tick)\n\n"
    "    def on_scan(self, msg):\n"
    "        self.scan = msg\n\n"
    "    def tick(self):\n"
    "        if {}:\n"
    "            {}\n"
    "        self.get_logger().info(f'{{min(self.scan.ranges)}}')\n"
)
_TEST = "def collect():\n    return []\n\n\ndef test_texts():\n    texts = collect()\n    if {}:\n"


class GuardInverted(PythonRule):
    """A guard leaves when there is a value, and the code after it uses the value.

    **Why.** ``if self.scan is not None: return`` before ``self.scan.ranges``: while there is no
    message, AttributeError or TypeError, because ``None`` has neither attributes nor elements; and
    with a message, nothing happens. A test with such a guard tests nothing.

    **Fix.** Invert the condition: ``if self.scan is None: return``.

    **Source.** Python language reference, "Attribute references", "Subscriptions".
    """

    code = "ND136"
    name = "guard-inverted"
    examples = (
        Example("nothing yet", {"nearest.py": _NODE.format("self.scan is None", "return")}),
        Example(
            "inverted",
            {"nearest.py": _NODE.format("self.scan is not None", "return")},
            "18:32: self.scan is None here: AttributeError; the condition in line 16 is inverted",
        ),
        Example(
            "used where it is None",
            {"nearest.py": _NODE.format("self.scan is None", "print(self.scan.ranges)")},
            "17:19: self.scan is None here: AttributeError; see line 16",
        ),
        Example(
            "the first of no texts",
            {"test/test_texts.py": _TEST.format("texts") + "        return\n    assert texts[0]\n"},
            "9:12: texts is empty or None here: IndexError; the condition in line 7 is inverted",
        ),
        Example(
            "no texts",
            {"test/test_texts.py": _TEST.format("not texts") + "        print(texts[0])\n"},
            "8:15: texts is empty or None here: IndexError; see line 7",
        ),
        Example(
            "set before it is used",
            {
                "test/test_texts.py": _TEST.format("not texts")
                + "        texts = ['a']\n        print(texts[0])\n"
            },
        ),
        Example(
            "set by a method that is called",
            {
                "nearest.py": _NODE.format(
                    "self.scan is None", "self.wait()\n            print(self.scan.ranges)"
                )
            },
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        for guard in module.walk(ast.If):
            for missing, statements in _branches(module, guard):
                used = _first_use(module, missing, statements)
                if used is None:
                    continue
                error = _error(missing, used)
                if is_handled(module, used, error):
                    continue
                text = module.text(missing.value)
                where = f"in line {guard.lineno}"
                is_inverted = missing.is_after
                hint = f"the condition {where} is inverted" if is_inverted else f"see {where[3:]}"
                message = f"{text} is {missing.state} here: {error}; {hint}"
                yield self.report(module.location(used), message)


class _Missing(NamedTuple):
    """A value that a branch does not have."""

    value: ast.Name | ast.Attribute
    is_none: bool
    """Whether it is ``None``; otherwise it is only false."""
    is_after: bool
    """Whether the branch is what follows the guard."""

    @property
    def state(self) -> str:
        """What is known of the value."""
        return "None" if self.is_none else "empty or None"


def _branches(module: PythonModule, guard: ast.If) -> Iterator[tuple[_Missing, Sequence[ast.stmt]]]:
    """Yield the statements that run without the value of a condition."""
    after = _following(module, guard) if _leaves(guard) and not guard.orelse else ()
    match guard.test:
        case ast.Compare(
            left=ast.Name() | ast.Attribute() as value,
            ops=[ast.Is() | ast.IsNot() as operator],
            comparators=[ast.Constant(value=None)],
        ):
            if isinstance(operator, ast.Is):
                yield _Missing(value, is_none=True, is_after=False), guard.body
            else:
                yield _Missing(value, is_none=True, is_after=True), after or guard.orelse
        case ast.UnaryOp(op=ast.Not(), operand=ast.Name() | ast.Attribute() as value):
            yield _Missing(value, is_none=False, is_after=False), guard.body
        case ast.Name() | ast.Attribute() as value:
            yield _Missing(value, is_none=False, is_after=True), after or guard.orelse


def _leaves(guard: ast.If) -> bool:
    return isinstance(guard.body[-1], ast.Return | ast.Raise | ast.Continue | ast.Break)


def _following(module: PythonModule, statement: ast.stmt) -> Sequence[ast.stmt]:
    """Return the statements after one in its block."""
    for block in ("body", "orelse", "finalbody"):
        statements = getattr(module.parent(statement), block, [])
        if isinstance(statements, list) and statement in statements:
            return statements[statements.index(statement) + 1 :]
    return ()


def _first_use(
    module: PythonModule, missing: _Missing, statements: Sequence[ast.stmt]
) -> ast.expr | None:
    """Return the first use of a missing value, before anything may set it."""
    text = ast.unparse(missing.value)
    for statement in statements:
        for part in _parts(statement):
            for node in _evaluated(part):
                if _is_use(missing, node) and ast.unparse(_owner(node)) == text:
                    return node
        if not isinstance(statement, ast.Expr | ast.Assign | ast.Assert | ast.AugAssign):
            return None
        if _may_set(module, missing.value, statement):
            return None
    return None


def _parts(statement: ast.stmt) -> Iterator[ast.expr]:
    """Yield the expressions that a statement evaluates first."""
    match statement:
        case ast.Expr(value=value) | ast.AugAssign(value=value) | ast.Assign(value=value):
            yield value
        case ast.Return(value=ast.expr() as value):
            yield value
        case ast.If(test=test) | ast.While(test=test) | ast.Assert(test=test):
            yield test
        case ast.For(iter=iterable):
            yield iterable


def _evaluated(node: ast.AST) -> Iterator[ast.expr]:
    """Yield the parts of an expression that are always evaluated."""
    match node:
        case ast.Lambda() | ast.ListComp() | ast.SetComp() | ast.DictComp() | ast.GeneratorExp():
            return
        case ast.IfExp(test=test):
            yield from _evaluated(test)
            return
        case ast.BoolOp(values=[first, *_]):
            yield from _evaluated(first)
            return
    if isinstance(node, ast.expr):
        yield node
    for child in ast.iter_child_nodes(node):
        yield from _evaluated(child)


def _is_use(missing: _Missing, node: ast.expr) -> bool:
    match node:
        case ast.Subscript(slice=ast.Constant(value=int())):
            return True
        case ast.Attribute(attr=name):
            return missing.is_none and not name.startswith("__")
        case ast.Subscript():
            return missing.is_none
    return False


def _error(missing: _Missing, use: ast.expr) -> str:
    """Return the name of the exception of a use."""
    if isinstance(use, ast.Attribute):
        return "AttributeError"
    return "TypeError" if missing.is_none else "IndexError"


def _owner(node: ast.expr) -> ast.expr:
    return node.value if isinstance(node, ast.Attribute | ast.Subscript) else node


def _may_set(module: PythonModule, value: ast.expr, statement: ast.stmt) -> bool:
    """Return whether a statement may set a variable or an attribute."""
    targets = statement.targets if isinstance(statement, ast.Assign) else []
    text = module.text(value)
    stored = {module.text(node) for target in targets for node in ast.walk(target)}
    if text in stored or (isinstance(statement, ast.AugAssign)):
        return True
    if any(isinstance(node, ast.NamedExpr) for node in ast.walk(statement)):
        return True
    is_local = isinstance(value, ast.Name) and _is_local(module, value)
    calls = (node for node in ast.walk(statement) if isinstance(node, ast.Call))
    return not is_local and not all(map(_only_tells, calls))


def _is_local(module: PythonModule, name: ast.Name) -> bool:
    """Return whether only the function itself can set a variable."""
    lookup = module.index.lookup(name.id, name)
    return lookup is not None and lookup[0] is module.enclosing_function(name)


def _only_tells(call: ast.Call) -> bool:
    """Return whether a call only logs or prints."""
    match call.func:
        case ast.Name(id="print" | "str" | "len" | "repr"):
            return True
        case ast.Attribute(attr=name):
            return name in LOG_METHODS or name == "get_logger"
    return False
