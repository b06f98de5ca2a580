"""TS077: computed floats are not compared with ``==``."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Severity, TestRule
from scaffold.api.python import PythonModule

_CODE = (
    "import math\n\n\ndef rotation(yaw):\n    return math.sin(yaw / 2.0), math.cos(yaw / 2.0)\n\n\n"
    "def speed():\n    return 0.3\n"
)
_TEST = (
    "import math\n\nimport pytest\nfrom talker.turn import rotation, speed\n\n\n"
    "def test_rotation():\n    z, w = rotation(math.pi)\n    assert {}\n"
)
_FUNCTIONS = ("sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sqrt", "hypot", "exp", "log")
_ROUNDING = ("math.", "numpy.")
_DEPTH = 3


class FloatComparedExactly(TestRule):
    """A test compares the result of sine, square root and the like with ``==``.

    **Why.** ``math.cos(math.pi / 2)`` is 6e-17, not 0.0: the test fails because of rounding, here
    or on another machine.

    **Fix.** ``assert w == pytest.approx(0.0, abs=1e-9)``.

    **Source.** Python tutorial, "Floating-Point Arithmetic: Issues and Limitations".
    """

    code = "TS077"
    name = "float-compared-exactly"
    severity = Severity.WARNING
    examples = (
        Example(
            "approximately; not computed",
            {
                "talker/turn.py": _CODE,
                "test/test_a.py": _TEST.format("w == pytest.approx(0.0, abs=1e-9)"),
                "test/test_b.py": _TEST.format("speed() == 0.3 and z > 0.5"),
                "test/test_c.py": _TEST.format("math.cos(0) == 1.0 and rotation(0.0)[1] == 1.0"),
            },
        ),
        Example(
            "exactly",
            {
                "talker/turn.py": _CODE,
                "test/test_a.py": _TEST.format("w == 0.0"),
                "test/test_b.py": _TEST.format("math.sqrt(2.0) ** 2 == 2.0"),
            },
            "test/test_a.py:9:12: w is a computed float: the test may fail because of rounding; "
            "compare with pytest.approx(...)",
            "test/test_b.py:9:12: math.sqrt(2.0) ** 2 is a computed float: the test may fail "
            "because of rounding; compare with pytest.approx(...)",
        ),
        Example(
            "a sum",
            {"test/test_a.py": _TEST.format("0.1 + 0.2 == 0.3")},
            "9:12: 0.1 + 0.2 is a computed float: the test may fail because of rounding; compare "
            "with pytest.approx(...)",
        ),
    )

    def check_in(self, package: Package, module: PythonModule) -> Iterator[Diagnostic]:
        for node in module.walk(ast.Assert):
            for compare in ast.walk(node.test):
                match compare:
                    case ast.Compare(
                        left=left, ops=[ast.Eq()], comparators=[ast.Constant(value=float())]
                    ) if _is_computed(package, module, left, 0):
                        text = module.text(left)
                        message = (
                            f"{text} is a computed float: the test may fail because of rounding; "
                            f"compare with pytest.approx(...)"
                        )
                        yield self.report(module.location(compare), message)


def _is_computed(package: Package, module: PythonModule, node: ast.expr, depth: int) -> bool:
    """Return whether a value is the result of a function that rounds."""
    parts: tuple[ast.expr | None, ...] = ()
    match node:
        case ast.Attribute(value=value) | ast.Subscript(value=value):
            parts = (value,)
        case ast.BinOp(left=ast.Constant(), right=ast.Constant()):
            return _is_inexact(node)
        case ast.BinOp(left=left, right=right):
            parts = (left, right)
        case ast.Name(id=name):
            lookup = module.index.lookup(name, node)
            bindings = lookup[1] if lookup else ()
            values = [item.value or _unpacked(module, item.node) for item in bindings]
            parts = (values[0],) if len(values) == 1 else ()
        case ast.Call(func=function, args=arguments):
            if arguments and all(map(_is_zero, arguments)):
                return False
            rounds = _rounds(module.qualified_name(function))
            return rounds or _has_rounding(package, module, function)
    return depth < _DEPTH and any(
        part is not None and _is_computed(package, module, part, depth + 1) for part in parts
    )


def _is_zero(node: ast.expr) -> bool:
    """Return whether a value is 0 or empty, for which the functions are exact."""
    match node:
        case ast.Constant(value=value):
            return not value
        case ast.List(elts=items) | ast.Tuple(elts=items):
            return all(map(_is_zero, items))
    return False


def _unpacked(module: PythonModule, node: ast.AST) -> ast.expr | None:
    """Return the value assigned to a tuple of names."""
    for parent in module.parents(node):
        if isinstance(parent, ast.Assign):
            return parent.value
    return None


def _is_inexact(node: ast.BinOp) -> bool:
    """Return whether a sum of numbers is not exact."""
    match node:
        case ast.BinOp(
            left=ast.Constant(value=float() as left),
            op=ast.Add(),
            right=ast.Constant(value=float() as right),
        ):
            return len(repr(left + right)) > max(len(repr(left)), len(repr(right))) + 4
    return False


def _rounds(name: str | None) -> bool:
    return name is not None and name.startswith(_ROUNDING) and name.rpartition(".")[2] in _FUNCTIONS


def _has_rounding(package: Package, module: PythonModule, function: ast.expr) -> bool:
    """Return whether a function of the package computes with sines, roots and the like."""
    name = module.qualified_name(function) or ""
    owner, _, attribute = name.rpartition(".")
    path = f"{owner.replace('.', '/')}.py"
    if not owner or not package.has(path):
        return False
    definition = package.module(path)
    called = definition.functions.get(attribute)
    return called is not None and any(
        isinstance(node, ast.Call) and _rounds(definition.qualified_name(node.func))
        for node in ast.walk(called.node)
    )
