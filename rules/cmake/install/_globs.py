"""Patterns of ``file(GLOB)`` that match no file."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from scaffold.api.workspace import is_untracked

if TYPE_CHECKING:
    from scaffold.api import Package
    from scaffold.api.cmake import Argument, CMakeLists, Generation

_REFERENCE = re.compile(r"\$\{(\w+)\}")
_OPTIONS = frozenset({"LIST_DIRECTORIES", "RELATIVE"})
"""Options of ``file(GLOB)`` with a value."""
_NOT_FILES = frozenset({"DEPENDENCIES", "LIBRARY_NAME", "ADD_LINTER_TESTS", "SKIP_INSTALL"})
"""The keywords of ``rosidl_generate_interfaces`` after its files."""


def interface_patterns_without_files(
    package: Package, call: Generation
) -> list[tuple[Argument, str]]:
    """Return the patterns of the only interfaces of a call if none of them matches a file."""
    return patterns_without_files(package, call.command.sections(_NOT_FILES)[""][1:])


def patterns_without_files(
    package: Package, given: Sequence[Argument]
) -> list[tuple[Argument, str]]:
    """Return the patterns of files in some arguments if none of them matches a file.

    Nothing in doubt: other commands change a variable, or files are not tracked by git.
    """
    cmake = package.cmake
    found: list[tuple[Argument, str]] = []
    for argument in given:
        reference = _REFERENCE.fullmatch(argument.text)
        patterns = [*_patterns(cmake, reference[1])] if reference else []
        if not patterns or any(_may_match(package, path) for _, path in patterns):
            return []
        found += [(argument, path) for argument, path in patterns if path is not None]
    return found


def _patterns(cmake: CMakeLists, name: str) -> Iterator[tuple[Argument, str | None]]:
    """Yield the patterns whose files are in a variable; ``None`` for an unknown one."""
    for command in cmake.commands:
        if name not in command.values or command.name == "unset":
            continue
        values = command.values
        is_glob = command.name == "file" and values[:1] in (["GLOB"], ["GLOB_RECURSE"])
        if not is_glob or values[1] != name or command.blocks:
            yield command.arguments[0], None
            continue
        before = ""
        for argument in command.arguments[2:]:
            if before not in _OPTIONS and argument.value not in {*_OPTIONS, "CONFIGURE_DEPENDS"}:
                value = cmake.expand(argument, command)
                yield argument, None if value is None else cmake.path_of(value)
            before = argument.value


def _may_match(package: Package, path: str | None) -> bool:
    """Return whether files may match a pattern, wherever they are below its directory."""
    if path is None or path.startswith(("/", "..")):
        return True
    directory, _, name = path.rpartition("/")
    inside, ending = f"{directory}/" if directory else "", name.rpartition("*")[2]
    if not {"*", "?", "["}.isdisjoint(directory) or is_untracked(package, directory or "."):
        return True
    return any(file.startswith(inside) and file.endswith(ending) for file in package.files)
