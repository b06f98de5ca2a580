"""CM020: package.xml declares what CMakeLists.txt finds."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.api import (
    Diagnostic,
    Effect,
    Example,
    Fix,
    Package,
    Report,
    Rule,
    Severity,
    ViewError,
    closure,
)
from scaffold.api.catalog import ROS_PACKAGES, transitive_dependencies
from scaffold.api.cmake import FoundPackage
from scaffold.api.distributions import removed_package, target
from scaffold.api.manifest import brought_by, declared, declaring

_MANIFEST = '<package format="3">\n  <name>talker</name>\n  <depend>rclcpp</depend>\n{}</package>\n'
_LISTS = "project(talker)\nfind_package(rclcpp REQUIRED)\nfind_package({} REQUIRED)\n"
_ELSEWHERE = (
    '<package format="3">\n  <name>talker</name>\n{}'
    '  <depend condition="$ROS_DISTRO == humble">rclcpp</depend>\n'
    '  <depend condition="$SIMULATION == yes">nav_msgs</depend>\n</package>\n'
)
_MANIFEST_RUN_ONLY = '<package format="3">\n  <name>talker</name>\n{}</package>\n'
_LISTS_RUN_ONLY = "project(talker)\nfind_package(std_msgs REQUIRED)\n"
_EXEC = "  <exec_depend>std_msgs</exec_depend>\n"
_HOLDING = frozenset({"BUILD_TESTING", "UNIX", "LINUX", "TRUE", "ON", "1"}) | frozenset(
    {"NOT", "AND", "OR", "WIN32", "APPLE", "MSVC", "ANDROID", "CMAKE_CROSSCOMPILING"}
)
"""Words of conditions that hold on the platform of ROS 2, by default."""
_OF_DISTRIBUTION = re.compile(r"ROS_DISTRO|rclcpp_VERSION|ROS_VERSION|ament_cmake_VERSION")
"""Matches what is asked for in conditions on the distribution, which are decided."""


class FoundUndeclared(Rule):
    """``find_package`` names a ROS package that package.xml does not declare for the build.

    **Why.** On a clean machine rosdep does not install it and CMake stops; colcon may build the two
    packages in the wrong order. The build farm does not install run dependencies before the build.

    **Fix.** Add a ``<build_depend>``, or a ``<test_depend>`` if only tests need it. If the
    condition of an existing dependency excludes the distribution, change the condition. Pure Python
    packages need no ``find_package``.

    **Source.** ROS 2 documentation, "ament_cmake user documentation"; REP 149; bloom, whose
    ``Build-Depends`` are those of ``buildtool_depend``, ``build_depend``, ``depend`` and
    ``test_depend``.
    """

    code = "CM020"
    name = "found-undeclared"
    effect = Effect.STOPS_BUILD
    release_refused = "the build farm does not install the package before it builds"
    other_severities = {
        Severity.WARNING: "it is declared as a run dependency only; or it is only looked for "
        "under a condition that need not hold; or an unknown dependency, or one of several, may "
        "bring it"
    }
    examples = (
        Example(
            "declared, and a library whose rosdep key may differ",
            {
                "package.xml": _MANIFEST.format("  <depend>std_msgs</depend>\n"),
                "CMakeLists.txt": _LISTS.format("std_msgs") + "find_package(Eigen3 REQUIRED)\n",
            },
        ),
        Example(
            "a system library",
            {
                "package.xml": _MANIFEST.format("  <depend>liboctomap-dev</depend>\n"),
                "CMakeLists.txt": _LISTS.format("octomap"),
            },
        ),
        Example(
            "transitive dependency of a metapackage",
            {
                "package.xml": _MANIFEST.format("  <depend>common_interfaces</depend>\n"),
                "CMakeLists.txt": _LISTS.format("std_srvs"),
            },
        ),
        Example(
            "transitive dependency of the generators of interfaces",
            {
                "package.xml": _MANIFEST.format(
                    "  <build_depend>rosidl_default_generators</build_depend>\n"
                ),
                "CMakeLists.txt": _LISTS.format("action_msgs"),
            },
        ),
        Example(
            "transitive dependency of a package of the workspace",
            {
                "package.xml": _MANIFEST.format("  <depend>common</depend>\n"),
                "CMakeLists.txt": _LISTS.format("nav_msgs"),
            },
            neighbors={
                "common": {
                    "package.xml": '<package format="3">\n  <name>common</name>\n'
                    "  <depend>nav_msgs</depend>\n</package>\n"
                }
            },
        ),
        Example(
            "a tool that a package of the workspace is built with",
            {
                "package.xml": _MANIFEST.format("  <depend>my_msgs</depend>\n"),
                "CMakeLists.txt": _LISTS.format("rosidl_default_generators"),
            },
            neighbors={
                "my_msgs": {
                    "package.xml": '<package format="3">\n  <name>my_msgs</name>\n'
                    "  <buildtool_depend>rosidl_default_generators</buildtool_depend>\n</package>\n"
                }
            },
        ),
        Example(
            "found only if an option is on",
            {
                "package.xml": _MANIFEST.format(""),
                "CMakeLists.txt": "project(talker)\nfind_package(rclcpp REQUIRED)\n"
                'option(CHECK_TIDY "Run clang-tidy" OFF)\nif(CHECK_TIDY)\n'
                "  find_package(ament_cmake_clang_tidy REQUIRED)\nendif()\n",
            },
        ),
        Example(
            "found in an installed function that only other packages call",
            {
                "package.xml": _MANIFEST.format(""),
                "CMakeLists.txt": "project(talker)\nfind_package(rclcpp REQUIRED)\n"
                "include(cmake/talker_lint.cmake)\n",
                "cmake/talker_lint.cmake": "function(talker_lint)\n"
                "  find_package(ament_cmake_clang_tidy REQUIRED)\nendfunction()\n",
            },
        ),
        Example(
            "looked for with one version of Gazebo only",
            {
                "package.xml": _MANIFEST.format(""),
                "CMakeLists.txt": "project(talker)\nfind_package(rclcpp REQUIRED)\n"
                'if("$ENV{GZ_VERSION}" STREQUAL "harmonic")\n'
                "  find_package(ros_gz_bridge REQUIRED)\nendif()\n",
            },
            Report(
                "CMakeLists.txt:4:16",
                "finds 'ros_gz_bridge', which package.xml does not declare; add "
                "<build_depend>ros_gz_bridge</build_depend>",
                fix="Declare ros_gz_bridge",
                severity=Severity.WARNING,
            ),
            fixed={
                "package.xml": _MANIFEST.format("").replace(
                    "  <depend>rclcpp</depend>\n",
                    "  <build_depend>ros_gz_bridge</build_depend>\n  <depend>rclcpp</depend>\n",
                )
            },
        ),
        Example(
            "declared for another distribution",
            {
                "package.xml": _ELSEWHERE.format(""),
                "CMakeLists.txt": _LISTS.format("nav_msgs")
                + "if(USES_NODES)\n  find_package(rclcpp REQUIRED)\nendif()\n",
            },
            "CMakeLists.txt:2:14: finds 'rclcpp', and line 3 of package.xml declares it only if "
            "$ROS_DISTRO == humble, which excludes Jazzy; change the condition, or call "
            "find_package under the same one",
        ),
        Example(
            "transitive dependency of a dependency for another distribution",
            {
                "package.xml": _ELSEWHERE.format(""),
                "CMakeLists.txt": "project(talker)\nfind_package(rcl_interfaces REQUIRED)\n",
            },
            Report(
                "CMakeLists.txt:2:14",
                "finds 'rcl_interfaces', which package.xml does not declare; add "
                "<build_depend>rcl_interfaces</build_depend>",
                fix="Declare rcl_interfaces",
            ),
            fixed={
                "package.xml": _ELSEWHERE.format("  <build_depend>rcl_interfaces</build_depend>\n")
            },
        ),
        Example(
            "messages that unknown messages may bring",
            {
                "package.xml": _MANIFEST.format("  <depend>arm_msgs</depend>\n"),
                "CMakeLists.txt": _LISTS.format("std_msgs"),
            },
            Report(
                "CMakeLists.txt:3:14",
                "finds 'std_msgs', which package.xml does not declare; add "
                "<build_depend>std_msgs</build_depend>",
                fix="Declare std_msgs",
                severity=Severity.WARNING,
            ),
            fixed={
                "package.xml": _MANIFEST.format("  <depend>arm_msgs</depend>\n").replace(
                    "  <depend>rclcpp</depend>\n",
                    "  <build_depend>std_msgs</build_depend>\n  <depend>rclcpp</depend>\n",
                )
            },
        ),
        Example(
            "a library that one of several unknown packages may bring",
            {
                "package.xml": _MANIFEST.format(
                    "  <depend>arm_driver</depend>\n  <depend>hand_control</depend>\n"
                ),
                "CMakeLists.txt": _LISTS.format("tf2_ros"),
            },
            Report(
                "CMakeLists.txt:3:14",
                "finds 'tf2_ros', which package.xml does not declare; add "
                "<build_depend>tf2_ros</build_depend>",
                fix="Declare tf2_ros",
                severity=Severity.WARNING,
            ),
            fixed={
                "package.xml": _MANIFEST.format(
                    "  <depend>arm_driver</depend>\n  <depend>hand_control</depend>\n"
                ).replace(
                    "  <depend>rclcpp</depend>\n",
                    "  <build_depend>tf2_ros</build_depend>\n  <depend>rclcpp</depend>\n",
                )
            },
        ),
        Example(
            "not declared",
            {"package.xml": _MANIFEST.format(""), "CMakeLists.txt": _LISTS.format("std_msgs")},
            Report(
                "CMakeLists.txt:3:14",
                "finds 'std_msgs', which package.xml does not declare; add "
                "<build_depend>std_msgs</build_depend>",
                fix="Declare std_msgs",
            ),
            fixed={
                "package.xml": _MANIFEST.format("").replace(
                    "  <depend>rclcpp</depend>\n",
                    "  <build_depend>std_msgs</build_depend>\n  <depend>rclcpp</depend>\n",
                )
            },
        ),
        Example(
            "ament_cmake, which every package needs",
            {
                "package.xml": '<package format="3">\n  <name>talker</name>\n</package>\n',
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake)\n",
            },
            Report(
                "CMakeLists.txt:2:14",
                "finds 'ament_cmake', which package.xml does not declare; add "
                "<buildtool_depend>ament_cmake</buildtool_depend>",
                fix="Declare ament_cmake",
            ),
            fixed={
                "package.xml": '<package format="3">\n  <name>talker</name>\n'
                "  <buildtool_depend>ament_cmake</buildtool_depend>\n</package>\n"
            },
        ),
        Example(
            "declared for the build",
            {
                "package.xml": _MANIFEST_RUN_ONLY.format("  <depend>std_msgs</depend>\n"),
                "CMakeLists.txt": _LISTS_RUN_ONLY,
            },
        ),
        Example(
            "transitive dependency of a build dependency",
            {
                "package.xml": _MANIFEST_RUN_ONLY.format(
                    "  <depend>sensor_msgs</depend>\n" + _EXEC
                ),
                "CMakeLists.txt": _LISTS_RUN_ONLY,
            },
        ),
        Example(
            "found only where it is installed",
            {
                "package.xml": _MANIFEST_RUN_ONLY.format(_EXEC),
                "CMakeLists.txt": "project(talker)\nfind_package(std_msgs)\n",
            },
        ),
        Example(
            "declared for run time",
            {"package.xml": _MANIFEST_RUN_ONLY.format(_EXEC), "CMakeLists.txt": _LISTS_RUN_ONLY},
            Report(
                "package.xml:3:3",
                "<exec_depend> 'std_msgs' is not installed when the package is built, "
                "but CMakeLists.txt, line 2 finds it; add <build_depend>",
                fix="Add a <build_depend> of std_msgs",
                severity=Severity.WARNING,
            ),
            fixed={
                "package.xml": _MANIFEST_RUN_ONLY.format(
                    "  <build_depend>std_msgs</build_depend>\n" + _EXEC
                )
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_run_only(package)
        manifest = package.manifest
        dependencies = declared(package, for_tests=True)
        reported: set[str] = set()
        always_first = sorted(
            _undeclared(package), key=lambda found: not _is_always_found(package, found)
        )
        for found in always_first:
            name = found.name
            is_used = name == "ament_cmake" and not found.command.has("QUIET")
            is_required = found.required or is_used
            if name in reported or not is_required or package.cmake.is_off(found.command):
                continue
            other = manifest.left_out({name}, "build", "build_export", "run", "test")
            if other is not None:
                if [*package.cmake.conditions(found.command)]:
                    continue  # which may hold where the dependency is installed
                reported.add(name)
                message = (
                    f"finds {name!r}, and line {other.location.line} of package.xml declares it "
                    f"only if {other.condition}, which excludes {target().title}; change the "
                    f"condition, or call find_package under the same one"
                )
                yield self.report(found, message)
                continue
            reported.add(name)
            needed = declaring(package, _tag(found), name)
            message = f"finds {name!r}, which package.xml does not declare; {needed.advice}"
            is_certain = _is_always_found(package, found)
            is_certain = is_certain and not dependencies.may_use(package, name)
            severity = None if is_certain else Severity.WARNING
            cause = f"dependency {name}"
            yield self.report(found, message, needed.fix, severity=severity, cause=cause)

    def _check_run_only(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        kinds: dict[str, set[str]] = {}
        for dependency in manifest.dependencies:
            kinds.setdefault(dependency.name, set()).add(dependency.kind)
        only = {name for name, item in kinds.items() if item == {"exec_depend"}}
        along = _transitive_dependencies(package) if only else set()
        for found_package in package.cmake.found_packages:
            name = found_package.name
            if (
                name not in only
                or name in along
                or not found_package.required
                or found_package.command.blocks
            ):
                continue
            if name not in ROS_PACKAGES and package.workspace.get(name) is None:
                continue
            only.remove(name)
            element = next(
                dependency for dependency in manifest.dependencies if dependency.name == name
            ).element
            message = (
                f"<exec_depend> {name!r} is not installed when the package is built, but "
                f"CMakeLists.txt, line {found_package.location.line} finds it; add <build_depend>"
            )
            fix = Fix(f"Add a <build_depend> of {name}", (manifest.insert("build_depend", name),))
            yield self.report(element, message, fix, severity=Severity.WARNING)


def _undeclared(package: Package) -> Iterator[FoundPackage]:
    """Yield the ROS packages that are searched for and that no dependency provides."""
    direct = {item.name for item in package.manifest.dependencies if item.may_be_active}
    dependencies = declared(package, for_tests=True)
    names = {package.name, *direct, *transitive_dependencies(direct), *dependencies.along}
    names |= dependencies.direct | _built_with(package)
    for found in package.cmake.found_packages:
        name, neighbor = found.name, package.workspace.get(found.name)
        if not package.cmake.is_called(found.command):
            continue  # other packages call the function, which is installed
        if name == "rosidl_default_generators" and package.cmake.find("rosidl_generate_interfaces"):
            continue  # interface-declarations-missing reports it, with other missing ones
        if name in names or f"lib{name}-dev" in direct:  # the system package that contains it
            continue
        if neighbor is None and (name not in ROS_PACKAGES or removed_package(name)):
            continue  # unknown, or reported by package-removed
        yield found


def _built_with(package: Package) -> set[str]:
    """Return what the declared packages of the workspace are built with, which is installed."""
    result: set[str] = set()
    for dependency in package.manifest.dependencies:
        neighbor = package.workspace.get(dependency.name)
        try:
            others = neighbor.manifest.dependencies if neighbor is not None else ()
        except ViewError:
            continue
        result |= {other.name for other in others if other.kind.startswith("build")}
    return result | transitive_dependencies(result)


def _is_always_found(package: Package, found: FoundPackage) -> bool:
    """Return whether no condition on a variable decides whether a package is searched for."""
    options = [command.values for command in package.cmake.find("option")]
    holding = {*_HOLDING, *(values[0] for values in options if values[2:] == ["ON"])}
    asked = [*package.cmake.conditions(found.command)]
    words = {word for condition in asked for word in condition}
    return words <= holding or any(map(_OF_DISTRIBUTION.search, words))


def _tag(found: FoundPackage) -> str:
    if found.in_testing:
        return "test_depend"
    is_tool = found.name.startswith(("ament_cmake", "rosidl_default_generators"))
    return "buildtool_depend" if is_tool else "build_depend"


def _transitive_dependencies(package: Package) -> set[str]:
    """Return the transitive build and test dependencies."""
    manifest = package.manifest
    tools = {item.name for item in manifest.dependencies if item.kind.startswith("buildtool")}
    direct = manifest.build_names | manifest.test_names | tools
    result = direct | closure(direct, lambda name: brought_by(package, name))
    # A package with messages depends on everything that is needed to use them.
    return result | transitive_dependencies(result) | {"rosidl_default_runtime"}
