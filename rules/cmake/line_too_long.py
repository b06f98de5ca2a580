"""CM070: lines of CMake files have at most 140 characters."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.ament import lint_cmake

LONG = "set(WORDS " + "word " * 26 + "word)\n"


class LineTooLong(Rule):
    """A line of a CMake file has more than 140 characters.

    **Why.** ``ament_lint_cmake`` fails under ``colcon test``. A line that begins with a string is
    let pass, as it cannot be broken, unless it belongs to ``message()``, which takes several.

    **Fix.** Break the line; an argument per line reads best in a long list.

    **Source.** ament_lint_cmake, filter ``linelength``.
    """

    code = "CM070"
    name = "line-too-long"
    severity = Severity.WARNING
    examples = (
        Example("just fits", {"CMakeLists.txt": LONG.replace(" word)", ")")}),
        Example(
            "a string that cannot be broken",
            {"CMakeLists.txt": f'set(TEXT\n  "{"x" * 150}"\n)\n'},
        ),
        Example(
            "too long",
            {"CMakeLists.txt": LONG},
            reports=(
                Report("CMakeLists.txt:1:141", "145 characters: ament_lint_cmake allows 140"),
            ),
        ),
        Example(
            "a message can be broken",
            {"cmake/say.cmake": f'message(\n  "{"x" * 150}"\n)\n'},
            reports=(
                Report("cmake/say.cmake:2:141", "154 characters: ament_lint_cmake allows 140"),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for found in lint_cmake.findings(package, "linelength"):
            message = f"{found.said} characters: ament_lint_cmake allows {lint_cmake.LINE_LENGTH}"
            yield self.report(found, message)
