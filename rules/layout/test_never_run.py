"""LY047: what looks like a test is run."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, Severity
from scaffold.model.python_module import PythonModule
from scaffold.model.scopes import FunctionNode
from scaffold.model.test_files import (
    fixture_decorator,
    fixtures,
    is_test_case,
    methods,
    test_functions,
    test_modules,
)

_TEST = "{}def test_text():\n    assert True\n\n\n{}"
_PLUGINS = ("pytestmark", "asyncio_mode", "anyio", "pytest_pyfunc_call", "python_functions")


class TestNeverRun(Rule):
    """A function or class of tests stands beside others, and pytest does not run it.

    **Why.** The file passes without it: pytest takes functions that begin with ``test`` and classes
    that begin with ``Test``; it does not wait for a coroutine, nor go through a generator.

    **Fix.** Rename it; ``asyncio.run(...)`` in a plain test; ``parametrize`` instead of ``yield``.

    **Source.** pytest documentation, "Conventions for Python test discovery".
    """

    code = "LY047"
    name = "test-never-run"
    severity = Severity.WARNING
    examples = (
        Example(
            "called by another",
            {
                "test/test_text.py": _TEST.format("", "def check():\n    assert True\n")
                + "\n\ndef test_all():\n    check()\n"
            },
        ),
        Example(
            "another name",
            {"test/test_text.py": _TEST.format("", "def check_more():\n    assert True\n")},
            at=("test/test_text.py:5",),
        ),
        Example(
            "a coroutine, a generator",
            {
                "test/test_text.py": _TEST.format("async ", "def test_more():\n    yield 1\n"),
            },
            at=("test/test_text.py:1", "test/test_text.py:5"),
        ),
        Example(
            "a class of another name",
            {
                "test/test_text.py": _TEST.format(
                    "", "class TextTests:\n    def test_more(self):\n        assert True\n"
                )
            },
            at=("test/test_text.py:5",),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        names = ("pytest.ini", "setup.cfg", "pyproject.toml", "tox.ini")
        texts = [package.source(name).text for name in names if package.has(name)]
        texts += [module.source.text for module in package.modules() if module.in_tests]
        if any(word in text for text in texts for word in _PLUGINS):
            return
        for module in test_modules(package):
            if module.has_main_guard:
                continue
            for test in test_functions(module):
                is_plain = test.class_ is None or not test.class_.bases
                problem = _kind_problem(module, test.node) if is_plain else ""
                if problem and not _is_used(package, test.node.name):
                    yield self.report(module.name_location(test.node), problem)
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
            if not _is_used(package, function.name):
                yield self.report(function, message)

    def _check_classes(self, package: Package, module: PythonModule) -> Iterator[Diagnostic]:
        for class_ in module.classes.values():
            if _is_used(package, class_.name) or class_.node.decorator_list:
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
                if _states(one) and not one.decorator_list and not _is_used(package, one.name):
                    message = f"pytest does not run {one.name}: its name does not begin with test"
                    yield self.report(module.name_location(one), message)


def _states(method: FunctionNode) -> bool:
    """Tell whether a method could be a test: it asserts and takes nothing but ``self``."""
    if method.name.startswith(("test", "_", "set", "tear", "run")) or len(method.args.args) != 1:
        return False
    return any(
        isinstance(node, ast.Assert)
        or (
            isinstance(node, ast.Expr)
            and isinstance(node.value, ast.Call)
            and isinstance(node.value.func, ast.Attribute)
            and node.value.func.attr.startswith("assert")
        )
        for node in method.body
    )


def _asserts(function: FunctionNode, known: set[str]) -> bool:
    """Tell whether a function could be a test: it asserts, and pytest has its arguments."""
    name, arguments = function.name, {one.arg for one in function.args.args}
    if name.startswith(("test", "_", "pytest_", "setup", "teardown")) or not arguments <= known:
        return False
    return any(isinstance(node, ast.Assert) for node in function.body)


def _is_used(package: Package, name: str) -> bool:
    """Tell whether a name stands anywhere else: in a call, an import, an argument, a text."""
    count = sum(module.source.text.count(name) for module in package.modules())
    return count > 1


def _kind_problem(module: PythonModule, test: FunctionNode) -> str:
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
