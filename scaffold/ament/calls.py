"""The command lines with which the tests of a package run ament_flake8 and ament_pep257."""

from __future__ import annotations

import ast
import os
from collections.abc import Iterator, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

from scaffold.ament.use import file_excludes, hook, is_switched_off, linter_tests
from scaffold.model.python.evaluation.evaluator import Evaluator
from scaffold.model.python.evaluation.values import UNKNOWN, PathValue, is_known
from scaffold.record import NamedTuple
from scaffold.source import Location, ViewError

if TYPE_CHECKING:
    from scaffold.model.cmake.lists import CMakeLists
    from scaffold.model.cmake.parser import Argument, Command
    from scaffold.model.package import Package
    from scaffold.model.python.module import PythonModule

Arguments = tuple[str | None, ...]
"""As on a command line; ``None`` for arguments that are unknown without running the tests."""

_KEYWORDS = {
    "flake8": {"EXCLUDE": "--exclude", "MAX_LINE_LENGTH": "--linelength"},
    "pep257": {},
}
_SOURCE_VARIABLES = ("_SOURCE_DIR}", "_LIST_DIR}")


class Call(NamedTuple):
    """A run of a linter, in the directory of the package."""

    arguments: Arguments
    location: Location


def directory_of(package: Package) -> str:
    """Return the directory where the tests of a package run; a placeholder for one in memory."""
    return os.path.abspath(package.place or "/package")


def linter_calls(package: Package, linter: str) -> list[Call]:
    """Return how the tests of a package run a linter, without runs that cannot fail.

    Args:
        package: The package.
        linter: Its name without ``ament_``: ``flake8`` or ``pep257``.
    """
    result: list[Call] = []
    for run in (_by_function, _by_hook):
        with suppress(ViewError):
            result.extend(run(package, linter))
    return [*result, *_by_tests(package, f"ament_{linter}")]


def _by_function(package: Package, linter: str) -> Iterator[Call]:
    """Yield the calls of a linter in the CMakeLists.txt; raises ViewError."""
    cmake = package.cmake
    for command in cmake.find(f"ament_{linter}"):
        words = [word for item in command.arguments for word in _expanded(cmake, item, command)]
        yield Call((*_command_line(cmake, command, linter, words),), command.location)


def _by_hook(package: Package, linter: str) -> Iterator[Call]:
    """Yield the run of a linter by ament_lint_auto; raises ViewError."""
    cmake, command = package.cmake, hook(package, linter)
    if command is None or is_switched_off(cmake, linter):
        return
    words: list[str | None] = []
    if linter == "flake8":
        excludes = file_excludes(cmake)
        words = ["EXCLUDE", *([None] if excludes is None else excludes)]
    yield Call((*_command_line(cmake, command, linter, words),), command.location)


def _expanded(cmake: CMakeLists, argument: Argument, command: Command) -> Sequence[str | None]:
    values = cmake.expand_list([argument], command)
    if values is None:
        return [None]
    # A plain name means any directory to flake8, and the path of a file does not.
    is_path = any(variable in argument.text for variable in _SOURCE_VARIABLES)
    return [f"./{value}" if is_path and "/" not in value else value for value in values]


def _command_line(
    cmake: CMakeLists, command: Command, linter: str, words: Sequence[str | None]
) -> Iterator[str | None]:
    """Yield the command line that the CMake function of a linter passes on."""
    keywords = (
        {"TESTNAME", "CONFIG_FILE", *_KEYWORDS[linter]} if linter == "flake8" else {"TESTNAME"}
    )
    given: dict[str, str | None] = {}
    others: list[str | None] = []
    keyword = ""
    for word in words:
        if word in keywords:
            keyword = str(word)
        elif keyword:
            given[keyword], keyword = word, ""
        else:
            others.append(word)
    if "CONFIG_FILE" in given:
        yield from ("--config", given["CONFIG_FILE"])
    elif linter == "flake8" and _is_set(cmake, _CONFIGURATION):
        yield from ("--config", cmake.expand(f"${{{_CONFIGURATION}}}", command))
    for name, flag in reversed(_KEYWORDS[linter].items()):
        if name in given:
            yield from (flag, given[name])
    yield from others


_CONFIGURATION = "ament_cmake_flake8_CONFIG_FILE"


def _is_set(cmake: CMakeLists, variable: str) -> bool:
    return any(
        command.arguments and command.arguments[0].text == variable for command in cmake.find("set")
    )


def _by_tests(package: Package, linter: str) -> Iterator[Call]:
    for module, why_not in linter_tests(package, linter):
        if why_not:
            continue
        evaluator = _TestEvaluator(module, directory_of(package))
        for call in module.walk(ast.Call):
            if module.qualified_names(call.func) & {
                f"{linter}.main.main",
                f"{linter}.main.main_with_errors",
            }:
                yield Call((*_arguments(evaluator, call),), module.location(call))


def _arguments(evaluator: Evaluator, call: ast.Call) -> Iterator[str | None]:
    given = [word.value for word in call.keywords if word.arg == "argv"] or call.args[:1]
    if any(word.arg is None for word in call.keywords):
        yield None
    for node in given:
        values = evaluator.evaluate(node)
        if not isinstance(values, list | tuple):
            items = evaluator.elements(node)
            values = [item.value for item in items.items]
            values += [] if items.complete else [UNKNOWN]
        for value in values:
            is_text = is_known(value) and isinstance(value, str | PathValue)
            yield str(value) if is_text else None


_SAME_PATH = frozenset(
    {"os.path.abspath", "os.path.realpath", "os.path.normpath", "os.fspath", "os.path.expanduser"}
)


class _TestEvaluator(Evaluator):
    """Evaluates ``__file__`` of a test, and paths derived from it.

    Args:
        module: The file.
        directory: The directory of the package, where the test runs.
    """

    def __init__(self, module: PythonModule, directory: str) -> None:
        super().__init__(module)
        self._directory = directory
        self._file = os.path.join(directory, module.path)

    def evaluate(self, node: ast.expr | None) -> object:
        """Return the value of an expression."""
        if isinstance(node, ast.Name) and node.id == "__file__":
            return self._file
        return super().evaluate(node)

    def attribute(self, node: ast.Attribute) -> object:
        """Return the directories above a path."""
        holder = self.evaluate(node.value)
        if isinstance(holder, PathValue) and node.attr in {"parent", "parents"}:
            above = [PathValue(path) for path in _parents(holder.text)]
            return above if node.attr == "parents" else above[0]
        return super().attribute(node)

    def call(self, node: ast.Call) -> object:
        """Return the value of a function of a path."""
        name = self.module.qualified_name(node.func)
        if name in {"os.getcwd", "pathlib.Path.cwd"}:
            return PathValue(self._directory) if name != "os.getcwd" else self._directory
        if len(node.args) == 1 and (name in _SAME_PATH or name == "os.path.dirname"):
            value = self.evaluate(node.args[0])
            text = value.text if isinstance(value, PathValue) else value
            if isinstance(text, str):
                return os.path.dirname(text) if name == "os.path.dirname" else self._full(text)
        if isinstance(node.func, ast.Attribute) and not node.args:
            holder = self.evaluate(node.func.value)
            if isinstance(holder, PathValue) and node.func.attr in {"resolve", "absolute"}:
                return PathValue(self._full(holder.text))
        return super().call(node)

    def _full(self, path: str) -> str:
        return os.path.normpath(os.path.join(self._directory, path))


def _parents(path: str) -> Iterator[str]:
    while True:
        parent = os.path.dirname(path)
        yield parent or "."
        if parent in {"", path}:
            return
        path = parent
