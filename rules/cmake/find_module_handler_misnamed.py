"""CM082: a find module reports under the name of its file."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.ament import lint_cmake

INCLUDE = "include(FindPackageHandleStandardArgs)\n"


class FindModuleHandlerMisnamed(Rule):
    """``find_package_handle_standard_args()`` gets another name than that of the find module.

    **Why.** ``find_package()`` looks at ``<file name>_FOUND``; another variable does not reach
    it. ``ament_lint_cmake`` fails under ``colcon test``, and it wants upper case.

    **Fix.** Give the name of the file, in upper case.

    **Source.** ament_lint_cmake, filter ``package/stdargs``.
    """

    code = "CM082"
    name = "find-module-handler-misnamed"
    severity = Severity.WARNING
    examples = (
        Example(
            "the file's name",
            {"cmake/FindFOO.cmake": INCLUDE + "find_package_handle_standard_args(FOO FOO_LIB)\n"},
        ),
        Example(
            "another name",
            {"cmake/FindFOO.cmake": INCLUDE + "find_package_handle_standard_args(BAR BAR_LIB)\n"},
            reports=(
                Report(
                    "cmake/FindFOO.cmake:2:1", "BAR is handed over in FindFOO.cmake: expected FOO"
                ),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for found in lint_cmake.findings(package, "package/stdargs"):
            given, _, expected = found.said.partition(" ")
            name = found.source.path.rpartition("/")[2]
            yield self.report(found, f"{given} is handed over in {name}: expected {expected}")
