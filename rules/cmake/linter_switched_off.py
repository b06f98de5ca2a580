"""CM027: linters that are declared run."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity

_LISTS = (
    "project(talker)\nif(BUILD_TESTING)\n{}  ament_lint_auto_find_test_dependencies()\nendif()\n"
)


class LinterSwitchedOff(Rule):
    """A line disables a linter by marking it as already found.

    **Why.** ``ros2 pkg create`` writes it with the advice to remove it: until then missing license
    headers pass ``colcon test``.

    **Fix.** Remove the line, once every source file has its header.

    **Source.** ``ros2pkg/resource/ament_cmake/CMakeLists.txt.em``.
    """

    code = "CM027"
    name = "linter-switched-off"
    severity = Severity.INFO
    examples = (
        Example("all linters run", {"CMakeLists.txt": _LISTS.format("")}),
        Example(
            "as written by ros2 pkg create",
            {"CMakeLists.txt": _LISTS.format("  set(ament_cmake_copyright_FOUND TRUE)\n")},
            Report("3:3", "disables ament_cmake_copyright: it never runs"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for command in package.cmake.find("set"):
            name, *values = command.values or [""]
            if not (name.startswith("ament_cmake_") and name.endswith("_FOUND")):
                continue
            if [value.upper() for value in values[:1]] in (["TRUE"], ["ON"], ["1"], ["YES"]):
                linter = name.removesuffix("_FOUND")
                yield self.report(command.name_location, f"disables {linter}: it never runs")
