"""CM080: CMake files have the names that CMake and its users expect."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.ament import lint_cmake

MODULE = "include(FindPackageHandleStandardArgs)\nfind_package_handle_standard_args(FOO)\n"


class CmakeFileName(Rule):
    """``CMakeLists.txt`` is spelt otherwise, or a find module is not in upper case.

    **Why.** CMake does not find a ``CMakelists.txt``: the package does not build. For
    ``FindFoo.cmake`` it is only ``ament_lint_cmake`` that fails, under ``colcon test``.

    **Fix.** Rename the file; a find module that other packages search as ``Foo`` keeps its name
    and gets the line ``# lint_cmake: -convention/filename``.

    **Source.** ament_lint_cmake, filter ``convention/filename``.
    """

    code = "CM080"
    name = "cmake-file-name"
    severity = Severity.WARNING
    examples = (
        Example("right", {"CMakeLists.txt": "project(talker)\n", "cmake/FindFOO.cmake": MODULE}),
        Example(
            "CMakelists.txt",
            {"CMakelists.txt": "project(talker)\n"},
            reports=(
                Report("CMakelists.txt:1:1", "CMake looks for CMakeLists.txt, spelt exactly so"),
            ),
        ),
        Example(
            "FindFoo.cmake",
            {"cmake/FindFoo.cmake": MODULE},
            reports=(
                Report(
                    "cmake/FindFoo.cmake:1:1",
                    "ament_lint_cmake wants upper case in names of find modules: FindFOO.cmake",
                ),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for found in lint_cmake.findings(package, "convention/filename"):
            if found.said == "CMakeLists.txt":
                message = "CMake looks for CMakeLists.txt, spelt exactly so"
            else:
                message = (
                    f"ament_lint_cmake wants upper case in names of find modules: {found.said}"
                )
            yield self.report(found, message)
