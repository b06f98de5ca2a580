"""CM064: packages whose types the fields use are found, and listed in DEPENDENCIES."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Rule, ViewError
from scaffold.api.catalog import transitive_dependencies
from scaffold.api.cmake import CMakeLists, Generation, generations, has_unknown_commands
from scaffold.api.interfaces import KINDS, Definitions, interface_files

_LISTS = (
    "project(my_msgs)\nfind_package(geometry_msgs REQUIRED)\nfind_package(std_msgs REQUIRED)\n"
    "rosidl_generate_interfaces(${PROJECT_NAME} msg/Beat.msg %s)\n"
)
_FILES = {"msg/Beat.msg": "std_msgs/Header header\ngeometry_msgs/Point point\n"}
_TOOLS = ("ament_cmake", "ament_lint", "rosidl_", "Python3", "Eigen3")
"""Packages that provide no interfaces, except for those that all interfaces use."""
_ALWAYS = frozenset({"action_msgs", "builtin_interfaces", "service_msgs"})
_ALWAYS |= {"unique_identifier_msgs", "type_description_interfaces", "rcl_interfaces"}
_LISTS_FOUND = (
    "project(my_msgs)\nfind_package(ament_cmake REQUIRED)\n"
    "find_package(rosidl_default_generators REQUIRED)\n{}"
    "rosidl_generate_interfaces(${{PROJECT_NAME}} msg/Beat.msg DEPENDENCIES std_msgs)\n"
    "ament_package()\n"
)
_BEAT = {"msg/Beat.msg": "std_msgs/Header header\n"}


class InterfaceDependencyMissing(Rule):
    """Interfaces use types of a package that is not listed in ``DEPENDENCIES``, or not found.

    **Why.** The build stops: the generators do not find the definition of the type, or
    ``rosidl_generate_interfaces() the passed dependency 'std_msgs' has not been found before using
    find_package()``.

    **Fix.** Call ``find_package`` for the package first, and add it to ``DEPENDENCIES``.

    **Source.** ``rosidl_cmake/cmake/rosidl_generate_interfaces.cmake``: DEPENDENCIES are "the
    packages from which message types are being used".
    """

    code = "CM064"
    name = "interface-dependency-missing"
    effect = Effect.STOPS_BUILD
    examples = (
        Example(
            "std_msgs as a dependency of geometry_msgs",
            {"CMakeLists.txt": _LISTS % "DEPENDENCIES geometry_msgs", **_FILES},
        ),
        Example(
            "no DEPENDENCIES; incomplete DEPENDENCIES",
            {"CMakeLists.txt": _LISTS % "", **_FILES},
            "CMakeLists.txt:4:1: msg/Beat.msg:1 uses a type of 'std_msgs', which is not in "
            "DEPENDENCIES: the build stops; add it",
            "CMakeLists.txt:4:1: msg/Beat.msg:2 uses a type of 'geometry_msgs', which is not in "
            "DEPENDENCIES: the build stops; add it",
        ),
        Example(
            "found first",
            {"CMakeLists.txt": _LISTS_FOUND.format("find_package(std_msgs REQUIRED)\n"), **_BEAT},
        ),
        Example(
            "found as a dependency of geometry_msgs",
            {
                "CMakeLists.txt": _LISTS_FOUND.format("find_package(geometry_msgs REQUIRED)\n"),
                **_BEAT,
            },
        ),
        Example(
            "listed in DEPENDENCIES, but not found",
            {"CMakeLists.txt": _LISTS_FOUND.format(""), **_BEAT},
            "CMakeLists.txt:4:1: 'std_msgs' is in DEPENDENCIES, but not found: CMake stops; call "
            "find_package('std_msgs' REQUIRED) first",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_listed(package)
        yield from self._check_found(package)

    def _check_listed(self, package: Package) -> Iterator[Diagnostic]:
        definitions = package.workspace.interfaces
        for call in generations(package):
            if call.dependencies is None:
                continue
            reached = _with_dependencies(definitions, call.dependencies)
            if reached is None:
                continue
            for name, path, line in _used_packages(package, call):
                if name not in {*reached, package.name}:
                    message = (
                        f"{path}:{line} uses a type of {name!r}, which is not in DEPENDENCIES: "
                        f"the build stops; add it"
                    )
                    yield self.report(call.command.name_location, message)

    def _check_found(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        calls = [call for call in generations(package) if call.dependencies]
        if not calls or cmake.finds_automatically or has_unknown_commands(package):
            return
        available = _available(package, _names_found(cmake))
        for call in calls if available is not None else ():
            for name in call.dependencies or ():
                if name not in {*(available or ()), *_ALWAYS, package.name}:
                    message = (
                        f"{name!r} is in DEPENDENCIES, but not found: CMake stops; call "
                        f"find_package({name!r} REQUIRED) first"
                    )
                    yield self.report(call.command.name_location, message)


def _used_packages(package: Package, call: Generation) -> Iterator[tuple[str, str, int]]:
    """Yield each package that the listed files use, with the first place."""
    listed = {file.path for file in call.files}
    seen: set[str] = set()
    for file in interface_files(package):
        for field in file.definition.all_fields if file.path in listed else ():
            name = field.type.package
            if name is not None and name not in seen:
                seen.add(name)
                yield name, file.path, field.location.line


def _with_dependencies(definitions: Definitions, names: list[str]) -> set[str] | None:
    """Return some packages with their dependencies; ``None`` if unknown."""
    result = {"service_msgs", "action_msgs", "builtin_interfaces", "unique_identifier_msgs"}
    pending = [*names]
    while pending:
        package = pending.pop()
        result.add(package)
        for kind in KINDS:
            interfaces = definitions.names(package, kind)
            if interfaces is None and package in names:
                return None
            uses = _packages_of_fields(definitions, package, kind, interfaces or ())
            pending += [use for use in uses if use not in result and use not in pending]
    return result


def _packages_of_fields(
    definitions: Definitions, package: str, kind: str, names: Iterable[str]
) -> set[str]:
    """Return the packages whose messages some interfaces have as fields."""
    interfaces = [definitions.find(f"{package}/{kind}/{name}") for name in names]
    fields = [field for interface in interfaces if interface for field in interface.all_fields]
    return {field.type.package for field in fields if field.type.package}


def _names_found(cmake: CMakeLists) -> set[str] | None:
    """Return the found packages; ``None`` if a name is not known."""
    names: set[str] = set()
    for command in cmake.find("find_package"):
        expanded = cmake.expand_list(command.arguments[:1], command)
        if not expanded and not any(package.command is command for package in cmake.found_packages):
            return None
    names.update(package.name for package in cmake.found_packages)
    return names


def _available(package: Package, required: set[str] | None) -> set[str] | None:
    """Return the found packages with their dependencies; ``None`` if there may be more."""
    if required is None:
        return None
    definitions = package.workspace.interfaces
    available: set[str] = set()
    pending = sorted(required)
    while pending:
        name = pending.pop()
        if name in available:
            continue
        available.add(name)
        if name.startswith(_TOOLS):
            continue
        pending += sorted(transitive_dependencies({name}))
        interfaces = [(kind, definitions.names(name, kind)) for kind in KINDS]
        if name in required and not any(names for _, names in interfaces):
            return None
        pending += _declared(package, name)
        for kind, names in interfaces:
            pending += sorted(_packages_of_fields(definitions, name, kind, names or ()))
    return available


def _declared(package: Package, name: str) -> list[str]:
    """Return the DEPENDENCIES of another package of the workspace."""
    other = package.workspace.get(name)
    try:
        calls = generations(other) if other is not None else []
    except ViewError:
        return []
    return [dependency for call in calls for dependency in call.dependencies or ()]
