"""The interfaces that ``rosidl_generate_interfaces`` generates."""

from __future__ import annotations

from typing import TYPE_CHECKING

from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.cmake.lists import CMakeLists
    from scaffold.model.cmake.parser import Argument, Command

GENERATE = "rosidl_generate_interfaces"
_OPTIONS = frozenset({"ADD_LINTER_TESTS", "SKIP_INSTALL", "SKIP_GROUP_MEMBERSHIP_CHECK"})
_WITH_VALUES = frozenset({"DEPENDENCIES", "LIBRARY_NAME"})


class Listed(NamedTuple):
    """A file that is passed to the call."""

    path: str
    """Relative to the package."""
    argument: Argument
    """The argument with the file: of the call, or of the ``set`` of its variable."""


class Generation(NamedTuple):
    """A call of ``rosidl_generate_interfaces``."""

    command: Command
    target: str | None
    """The first argument, with variables replaced."""
    files: list[Listed]
    is_complete: bool
    """Whether these are all files, and all are from this package."""
    dependencies: list[str] | None
    """``None`` if a variable is unknown."""
    options: frozenset[str]
    """``SKIP_INSTALL`` ..., and the names of the arguments with values."""
    for_tests: bool


def generations_of(cmake: CMakeLists) -> list[Generation]:
    """Return the calls in a CMakeLists.txt."""
    return [_generation(cmake, command) for command in cmake.find(GENERATE) if command.arguments]


def _generation(cmake: CMakeLists, command: Command) -> Generation:
    files: list[Listed] = []
    options: set[str] = set()
    dependencies: list[str] = []
    knows_dependencies = True
    complete = True
    collecting = ""
    target, *arguments = command.arguments
    for argument in arguments:
        values = cmake.expand_list([argument], command)
        for value in [None] if values is None else values:
            if value in _OPTIONS or value in _WITH_VALUES:
                options.add(str(value))
                collecting = str(value) if value in _WITH_VALUES else ""
            elif collecting == "DEPENDENCIES":
                knows_dependencies = knows_dependencies and value is not None
                # rosidl splits a quoted list.
                dependencies += str(value).split(";")
            elif collecting:
                collecting = ""
            elif value is None or ":" in value or value.startswith("/") or "$" in value:
                complete = False
            else:
                written = cmake.where_written(command, argument, value)
                files.append(Listed(cmake.path_of(value), written))
    return Generation(
        command,
        cmake.expand(target, command),
        files,
        complete,
        dependencies if knows_dependencies else None,
        frozenset(options),
        cmake.guarded_by_testing(command),
    )
