"""Whether a package runs a linter of ament in its own tests, and over which files."""

from __future__ import annotations

import ast
import re
from collections.abc import Sequence
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.cmake.lists import CMakeLists
    from scaffold.model.package import Package
    from scaffold.model.python.module import PythonModule

_COLLECTION = "ament_lint_common"


class Use(NamedTuple):
    """How a package uses a linter."""

    runs: bool
    why_not: str = ""
    """Why the linter does not run; for people."""
    excluded: tuple[str, ...] = ()
    """Patterns of files that it is configured to skip."""
    is_excluded: bool = False
    """The package switches it off on purpose."""

    def covers(self, path: str) -> bool:
        """Tell whether the linter looks at a file."""
        return self.runs and not any(
            fnmatchcase(path, pattern) and path.count("/") == pattern.count("/")
            for pattern in self.excluded
        )


def linter_use(package: Package, linter: str) -> Use:
    """Return how a package uses a linter: by CMake, or by a test in Python.

    Args:
        package: The package.
        linter: Its name without ``ament_``: ``copyright``, ``flake8``, ``pep257``.
    """
    return package.remember(("linter_use", linter), lambda: _use(package, linter))


def _use(package: Package, linter: str) -> Use:
    uses = (_by_cmake(package, linter), _by_pytest(package, f"ament_{linter}"))
    result = [use for use in uses if use is not None]
    running = [use for use in result if use.runs]
    return next(iter(running or result), Use(runs=False, why_not="no test of this package runs it"))


def _by_cmake(package: Package, linter: str) -> Use | None:
    try:
        cmake = package.cmake
        declared = package.manifest.declared_names
    except ViewError:
        return None
    calls = cmake.find(f"ament_{linter}")
    if calls:
        arguments = [a for call in calls for a in call.arguments if a.text != "EXCLUDE"]
        return _excluding(cmake, cmake.expand_list(arguments))
    finds = cmake.find("ament_lint_auto_find_test_dependencies")
    finds = finds or cmake.find("ament_auto_find_test_dependencies")
    wrapper = f"ament_cmake_{linter}"
    if not finds or not any(_brings(package, name, wrapper) for name in declared):
        return None
    for command in cmake.find("set", "list"):
        words = [argument.text for argument in command.arguments]
        line = command.location.line
        if words[:1] == [f"{wrapper}_FOUND"] and words[1:2] not in ([], ["FALSE"], ["OFF"], ["0"]):
            return Use(
                runs=False, why_not=f"CMakeLists.txt line {line} switches it off", is_excluded=True
            )
        if "AMENT_LINT_AUTO_EXCLUDE" in words[:2] and wrapper in words:
            return Use(
                runs=False, why_not=f"CMakeLists.txt line {line} excludes it", is_excluded=True
            )
    return _excluding(cmake, _file_excludes(cmake))


def _brings(package: Package, name: str, wrapper: str) -> bool:
    """Tell whether a dependency is the linter or a collection, ours or of the workspace."""
    collections = (_COLLECTION, wrapper)
    if name in collections:
        return True
    other = package.workspace.get(name) if name.endswith("_lint_common") else None
    try:
        return other is not None and not other.manifest.run_names.isdisjoint(collections)
    except ViewError:
        return False


def _file_excludes(cmake: CMakeLists) -> list[str] | None:
    result: list[str] = []
    for command in cmake.find("set", "list"):
        words = [argument.text for argument in command.arguments]
        if "AMENT_LINT_AUTO_FILE_EXCLUDE" in words[:2]:
            start = words.index("AMENT_LINT_AUTO_FILE_EXCLUDE") + 1
            values = cmake.expand_list(command.arguments[start:], command)
            if values is None:
                return None
            result += values
    return result


def _excluding(cmake: CMakeLists, values: list[str] | None) -> Use:
    if values is None:
        return Use(runs=False, why_not="which files CMakeLists.txt excludes cannot be told")
    return Use(runs=True, excluded=tuple(cmake.path_of(value) for value in values))


def _by_pytest(package: Package, linter: str) -> Use | None:
    result: Use | None = None
    for path in package.python_files:
        if "test" not in path:
            continue
        try:
            module = package.module(path)
        except ViewError:
            continue
        if linter not in module.source.text or linter not in module.imports_by_root:
            continue
        if re.search(r"pytest\.mark\.(?:skip|xfail)|pytest\.skip\(", module.source.text):
            result = Use(runs=False, why_not=f"{path} is skipped")
        elif not _asserts(module):
            result = Use(runs=False, why_not=f"{path} asserts nothing")
        else:
            return Use(runs=True, excluded=_arguments(module.walk(ast.List)))
    return result


def _asserts(module: PythonModule) -> bool:
    """Tell whether a test can fail: by an ``assert``, or a call such as ``assertEqual``."""
    return bool(module.walk(ast.Assert)) or any(
        re.search(r"assert|fail|exit", ast.unparse(call.func), re.IGNORECASE)
        for call in module.walk(ast.Call)
    )


def _arguments(lists: Sequence[ast.List]) -> tuple[str, ...]:
    """Return what follows ``--exclude`` in lists of arguments."""
    result: list[str] = []
    for node in lists:
        values = [item.value for item in node.elts if isinstance(item, ast.Constant)]
        excluding = False
        for value in values:
            if isinstance(value, str) and value.startswith("--"):
                excluding = value == "--exclude"
            elif excluding and isinstance(value, str):
                result.append(value.removeprefix("./"))
    return tuple(result)
