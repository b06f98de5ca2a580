"""CM030: executables are installed."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.api.cmake import has_unknown_commands

_LISTS = (
    "project(talker)\nfind_package(ament_cmake REQUIRED)\nadd_executable(talk src/talk.cpp)\n"
    "add_executable(listen src/listen.cpp)\n"
    "install(TARGETS talk {}DESTINATION lib/${{PROJECT_NAME}})\nament_package()\n"
)


class TargetNotInstalled(Rule):
    """An executable is built, but not installed.

    **Why.** ``ros2 run`` answers ``No executable found``.

    **Fix.** Add it to ``install(TARGETS ... DESTINATION lib/${PROJECT_NAME})``.

    **Source.** ROS 2 documentation, "ament_cmake user documentation"; catkin_lint, "target is not
    installed".
    """

    code = "CM030"
    name = "target-not-installed"
    examples = (
        Example("both", {"CMakeLists.txt": _LISTS.format("listen ")}),
        Example(
            "one is forgotten",
            {"CMakeLists.txt": _LISTS.format("")},
            "4:16: 'listen' is built, but not installed",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        if not cmake.find("ament_package") or has_unknown_commands(package):
            return
        targets = [install for install in cmake.installs if install.kind == "TARGETS"]
        installed = {item.value for target in targets for item in target.items}
        # An application that installs nothing at all has not forgotten this one.
        if not installed or None in installed:
            return
        for command in cmake.find("add_executable"):
            if command.blocks or not command.arguments or cmake.guarded_by_testing(command):
                continue
            name = cmake.expand(command.arguments[0], command)
            kinds = set(command.values[1:2])
            if (
                name is None
                or name in installed
                or kinds & {"IMPORTED", "ALIAS", "EXCLUDE_FROM_ALL"}
            ):
                continue
            if self._is_used(package, name) or "test" in name or "benchmark" in name:
                continue
            yield self.report(command.arguments[0], f"{name!r} is built, but not installed")

    def _is_used(self, package: Package, name: str) -> bool:
        """Tell whether the build itself runs or installs the executable."""
        ways = (
            "add_custom_command",
            "add_custom_target",
            "rclcpp_components_register_node",
            "install",
            "add_test",
            "add_dependencies",
        )
        return any(
            name in value.split(":") or f"TARGET_FILE:{name}" in value
            for command in package.cmake.find(*ways)
            for value in command.values
        )
