"""Which linters of ament the tests of a package run, and on which files.

The arguments of the Python style linters are in `calls`.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator, Sequence
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

from scaffold.model.install.declared_pytest import lacks_pytest
from scaffold.model.install.unused import is_named, is_unrun_test
from scaffold.model.python.evaluation.given_arguments import argument_of
from scaffold.model.python.module import is_collected
from scaffold.model.remembered import remembered
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.cmake.lists import CMakeLists
    from scaffold.model.cmake.parser import Argument, Command
    from scaffold.model.package import Package
    from scaffold.model.python.module import PythonModule

_COLLECTION = "ament_lint_common"
_FINDING = ("ament_lint_auto_find_test_dependencies", "ament_auto_find_test_dependencies")


class Use(NamedTuple):
    """How the tests of a package use a linter."""

    runs: bool
    why_not: str = ""
    """Why the linter does not run, for messages."""
    excluded: tuple[str, ...] = ()
    """Patterns of files that it is configured to skip."""
    is_excluded: bool = False
    """Whether the package disables it on purpose."""
    paths: tuple[str, ...] = ()
    """The files and directories passed to it; empty for the whole package."""

    def covers(self, path: str) -> bool:
        """Return whether the linter checks a file."""
        is_given = not self.paths or any(
            path == given or path.startswith(f"{given}/") for given in self.paths
        )
        return (
            self.runs
            and is_given
            and not any(
                fnmatchcase(path, pattern) and path.count("/") == pattern.count("/")
                for pattern in self.excluded
            )
        )


@remembered
def linter_use(package: Package, linter: str) -> Use:
    """Return how a package uses a linter: by CMake, or by a test in Python.

    Args:
        package: The package.
        linter: Its name without ``ament_``: ``copyright``, ``flake8``, ``pep257``.
    """
    uses = (_by_cmake(package, linter), _by_pytest(package, f"ament_{linter}"))
    result = [use for use in uses if use is not None]
    running = [use for use in result if use.runs]
    return next(iter(running or result), Use(runs=False, why_not="no test of this package runs it"))


def _by_cmake(package: Package, linter: str) -> Use | None:
    try:
        cmake = package.cmake
        calls = cmake.find(f"ament_{linter}")
        if calls:
            return _use_by_command(cmake, calls)
        if hook(package, linter) is None:
            return None
    except ViewError:
        return None
    reason = _switched_off(cmake, linter)
    if reason:
        return Use(runs=False, why_not=reason, is_excluded=True)
    return _excluding(cmake, file_excludes(cmake))


_KEYWORDS = ("EXCLUDE", "TESTNAME", "TIMEOUT", "EXTENSIONS", "CONFIG_FILE")


def _use_by_command(cmake: CMakeLists, calls: Sequence[Command]) -> Use:
    """Return the arguments of a linter in CMake: excluded files, and paths."""
    excluded: list[Argument] = []
    given: list[str] = []
    is_limited = True
    for call in calls:
        sections = call.sections(_KEYWORDS)
        excluded += sections.get("EXCLUDE", ())
        # The keywords TESTNAME and TIMEOUT have one value; arguments after it are paths as well.
        single = (name for name in ("TESTNAME", "TIMEOUT") if name in sections)
        paths = [
            *sections.get("", ()),
            *(argument for name in single for argument in sections[name][1:]),
        ]
        values = cmake.expand_list(paths, call)
        if values is None:
            return _undetermined("names")
        is_limited = is_limited and bool(values)
        given += map(cmake.path_of, values)
    use = _excluding(cmake, cmake.expand_list(excluded))
    is_limited = is_limited and not {"", "."} & {*given}
    return use._replace(paths=tuple(given)) if is_limited else use


def hook(package: Package, linter: str) -> Command | None:
    """Return the command that runs a linter declared in the manifest; raises ViewError."""
    finds = package.cmake.find(*_FINDING)
    wrapper = f"ament_cmake_{linter}"
    is_found = finds and any(
        _provides_linter(package, name, wrapper) for name in _found_packages(package)
    )
    return finds[0] if is_found else None


def _found_packages(package: Package) -> set[str]:
    """Return the packages found by CMake and declared in the manifest.

    ament_lint_auto only finds test dependencies, so that it ignores a ``<depend>``.
    """
    manifest, cmake = package.manifest, package.cmake
    others = manifest.build_names if cmake.finds_automatically else set()
    return manifest.test_names | others | {x for x in manifest.declared_names if cmake.finds(x)}


def is_switched_off(cmake: CMakeLists, linter: str) -> bool:
    """Return whether a CMakeLists.txt keeps ament_lint_auto from running a linter."""
    return bool(_switched_off(cmake, linter))


def _switched_off(cmake: CMakeLists, linter: str) -> str:
    wrapper = f"ament_cmake_{linter}"
    for command in cmake.find("set", "list"):
        words = [argument.text for argument in command.arguments]
        line = command.location.line
        if words[:1] == [f"{wrapper}_FOUND"] and words[1:2] not in ([], ["FALSE"], ["OFF"], ["0"]):
            return f"CMakeLists.txt line {line} switches it off"
        if "AMENT_LINT_AUTO_EXCLUDE" in words[:2] and wrapper in words:
            return f"CMakeLists.txt line {line} excludes it"
    return ""


def _provides_linter(package: Package, name: str, wrapper: str) -> bool:
    """Return whether a dependency is the linter or a collection that includes it."""
    collections = (_COLLECTION, wrapper)
    if name in collections:
        return True
    other = package.workspace.get(name) if name.endswith("_lint_common") else None
    try:
        return other is not None and not other.manifest.run_names.isdisjoint(collections)
    except ViewError:
        return False


def file_excludes(cmake: CMakeLists) -> list[str] | None:
    """Return the files that ament_lint_auto excludes; ``None`` if unknown."""
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


def _undetermined(verb: str) -> Use:
    return Use(runs=False, why_not=f"the files that CMakeLists.txt {verb} cannot be determined")


def _excluding(cmake: CMakeLists, values: list[str] | None) -> Use:
    if values is None:
        return _undetermined("excludes")
    return Use(runs=True, excluded=tuple(cmake.path_of(value) for value in values))


def _by_pytest(package: Package, linter: str) -> Use | None:
    result: Use | None = None
    undeclared = "setup.py does not declare pytest, so that colcon runs no test"
    for module, why_not in linter_tests(package, linter):
        reason = why_not or (undeclared if not module.classes and lacks_pytest(package) else "")
        if not reason:
            excluded = _excluded(module.walk(ast.List))
            return Use(runs=True, excluded=excluded, paths=_given_paths(module))
        result = Use(runs=False, why_not=reason)
    return result


def linter_tests(package: Package, linter: str) -> Iterator[tuple[PythonModule, str]]:
    """Yield the Python tests that import a linter, each with why it cannot fail, if so.

    Args:
        package: The package.
        linter: The name of its module, ``ament_flake8``.
    """
    for path in package.python_files:
        if "test" not in path:
            continue
        try:
            if linter.encode() not in package.data(path):
                continue
            module = package.module(path)
        except ViewError:
            continue
        if linter not in module.imports_by_root:
            continue
        if re.search(r"pytest\.mark\.(?:skip|xfail)|pytest\.skip\(", module.source.text):
            yield module, f"{path} is skipped"
        elif is_unrun_test(package, path):
            yield module, f"CMake does not run {path}"
        elif _is_uncollected(package, path):
            yield module, f"pytest does not run {path}"
        else:
            yield module, "" if _can_fail(module) else f"{path} asserts nothing"


def _is_uncollected(package: Package, path: str) -> bool:
    """Return whether pytest does not collect a file by its name, and no other file mentions it."""
    name = path.rpartition("/")[2]
    is_collected_by_name = package.build_type != "ament_python" or is_collected(name)
    return not is_collected_by_name and not is_named(package, path, name.removesuffix(".py"))


def _can_fail(module: PythonModule) -> bool:
    """Return whether a test can fail: by an ``assert``, or a call such as ``assertEqual``."""
    return bool(module.walk(ast.Assert)) or any(
        re.search(r"assert|fail|exit", ast.unparse(call.func), re.IGNORECASE)
        for call in module.walk(ast.Call)
    )


def _given_paths(module: PythonModule) -> tuple[str, ...]:
    """Return the paths that a test passes to a linter; empty if it may be the whole package."""
    result: set[str] = set()
    for call in module.walk(ast.Call):
        if not ast.unparse(call.func).endswith("main"):
            continue
        given = argument_of(call, "argv", 0)
        values = _constants(given) if isinstance(given, ast.List) else None
        paths = {_plain(value) for option, value in values or () if not option}
        if values is None or paths <= {"", "."} or "." in paths:
            return ()
        result |= paths
    return tuple(sorted(result))


def _excluded(lists: Sequence[ast.List]) -> tuple[str, ...]:
    """Return the values of ``--exclude`` in lists of arguments."""
    return tuple(
        _plain(value)
        for node in lists
        for option, value in _options(item for item in node.elts if isinstance(item, ast.Constant))
        if option == "--exclude"
    )


def _constants(node: ast.List) -> list[tuple[str, str]] | None:
    """Return the arguments of a list, each with its option; ``None`` if not all are known."""
    constants = [item for item in node.elts if isinstance(item, ast.Constant)]
    return [*_options(constants)] if len(constants) == len(node.elts) else None


def _options(constants: Iterable[ast.Constant]) -> Iterator[tuple[str, str]]:
    """Yield arguments, each with the option before it; empty if there is none."""
    option = ""
    for constant in constants:
        if not isinstance(constant.value, str):
            continue
        if constant.value.startswith("--"):
            option = constant.value
        else:
            yield option, constant.value


def _plain(path: str) -> str:
    return path.removeprefix("./").rstrip("/")
