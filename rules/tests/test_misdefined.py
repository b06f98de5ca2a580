"""TS042: pytest can run the tests."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, ViewError
from scaffold.api.python import FunctionNode, PythonModule
from scaffold.api.tests import files_of_tests

_TEST = (
    "import pytest\n\n\n"
    "class TestText:\n"
    "    @pytest.mark.parametrize('word, {}', [('a', 1)])\n"
    "    def test_text({}word, count):\n"
    "        assert len(word) == count\n"
)


class TestMisdefined(Rule):
    """A test is defined in a way that pytest cannot run.

    **Why.** pytest ends with an error: a method without ``self`` ("takes 0 positional arguments but
    1 was given"), a name in ``parametrize`` that the test does not accept ("function uses no
    argument"), a section ``[pytest]`` in setup.cfg ("no longer supported").

    **Fix.** Add ``self``; use the same names in both places; call the section ``[tool:pytest]``.

    **Source.** pytest documentation, "How to parametrize fixtures and test functions",
    "Configuration".
    """

    code = "TS042"
    name = "test-misdefined"
    examples = (
        Example("valid tests", {"test/test_text.py": _TEST.format("count", "self, ")}),
        Example(
            "another name; no self",
            {
                "test/test_text.py": _TEST.format("number", "self, ")
                + "\n    def test_all():\n        assert True\n"
            },
            "5:30: test_text takes no argument 'number': pytest stops here",
            "9:9: test_all is a method without self: TypeError",
        ),
        Example(
            "a name that a fixture uses",
            {
                "test/test_text.py": _TEST.format("number", "self, ")
                + "\n\n@pytest.fixture\ndef count(number):\n    return number\n"
            },
        ),
        Example(
            "the section in setup.cfg",
            {"setup.py": "", "setup.cfg": "[pytest]\nxfail_strict = true\n"},
            "setup.cfg:1:2: pytest rejects the section [pytest] in setup.cfg; write [tool:pytest]",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        modules = [*package.modules(files_of_tests(package))]
        taken = {name for module in modules for name in _all_parameters(module)}
        for module in modules:
            functions: list[FunctionNode] = [*module.walk(ast.FunctionDef)]
            functions += module.walk(ast.AsyncFunctionDef)
            for function in functions:
                if not function.name.startswith("test"):
                    continue
                if _lacks_self(module, function):
                    message = f"{function.name} is a method without self: TypeError"
                    yield self.report(module.name_location(function), message)
                for node, name in _parametrized_names(module, function):
                    if name not in taken:
                        message = f"{function.name} takes no argument {name!r}: pytest stops here"
                        yield self.report(module.location(node), message)
        yield from self._check_section(package)

    def _check_section(self, package: Package) -> Iterator[Diagnostic]:
        if package.has("pytest.ini") or not package.has("setup.cfg"):
            return
        try:
            sections = package.setup_cfg.sections.values()
        except ViewError:
            return
        for section in sections:
            if section.name == "pytest":
                message = "pytest rejects the section [pytest] in setup.cfg; write [tool:pytest]"
                yield self.report(section.name_location, message)


def _all_parameters(module: PythonModule) -> Iterator[str]:
    """Yield the names of all parameters in a file: fixtures may request others than tests."""
    for arguments in module.walk(ast.arguments):
        for posonlyarg in [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs]:
            yield posonlyarg.arg


def _lacks_self(module: PythonModule, function: FunctionNode) -> bool:
    class_, given = module.parent(function), function.args
    is_method = isinstance(class_, ast.ClassDef) and class_.name.startswith("Test")
    return is_method and not (
        function.decorator_list or given.args or given.posonlyargs or given.vararg
    )


def _parametrized_names(
    module: PythonModule, function: FunctionNode
) -> Iterator[tuple[ast.expr, str]]:
    """Yield the parameter names from ``parametrize``, with their places."""
    for decorator in function.decorator_list:
        if not isinstance(decorator, ast.Call) or not decorator.args:
            continue
        name = module.qualified_name(decorator.func)
        first = decorator.args[0]
        if name == "pytest.mark.parametrize" and isinstance(first, ast.Constant):
            for part in str(first.value).split(","):
                if part.strip():
                    yield first, part.strip()
