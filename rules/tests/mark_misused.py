"""TS046: pytest marks exist and are complete."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, TestRule, fact
from scaffold.api.python import PythonModule
from scaffold.api.tests import (
    keywords,
    marks,
    pytest_settings,
    settings_or_tests_mention,
    test_functions,
)

_MEANT = {
    **dict.fromkeys(
        ("parameterize", "parametrise", "parameterise", "parametize", "parametrized"), "parametrize"
    ),
    **dict.fromkeys(("parameterized", "parameters", "parameter"), "parametrize"),
    **dict.fromkeys(("skip_if", "skipIf", "skif"), "skipif"),
    **dict.fromkeys(("usefixture", "use_fixtures", "use_fixture"), "usefixtures"),
    **dict.fromkeys(("x_fail", "xFail", "expected_fail"), "xfail"),
}
_OF_PLUGINS = frozenset(
    """
    anyio asyncio benchmark copyright cppcheck cpplint dependency django_db filterwarnings flake8
    flaky forked isort launch launch_test linter lint_cmake mypy no_cover order parametrize pep257
    repeat rostest skip skipif timeout trio tryfirst trylast uncrustify usefixtures xdist_group
    xfail xmllint
    """.split()  # noqa: SIM905  a column of quoted names would hide them
)
"""The marks of pytest, its common plugins and the linters of ament."""
_PARAMETERS = (
    "import pytest\n\n\n@pytest.mark.parametrize('word, count', {})\n"
    "def test_text(word, count):\n    assert len(word) == count\n"
)
_TEST = (
    "import pytest\n\n\n@pytest.mark.{}('word, count', {})\ndef test_text(word, count):\n"
    "    assert len(word) == count\n"
)


class MarkMisused(TestRule):
    """A mark is misspelled or incomplete, or ``parametrize`` has more or fewer values than names.

    **Why.** pytest stops: ``Unknown 'parameterize' mark``, ``you need to specify reason=STRING``,
    ``in "parametrize" the number of names must be equal to the number of values``; without values,
    it skips the test.

    **Fix.** Write ``@pytest.mark.parametrize('a, b', [(1, 2)])``; ``reason='...'`` for ``skipif``.

    **Source.** pytest documentation, "How to mark test functions with attributes", "How to
    parametrize fixtures and test functions", "How to use skip and xfail".
    """

    code = "TS046"
    name = "mark-misused"
    examples = (
        Example("valid marks", {"test/test_text.py": _TEST.format("parametrize", "[('a', 1)]")}),
        Example(
            "misspelled",
            {"test/test_text.py": _TEST.format("parameterize", "[('a', 1)]")},
            "4:2: unknown mark 'parameterize': pytest stops; did you mean 'parametrize'?",
        ),
        Example(
            "no reason",
            {
                "test/test_text.py": "import pytest\n\n\n@pytest.mark.skipif(True)\n"
                "def test_one():\n    pass\n"
            },
            "4:2: a condition that is not a string needs reason='...': pytest stops here",
        ),
        Example("as many values as names", {"test/test_text.py": _PARAMETERS.format("[('a', 1)]")}),
        Example(
            "an extra value",
            {"test/test_text.py": _PARAMETERS.format("[('a', 1), ('b', 1, 2)]")},
            "4:2: 2 names, but ('b', 1, 2) has 3 values: pytest stops",
        ),
        Example(
            "no values",
            {"test/test_text.py": _PARAMETERS.format("[]")},
            "4:2: no values: pytest skips the test",
        ),
        Example(
            "neither names nor values; no values",
            {
                "test/test_text.py": "import pytest\n\n\n"
                "@pytest.mark.parametrize\ndef test_one():\n"
                "    pass\n\n\n@pytest.mark.parametrize('word')\ndef test_two(word):\n"
                "    pass\n"
            },
            "4:2: parametrize requires names and values",
            "9:2: parametrize requires values in addition to the names",
        ),
        Example(
            "values in a constant",
            {
                "test_sum.py": "import pytest\n\nSUMS = [(1, 2, 3)]\n\n\n"
                "@pytest.mark.parametrize('first, second', SUMS)\n"
                "def test_sum(first, second):\n    assert first + second == 3\n"
            },
            "6:2: 2 names, but (1, 2, 3) has 3 values: pytest stops",
        ),
        Example(
            "registered marks and another one, with --strict-markers",
            {
                "pytest.ini": "[pytest]\naddopts = --strict-markers\nmarkers =\n    slow: long\n",
                "test/test_text.py": "import pytest\n\n\n@pytest.mark.slow\n@pytest.mark.linter\n"
                "@pytest.mark.hardware\ndef test_one():\n    pass\n",
            },
            "test/test_text.py:6:2: mark 'hardware' is not registered, and markers are strict: "
            "pytest stops; add it to markers in the settings",
        ),
    )

    def check_in(self, package: Package, module: PythonModule) -> Iterator[Diagnostic]:
        registered = _registered(package)
        for test in test_functions(module):
            for name, decorator in marks(module, test.node):
                problem = _mark_problem(module, name, decorator)
                if not problem and registered is not None and name not in registered:
                    problem = (
                        f"mark {name!r} is not registered, and markers are strict: pytest stops; "
                        "add it to markers in the settings"
                    )
                if problem:
                    yield self.report(module.location(decorator), problem)


@fact
def _registered(package: Package) -> frozenset[str] | None:
    """Return the marks that pytest accepts; ``None`` if it accepts all, or plugins add some."""
    settings = pytest_settings(package)
    options = settings["addopts"].words if "addopts" in settings else ()
    if not {"--strict", "--strict-markers"}.intersection(options):
        return None
    if settings_or_tests_mention(package, ("addinivalue_line", "pytest_plugins", "-p ")):
        return None
    words = settings["markers"].words if "markers" in settings else ()
    return frozenset(word.partition(":")[0].partition("(")[0] for word in words) | _OF_PLUGINS


def _mark_problem(module: PythonModule, name: str, decorator: ast.expr) -> str:
    if name in _MEANT:
        return f"unknown mark {name!r}: pytest stops; did you mean {_MEANT[name]!r}?"
    if not isinstance(decorator, ast.Call):
        return "" if name != "parametrize" else "parametrize requires names and values"
    if name == "parametrize":
        return _parametrize_problem(module, decorator)
    words = keywords(decorator)
    if name == "skipif" and "reason" not in words and len(decorator.args) == 1:
        match decorator.args[0]:
            case ast.Compare() | ast.BoolOp() | ast.UnaryOp() | ast.Constant(value=bool()):
                return "a condition that is not a string needs reason='...': pytest stops here"
    return ""


def _parametrize_problem(module: PythonModule, call: ast.Call) -> str:
    words = keywords(call)
    if any(isinstance(arg, ast.Starred) for arg in call.args):
        return ""
    names = call.args[0] if call.args else words.get("argnames")
    values = call.args[1] if len(call.args) > 1 else words.get("argvalues")
    if values is None:
        is_open = len(words) < len(call.keywords)
        return "" if is_open else "parametrize requires values in addition to the names"
    values = module.index.only_value(values) or values
    if not isinstance(values, ast.List | ast.Tuple):
        return ""
    if not values.elts:
        return "no values: pytest skips the test"
    count = _count(names)
    for value in values.elts if count > 1 else ():
        given = _value_count(module, value)
        if given is not None and given != count:
            return f"{count} names, but {module.text(value)} has {given} values: pytest stops"
    return ""


def _count(names: ast.expr | None) -> int:
    match names:
        case ast.Constant(value=str(text)):
            return len([part for part in text.split(",") if part.strip()])
        case ast.List(elts=items) | ast.Tuple(elts=items):
            return len(items)
    return 0


def _value_count(module: PythonModule, value: ast.expr) -> int | None:
    """Return the number of values for one call of the test."""
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
