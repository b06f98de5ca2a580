"""TS073: fixtures have a scope that pytest takes, and give one value."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.tests import Fixture, arguments, files_of_tests, fixtures, own_fixtures

_SCOPES = ("function", "class", "module", "package", "session")
"""From the narrowest to the widest."""
_TEST = (
    "import pytest\n\n\n@pytest.fixture\ndef word():\n    return 'a'\n\n\n"
    "@pytest.fixture(scope='{}')\ndef text(word):\n    yield word\n{}\n\n"
    "def test_text(text):\n    assert text == 'a'\n"
)


class FixtureMadeWrongly(Rule):
    """A fixture has a scope that pytest refuses, or yields twice.

    **Why.** The tests that use it end in an error: ``ScopeMismatch``, ``fixture function has more
    than one 'yield'``.

    **Fix.** Give it a scope that is not wider than those of the fixtures that it takes; ``yield``
    once.

    **Source.** pytest documentation, "How to use fixtures".
    """

    code = "TS073"
    name = "fixture-made-wrongly"
    examples = (
        Example("of one test", {"test/test_text.py": _TEST.format("function", "")}),
        Example(
            "a scope that does not exist",
            {"test/test_text.py": _TEST.format("modul", "")},
            Report(
                "9:2",
                "unknown scope 'modul'; choose from function, class, module, package, session",
            ),
        ),
        Example(
            "a wider scope than that of what it takes",
            {"test/test_text.py": _TEST.format("module", "")},
            Report("9:2", "a fixture of scope 'module' cannot use word of scope 'function'"),
        ),
        Example(
            "two values",
            {"test/test_text.py": _TEST.format("function", "    yield 'b'\n")},
            Report("9:2", "the fixture text yields twice: pytest takes one value"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for module in package.modules(files_of_tests(package)):
            if "pytest" not in module.imports_by_root:
                continue
            available = fixtures(package, module)
            for fixture in own_fixtures(module):
                problem = _problem(fixture, available)
                if problem and fixture.node.decorator_list:
                    yield self.report(module.location(fixture.node.decorator_list[0]), problem)


def _problem(fixture: Fixture, available: Mapping[str, Fixture]) -> str:
    """Return what is wrong about the scope of a fixture, or what it yields."""
    if not fixture.scope:
        return ""
    if fixture.scope not in _SCOPES:
        return f"unknown scope {fixture.scope!r}; choose from {', '.join(_SCOPES)}"
    if sum(map(_yields, fixture.node.body)) > 1:
        return f"the fixture {fixture.name} yields twice: pytest takes one value"
    for name in arguments(fixture.node):
        inner = available.get(name)
        if inner is None or inner.scope not in _SCOPES or inner.node is fixture.node:
            continue
        if _SCOPES.index(inner.scope) < _SCOPES.index(fixture.scope):
            return (
                f"a fixture of scope {fixture.scope!r} cannot use {name} of scope {inner.scope!r}"
            )
    return ""


def _yields(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Yield)
