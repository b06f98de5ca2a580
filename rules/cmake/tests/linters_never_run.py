"""CM099: linters that are found also run."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity

_LISTS = "project(talker)\nif(BUILD_TESTING)\n  find_package(ament_lint_auto REQUIRED)\n{}endif()\n"
_LISTS_SWITCHED = (
    "project(talker)\nif(BUILD_TESTING)\n{}  ament_lint_auto_find_test_dependencies()\nendif()\n"
)


class LintersNeverRun(Rule):
    """``ament_lint_auto`` is found, but its linters are not registered, or one is disabled.

    **Why.** ``colcon test`` passes without running any linter. ``ros2 pkg create`` writes a line
    that disables a linter, with the advice to remove it: until then, missing license headers are
    not reported.

    **Fix.** Call ``ament_lint_auto_find_test_dependencies()`` after ``find_package``; remove the
    line that disables a linter once every source file has a license header.

    **Source.** ``ament_lint_auto/cmake/ament_lint_auto_find_test_dependencies.cmake``;
    ``ros2pkg/resource/ament_cmake/CMakeLists.txt.em``.
    """

    code = "CM099"
    name = "linters-never-run"
    severity = Severity.WARNING
    other_severities = {Severity.INFO: "a single linter is disabled"}
    examples = (
        Example(
            "registered",
            {"CMakeLists.txt": _LISTS.format("  ament_lint_auto_find_test_dependencies()\n")},
        ),
        Example(
            "found, but not registered",
            {"CMakeLists.txt": _LISTS.format("")},
            "3:16: no linter runs; call ament_lint_auto_find_test_dependencies()",
        ),
        Example("no linter disabled", {"CMakeLists.txt": _LISTS_SWITCHED.format("")}),
        Example(
            "a linter disabled by ros2 pkg create",
            {"CMakeLists.txt": _LISTS_SWITCHED.format("  set(ament_cmake_copyright_FOUND TRUE)\n")},
            Report(
                "3:3",
                "disables ament_cmake_copyright, so it never runs; remove this line",
                severity=Severity.INFO,
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_registered(package)
        yield from self._check_switched(package)

    def _check_registered(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        if cmake.find("ament_lint_auto_find_test_dependencies", "include", "add_subdirectory"):
            return
        if any(command.name.endswith("_package") for command in cmake.commands) and cmake.find(
            "autoware_package", "ament_auto_package"
        ):
            return
        for found_package in cmake.found_packages:
            if found_package.name == "ament_lint_auto":
                message = "no linter runs; call ament_lint_auto_find_test_dependencies()"
                yield self.report(found_package, message)

    def _check_switched(self, package: Package) -> Iterator[Diagnostic]:
        for command in package.cmake.find("set"):
            name, *values = command.values or [""]
            if not (name.startswith("ament_cmake_") and name.endswith("_FOUND")):
                continue
            if [value.upper() for value in values[:1]] in (["TRUE"], ["ON"], ["1"], ["YES"]):
                linter = name.removesuffix("_FOUND")
                message = f"disables {linter}, so it never runs; remove this line"
                yield self.report(command.name_location, message, severity=Severity.INFO)
