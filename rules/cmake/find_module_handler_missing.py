"""CM081: a find module reports what it found by CMake's own function."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.ament import lint_cmake

INCLUDE = "include(FindPackageHandleStandardArgs)\n"
CALL = "find_package_handle_standard_args(FOO DEFAULT_MSG FOO_LIBRARY)\n"


class FindModuleHandlerMissing(Rule):
    """A find module does not use ``find_package_handle_standard_args()``.

    **Why.** ``REQUIRED`` and ``QUIET`` of ``find_package()`` have no effect without it, and
    ``ament_lint_cmake`` fails under ``colcon test``.

    **Fix.** ``include(FindPackageHandleStandardArgs)`` and call the function.

    **Source.** ament_lint_cmake, filter ``package/consistency``.
    """

    code = "CM081"
    name = "find-module-handler-missing"
    severity = Severity.WARNING
    examples = (
        Example("used", {"cmake/FindFOO.cmake": INCLUDE + CALL}),
        Example(
            "not included",
            {"cmake/FindFOO.cmake": CALL},
            reports=(
                Report(
                    "cmake/FindFOO.cmake:1:1",
                    "this find module never includes FindPackageHandleStandardArgs",
                ),
            ),
        ),
        Example(
            "not called",
            {"cmake/FindFOO.cmake": INCLUDE + "set(FOO_FOUND TRUE)\n"},
            reports=(
                Report(
                    "cmake/FindFOO.cmake:1:1",
                    "this find module never calls find_package_handle_standard_args",
                ),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for found in lint_cmake.findings(package, "package/consistency"):
            verb = "includes" if found.said[0].isupper() else "calls"
            yield self.report(found, f"this find module never {verb} {found.said}")
