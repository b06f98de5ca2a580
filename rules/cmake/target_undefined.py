"""CM031: commands are given targets that exist."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Rule, closest_name
from scaffold.api.cmake import (
    TAKING_TARGETS,
    defined_targets,
    has_unknown_commands,
    targets_named_once,
)

_LISTS = (
    "project(talker)\nadd_executable(talk src/talk.cpp)\nament_target_dependencies({} rclcpp)\n"
)


class TargetUndefined(Rule):
    """A command uses an undefined target.

    **Why.** CMake stops: the first argument must be a valid target name.

    **Fix.** Write the name of the target.

    **Source.** ``ament_cmake_target_dependencies/cmake/ament_target_dependencies.cmake``.
    """

    code = "CM031"
    name = "target-undefined"
    effect = Effect.STOPS_BUILD
    examples = (
        Example("defined", {"CMakeLists.txt": _LISTS.format("talk")}),
        Example(
            "not defined",
            {"CMakeLists.txt": _LISTS.format("talks")},
            "3:27: nothing defines the target 'talks'; closest: 'talk'",
        ),
        Example(
            "Python scripts are no targets",
            {
                "CMakeLists.txt": "project(talker)\n"
                "install(TARGETS talk listen DESTINATION lib/${PROJECT_NAME})\n",
                "talker/talk.py": "",
            },
            "CMakeLists.txt:2:17: nothing defines the target 'talk': CMake stops",
            "CMakeLists.txt:2:22: nothing defines the target 'listen': CMake stops",
        ),
        Example(
            "of an unknown command",
            {
                "CMakeLists.txt": "project(talker)\nfind_package(maker REQUIRED)\n"
                "make_some(talk)\ninstall(TARGETS talk DESTINATION lib/${PROJECT_NAME})\n"
            },
        ),
        Example(
            "not defined, but named elsewhere",
            {"CMakeLists.txt": _LISTS.format("talks") + "message(STATUS talks)\n"},
            "3:27: nothing defines the target 'talks'; closest: 'talk'",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        if has_unknown_commands(package) or cmake.find("function", "macro", "foreach"):
            return
        defined = defined_targets(cmake)
        if defined is None:
            return
        targets = sorted(defined)
        never_named = targets_named_once(cmake)
        for target, argument in never_named:
            closest = closest_name(package, target, targets, 0.75)
            hint = f"; closest: {closest!r}" if closest else ": CMake stops"
            yield self.report(argument, f"nothing defines the target {target!r}{hint}")
        reported = {target for target, _ in never_named}
        for command in cmake.find(*TAKING_TARGETS):
            name = cmake.expand(command.arguments[0], command) if command.arguments else None
            if name is None or name in defined | reported or "::" in name or command.blocks:
                continue
            closest = closest_name(package, name, targets, 0.75)
            if closest:
                message = f"nothing defines the target {name!r}; closest: {closest!r}"
                yield self.report(command.arguments[0], message)
