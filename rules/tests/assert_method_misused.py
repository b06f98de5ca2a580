"""TS071: the assert methods of a TestCase exist, and compare what they are given."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Report, TestRule
from scaffold.api.python import PythonModule
from scaffold.api.tests import is_test_case, methods

_GONE = {
    "assertEquals": "assertEqual",
    "assertNotEquals": "assertNotEqual",
    "assertAlmostEquals": "assertAlmostEqual",
    "assertNotAlmostEquals": "assertNotAlmostEqual",
    "assertRegexpMatches": "assertRegex",
    "assertNotRegexpMatches": "assertNotRegex",
    "assertRaisesRegexp": "assertRaisesRegex",
    "assertItemsEqual": "assertCountEqual",
    "assert_": "assertTrue",
    "failUnless": "assertTrue",
    "failUnlessEqual": "assertEqual",
    "failIf": "assertFalse",
}
"""What Python 3.12 no longer has, and what took its place."""
_TEST = (
    "import unittest\n\n\nclass TestText(unittest.TestCase):\n"
    "    def test_text(self):\n        self.{}('a'.upper(), 'A')\n"
)


class AssertMethodMisused(TestRule):
    """A test calls an assert method that Python 3.12 does not have, or one that compares nothing.

    **Why.** ``AttributeError: 'TestText' object has no attribute 'assertEquals'``.
    ``assertTrue(a, b)`` takes ``b`` for a message: it passes whatever ``b`` is.

    **Fix.** ``assertEqual``.

    **Source.** Python documentation, ``unittest``, and "What's New In Python 3.12".
    """

    code = "TS071"
    name = "assert-method-misused"
    examples = (
        Example("compared", {"test/test_text.py": _TEST.format("assertEqual")}),
        Example(
            "gone",
            {"test/test_text.py": _TEST.format("assertEquals")},
            Report("6:9", "assertEquals was removed in Python 3.12; use assertEqual"),
        ),
        Example(
            "not compared",
            {"test/test_text.py": _TEST.format("assertTrue").replace("'A'", "['A']")},
            Report("6:9", "assertTrue checks one value, the second is a message; use assertEqual"),
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        for class_ in module.classes.values():
            if is_test_case(module, class_.node):
                yield from self._check_calls(module, class_.node)

    def _check_calls(self, module: PythonModule, class_: ast.ClassDef) -> Iterator[Diagnostic]:
        own = {method.name for method in methods(class_)}
        for node in ast.walk(class_):
            match node:
                case ast.Call(func=ast.Attribute(value=ast.Name(id="self"), attr=name)):
                    if name in _GONE and name not in own:
                        message = f"{name} was removed in Python 3.12; use {_GONE[name]}"
                        yield self.report(module.location(node.func), message)
                    elif name in {"assertTrue", "assertFalse"} and _compares(node.args):
                        message = (
                            f"{name} checks one value, the second is a message; use assertEqual"
                        )
                        yield self.report(module.location(node.func), message)


def _compares(given: list[ast.expr]) -> bool:
    """Tell whether a second argument is certainly a value to compare with, not a message."""
    if len(given) != 2:  # noqa: PLR2004  a value and a message
        return False
    first, second = given
    if isinstance(second, ast.Constant) and not isinstance(second.value, str):
        return second.value is not None
    return isinstance(second, ast.List | ast.Dict | ast.Tuple) or (
        isinstance(first, ast.Constant) and isinstance(first.value, str)
    )
