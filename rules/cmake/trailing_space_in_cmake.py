"""CM074: lines of CMake files do not end in blanks."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Severity
from scaffold.api.ament import lint_cmake


class TrailingSpaceInCmake(Rule):
    """A line of a CMake file ends in blanks.

    **Why.** ``ament_lint_cmake`` fails under ``colcon test``.

    **Fix.** Remove them; inside of a string that goes over several lines they count, and stay.

    **Source.** ament_lint_cmake, filter ``whitespace/eol``.
    """

    code = "CM074"
    name = "trailing-space-in-cmake"
    severity = Severity.WARNING
    examples = (
        Example("none", {"CMakeLists.txt": "project(talker)\n\n# A talker.\n"}),
        Example(
            "behind a command, a comment, and alone",
            {"CMakeLists.txt": "project(talker) \n  \n# A talker.\t\n"},
            reports=(
                Report("CMakeLists.txt:1:16", "the line ends in blanks", fix="remove the blanks"),
                Report("CMakeLists.txt:2:1", "the line ends in blanks", fix="remove the blanks"),
                Report("CMakeLists.txt:3:12", "the line ends in blanks", fix="remove the blanks"),
            ),
            fixed={"CMakeLists.txt": "project(talker)\n\n# A talker.\n"},
        ),
        Example(
            "in a string",
            {"cmake/text.cmake": 'set(TEXT "one \ntwo")\n'},
            reports=(Report("cmake/text.cmake:1:14", "the line ends in blanks"),),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for found in lint_cmake.findings(package, "whitespace/eol"):
            path, start, end = found.source.path, found.start, found.end
            fix = None
            if not lint_cmake.outline(package, found.source).touches_literal(start, end):
                fix = Fix("remove the blanks", (Edit(path, start, end, ""),))
            yield self.report(found, "the line ends in blanks", fix)
