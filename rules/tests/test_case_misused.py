"""TS045: methods of a TestCase have the names and arguments that unittest expects."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, TestRule
from scaffold.api.python import FunctionNode, PythonModule
from scaffold.api.tests import LAUNCH, arguments, is_test_case, marks, methods

_SET_UP = ("setUp", "tearDown", "setUpClass", "tearDownClass")
_PLAIN = {"setUp": "setup_method", "tearDown": "teardown_method"}
_TEST = (
    "import unittest\n\n\nclass TestText({}):\n"
    "    def {}(self):\n        self.text = 'a'\n\n"
    "    def test_text(self{}):\n        assert self.text\n"
)
_CASE = "unittest.TestCase"


class TestCaseMisused(TestRule):
    """A TestCase has a method that unittest never calls, or calls with other arguments.

    **Why.** ``set_up`` is never called, nor is ``setUp`` in a class that is not a TestCase:
    AttributeError in the tests. unittest passes no arguments to tests, so neither fixtures nor
    ``parametrize`` work: TypeError.

    **Fix.** Use ``setUp`` and ``tearDown``; ``@classmethod`` for ``setUpClass``; a plain class or
    function for fixtures.

    **Source.** Python documentation, ``unittest``; pytest documentation, "How to use unittest-based
    tests with pytest".
    """

    code = "TS045"
    name = "test-case-misused"
    examples = (
        Example(
            "constructor of a TestCase",
            {
                "test/test_a.py": "import unittest\n\n\nclass TestA(unittest.TestCase):\n"
                "    def __init__(self):\n        self.value = 1\n\n"
                "    def test_value(self):\n        self.assertEqual(self.value, 1)\n"
            },
            "5:9: unittest passes the name of a test to __init__; use setUp instead",
        ),
        Example("valid methods", {"test/test_text.py": _TEST.format(_CASE, "setUp", "")}),
        Example(
            "setUpClass as a function without arguments",
            {
                "test/test_text.py": _TEST.format(_CASE, "setUpClass", "")
                .replace("setUpClass(self", "setUpClass(")
                .replace("self.text = 'a'", "TestText.text = 'a'")
            },
        ),
        Example(
            "constructed in the file",
            {
                "test/test_text.py": _TEST.format(_CASE, "__init__", "")
                + "\n\nTestText().test_text()\n"
            },
        ),
        Example(
            "set_up, a fixture",
            {"test/test_text.py": _TEST.format(_CASE, "set_up", ", tmp_path")},
            "5:9: unittest never calls set_up; use setUp",
            "8:9: unittest passes no arguments to test_text, but it takes 'tmp_path': TypeError",
        ),
        Example(
            "setUp without TestCase",
            {"test/test_text.py": _TEST.format("object", "setUp", "")},
            "5:9: pytest only calls setUp in a TestCase; use setup_method",
        ),
        Example(
            "an argument of setUp, an instance method setUpClass, parametrize",
            {
                "test/test_a.py": _TEST.format(_CASE, "setUp", "").replace(
                    "setUp(self", "setUp(self, text"
                ),
                "test/test_b.py": _TEST.format(_CASE, "setUpClass", ""),
                "test/test_c.py": _TEST.format(_CASE, "setUp", "")
                .replace("    def test_", "    @pytest.mark.parametrize('a', [1])\n    def test_")
                .replace("import ", "import pytest\nimport "),
            },
            "test/test_a.py:5:9: unittest only passes self to setUp, but it takes 2 arguments: "
            "TypeError",
            "test/test_b.py:5:9: unittest calls setUpClass on the class: TypeError; add "
            "@classmethod",
            "test/test_c.py:10:9: parametrize has no effect in a TestCase: test_text fails with "
            "TypeError",
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        for class_ in module.classes.values():
            is_case = is_test_case(module, class_.node)
            is_plain = class_.name.startswith("Test") and _has_no_base(class_.node)
            for method in methods(class_.node) if is_case or is_plain else ():
                problem = _case_problem(module, method) if is_case else _plain(method)
                is_called = (
                    _is_made(module, class_.name)
                    if method.name == "__init__"
                    else module.index.attributes(method.name)
                )
                if problem and not is_called:
                    yield self.report(module.name_location(method), problem)


def _is_made(module: PythonModule, name: str) -> bool:
    """Return whether the file creates an instance of a class or of a derived one."""
    heirs = {name}
    for class_ in module.classes.values():
        if any(isinstance(base, ast.Name) and base.id in heirs for base in class_.node.bases):
            heirs.add(class_.name)
    return any(
        isinstance(call.func, ast.Name) and call.func.id in heirs for call in module.walk(ast.Call)
    )


def _has_no_base(class_: ast.ClassDef) -> bool:
    return all(isinstance(base, ast.Name) and base.id == "object" for base in class_.bases)


def _plain(method: FunctionNode) -> str:
    name = _PLAIN.get(method.name)
    return f"pytest only calls {method.name} in a TestCase; use {name}" if name else ""


def _case_problem(module: PythonModule, method: FunctionNode) -> str:
    """Return the problem with a method of a TestCase."""
    name, given = method.name, arguments(method)
    decorated = {module.qualified_name(item) for item in method.decorator_list}
    static, launched = "staticmethod" in decorated, LAUNCH in module.functions
    problem = ""
    for right in _SET_UP:
        if name != right and name.replace("_", "").lower() == right.lower():
            return f"unittest never calls {name}; use {right}"
    if name in {"setUpClass", "tearDownClass"} and given and not decorated:
        problem = f"unittest calls {name} on the class: TypeError; add @classmethod"
    elif name in {"setUp", "tearDown"} and not decorated and len(given) != 1 and not launched:
        problem = (
            f"unittest only passes self to {name}, but it takes {len(given)} arguments: TypeError"
        )
    elif name == "__init__" and len(method.args.args) == 1 and not method.args.vararg:
        problem = "unittest passes the name of a test to __init__; use setUp instead"
    elif name.startswith("test") and not launched and not static:
        if any(mark == "parametrize" for mark, _ in marks(module, method)):
            problem = f"parametrize has no effect in a TestCase: {name} fails with TypeError"
        elif len(given) > 1 and not decorated:
            problem = (
                f"unittest passes no arguments to {name}, but it takes {given[1]!r}: TypeError"
            )
    return problem
