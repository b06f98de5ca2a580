"""CM073: CMake files have no tabs."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Severity
from scaffold.api.ament import Finding, lint_cmake


class TabInCmake(Rule):
    """A line of a CMake file has a tab in it.

    **Why.** ``ament_lint_cmake`` fails under ``colcon test``.

    **Fix.** Indent by two blanks per tab; between words one blank.

    **Source.** ament_lint_cmake, filter ``whitespace/tabs``; ROS 2 code style, CMake.
    """

    code = "CM073"
    name = "tab-in-cmake"
    severity = Severity.WARNING
    examples = (
        Example("blanks", {"CMakeLists.txt": "if(A)\n  set(B 1)\nendif()\n"}),
        Example(
            "tabs",
            {"CMakeLists.txt": "if(A)\n\tset(B\t1)\nendif()\n"},
            reports=(
                Report(
                    "CMakeLists.txt:2:1", "a tab: ament_lint_cmake wants blanks", fix="write blanks"
                ),
            ),
            fixed={"CMakeLists.txt": "if(A)\n  set(B 1)\nendif()\n"},
        ),
        Example(
            "in a string: write \\t",
            {"CMakeLists.txt": 'set(B "a\tb")\n'},
            reports=(Report("CMakeLists.txt:1:9", "a tab: ament_lint_cmake wants blanks"),),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for found in lint_cmake.findings(package, "whitespace/tabs"):
            line = found.source.position(found.start)[0]
            start = found.source.offset(line)
            end = start + len(found.source.lines[line - 1])
            fix = None
            if not lint_cmake.outline(package, found.source).touches_literal(start, end):
                fix = Fix("write blanks", (_edit(found, start, end),))
            yield self.report(found, "a tab: ament_lint_cmake wants blanks", fix)


def _edit(found: Finding, start: int, end: int) -> Edit:
    text = found.source.text[start:end]
    rest = text.lstrip(" \t")
    indentation = text[: len(text) - len(rest)].replace("\t", "  ")
    return Edit(found.source.path, start, end, indentation + rest.replace("\t", " "))
