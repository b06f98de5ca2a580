"""CM020: what CMake finds is declared."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Fix, Package, Report, Rule
from scaffold.api.catalog import ROS_PACKAGES, transitive_dependencies
from scaffold.api.distributions import removed_package
from scaffold.api.manifest import requirements

_MANIFEST = '<package format="3">\n  <name>talker</name>\n  <depend>rclcpp</depend>\n{}</package>\n'
_LISTS = "project(talker)\nfind_package(rclcpp REQUIRED)\nfind_package({} REQUIRED)\n"


class FoundUndeclared(Rule):
    """``find_package`` looks for a ROS package that the manifest does not declare.

    **Why.** On a clean machine rosdep does not install it and CMake stops; colcon may build the
    two packages in the wrong order.

    **Fix.** Add a ``<build_depend>``, or a ``<test_depend>`` when it is found for tests only.

    **Source.** ROS 2 documentation, "ament_cmake user documentation"; REP-149.
    """

    code = "CM020"
    name = "found-undeclared"
    examples = (
        Example(
            "declared, and a library whose key may have another name",
            {
                "package.xml": _MANIFEST.format("  <depend>std_msgs</depend>\n"),
                "CMakeLists.txt": _LISTS.format("std_msgs") + "find_package(Eigen3 REQUIRED)\n",
            },
        ),
        Example(
            "a library of the system",
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
            neighbours={
                "common": {
                    "package.xml": '<package format="3">\n  <name>common</name>\n'
                    "  <depend>nav_msgs</depend>\n</package>\n"
                }
            },
        ),
        Example(
            "looked for only where an option is switched on",
            {
                "package.xml": _MANIFEST.format(""),
                "CMakeLists.txt": "project(talker)\nfind_package(rclcpp REQUIRED)\n"
                'option(CHECK_TIDY "Run clang-tidy" OFF)\nif(CHECK_TIDY)\n'
                "  find_package(ament_cmake_clang_tidy REQUIRED)\nendif()\n",
            },
        ),
        Example(
            "not declared",
            {"package.xml": _MANIFEST.format(""), "CMakeLists.txt": _LISTS.format("std_msgs")},
            Report(
                "CMakeLists.txt:3:14",
                "finds 'std_msgs', which no dependency in package.xml names; add "
                "<build_depend>std_msgs</build_depend>",
                fix="declare std_msgs",
            ),
            fixed={
                "package.xml": _MANIFEST.format("").replace(
                    "  <depend>rclcpp</depend>\n",
                    "  <build_depend>std_msgs</build_depend>\n  <depend>rclcpp</depend>\n",
                )
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        declared = manifest.declared_names
        there = requirements.declared(package, for_tests=True)
        along = transitive_dependencies(declared) | there.along | there.direct
        reported: set[str] = set()
        for found_package in package.cmake.found_packages:
            name = found_package.name
            if name == "rosidl_default_generators" and package.cmake.find(
                "rosidl_generate_interfaces"
            ):
                continue  # interface-declarations-missing says it, with what else is missing
            if name in reported or name in declared or name in along or name == package.name:
                continue
            if f"lib{name}-dev" in declared:
                continue  # the package of the system that has it
            if name not in ROS_PACKAGES and package.workspace.get(name) is None:
                continue
            if removed_package(name) and package.workspace.get(name) is None:
                continue  # package-removed says it
            if not found_package.required or package.cmake.is_off(found_package.command):
                continue
            reported.add(name)
            tag = "test_depend" if found_package.in_testing else "build_depend"
            if (
                name.startswith(("ament_cmake", "rosidl_default_generators"))
                and not found_package.in_testing
            ):
                tag = "buildtool_depend"
            message = (
                f"finds {name!r}, which no dependency in package.xml names; "
                f"add <{tag}>{name}</{tag}>"
            )
            fix = Fix(f"declare {name}", (manifest.insert(tag, name),))
            yield self.report(found_package, message, fix, cause=f"dependency {name}")
