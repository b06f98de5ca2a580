"""The tests of a package: functions that pytest and unittest call, and their fixtures."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

from scaffold.model.contents.python_facts import paths_importing
from scaffold.model.python.module import is_collected, is_in_tests
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.python.module import PythonModule
    from scaffold.model.python.scopes import FunctionNode

LAUNCH = "generate_test_description"
"""The function of files for launch_testing, which runs tests in its own way."""


class Fixture(NamedTuple):
    """A function that pytest calls for a parameter of a test."""

    name: str
    node: FunctionNode
    module: PythonModule
    scope: str
    """The scope, by default ``function``; empty if it is computed."""


class TestFunction(NamedTuple):
    """A function collected as a test."""

    node: FunctionNode
    class_: ast.ClassDef | None


def files_of_tests(package: Package) -> list[str]:
    """Return the Python files of tests, including helpers."""
    return [path for path in package.python_files if is_in_tests(path)]


def test_modules(package: Package) -> list[PythonModule]:
    """Return the files of tests that pytest collects."""
    return list(package.modules(test_paths(package)))


def test_paths(package: Package) -> list[str]:
    """Return their paths, whether they can be parsed or not."""
    return [path for path in files_of_tests(package) if is_collected(path.rpartition("/")[2])]


def is_test_case(module: PythonModule, class_: ast.ClassDef) -> bool:
    """Return whether a class is a TestCase of unittest."""
    names = [name for base in class_.bases for name in module.qualified_names(base)]
    return any(name.startswith("unittest.") and name.endswith("TestCase") for name in names)


def test_functions(module: PythonModule) -> Iterator[TestFunction]:
    """Yield the collected functions and methods."""
    for function in module.functions.values():
        if function.name.startswith("test") and not fixture_decorator(module, function.node):
            yield TestFunction(function.node, None)
    for class_ in module.classes.values():
        plain = class_.name.startswith("Test") and not class_.node.bases
        if plain or is_test_case(module, class_.node):
            for node in methods(class_.node):
                if node.name.startswith("test"):
                    yield TestFunction(node, class_.node)


def methods(class_: ast.ClassDef) -> list[FunctionNode]:
    """Return the methods that a class defines itself."""
    return [
        node for node in class_.body if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
    ]


def arguments(function: FunctionNode) -> list[str]:
    """Return the names of the arguments without a default."""
    given = [*function.args.posonlyargs, *function.args.args]
    without = given[: len(given) - len(function.args.defaults)]
    return [item.arg for item in [*without, *function.args.kwonlyargs]]


def fixture_decorator(module: PythonModule, function: FunctionNode) -> ast.expr | None:
    """Return the fixture decorator of a function."""
    for decorator in function.decorator_list:
        node = decorator.func if isinstance(decorator, ast.Call) else decorator
        if module.qualified_name(node) == "pytest.fixture":
            return decorator
    return None


def fixtures(package: Package, module: PythonModule) -> Mapping[str, Fixture]:
    """Return the fixtures of a test file and of its conftest.py files, by name."""
    result: dict[str, Fixture] = {}
    for other in _with_conftests(package, module):
        for fixture in own_fixtures(other):
            if other is module or fixture.name not in result:
                result[fixture.name] = fixture
    return result


def may_be_imported(package: Package, module: PythonModule, name: str) -> bool:
    """Return whether a test file or one of its conftest.py files may import a fixture."""
    return any(
        taken.name == "*" or (taken.asname or taken.name) == name
        for other in _with_conftests(package, module)
        for item in other.imports
        for taken in item.names
    )


def _with_conftests(package: Package, module: PythonModule) -> Iterator[PythonModule]:
    directory = module.path.rpartition("/")[0]
    return package.modules(
        path for path in package.python_files if path == module.path or _is_near(path, directory)
    )


def _is_near(path: str, directory: str) -> bool:
    """Return whether a file is a conftest.py for the tests in a directory."""
    place, _, name = path.rpartition("/")
    return name == "conftest.py" and f"{directory}/".startswith(f"{place}/" if place else "")


def own_fixtures(module: PythonModule) -> Iterator[Fixture]:
    """Yield the fixtures that a file defines at module level or in classes."""
    for function in module.function_nodes:
        decorator = fixture_decorator(module, function)
        if decorator is not None:
            words = keywords(decorator)
            name, scope = words.get("name"), words.get("scope")
            fixture = name.value if isinstance(name, ast.Constant) else function.name
            given = scope.value if isinstance(scope, ast.Constant) else ""
            yield Fixture(str(fixture), function, module, str(given) if scope else "function")


def keywords(decorator: ast.expr) -> dict[str, ast.expr]:
    """Return the arguments by name of a decorator."""
    given: Sequence[ast.keyword] = decorator.keywords if isinstance(decorator, ast.Call) else ()
    return {word.arg: word.value for word in given if word.arg}


def marks(
    module: PythonModule, function: FunctionNode | ast.ClassDef
) -> Iterator[tuple[str, ast.expr]]:
    """Yield name and decorator of the marks, ``skip`` for ``@pytest.mark.skip``."""
    for decorator in function.decorator_list:
        node = decorator.func if isinstance(decorator, ast.Call) else decorator
        name = module.qualified_name(node) or ""
        if name.startswith("pytest.mark."):
            yield name.removeprefix("pytest.mark."), decorator


def settings_or_tests_mention(package: Package, words: Sequence[str]) -> bool:
    """Return whether the settings of pytest, or a test, contain one of some words."""
    names = ("pytest.ini", "setup.cfg", "pyproject.toml", "tox.ini")
    texts = [package.source(name).text for name in names if package.has(name)]
    if any(word in text for text in texts for word in words):
        return True
    return any(
        word.encode() in data for data in _data(package, files_of_tests(package)) for word in words
    )


def may_start(package: Package, name: str) -> bool:
    """Return whether another file of the package may start a test with ``launch_test``.

    Args:
        package: The package.
        name: The name of the file that describes the launch.
    """
    return any(
        name.encode() in data or b"'launch_test'" in data
        for data in _data(
            package, (path for path in package.python_files if path.rpartition("/")[2] != name)
        )
    )


def is_named_elsewhere(package: Package, module: PythonModule, name: str) -> bool:
    """Return whether a name of a module occurs again: in a call, import, argument or string."""
    return not package.is_mentioned_once(name, module.path)


def _data(package: Package, paths: Iterable[str]) -> Iterator[bytes]:
    """Yield the bytes of Python files, to search for names without parsing."""
    for path in paths:
        with suppress(ViewError):
            yield package.data(path)


def constructed_class(module: PythonModule, node: ast.expr) -> str:
    """Return the full name of the class that constructs the only value of a name."""
    made = module.index.only_value(node)
    return (module.qualified_name(made.func) or "") if isinstance(made, ast.Call) else ""


def node_tests(package: Package) -> Iterator[tuple[PythonModule, str]]:
    """Yield the files with tests of nodes, each with its text and that of its conftest.py files.

    Tests with launch_testing, and scripts, are skipped.
    """
    conftests = [path for path in package.python_files if path.endswith("conftest.py")]
    around = [*package.modules(conftests)]
    for module in package.modules(
        set(test_paths(package)) & set(paths_importing(package, "rclpy"))
    ):
        if LAUNCH in module.functions:
            continue
        if not module.has_main_guard and "launch_pytest" not in module.imports_by_root:
            yield module, "\n".join(item.source.text for item in [module, *around])
