"""TS047: functions and classes that look like tests are run."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, Severity
from scaffold.api.python import FunctionNode, PythonModule
from scaffold.api.tests import (
    fixture_decorator,
    fixtures,
    is_named_elsewhere,
    is_test_case,
    methods,
    settings_or_tests_mention,
    test_functions,
    test_modules,
)

_TEST = "def test_text():\n    assert True\n\n\n{}"
_CHECK = "def check():\n    assert True\n"
_OUTER = "def ready():\n    return False\n\n\ndef test_text():\n{}"
_OWN = "    class Case:\n        def test_more(self):\n            pass\n\n    assert run(Case)\n"
_MORE = "    assert ready()\n\n    def test_more():\n        assert ready()\n"
_CLASS = "class TextTests:\n    def test_more(self):\n        assert True\n"
_TEST_BODIES = "{}def test_text():\n    {}\n"
_PLUGINS = ("pytestmark", "asyncio_mode", "anyio", "pytest_pyfunc_call", "python_functions")
"""Words that indicate other ways to run tests."""


class TestNeverRun(Rule):
    """A test has a name or place that pytest does not collect, or is a coroutine or generator.

    **Why.** The test run passes without it: pytest collects functions that start with ``test`` and
    classes that start with ``Test``, but not those inside another test. It does not await
    coroutines or iterate over generators: their bodies never run.

    **Fix.** Rename it, or move it out of the test; call ``asyncio.run(...)`` in a plain test; use
    ``parametrize`` instead of ``yield``.

    **Source.** pytest documentation, "Conventions for Python test discovery", "Deprecations and
    Removals", ``yield`` tests, and "How to handle test failures", async tests.
    """

    code = "TS047"
    name = "test-never-run"
    severity = Severity.WARNING
    examples = (
        Example(
            "called by a test",
            {"test/test_text.py": _TEST.format(_CHECK + "\n\ndef test_all():\n    check()\n")},
        ),
        Example(
            "another name",
            {"test/test_text.py": _TEST.format(_CHECK)},
            "5:5: pytest does not run check: its name does not start with test",
        ),
        Example(
            "a class of another name",
            {"test/test_text.py": _TEST.format(_CLASS)},
            "5:7: pytest does not run TextTests: its name does not start with Test",
        ),
        Example(
            "inside a test: a class that the test runs",
            {"test/test_text.py": _OUTER.format(_OWN)},
        ),
        Example(
            "inside a test: a function that is never called",
            {"test/test_text.py": _OUTER.format(_MORE)},
            "8:5: test_more is inside test_text: pytest does not collect it; move it to module "
            "level",
        ),
        Example(
            "a method of another name, a fixture",
            {
                "test/test_text.py": "import pytest\n\n\n"
                "@pytest.fixture\ndef test_data():\n    return 1\n\n"
                "\n"
                + _CLASS.replace("TextTests", "TestText")
                + "\n    def check(self):\n        assert True\n"
            },
            "5:5: test_data is a fixture: pytest does not run it as a test",
            "13:9: pytest does not run check: its name does not start with test",
        ),
        Example(
            "a coroutine",
            {"test/test_text.py": _TEST_BODIES.format("async ", "assert True")},
            "1:11: test_text is a coroutine: pytest does not run it; call asyncio.run() in a "
            "plain test",
        ),
        Example(
            "a generator",
            {"test/test_text.py": _TEST_BODIES.format("", "yield 1")},
            "1:5: test_text is a generator: pytest does not run it; use parametrize",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_collected(package)
        yield from self._check_bodies(package)

    def _check_collected(self, package: Package) -> Iterator[Diagnostic]:
        for module in test_modules(package):
            yield from self._check_inner_tests(module)
        modules = [] if _uses_pytest_plugins(package) else test_modules(package)
        for module in modules:
            if not module.has_main_guard:
                yield from self._check_functions(package, module)
                yield from self._check_classes(package, module)

    def _check_inner_tests(self, module: PythonModule) -> Iterator[Diagnostic]:
        for test in test_functions(module):
            for node in ast.walk(test.node):
                is_other = isinstance(node, ast.FunctionDef) and node is not test.node
                if isinstance(node, ast.FunctionDef) and is_other and _is_unused_test(module, node):
                    place = f"{node.name} is inside {test.node.name}"
                    message = f"{place}: pytest does not collect it; move it to module level"
                    yield self.report(module.location(node), message)

    def _check_functions(self, package: Package, module: PythonModule) -> Iterator[Diagnostic]:
        fixture_names = fixtures(package, module)
        has_tests = any(True for _ in test_functions(module))
        for function in module.functions.values():
            decorators = function.node.decorator_list
            if function.name.startswith("test") and fixture_decorator(module, function.node):
                message = f"{function.name} is a fixture: pytest does not run it as a test"
            elif has_tests and not decorators and _could_be_test(function.node, set(fixture_names)):
                message = f"pytest does not run {function.name}: its name does not start with test"
            else:
                continue
            if not is_named_elsewhere(package, module, function.name):
                yield self.report(function, message)

    def _check_classes(self, package: Package, module: PythonModule) -> Iterator[Diagnostic]:
        for class_ in module.classes.values():
            if is_named_elsewhere(package, module, class_.name) or class_.node.decorator_list:
                continue
            own = methods(class_.node)
            tests = [item for item in own if item.name.startswith("test")]
            is_case = is_test_case(module, class_.node)
            if not (class_.name.startswith("Test") or class_.node.bases) and tests:
                message = f"pytest does not run {class_.name}: its name does not start with Test"
                yield self.report(class_, message)
            if not is_case and (class_.node.bases or not class_.name.startswith("Test")):
                continue
            for suite in own:
                if (
                    _could_be_test_method(suite)
                    and not suite.decorator_list
                    and not is_named_elsewhere(package, module, suite.name)
                ):
                    message = f"pytest does not run {suite.name}: its name does not start with test"
                    yield self.report(module.name_location(suite), message)

    def _check_bodies(self, package: Package) -> Iterator[Diagnostic]:
        if _uses_pytest_plugins(package):
            return
        for module in test_modules(package):
            for test in test_functions(module) if not module.has_main_guard else ():
                is_plain = test.class_ is None or not test.class_.bases
                problem = _problem(module, test.node) if is_plain else ""
                if problem and not is_named_elsewhere(package, module, test.node.name):
                    yield self.report(module.name_location(test.node), problem)


def _could_be_test_method(method: FunctionNode) -> bool:
    """Return whether a method could be a test: it asserts and only has the parameter ``self``."""
    if method.name.startswith(("test", "_", "set", "tear", "run")) or len(method.args.args) != 1:
        return False
    for node in method.body:
        match node:
            case ast.Assert():
                return True
            case ast.Expr(value=ast.Call(func=ast.Attribute(attr=name))):
                if name.startswith("assert"):
                    return True
    return False


def _could_be_test(function: FunctionNode, fixture_names: set[str]) -> bool:
    """Return whether a function could be a test: it asserts, and its parameters are fixtures."""
    name, arguments = function.name, {arg.arg for arg in function.args.args}
    if (
        name.startswith(("test", "_", "pytest_", "setup", "teardown"))
        or not arguments <= fixture_names
    ):
        return False
    return any(isinstance(node, ast.Assert) for node in function.body)


def _is_unused_test(module: PythonModule, node: ast.FunctionDef) -> bool:
    """Return whether a function is named like a test and unused."""
    holder = module.parent(node)
    used = isinstance(holder, ast.ClassDef) and _is_used(module, holder)
    return node.name.startswith("test_") and not (used or _is_used(module, node))


def _is_used(module: PythonModule, node: ast.FunctionDef | ast.ClassDef) -> bool:
    """Return whether a function or class is used anywhere."""
    return bool(node.decorator_list or module.index.names(node.name))


def _problem(module: PythonModule, test: FunctionNode) -> str:
    """Return the problem with a test that pytest does not call as a function."""
    if test.decorator_list:
        return ""
    if isinstance(test, ast.AsyncFunctionDef):
        return (
            f"{test.name} is a coroutine: pytest does not run it; call asyncio.run() in a "
            f"plain test"
        )
    for kind in (ast.Yield, ast.YieldFrom):
        for node in module.walk(kind):
            if module.enclosing_function(node) is test:
                return f"{test.name} is a generator: pytest does not run it; use parametrize"
    return ""


def _uses_pytest_plugins(package: Package) -> bool:
    """Return whether plugins or settings of pytest may run other tests."""
    return settings_or_tests_mention(package, _PLUGINS)
