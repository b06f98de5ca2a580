"""CM099: linters that are looked for are run."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity

_LISTS = "project(talker)\nif(BUILD_TESTING)\n  find_package(ament_lint_auto REQUIRED)\n{}endif()\n"


class LintersNeverRun(Rule):
    """``ament_lint_auto`` is found, but its linters are not registered.

    **Why.** No linter runs under ``colcon test``, which passes.

    **Fix.** Call ``ament_lint_auto_find_test_dependencies()`` after ``find_package``.

    **Source.** ``ament_lint_auto/cmake/ament_lint_auto_find_test_dependencies.cmake``.
    """

    code = "CM099"
    name = "linters-never-run"
    severity = Severity.WARNING
    examples = (
        Example(
            "registered",
            {"CMakeLists.txt": _LISTS.format("  ament_lint_auto_find_test_dependencies()\n")},
        ),
        Example(
            "found only",
            {"CMakeLists.txt": _LISTS.format("")},
            Report(
                "3:16", "no linter runs: ament_lint_auto_find_test_dependencies() is not called"
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        if cmake.find("ament_lint_auto_find_test_dependencies", "include", "add_subdirectory"):
            return
        if any(command.name.endswith("_package") for command in cmake.commands) and cmake.find(
            "autoware_package", "ament_auto_package"
        ):
            return
        for found_package in cmake.found_packages:
            if found_package.name == "ament_lint_auto":
                message = "no linter runs: ament_lint_auto_find_test_dependencies() is not called"
                yield self.report(found_package, message)
