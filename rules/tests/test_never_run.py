"""TS047: what looks like a test is run."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.python import FunctionNode, PythonModule
from scaffold.api.tests import (
    fixture_decorator,
    fixtures,
    has_other_ways,
    is_named_elsewhere,
    is_test_case,
    methods,
    test_functions,
    test_modules,
)

_TEST = "def test_text():\n    assert True\n\n\n{}"
_CHECK = "def check():\n    assert True\n"
_CLASS = "class TextTests:\n    def test_more(self):\n        assert True\n"


class TestNeverRun(Rule):
    """A function or class of tests stands next to others, and pytest does not run it.

    **Why.** The file passes without it: pytest takes functions that begin with ``test`` and classes
    that begin with ``Test``.

    **Fix.** Rename it.

    **Source.** pytest documentation, "Conventions for Python test discovery".
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
            Report(
                "test/test_text.py:5:5",
                "pytest does not run check: its name does not begin with test",
            ),
        ),
        Example(
            "a class of another name",
            {"test/test_text.py": _TEST.format(_CLASS)},
            Report(
                "test/test_text.py:5:7",
                "pytest does not run TextTests: its name does not begin with Test",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        modules = [] if has_other_ways(package) else test_modules(package)
        for module in modules:
            if not module.has_main_guard:
                yield from self._check_functions(package, module)
                yield from self._check_classes(package, module)

    def _check_functions(self, package: Package, module: PythonModule) -> Iterator[Diagnostic]:
        known = fixtures(package, module)
        has_tests = any(True for _ in test_functions(module))
        for function in module.functions.values():
            decorators = function.node.decorator_list
            if function.name.startswith("test") and fixture_decorator(module, function.node):
                message = f"{function.name} is a fixture, so pytest does not run it as a test"
            elif has_tests and not decorators and _asserts(function.node, set(known)):
                message = f"pytest does not run {function.name}: its name does not begin with test"
            else:
                continue
            if not is_named_elsewhere(package, function.name):
                yield self.report(function, message)

    def _check_classes(self, package: Package, module: PythonModule) -> Iterator[Diagnostic]:
        for class_ in module.classes.values():
            if is_named_elsewhere(package, class_.name) or class_.node.decorator_list:
                continue
            own = methods(class_.node)
            tests = [one for one in own if one.name.startswith("test")]
            is_case = is_test_case(module, class_.node)
            if not (class_.name.startswith("Test") or class_.node.bases) and tests:
                message = f"pytest does not run {class_.name}: its name does not begin with Test"
                yield self.report(class_, message)
            if not is_case and (class_.node.bases or not class_.name.startswith("Test")):
                continue
            for one in own:
                if (
                    _states(one)
                    and not one.decorator_list
                    and not is_named_elsewhere(package, one.name)
                ):
                    message = f"pytest does not run {one.name}: its name does not begin with test"
                    yield self.report(module.name_location(one), message)


def _states(method: FunctionNode) -> bool:
    """Tell whether a method could be a test: it asserts and takes nothing but ``self``."""
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


def _asserts(function: FunctionNode, known: set[str]) -> bool:
    """Tell whether a function could be a test: it asserts, and pytest has its arguments."""
    name, arguments = function.name, {one.arg for one in function.args.args}
    if name.startswith(("test", "_", "pytest_", "setup", "teardown")) or not arguments <= known:
        return False
    return any(isinstance(node, ast.Assert) for node in function.body)
