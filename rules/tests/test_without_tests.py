"""TS040: test files contain tests that pytest collects."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Location, Severity, TestRule
from scaffold.api.python import PythonModule

_LAUNCH = ("generate_test_description", "launch_description", "pytest_generate_tests")

_FIXTURES = frozenset({"setUp", "setUpClass", "tearDown", "tearDownClass"})


class TestWithoutTests(TestRule):
    """A test file contains no test that pytest collects, or a test that cannot fail.

    **Why.** pytest collects functions that start with ``test``, and classes that start with
    ``Test`` and have no constructor: the file passes without testing anything.

    **Fix.** Rename the function or class; use ``assert`` instead of ``return``.

    **Source.** pytest documentation, "Conventions for Python test discovery".
    """

    code = "TS040"
    name = "test-without-tests"
    severity = Severity.WARNING
    examples = (
        Example("a test", {"test/test_text.py": "def test_text():\n    assert True\n"}),
        Example(
            "another name",
            {"test/test_text.py": "def check_text():\n    assert True\n"},
            "1:1: pytest collects no test here: names must start with test or Test",
        ),
        Example(
            "a class with a constructor",
            {
                "test/test_text.py": "class TestText:\n"
                "    def __init__(self):\n        self.n = 1\n\n"
                "    def test_text(self):\n        assert self.n\n"
            },
            "1:7: pytest does not collect TestText, because it has a constructor; use a fixture "
            "or setup_method()",
        ),
        Example(
            "a comparison that is returned",
            {"test/test_text.py": "def test_text():\n    return 1 == 2\n"},
            "2:5: the return value of a test is ignored: use assert",
        ),
        Example(
            "test case without and with tests",
            {
                f"test/test_{name}.py": "import unittest\n\n\n"
                "class TestLoad(unittest.TestCase):\n"
                "    def setUp(self):\n"
                "        self.assertTrue(True)\n\n"
                f"    def {prefix}memory(self):\n"
                "        self.assertGreater(2, 1)\n"
                for name, prefix in (("right", "test_"), ("wrong", ""))
            },
            "test/test_wrong.py:8:9: unittest does not run memory(): names of tests start with "
            "test",
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        directory, _, name = module.path.rpartition("/")
        if directory not in {"test", "tests"} or not name.startswith("test_"):
            return
        yield from self._check_returns(module)
        for method in _uncollected_methods(module):
            message = f"unittest does not run {method.name}(): names of tests start with test"
            yield self.report(module.name_location(method), message)
        for class_ in _skipped_classes(module):
            message = (
                f"pytest does not collect {class_.name}, because it has a constructor; use "
                f"a fixture or setup_method()"
            )
            yield self.report(module.name_location(class_), message)
        if not _has_tests(module) and _asserts(module):
            message = "pytest collects no test here: names must start with test or Test"
            yield self.report(Location.start_of(module.path), message)

    def _check_returns(self, module: PythonModule) -> Iterator[Diagnostic]:
        for function in module.functions.values():
            if not function.name.startswith("test") or function.node.decorator_list:
                continue
            inner = list(ast.walk(function.node))
            if any(isinstance(node, ast.Assert | ast.Raise | ast.With) for node in inner):
                continue
            for node in inner:
                if isinstance(node, ast.Return) and isinstance(node.value, ast.Compare):
                    message = "the return value of a test is ignored: use assert"
                    yield self.report(module.location(node), message)


def _methods(class_: ast.ClassDef) -> set[str]:
    return {node.name for node in class_.body if isinstance(node, ast.FunctionDef)}


def _uncollected_methods(module: PythonModule) -> Iterator[ast.FunctionDef]:
    """Yield methods with assertions in test cases that have no test."""
    for class_ in module.classes.values():
        bases = {module.qualified_name(base) for base in class_.node.bases}
        methods = [node for node in class_.node.body if isinstance(node, ast.FunctionDef)]
        names = {node.name for node in methods}
        uses = [use for use in module.index.names(class_.name) if isinstance(use.ctx, ast.Load)]
        if bases != {"unittest.TestCase"} or uses or class_.node.decorator_list:
            continue
        if any(name.startswith("test") or name == "runTest" for name in names):
            continue
        for method in methods:
            is_own = method.name[:1] != "_" and not module.index.attributes(method.name)
            if is_own and method.name not in _FIXTURES and _asserts_in(module, method):
                yield method


def _asserts_in(module: PythonModule, method: ast.FunctionDef) -> bool:
    called = (call.func for call in module.below(method, ast.Call))
    names = [func.attr for func in called if isinstance(func, ast.Attribute)]
    return any(module.below(method, ast.Assert)) or any(name.startswith("assert") for name in names)


def _skipped_classes(module: PythonModule) -> list[ast.ClassDef]:
    """Return the test classes that pytest skips because of their constructor."""
    return [
        class_.node
        for class_ in module.classes.values()
        if class_.name.startswith("Test")
        and not any(_may_be_collected(module, base) for base in class_.node.bases)
        and "__init__" in _methods(class_.node)
        and any(name.startswith("test") for name in _methods(class_.node))
    ]


def _may_be_collected(module: PythonModule, base: ast.expr) -> bool:
    return module.qualified_name(base) not in {"object", "rclpy.node.Node"}


def _has_tests(module: PythonModule) -> bool:
    names = {*module.functions, *module.index.bindings(module.tree)}
    if any(name.startswith(("test", *_LAUNCH)) for name in names):
        return True
    refused = _skipped_classes(module)
    return any(
        class_.node not in refused
        and (class_.name.startswith("Test") or class_.node.bases or class_.node.decorator_list)
        for class_ in module.classes.values()
    ) or bool(refused)


def _asserts(module: PythonModule) -> bool:
    return bool(module.walk(ast.Assert)) and not module.has_main_guard
