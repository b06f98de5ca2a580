"""CM112: CMake accepts the commands about targets, in their order and form."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Rule
from scaffold.api.catalog import is_released
from scaffold.api.cmake import Argument, CMakeLists, Command, has_unknown_commands

from ._packages_found import packages_found
from ._targets import DEFINING

_CONFIGURING = (
    "ament_target_dependencies",
    "set_target_properties",
    "target_compile_definitions",
    "target_compile_features",
    "target_compile_options",
    "target_include_directories",
    "target_link_libraries",
    "target_link_options",
    "target_sources",
)
"""Commands whose first argument is a target that has to exist already."""
_SCOPES = frozenset({"PUBLIC", "PRIVATE", "INTERFACE"})
_AMENT = "ament_target_dependencies"
_KEYWORDS = frozenset({"PUBLIC", "INTERFACE", "SYSTEM"})
_LOOSE = frozenset({"foreach", "function", "macro", "while"})
"""Blocks that run several times, or later."""
_MANIFEST = '<package format="3"><name>talker</name></package>\n'
_LISTS = (
    "project(talker)\nfind_package(ament_cmake REQUIRED)\nfind_package(rclcpp REQUIRED)\n"
    "{}ament_package()\n"
)
_ADD = "add_executable(talk src/talk.cpp)\n"
_USE = "ament_target_dependencies(talk rclcpp)\n"
_FILES = {"src/talk.cpp": "int main() {}\n"}


def _files(commands: str) -> dict[str, str]:
    return {"CMakeLists.txt": _LISTS.format(commands), "package.xml": _MANIFEST, **_FILES}


class TargetCommandRejected(Rule):
    """A command uses a target, export set or package in a way that CMake does not accept.

    The target is only defined later, the calls of ``target_link_libraries`` mix the forms with and
    without ``PUBLIC`` or ``PRIVATE``, no ``install`` defines the exported set, or no
    ``find_package`` call finds the package.

    **Why.** CMake stops: ``Cannot specify include directories for target "talk" which is not built
    by this project``, ``All uses of target_link_libraries with a target must be either all-keyword
    or all-plain``, ``INSTALL(EXPORT) given unknown export``, ``the passed package name 'nav_msgs'
    was not found before``.

    **Fix.** Define the target first, use one form, install targets with ``EXPORT``, find each
    package. ``ament_target_dependencies`` uses the form without keywords, unless its list starts
    with ``PUBLIC``.

    **Source.** CMake documentation, ``target_link_libraries``, ``CMP0023``;
    ``ament_cmake_target_dependencies/cmake/ament_target_dependencies.cmake``;
    ``ament_cmake_export_targets``.
    """

    code = "CM112"
    name = "target-command-rejected"
    effect = Effect.STOPS_BUILD
    examples = (
        Example("defined first", _files(_ADD + _USE)),
        Example(
            "defined later",
            _files(_USE + _ADD),
            "CMakeLists.txt:4:27: target 'talk' is only defined in line 5: CMake stops; move this "
            "call after it",
        ),
        Example(
            "installed before it is defined",
            _files(f"install(TARGETS talk DESTINATION lib/${{PROJECT_NAME}})\n{_ADD}"),
            "CMakeLists.txt:4:17: target 'talk' is only defined in line 5: CMake stops; move this "
            "call after it",
        ),
        Example(
            "one form, and another one in a branch that excludes it",
            _files(
                f"{_ADD}if(WIN32)\n  target_link_libraries(talk m)\nelse()\n"
                "  target_link_libraries(talk PRIVATE m)\nendif()\n"
            ),
        ),
        Example(
            "both forms",
            _files(f"{_ADD}{_USE}target_link_libraries(talk PRIVATE m)\n"),
            "CMakeLists.txt:6:1: links 'talk' with PUBLIC or PRIVATE, ament_target_dependencies() "
            "in line 5 without PUBLIC or PRIVATE: CMake stops; use one form",
        ),
        Example(
            "both forms, the one with keywords first",
            _files(f"{_ADD}target_link_libraries(talk PUBLIC m)\n{_USE}"),
            "CMakeLists.txt:6:1: links 'talk' without PUBLIC or PRIVATE, target_link_libraries() "
            "in line 5 with PUBLIC or PRIVATE: CMake stops; use one form",
        ),
        Example(
            "an installed export set",
            _files(
                "add_library(talking src/talk.cpp)\n"
                "install(TARGETS talking EXPORT export_talker DESTINATION lib)\n"
                "ament_export_targets(export_talker)\n"
            ),
        ),
        Example(
            "an export set that nothing defines",
            _files(
                "add_library(talking src/talk.cpp)\n"
                "install(TARGETS talking DESTINATION lib)\n"
                "ament_export_targets(export_talker)\n"
            ),
            "CMakeLists.txt:6:22: no install(TARGETS ... EXPORT export_talker) defines the export "
            "set 'export_talker': CMake stops",
        ),
        Example(
            "a package that a found one needs",
            _files(
                f"find_package(sensor_msgs REQUIRED)\n{_ADD}"
                "ament_target_dependencies(talk rclcpp std_msgs)\n"
            ),
        ),
        Example(
            "packages that an unknown one may find",
            _files(
                f"find_package(talk_common REQUIRED)\n{_ADD}"
                "ament_target_dependencies(talk rclcpp nav_msgs)\n"
            ),
        ),
        Example(
            "a package that is not found",
            _files(f"{_ADD}ament_target_dependencies(talk PUBLIC rclcpp nav_msgs)\n"),
            "CMakeLists.txt:5:46: no find_package(nav_msgs) call comes before this one: CMake "
            "stops; add find_package(nav_msgs REQUIRED)",
        ),
        Example(
            "a package that is found later",
            _files(
                f"{_ADD}ament_target_dependencies(talk rclcpp nav_msgs)\n"
                "find_package(nav_msgs REQUIRED)\n"
            ),
            "CMakeLists.txt:5:39: no find_package(nav_msgs) call comes before this one: CMake "
            "stops; add find_package(nav_msgs REQUIRED)",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        yield from self._check_forms(cmake)
        if not has_unknown_commands(package):
            yield from self._check_order(cmake)
            yield from self._check_exports(cmake)
            yield from self._check_found(package)

    def _check_order(self, cmake: CMakeLists) -> Iterator[Diagnostic]:
        """Report targets that are used before the only command that defines them."""
        places: dict[str, list[Command]] = {}
        for command in cmake.find(*DEFINING):
            name = cmake.expand(command.arguments[0], command) if command.arguments else None
            if name is None:
                return
            places.setdefault(name, []).append(command)
        for command, argument in _uses(cmake):
            name = cmake.expand(argument, command) or ""
            later = places.get(name, ())
            if command.blocks or not later or any(item.index < command.index for item in later):
                continue
            message = (
                f"target {name!r} is only defined in line {later[0].location.line}: CMake stops; "
                f"move this call after it"
            )
            yield self.report(argument, message)

    def _check_forms(self, cmake: CMakeLists) -> Iterator[Diagnostic]:
        """Report targets that are linked with and without keywords in the same block."""
        first: dict[tuple[str, int], tuple[Command, bool]] = {}
        for command in cmake.find("target_link_libraries", _AMENT):
            has_keyword = _has_keyword(command)
            name = cmake.expand(command.arguments[0], command) if command.arguments else None
            if name is None or has_keyword is None or _is_loose(command):
                continue
            block = command.branch.index if command.branch else -1
            other, form = first.setdefault((name, block), (command, has_keyword))
            if form != has_keyword:
                forms = ("with PUBLIC or PRIVATE", "without PUBLIC or PRIVATE")
                mine, theirs = forms if has_keyword else forms[::-1]
                message = (
                    f"links {name!r} {mine}, {other.name}() in line {other.location.line} "
                    f"{theirs}: CMake stops; use one form"
                )
                yield self.report(command.name_location, message)

    def _check_exports(self, cmake: CMakeLists) -> Iterator[Diagnostic]:
        """Report exported sets that no ``install`` defines."""
        if cmake.find("rosidl_generate_interfaces", "ament_auto_package"):
            return
        defined: set[str | None] = set()
        for command in cmake.find("install"):
            for argument, following in zip(command.arguments, command.arguments[1:], strict=False):
                if argument.value == "EXPORT":
                    defined.add(cmake.expand(following, command))
        for command in cmake.find("ament_export_targets"):
            for argument in command.arguments:
                name = cmake.expand(argument, command)
                if name in {None, "", "HAS_LIBRARY_TARGET"} or {None, name} & defined:
                    continue
                message = (
                    f"no install(TARGETS ... EXPORT {name}) defines the export set {name!r}: "
                    f"CMake stops"
                )
                yield self.report(argument, message)

    def _check_found(self, package: Package) -> Iterator[Diagnostic]:
        """Report packages that no ``find_package`` call before them finds."""
        cmake = package.cmake
        if cmake.finds_automatically or cmake.finds_tests_automatically:
            return
        if cmake.has_unknown_packages:
            return
        for command in cmake.find(_AMENT):
            found = packages_found(package, None if _is_loose(command) else command.index)
            if found is None or not cmake.is_called(command):
                continue
            for argument in command.arguments[1:]:
                for name in cmake.values_of(argument, command):
                    if name in found or name in _KEYWORDS:
                        continue
                    if is_released(name) or package.workspace.get(name) is not None:
                        message = (
                            f"no find_package({name}) call comes before this one: CMake stops; "
                            f"add find_package({name} REQUIRED)"
                        )
                        yield self.report(argument, message)


def _uses(cmake: CMakeLists) -> Iterator[tuple[Command, Argument]]:
    """Yield the commands that need existing targets, with each target."""
    for command in cmake.find(*_CONFIGURING, "install"):
        targets = command.arguments[:1]
        if command.name == "set_target_properties":
            targets = command.sections({"PROPERTIES"})[""]
        elif command.name == "install":
            is_of_targets = command.values[:1] == ["TARGETS"]
            targets = command.arguments[1:] if is_of_targets else []
        for target in targets:
            yield command, target


def _has_keyword(command: Command) -> bool | None:
    """Return whether a command links with ``PUBLIC`` or similar; ``None`` if unknown."""
    words = command.values[1:]
    if command.name == _AMENT:
        return not {"PUBLIC", "INTERFACE"}.isdisjoint(words[:2]) if words else None
    if not words or (words[0].startswith("${") and not words[0].endswith(("S}", "s}"))):
        return None
    return words[0] in _SCOPES


def _is_loose(command: Command) -> bool:
    return any(block.name in _LOOSE for block in command.blocks)
