"""TS072: what a test asserts can be false."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Report, Severity, TestRule
from scaffold.api.python import PythonModule
from scaffold.api.tests import test_functions

_MOCKED = ("called_once", "called_with", "called_once_with", "not_called", "has_calls")
_TEST = "def ready():\n    return False\n\n\ndef test_text():\n    assert {}\n"


class AssertionAlwaysTrue(TestRule):
    """A test asserts something that is always true.

    **Why.** The test passes whatever happens: a function that is not called is true, and so is a
    text that is not compared with anything.

    **Fix.** Call the function; compare with the text.

    **Source.** Python documentation, "Truth Value Testing"; ``unittest.mock``.
    """

    code = "TS072"
    name = "assertion-always-true"
    severity = Severity.WARNING
    examples = (
        Example("called", {"test/test_text.py": _TEST.format("ready()")}),
        Example(
            "a function",
            {"test/test_text.py": _TEST.format("ready")},
            Report("test/test_text.py:6:5", "ready is a function, which is always true: call it"),
        ),
        Example(
            "a text next to a comparison",
            {"test/test_text.py": _TEST.format("ready() == 'a' or 'b'")},
            Report(
                "test/test_text.py:6:5",
                "one side of this `or` is always true: compare with it as well",
            ),
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        for test in test_functions(module):
            for node in ast.walk(test.node):
                problem = _problem(module, node.test) if isinstance(node, ast.Assert) else ""
                if problem:
                    yield self.report(module.location(node), problem)


def _problem(module: PythonModule, condition: ast.expr) -> str:
    match condition:
        case ast.Constant(value=str(text)) if text:
            return "a text is always true: nothing is asserted"
        case ast.BoolOp(op=ast.Or(), values=values) if any(map(_is_true, values)):
            return "one side of this `or` is always true: compare with it as well"
        case ast.Call(func=ast.Attribute(attr=name)) if name in _MOCKED:
            return f"a mock has no {name}(): it fails, or is always true; assert_{name}() is meant"
        case ast.Name(id=name):
            function = module.functions.get(name)
            found = module.index.lookup(name, condition)
            if function is not None and found is not None and found[0] is module.tree:
                plain = not function.node.decorator_list and len(found[1]) == 1
                return f"{name} is a function, which is always true: call it" if plain else ""
        case ast.Attribute() if module.qualified_name(condition) == "rclpy.ok":
            return "rclpy.ok is a function, which is always true: call it"
    return ""


def _is_true(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str | int) and bool(node.value)
