"""The effects of ament_cmake commands in a CMakeLists.txt."""

from __future__ import annotations

import posixpath
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.model.cmake.distribution_branches import lines_not_run
from scaffold.model.cmake.inclusion import module_directories, named_file
from scaffold.model.cmake.known_commands import MODULES, is_known
from scaffold.model.cmake.lists import CMakeLists
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from scaffold.model.cmake.lists import InstallItem
    from scaffold.model.cmake.parser import Command
    from scaffold.model.package import Package
    from scaffold.source import Location

PACKAGE_COMMANDS = ("ament_package", "ament_auto_package", "autoware_package")
"""Commands that create the files of ament: the index entry, the environment hooks."""
_MAKERS = (
    *("configure_file", "file", "add_custom_command", "add_custom_target", "execute_process"),
    *("externalproject_add", "fetchcontent_declare", "generate_parameter_library"),
)
"""Commands that may create files in the source directory."""


class Program(NamedTuple):
    """A file of the package that is installed with ``install(PROGRAMS ...)``."""

    path: str
    name: str
    """The installed name."""
    destination: str | None
    location: Location
    command: Command


def uses_ament(package: Package) -> bool:
    """Return whether a CMakeLists.txt belongs to an ament_cmake package."""
    cmake = package.cmake
    return any(
        found_package.name.startswith("ament_cmake") for found_package in cmake.found_packages
    ) or bool(cmake.find(*PACKAGE_COMMANDS))


def is_built_for_ros1(package: Package) -> bool:
    """Return whether CMake builds a package with catkin alone, or a bridge to ROS 1."""
    try:
        is_bridge = bool(package.cmake.find("find_ros1_package"))
        return is_bridge or (package.cmake.finds("catkin") and not uses_ament(package))
    except ViewError:
        return False


def has_unknown_commands(package: Package) -> bool:
    """Return whether commands of other packages may do anything, such as install any file."""
    cmake = package.cmake
    return any(
        _is_unknown(command)
        for command in cmake.commands
        if command.name not in cmake.defined and command not in cmake.followed
    )


def _is_unknown(command: Command) -> bool:
    name = command.name
    if name == "include":
        return ",".join(command.values).lower() not in MODULES
    if name.endswith("_package"):
        return name not in _SAFE
    return name == "add_subdirectory" or not is_known(name)


_SAFE = frozenset(
    {"find_package", "ament_auto_package", "ament_package", "ament_python_install_package"}
    | {"moveit_package", "nav2_package"}
)


def nested(
    package: Package, is_asked_for: Callable[[CMakeLists, Command], bool] | None = None
) -> Iterator[CMakeLists]:
    """Yield the files of ``add_subdirectory`` and ``include``, recursively.

    Args:
        package: The package.
        is_asked_for: Tells whether a command must not be followed.
    """
    visited = {"CMakeLists.txt"}
    modules = [*module_directories(package.cmake)]
    pending = [("", package.cmake)]
    while pending:
        directory, lists = pending.pop()
        dead = [*lines_not_run(lists)]
        for command in lists.find_own("add_subdirectory", "include"):
            path = named_file(package, directory, lists, command, modules)
            if path is None or path in visited:
                continue
            if any(first <= command.location.line <= last for first, last in dead):
                continue
            if is_asked_for is not None and is_asked_for(lists, command):
                continue
            visited.add(path)
            below = CMakeLists.parse(package.source(path))
            below.place_below(package.cmake.project_name, package.listed)
            is_own = command.name == "add_subdirectory"
            pending.append((posixpath.dirname(path) if is_own else directory, below))
            yield below


def subdirectories(package: Package) -> Sequence[CMakeLists] | None:
    """Return the files that ``add_subdirectory`` always adds; ``None`` if some are not known."""
    found = package.remember("subdirectories", lambda: [*nested(package, _is_conditional)])
    result = [lists for lists in found if lists.source.path.endswith("/CMakeLists.txt")]
    calls = [call for lists in (package.cmake, *result) for call in lists.find("add_subdirectory")]
    is_known = len(calls) == len(result) and not any(lists.errors for lists in result)
    return result if is_known else None


def _is_conditional(_: CMakeLists, command: Command) -> bool:
    return bool(command.blocks)


def programs(package: Package) -> list[Program]:
    """Return the files that are installed as programs, as far as known."""
    result: list[Program] = []
    files = (package.cmake, *(subdirectories(package) or ()))
    for install in (install for lists in files for install in lists.installs):
        if install.kind != "PROGRAMS":
            continue
        for item in install.items:
            if item.path is None:
                continue
            name = install.rename or item.path.rpartition("/")[2]
            result.append(
                Program(item.path, name, install.destination, item.location, install.command)
            )
    return result


def installs_directory(package: Package, directory: str) -> bool | None:
    """Return whether a directory, or one around it, is installed; ``None`` if unknown."""
    unknown = False
    for install in package.cmake.installs:
        for item in install.items:
            if item.path is None:
                unknown = unknown or install.kind in {"DIRECTORY", "FILES"}
            elif (_includes(item, directory) and install.kind == "DIRECTORY") or (
                install.kind in {"FILES", "PROGRAMS"} and item.path.startswith(f"{directory}/")
            ):
                return True
    return None if unknown or has_unknown_commands(package) else False


def _includes(item: InstallItem, directory: str) -> bool:
    path = item.path or ""
    return path in {directory, "."} or directory.startswith(f"{path}/")


def is_made_by_build(package: Package, path: str) -> bool:
    """Return whether the build itself may create a file in the source directory."""
    name = path.rpartition("/")[2]
    makers = package.cmake.find(*_MAKERS)
    if any(name in argument.value for maker in makers for argument in maker.arguments):
        return True
    # set(model "${PROJECT_SOURCE_DIR}/models/a.onnx"), and a command fetches it
    named = package.cmake.find("set") if makers else ()
    return any(f"/{path}/" in argument.value for item in named for argument in item.arguments)


def is_used_by_build(package: Package, path: str) -> bool:
    """Return whether a file is installed, alone or in a directory of programs, or passed on.

    Also when an entry point starts it, when it lies deep in a directory of data, and when a comment
    says that it is excluded. A package without programs has scripts as data that Python is given.
    """
    is_script = not programs(package) and not package.is_executable(path)
    directories = {path.rpartition("/")[0], path.partition("/")[0]} - {""}
    for install in package.cmake.installs:
        is_for_programs = (install.destination or "").startswith("lib")
        for item in install.items:
            is_around = install.kind == "DIRECTORY" and item.path in directories
            is_deep = path.count("/") > 1 and item.path == path.partition("/")[0]
            is_data = is_around and (is_deep or is_script)
            if item.path == path or (is_around and is_for_programs) or is_data:
                return True
    name = path.rpartition("/")[2].removesuffix(".py")
    if any(f"{name}.py" in package.cmake.text(token) for token in package.cmake.comments):
        return True
    if _is_entry_point(package, path):
        return True
    return any(
        argument.value.rpartition("/")[2].partition(".")[0] == name
        for command in package.cmake.commands
        if command.name != "install" and _TESTING.search(command.name) is None
        for argument in command.arguments
    )


_TESTING = lazy_re.compile(r"_test$|^add_test$|^message$")
"""Matches the names of commands that mention a file without processing it."""


def _is_entry_point(package: Package, path: str) -> bool:
    """Return whether the setup.cfg of a CMake package has an entry point in a file."""
    entry = path.removesuffix(".py").replace("/", ".") + ":"
    files = [*package.glob("setup.cfg"), *package.glob("*/setup.cfg")]
    return any(entry in _text(package, file) for file in files)


def runs_with_python(package: Package, path: str) -> bool:
    """Return whether a CMake file runs a script with the Python found by CMake."""
    name = path.rpartition("/")[2]
    return any(
        name in line and "python" in line.partition(name)[0].lower()
        for file in package.files
        if file.endswith((".cmake", ".cmake.in"))
        for line in _text(package, file).splitlines()
    )


def _text(package: Package, path: str) -> str:
    try:
        return package.source(path).text
    except ViewError:
        return ""
