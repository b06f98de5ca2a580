"""TS074: a test with parameters gets as many values as it has names."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Report, TestRule
from scaffold.api.python import PythonModule
from scaffold.api.tests import keywords, marks, test_functions

_TEST = (
    "import pytest\n\n\n@pytest.mark.parametrize('word, count', {})\n"
    "def test_text(word, count):\n    assert len(word) == count\n"
)


class ParametrizeValuesDiffer(TestRule):
    """``parametrize`` has no values, or another number of them than of names.

    **Why.** pytest stops: ``in "parametrize" the number of names must be equal to the number of
    values``; without any value it skips the test.

    **Fix.** ``@pytest.mark.parametrize('a, b', [(1, 2), (3, 4)])``.

    **Source.** pytest documentation, "How to parametrize fixtures and test functions".
    """

    code = "TS074"
    name = "parametrize-values-differ"
    examples = (
        Example("as many", {"test/test_text.py": _TEST.format("[('a', 1)]")}),
        Example(
            "one too many",
            {"test/test_text.py": _TEST.format("[('a', 1), ('b', 1, 2)]")},
            Report("test/test_text.py:4:2", "there are 2 names, and ('b', 1, 2) has 3 values"),
        ),
        Example(
            "none",
            {"test/test_text.py": _TEST.format("[]")},
            Report("test/test_text.py:4:2", "there are no values: pytest skips the test"),
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        for test in test_functions(module):
            for name, mark in marks(module, test.node):
                if name != "parametrize" or not isinstance(mark, ast.Call):
                    continue
                problem = _problem(module, mark)
                if problem:
                    yield self.report(module.location(mark), problem)


def _problem(module: PythonModule, call: ast.Call) -> str:
    words = keywords(call)
    if any(isinstance(one, ast.Starred) for one in call.args):
        return ""
    names = call.args[0] if call.args else words.get("argnames")
    values = call.args[1] if len(call.args) > 1 else words.get("argvalues")
    if values is None:
        is_open = len(words) < len(call.keywords)
        return "" if is_open else "parametrize needs the values as well as the names"
    if not isinstance(values, ast.List | ast.Tuple):
        return ""
    if not values.elts:
        return "there are no values: pytest skips the test"
    count = _count(names)
    for value in values.elts if count > 1 else ():
        given = _given(module, value)
        if given is not None and given != count:
            return f"there are {count} names, and {module.text(value)} has {given} values"
    return ""


def _count(names: ast.expr | None) -> int:
    match names:
        case ast.Constant(value=str(text)):
            return len([part for part in text.split(",") if part.strip()])
        case ast.List(elts=items) | ast.Tuple(elts=items):
            return len(items)
    return 0


def _given(module: PythonModule, value: ast.expr) -> int | None:
    """Return how many values are written for one call of the test."""
    items: list[ast.expr] | None = None
    match value:
        case ast.Tuple() | ast.List():
            items = value.elts
        case ast.Call() if module.qualified_name(value.func) == "pytest.param":
            items = value.args
        case ast.Constant(value=bool() | int() | float() | None):
            return 1
    if items is None or any(isinstance(item, ast.Starred) for item in items):
        return None
    return len(items)
