"""TS042: pytest can run the tests."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping, Sequence

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity, ViewError
from scaffold.api.python import FunctionNode, PythonModule
from scaffold.api.setup_py import lacks_pytest
from scaffold.api.tests import (
    Setting,
    files_collected,
    files_of_tests,
    module_name,
    pytest_settings,
    settings_or_tests_mention,
)

_TEST = (
    "import pytest\n\n\n"
    "class TestText:\n"
    "    @pytest.mark.parametrize('word, {}', [('a', 1)])\n"
    "    def test_text({}word, count):\n"
    "        assert len(word) == count\n"
)
_TALK = "def test_talk():\n    assert len('hello') == 5\n"
_PACKAGE = {
    "package.xml": "<package><name>talker</name></package>\n",
    "setup.py": "from setuptools import setup\n\n"
    "setup(name='talker', extras_require={'test': ['pytest']})\n",
}


class TestMisdefined(Rule):
    """A test is defined in a way that pytest cannot run.

    **Why.** pytest ends with an error: a method without ``self`` ("takes 0 positional arguments but
    1 was given"), a name in ``parametrize`` that the test does not accept ("function uses no
    argument"), two files with the same name ("import file mismatch"), an option of a plugin that is
    not installed ("unrecognized arguments"), a section ``[pytest]`` in setup.cfg ("no longer
    supported"). With ``testpaths`` of a directory without tests, it runs none.

    **Fix.** Add ``self``; use the same names in both places; call the section ``[tool:pytest]``;
    declare the plugin; rename the file.

    **Source.** pytest documentation, "How to parametrize fixtures and test functions",
    "Configuration".
    """

    code = "TS042"
    name = "test-misdefined"
    other_severities = {
        Severity.WARNING: "the option is from pytest-cov, which apt installs with colcon"
    }
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
        Example(
            "tests of the same name in Python packages, and a declared plugin",
            {
                **_PACKAGE,
                "setup.cfg": "[tool:pytest]\ntestpaths = test\naddopts = --timeout 9\n",
                "package.xml": "<package><name>talker</name>"
                "<test_depend>python3-pytest-timeout</test_depend></package>\n",
                **{f"test/{name}/__init__.py": "" for name in ("unit", "system")},
                **{f"test/{name}/test_talk.py": _TALK for name in ("unit", "system")},
            },
        ),
        Example(
            "pytest.ini comes first, and pytest searches everywhere if no path exists",
            {
                **_PACKAGE,
                "pytest.ini": "[pytest]\ntestpaths = src\n",
                "setup.cfg": "[tool:pytest]\naddopts = -n 2\n",
                "test/test_talk.py": _TALK,
            },
        ),
        Example(
            "an undeclared plugin, and two files of one name",
            {
                **_PACKAGE,
                "pyproject.toml": "[tool.pytest.ini_options]\naddopts = ['-n', '2', '--cov=a']\n",
                **{f"test/{name}/test_talk.py": _TALK for name in ("unit", "system")},
            },
            Report(
                "pyproject.toml:2:1",
                "--cov=a is an option of pytest-cov, which package.xml does not "
                "declare: pytest stops without it; add "
                "<test_depend>python3-pytest-cov</test_depend>",
                severity=Severity.WARNING,
            ),
            "pyproject.toml:2:1: -n is an option of pytest-xdist, which package.xml does not "
            "declare: pytest stops without it; add "
            "<test_depend>python3-pytest-xdist</test_depend>",
            "test/unit/test_talk.py:1:1: pytest imports test/system/test_talk.py under the same "
            "name, and stops: import file mismatch; rename one, or add an __init__.py to both "
            "directories",
        ),
        Example(
            "settings that match no tests",
            {
                **_PACKAGE,
                "tox.ini": "[pytest]\ntestpaths = tests\n",
                "tests/words.txt": "",
                "test/test_talk.py": _TALK,
            },
            "tox.ini:2:13: no test file matches testpaths: pytest does not collect "
            "test/test_talk.py",
        ),
        Example(
            "settings that exclude the directory of the tests",
            {
                "setup.py": "",
                "pytest.ini": "[pytest]\nnorecursedirs = test\n",
                "test/test_talker.py": "def test_talker():\n    pass\n",
            },
            "pytest.ini:2:17: norecursedirs excludes all tests: pytest does not collect "
            "test/test_talker.py",
        ),
        Example(
            "a pattern that matches no tests",
            {
                **_PACKAGE,
                "setup.cfg": "[tool:pytest]\npython_files = check_*.py\n",
                "test/test_talk.py": _TALK,
            },
            "setup.cfg:2:16: no test file matches python_files: pytest does not collect "
            "test/test_talk.py",
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
        is_run = package.build_type == "ament_python" and package.has("setup.py")
        if is_run and not lacks_pytest(package):
            yield from self._check_settings(package, pytest_settings(package))

    def _check_settings(
        self, package: Package, settings: Mapping[str, Setting]
    ) -> Iterator[Diagnostic]:
        """Check what colcon runs in the directory of the package, without arguments."""
        options = settings["addopts"].words if "addopts" in settings else ()
        plugins = {_PLUGINS.get(option.partition("=")[0], ""): option for option in options[::-1]}
        for plugin, option in plugins.items():
            if plugin and not _is_declared(package, plugin):
                message = (
                    f"{option} is an option of {plugin}, which package.xml does not declare: "
                    f"pytest stops without it; add <test_depend>python3-{plugin}</test_depend>"
                )
                # A recommendation of the Debian package of colcon.
                severity = Severity.WARNING if plugin == "pytest-cov" else None
                yield self.report(settings["addopts"].location, message, severity=severity)
        files, usual = files_collected(package, settings), files_collected(package, {})
        if not files and usual:
            names = ("norecursedirs", "python_files", "testpaths")
            name = next(name for name in names if name in settings)
            setting = settings[name]
            of_file = f" of {setting.file}" if setting.file else ""
            problem = f"no test file matches {name}{of_file}"
            if name == "norecursedirs":
                problem = f"{name}{of_file} excludes all tests"
            message = f"{problem}: pytest does not collect {usual[0]}"
            yield self.report(setting.location, message)
        is_other = any("import" in option or "ignore" in option for option in options)
        if not is_other and "norecursedirs" not in settings:
            yield from self._check_names(package, files)

    def _check_names(self, package: Package, files: Sequence[str]) -> Iterator[Diagnostic]:
        seen: dict[str, str] = {}
        for path in files:
            first = seen.setdefault(module_name(package, path), path)
            if first != path and not settings_or_tests_mention(package, ("collect_ignore",)):
                message = (
                    f"pytest imports {first} under the same name, and stops: import file mismatch; "
                    f"rename one, or add an __init__.py to both directories"
                )
                yield self.report(package.start_of(path), message)

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


_PLUGINS = {
    "--asyncio-mode": "pytest-asyncio",
    "--benchmark-only": "pytest-benchmark",
    "--benchmark-skip": "pytest-benchmark",
    "--cov": "pytest-cov",
    "--cov-report": "pytest-cov",
    "--dist": "pytest-xdist",
    "-n": "pytest-xdist",
    "-nauto": "pytest-xdist",
    "--numprocesses": "pytest-xdist",
    "--timeout": "pytest-timeout",
}
"""The options of plugins, by the name of the plugin on PyPI."""


def _is_declared(package: Package, plugin: str) -> bool:
    """Return whether a file of the package declares a plugin of pytest."""
    names = ("package.xml", "setup.py", "setup.cfg", "pyproject.toml", *package.glob("*.txt"))
    texts = [package.source(name).text for name in names if package.has(name)]
    return any(re.search(plugin.replace("-", "[-_]"), text) for text in texts)


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
