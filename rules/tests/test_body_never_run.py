"""TS075: the bodies of tests are run."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.python import FunctionNode, PythonModule
from scaffold.api.tests import is_named_elsewhere, test_functions, test_modules, uses_pytest_plugins

_TEST = "{}def test_text():\n    {}\n"


class TestBodyNeverRun(Rule):
    """A test is a coroutine or a generator.

    **Why.** pytest does not wait for a coroutine, nor go through a generator: it skips the test, or
    passes it without having run its body.

    **Fix.** ``asyncio.run(...)`` in a plain test; ``parametrize`` instead of ``yield``.

    **Source.** pytest documentation, "Deprecations and Removals", ``yield`` tests, and "How to
    handle test failures", async tests.
    """

    code = "TS075"
    name = "test-body-never-run"
    severity = Severity.WARNING
    examples = (
        Example("a function", {"test/test_text.py": _TEST.format("", "assert True")}),
        Example(
            "a coroutine",
            {"test/test_text.py": _TEST.format("async ", "assert True")},
            Report("1:11", "test_text is a coroutine: pytest does not run it by itself"),
        ),
        Example(
            "a generator",
            {"test/test_text.py": _TEST.format("", "yield 1")},
            Report("1:5", "test_text yields: pytest does not run such a test"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        if uses_pytest_plugins(package):
            return
        for module in test_modules(package):
            for test in test_functions(module) if not module.has_main_guard else ():
                is_plain = test.class_ is None or not test.class_.bases
                problem = _problem(module, test.node) if is_plain else ""
                if problem and not is_named_elsewhere(package, module, test.node.name):
                    yield self.report(module.name_location(test.node), problem)


def _problem(module: PythonModule, test: FunctionNode) -> str:
    """Return what is wrong about a test that pytest does not call like a function."""
    if test.decorator_list:
        return ""
    if isinstance(test, ast.AsyncFunctionDef):
        return f"{test.name} is a coroutine: pytest does not run it by itself"
    for kind in (ast.Yield, ast.YieldFrom):
        for node in module.walk(kind):
            if module.enclosing_function(node) is test:
                return f"{test.name} yields: pytest does not run such a test"
    return ""
