"""CM075: CMake files are indented by two blanks."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.ament import lint_cmake


class OddIndentation(Rule):
    """A line of a CMake file begins with an odd number of blanks.

    **Why.** ``ament_lint_cmake`` fails under ``colcon test``, in comments and strings as well.

    **Fix.** Indent by two blanks per level. No automatic fix: the line may have to go to the left
    or to the right.

    **Source.** ament_lint_cmake, filter ``whitespace/indent``; ROS 2 code style, CMake.
    """

    code = "CM075"
    name = "odd-indentation"
    severity = Severity.WARNING
    examples = (
        Example("two and four", {"CMakeLists.txt": "if(A)\n  set(\n    B\n    1)\nendif()\n"}),
        Example(
            "aligned with the word behind a parenthesis",
            {"CMakeLists.txt": "install(TARGETS a\n        DESTINATION lib)\nset(BEE a\n   b)\n"},
            reports=(
                Report(
                    "CMakeLists.txt:4:1",
                    "indented by 3 blanks: ament_lint_cmake wants steps of two",
                ),
            ),
        ),
        Example(
            "switched off for the file",
            {"CMakeLists.txt": "# lint_cmake: -whitespace/indent\nif(A)\n   set(B 1)\nendif()\n"},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for found in lint_cmake.findings(package, "whitespace/indent"):
            number = "one blank" if found.said == "1" else f"{found.said} blanks"
            yield self.report(found, f"indented by {number}: ament_lint_cmake wants steps of two")
