"""TS044: fixtures exist, provide one value, and are not called."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.api.python import PythonModule
from scaffold.api.tests import (
    LAUNCH,
    Fixture,
    TestFunction,
    arguments,
    files_of_tests,
    fixtures,
    may_be_imported,
    own_fixtures,
    test_functions,
    test_modules,
)

_CONFTEST = "import pytest\n\n\n@pytest.fixture\ndef {}():\n    return 1\n"
_BUILT_IN = frozenset(
    {"cache", "capsys", "capsysbinary", "capfd", "capfdbinary", "caplog", "doctest_namespace"}
    | {"monkeypatch", "pytestconfig", "pytester", "record_property", "record_testsuite_property"}
    | {"recwarn", "request", "testdir", "tmp_path", "tmp_path_factory", "tmpdir", "tmpdir_factory"}
)
_OF_PLUGINS = frozenset(
    {"benchmark", "client", "event_loop", "faker", "freezer", "launch_context", "launch_service"}
    | {
        "mocker",
        "proc_info",
        "proc_output",
        "qapp",
        "qtbot",
        "requests_mock",
        "snapshot",
        "subtests",
    }
)
"""Fixtures of widespread plugins."""
_TEST = (
    "import pytest\n\n\n@pytest.fixture\ndef text():\n    {}\n\n\n"
    "def test_text({}):\n    assert {} == 'a'\n"
)
_SCOPES = ("function", "class", "module", "package", "session")
"""The scopes, from the narrowest to the widest."""
_TEST_MADE = (
    "import pytest\n\n\n@pytest.fixture\ndef word():\n    return 'a'\n\n\n"
    "@pytest.fixture(scope='{}')\ndef text(word):\n    yield word\n{}\n\n"
    "def test_text(text):\n    assert text == 'a'\n"
)


class FixtureMisused(Rule):
    """A fixture is called, misspelled, returns nothing, yields twice, or has a wrong scope.

    **Why.** The test ends in an error: ``Fixture "text" called directly``, ``fixture 'txt' not
    found``, ``'NoneType' object has no attribute ...``, ``ScopeMismatch``, ``fixture function has
    more than one 'yield'``.

    **Fix.** Add an argument with the name of the fixture to the test; ``return`` or ``yield`` the
    value once; use a scope that is not wider than those of the requested fixtures.

    **Source.** pytest documentation, "How to use fixtures".
    """

    code = "TS044"
    name = "fixture-misused"
    examples = (
        Example(
            "a name that no fixture has, and a fixture that no test asks for; one of a plugin",
            {
                "test/test_a.py": _TEST.format("return 'a'", "word", "word"),
                "test/test_b.py": _TEST.format("return 'a'", "mocker", "mocker"),
                "test/test_c.py": _TEST.format("return 'a'", "", "'a'")
                + "\n\nclass TestText:\n    def test_self(self):\n        assert self\n",
            },
            "test/test_a.py:9:5: there is no fixture 'word'; no test uses 'text'",
        ),
        Example(
            "imported from a package outside of the workspace",
            {
                "test/test_text.py": "from arm_testing.fixtures import arm as arm, gripper\n"
                + _TEST.format("return 'a'", "arm, gripper", "gripper")
            },
        ),
        Example("used", {"test/test_text.py": _TEST.format("return 'a'", "text", "text")}),
        Example(
            "called",
            {"test/test_text.py": _TEST.format("return 'a'", "", "text()")},
            "10:12: text is a fixture, which cannot be called: the test fails; request it as an "
            "argument",
        ),
        Example(
            "another name",
            {"test/test_text.py": _TEST.format("return 'a'", "txt", "txt")},
            "9:5: unknown fixture 'txt': the test fails; did you mean 'text'?",
        ),
        Example(
            "used without being requested",
            {"test/test_text.py": _TEST.format("return 'a'", "", "text")},
            "10:12: text is the fixture function here, not its value; request it as an argument "
            "of the test",
        ),
        Example(
            "a function without the decorator",
            {
                "test/test_text.py": _TEST.format("return 'a'", "text", "text").replace(
                    "@pytest.fixture\n", ""
                )
            },
            "8:5: text() is not a fixture: the test fails; add @pytest.fixture",
        ),
        Example(
            "the name of the variable that a fixture yields",
            {
                "test/test_text.py": _TEST.format("text_a = 'a'\n    yield text_a", "text", "text")
                .replace("def text()", "def words()")
                .replace(
                    "test_text(text)",
                    "test_words(words):\n    assert words == 'a'\n\n\ndef test_text(text_a)",
                )
            },
            "14:5: there is no fixture 'text_a': the test fails; 'words' provides it",
        ),
        Example(
            "nothing returned",
            {"test/test_text.py": _TEST.format("print('a')", "text", "text.lower()")},
            "10:12: the fixture text returns nothing, so this is None",
        ),
        Example(
            "self outside of a class",
            {"test/test_text.py": _TEST.format("return 'a'", "self", "'a'")},
            "9:5: test_text is not a method: pytest finds no fixture 'self'",
        ),
        Example("a fixture for one test", {"test/test_text.py": _TEST_MADE.format("function", "")}),
        Example(
            "a scope that does not exist",
            {"test/test_text.py": _TEST_MADE.format("modul", "")},
            "9:2: unknown scope 'modul'; choose from function, class, module, package, session",
        ),
        Example(
            "a wider scope than that of a requested fixture",
            {"test/test_text.py": _TEST_MADE.format("module", "")},
            "9:2: a fixture of scope 'module' cannot use word of scope 'function'",
        ),
        Example(
            "two values",
            {"test/test_text.py": _TEST_MADE.format("function", "    yield 'b'\n")},
            "9:2: the fixture text yields twice: pytest reports an error; yield once",
        ),
        Example(
            "a fixture with an explicit name",
            {
                "test/conftest.py": "import pytest\n\n\n@pytest.fixture(name='motor')\n"
                "def make_motor():\n    return 'motor'\n",
                "test/test_motor.py": "def test_name(motor):\n    assert motor == 'motor'\n\n\n"
                "def test_length(make_motor):\n    assert len(make_motor) == 5\n",
            },
            "test/test_motor.py:5:5: unknown fixture 'make_motor': 'make_motor'() is the fixture "
            "'motor'",
        ),
        Example(
            "a fixture of a conftest.py above, and of one elsewhere",
            {
                "test/conftest.py": _CONFTEST.format("near"),
                "test/fixtures/conftest.py": _CONFTEST.format("away"),
                "test/unit/test_a.py": "def test_a(near, away):\n    assert near == away\n",
            },
            "test/unit/test_a.py:1:5: unknown fixture 'away': that of test/fixtures/conftest.py is "
            "only for tests below test/fixtures/",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_use(package)
        yield from self._check_made(package)

    def _check_use(self, package: Package) -> Iterator[Diagnostic]:
        for module in package.modules(files_of_tests(package)):
            if "pytest" not in module.imports_by_root:
                continue
            for call in module.walk(ast.Call):
                name = _called_fixture(module, call)
                if name:
                    message = (
                        f"{name} is a fixture, which cannot be called: the test fails; "
                        f"request it as an argument"
                    )
                    yield self.report(module.location(call), message)
            for use in _taken_from_module(module):
                message = (
                    f"{use.id} is the fixture function here, not its value; request it as an "
                    f"argument of the test"
                )
                yield self.report(module.location(use), message)
        for module in test_modules(package):
            if LAUNCH not in module.functions:
                yield from self._check_tests(package, module)

    def _check_tests(self, package: Package, module: PythonModule) -> Iterator[Diagnostic]:
        available = fixtures(package, module)
        for test in test_functions(module):
            if test.class_ is not None and test.class_.bases:
                continue
            for name in arguments(test.node):
                fixture = available.get(name)
                if fixture is not None and _gives_nothing(fixture):
                    for node in ast.walk(test.node):
                        if isinstance(node, ast.Attribute) and _is_name(node.value, name):
                            message = f"the fixture {name} returns nothing, so this is None"
                            yield self.report(module.location(node), message)
                            break
                elif (
                    fixture is None
                    and not test.node.decorator_list
                    and not may_be_imported(package, module, name)
                ):
                    message = _missing(module, test, name, available)
                    message = message or _out_of_reach(package, name)
                    if message:
                        yield self.report(module.name_location(test.node), message)

    def _check_made(self, package: Package) -> Iterator[Diagnostic]:
        for module in package.modules(files_of_tests(package)):
            if "pytest" not in module.imports_by_root:
                continue
            available = fixtures(package, module)
            for fixture in own_fixtures(module):
                problem = _problem(fixture, available)
                if problem and fixture.node.decorator_list:
                    yield self.report(module.location(fixture.node.decorator_list[0]), problem)


def _missing(
    module: PythonModule, test: TestFunction, name: str, available: Mapping[str, Fixture]
) -> str:
    """Return the problem with an argument without a known fixture; empty if unclear."""
    if name == "self" and test.class_ is None:
        return f"{test.node.name} is not a method: pytest finds no fixture 'self'"
    if name in _BUILT_IN or name in {"self", "cls"}:
        return ""
    renamed = [it.name for it in available.values() if it.node.name == name]
    if renamed:
        return f"unknown fixture {name!r}: {name!r}() is the fixture {renamed[0]!r}"
    if name in module.functions:
        return f"{name}() is not a fixture: the test fails; add @pytest.fixture"
    closest = get_close_matches(name, available, 1, 0.75)
    if closest:
        return f"unknown fixture {name!r}: the test fails; did you mean {closest[0]!r}?"
    return "" if name in _OF_PLUGINS else _undefined(module, name)


def _out_of_reach(package: Package, name: str) -> str:
    """Return the problem with a fixture that only another directory of tests has."""
    if name in _BUILT_IN or name in _OF_PLUGINS:
        return ""
    for other in package.modules(files_of_tests(package)):
        is_shared = other.path.endswith("/conftest.py")
        if is_shared and any(fixture.name == name for fixture in own_fixtures(other)):
            directory = other.path.rpartition("/")[0]
            where = f"that of {other.path} is only for tests below {directory}/"
            return f"unknown fixture {name!r}: {where}"
    return ""


def _undefined(module: PythonModule, name: str) -> str:
    """Return the problem with a fixture whose name no plugin has; empty if it may exist."""
    makers = [it.name for it in own_fixtures(module) if name in _given(it)]
    if makers:
        return f"there is no fixture {name!r}: the test fails; {makers[0]!r} provides it"
    unused = _unused(module)
    return f"there is no fixture {name!r}; no test uses {unused[0]!r}" if unused else ""


def _given(fixture: Fixture) -> set[str]:
    """Return the variables that a fixture returns or yields."""
    given = [
        node.value for node in ast.walk(fixture.node) if isinstance(node, ast.Return | ast.Yield)
    ]
    return {node.id for node in given if isinstance(node, ast.Name)}


def _unused(module: PythonModule) -> list[str]:
    """Return the fixtures of a file that nothing asks for."""
    if module.mentions("pytest_generate_tests", "pytestmark", "pytest_plugins", "usefixtures"):
        return []
    asked = {argument.arg for argument in module.walk(ast.arg)}
    return [
        fixture.name
        for fixture in own_fixtures(module)
        if fixture.name not in asked and "autouse" not in module.text(fixture.node)
    ]


def _is_name(node: ast.expr, name: str) -> bool:
    return isinstance(node, ast.Name) and node.id == name


def _called_fixture(module: PythonModule, call: ast.Call) -> str:
    """Return the name of the called fixture of the same file."""
    if not isinstance(call.func, ast.Name):
        return ""
    lookup = module.index.lookup(call.func.id, call)
    nodes = [binding.node for binding in lookup[1]] if lookup else []
    own = {fixture.node for fixture in own_fixtures(module)} if len(nodes) == 1 else set()
    return call.func.id if nodes and nodes[0] in own else ""


def _taken_from_module(module: PythonModule) -> Iterator[ast.Name]:
    """Yield the uses of a fixture of the file without requesting it, each name once."""
    own = {fixture.name: fixture.node for fixture in own_fixtures(module)}
    for test in test_functions(module):
        seen = set(arguments(test.node))
        for use in module.below(test.node, ast.Name):
            lookup = module.index.lookup(use.id, use) if use.id in own.keys() - seen else None
            if lookup is None or [x.node for x in lookup[1]] != [own[use.id]]:
                continue
            if not module.call_with(use):
                seen.add(use.id)
                yield use


def _gives_nothing(fixture: Fixture) -> bool:
    gives = (ast.Return, ast.Yield, ast.YieldFrom)
    return not any(isinstance(node, gives) and node.value for node in ast.walk(fixture.node))


def _problem(fixture: Fixture, available: Mapping[str, Fixture]) -> str:
    """Return the problem with the scope of a fixture or with its yields."""
    if not fixture.scope:
        return ""
    if fixture.scope not in _SCOPES:
        return f"unknown scope {fixture.scope!r}; choose from {', '.join(_SCOPES)}"
    if sum(map(_yields, fixture.node.body)) > 1:
        return f"the fixture {fixture.name} yields twice: pytest reports an error; yield once"
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
