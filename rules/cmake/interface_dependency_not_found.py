"""CM065: the DEPENDENCIES of interfaces are found before they are used."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Report, Rule, ViewError
from scaffold.api.catalog import transitive_dependencies
from scaffold.api.cmake import CMakeLists, generations, has_unknown_commands
from scaffold.api.interfaces import KINDS

_TOOLS = ("ament_cmake", "ament_lint", "rosidl_", "Python3", "Eigen3")
"""What brings no interfaces along, except for those that all interfaces use."""
_ALWAYS = frozenset({"action_msgs", "builtin_interfaces", "service_msgs"})
_ALWAYS |= {"unique_identifier_msgs", "type_description_interfaces", "rcl_interfaces"}
_LISTS = (
    "project(my_msgs)\nfind_package(ament_cmake REQUIRED)\n"
    "find_package(rosidl_default_generators REQUIRED)\n{}"
    "rosidl_generate_interfaces(${{PROJECT_NAME}} msg/Beat.msg DEPENDENCIES std_msgs)\n"
    "ament_package()\n"
)
_BEAT = {"msg/Beat.msg": "std_msgs/Header header\n"}


class InterfaceDependencyNotFound(Rule):
    """A package is among the ``DEPENDENCIES`` of interfaces, and ``find_package`` is missing.

    **Why.** The build stops: ``rosidl_generate_interfaces() the passed dependency 'std_msgs' has
    not been found before using find_package()``.

    **Fix.** Call ``find_package(std_msgs REQUIRED)`` before.

    **Source.** ``rosidl_cmake/cmake/rosidl_generate_interfaces.cmake``.
    """

    code = "CM065"
    name = "interface-dependency-not-found"
    effect = Effect.STOPS_BUILD
    examples = (
        Example(
            "found", {"CMakeLists.txt": _LISTS.format("find_package(std_msgs REQUIRED)\n"), **_BEAT}
        ),
        Example(
            "geometry_msgs brings it along",
            {"CMakeLists.txt": _LISTS.format("find_package(geometry_msgs REQUIRED)\n"), **_BEAT},
        ),
        Example(
            "not found",
            {"CMakeLists.txt": _LISTS.format(""), **_BEAT},
            Report(
                "CMakeLists.txt:4:1",
                "'std_msgs' is among the DEPENDENCIES, but nothing finds it: "
                "find_package(std_msgs REQUIRED) is missing",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        calls = [call for call in generations(package) if call.dependencies]
        if not calls or cmake.finds_automatically or has_unknown_commands(package):
            return
        there = _available(package, _names_found(cmake))
        for call in calls if there is not None else ():
            for name in call.dependencies or ():
                if name not in {*(there or ()), *_ALWAYS, package.name}:
                    message = (
                        f"{name!r} is among the DEPENDENCIES, but nothing finds it: "
                        f"find_package({name} REQUIRED) is missing"
                    )
                    yield self.report(call.command.name_location, message)


def _names_found(cmake: CMakeLists) -> set[str] | None:
    """Return what is found; ``None`` if a name is not known."""
    names: set[str] = set()
    for command in cmake.find("find_package"):
        expanded = cmake.expand_list(command.arguments[:1], command)
        if not expanded and not any(package.command is command for package in cmake.found_packages):
            return None
    names.update(package.name for package in cmake.found_packages)
    return names


def _available(package: Package, required: set[str] | None) -> set[str] | None:
    """Return what is found, with what comes along; ``None`` if more may come along."""
    if required is None:
        return None
    definitions = package.workspace.interfaces
    there: set[str] = set()
    pending = sorted(required)
    while pending:
        name = pending.pop()
        if name in there:
            continue
        there.add(name)
        if name.startswith(_TOOLS):
            continue
        pending += sorted(transitive_dependencies({name}))
        interfaces = [(kind, definitions.names(name, kind)) for kind in KINDS]
        if name in required and not any(names for _, names in interfaces):
            return None
        pending += _declared(package, name)
        for kind, names in interfaces:
            for item in names or ():
                interface = definitions.find(f"{name}/{kind}/{item}")
                for section in interface.sections if interface else ():
                    pending += [field.type.package or "" for field in section.fields]
    return there


def _declared(package: Package, name: str) -> list[str]:
    """Return the DEPENDENCIES of another package of the workspace."""
    other = package.workspace.get(name)
    try:
        calls = generations(other) if other is not None else []
    except ViewError:
        return []
    return [dependency for call in calls for dependency in call.dependencies or ()]
