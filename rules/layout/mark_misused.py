"""LY046: marks of tests are spelt as pytest spells them, and have what they need."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.python_module import PythonModule
from scaffold.model.test_files import keywords, marks, test_functions, test_modules

_MEANT = {
    **dict.fromkeys(
        ("parameterize", "parametrise", "parameterise", "parametize", "parametrized"),
        "parametrize",
    ),
    **dict.fromkeys(("parameterized", "parameters", "parameter"), "parametrize"),
    **dict.fromkeys(("skip_if", "skipIf", "skif"), "skipif"),
    **dict.fromkeys(("usefixture", "use_fixtures", "use_fixture"), "usefixtures"),
    **dict.fromkeys(("x_fail", "xFail", "expected_fail"), "xfail"),
}
_TEST = (
    "import pytest\n\n\n@pytest.mark.{}('word, count', {})\ndef test_text(word, count):\n"
    "    assert len(word) == count\n"
)


class MarkMisused(Rule):
    """A mark is misspelt or lacks something.

    **Why.** pytest stops: ``Unknown 'parameterize' mark``, ``in "parametrize" the number of names
    must be equal to the number of values``, ``you need to specify reason=STRING``; or it skips the
    test: an empty list of values.

    **Fix.** ``@pytest.mark.parametrize('a, b', [(1, 2)])``; ``reason='...'`` for ``skipif``.

    **Source.** pytest documentation, "How to parametrize fixtures and test functions", "How to use
    skip and xfail".
    """

    code = "LY046"
    name = "mark-misused"
    examples = (
        Example("right", {"test/test_text.py": _TEST.format("parametrize", "[('a', 1)]")}),
        Example(
            "misspelt",
            {"test/test_text.py": _TEST.format("parameterize", "[('a', 1)]")},
            at=("test/test_text.py:4",),
        ),
        Example(
            "one value too many, no value",
            {
                "test/test_text.py": _TEST.format("parametrize", "[('a', 1, 2)]"),
                "test/test_more.py": _TEST.format("parametrize", "[]"),
            },
            at=("test/test_more.py:4", "test/test_text.py:4"),
        ),
        Example(
            "no reason",
            {
                "test/test_text.py": "import pytest\n\n\n@pytest.mark.skipif(True)\n"
                "def test_one():\n    pass\n"
            },
            at=("test/test_text.py:4",),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for module in test_modules(package):
            for test in test_functions(module):
                for name, decorator in marks(module, test.node):
                    problem = _mark_problem(module, name, decorator)
                    if problem:
                        yield self.report(module.location(decorator), problem)


def _mark_problem(module: PythonModule, name: str, decorator: ast.expr) -> str:
    if name in _MEANT:
        return f"pytest has no mark {name!r}; {_MEANT[name]!r} is meant"
    if not isinstance(decorator, ast.Call):
        return "" if name != "parametrize" else "parametrize needs names and values"
    words = keywords(decorator)
    if name == "skipif" and "reason" not in words and len(decorator.args) == 1:
        match decorator.args[0]:
            case ast.Compare() | ast.BoolOp() | ast.UnaryOp() | ast.Constant(value=bool()):
                return "a condition that is no text needs reason='...': pytest stops here"
    if name == "parametrize" and not any(isinstance(one, ast.Starred) for one in decorator.args):
        return _values_problem(module, decorator, words)
    return ""


def _values_problem(module: PythonModule, call: ast.Call, words: dict[str, ast.expr]) -> str:
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
