"""CM064: what the types of fields come from is among the DEPENDENCIES."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Report, Rule
from scaffold.api.cmake import Generation, generations
from scaffold.api.interfaces import KINDS, Definitions, interface_files

_LISTS = (
    "project(my_msgs)\nfind_package(geometry_msgs REQUIRED)\nfind_package(std_msgs REQUIRED)\n"
    "rosidl_generate_interfaces(${PROJECT_NAME} msg/Beat.msg %s)\n"
)
_FILES = {"msg/Beat.msg": "std_msgs/Header header\ngeometry_msgs/Point point\n"}


class InterfaceDependencyMissing(Rule):
    """A field has a type of a package that is not among the ``DEPENDENCIES``.

    **Why.** The build stops: the generators do not find the definition of the type.

    **Fix.** Call ``find_package`` for the package and add it to ``DEPENDENCIES``.

    **Source.** ``rosidl_cmake/cmake/rosidl_generate_interfaces.cmake``: DEPENDENCIES are "the
    packages from which message types are being used".
    """

    code = "CM064"
    name = "interface-dependency-missing"
    effect = Effect.STOPS_BUILD
    examples = (
        Example(
            "geometry_msgs brings std_msgs along",
            {"CMakeLists.txt": _LISTS % "DEPENDENCIES geometry_msgs", **_FILES},
        ),
        Example(
            "no DEPENDENCIES; one that is not enough",
            {"CMakeLists.txt": _LISTS % "", **_FILES},
            Report(
                "CMakeLists.txt:4:1",
                "msg/Beat.msg:1 uses a type of 'std_msgs', which is not among the "
                "DEPENDENCIES: add it",
            ),
            Report(
                "CMakeLists.txt:4:1",
                "msg/Beat.msg:2 uses a type of 'geometry_msgs', which is not among "
                "the DEPENDENCIES: add it",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        definitions = package.workspace.interfaces
        for call in generations(package):
            if call.dependencies is None:
                continue
            there = _reached(definitions, call.dependencies)
            if there is None:
                continue
            for name, path, line in _used(package, call):
                if name not in {*there, package.name}:
                    message = (
                        f"{path}:{line} uses a type of {name!r}, which is not among the "
                        "DEPENDENCIES: add it"
                    )
                    yield self.report(call.command.name_location, message)


def _used(package: Package, call: Generation) -> Iterator[tuple[str, str, int]]:
    """Yield each package that the listed files use, with the first place."""
    listed = {file.path for file in call.files}
    seen: set[str] = set()
    for file in interface_files(package):
        for section in file.definition.sections if file.path in listed else ():
            for field in section.fields:
                name = field.type.package
                if name is not None and name not in seen:
                    seen.add(name)
                    yield name, file.path, field.location.line


def _reached(definitions: Definitions, names: list[str]) -> set[str] | None:
    """Return the packages that some packages use, themselves included; ``None``: not known."""
    result = {"service_msgs", "action_msgs", "builtin_interfaces", "unique_identifier_msgs"}
    pending = [*names]
    while pending:
        package = pending.pop()
        result.add(package)
        for kind in KINDS:
            interfaces = definitions.names(package, kind)
            if interfaces is None and package in names:
                return None
            for name in interfaces or ():
                interface = definitions.find(f"{package}/{kind}/{name}")
                for section in interface.sections if interface else ():
                    uses = {field.type.package for field in section.fields if field.type.package}
                    pending += [use for use in uses if use not in result and use not in pending]
    return result
