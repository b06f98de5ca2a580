"""CM077: no command has upper and lower case in one word."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Severity
from scaffold.api.ament import lint_cmake


class CommandCaseWonky(Rule):
    """A command has capitals and small letters in one word.

    **Why.** ``ament_lint_cmake`` fails under ``colcon test``; the style guide wants lower case.

    **Fix.** Write it in lower case: CMake does not tell the cases apart.

    **Source.** ament_lint_cmake, filter ``readability/wonkycase``; ROS 2 code style, CMake.
    """

    code = "CM077"
    name = "command-case-wonky"
    severity = Severity.WARNING
    examples = (
        Example("lower case", {"CMakeLists.txt": "include(FetchContent)\n"}),
        Example(
            "as the documentation of a module spells it",
            {"CMakeLists.txt": "FetchContent_Declare(json)\n"},
            reports=(
                Report(
                    "CMakeLists.txt:1:1",
                    '"FetchContent_Declare" mixes cases: write "fetchcontent_declare"',
                    fix="write fetchcontent_declare",
                ),
            ),
            fixed={"CMakeLists.txt": "fetchcontent_declare(json)\n"},
        ),
        Example(
            "looks like a command, is an argument",
            {"CMakeLists.txt": "set(WORDS\n  Word(s)\n)\n"},
            reports=(Report("CMakeLists.txt:2:3", '"Word" mixes cases: write "word"'),),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for found in lint_cmake.findings(package, "readability/wonkycase"):
            source = found.source
            lower = found.said.lower()
            fix = None
            if found.start in lint_cmake.outline(package, source).commands:
                edit = Edit(source.path, found.start, found.end, lower)
                fix = Fix(f"write {lower}", (edit,))
            yield self.report(found, f'"{found.said}" mixes cases: write "{lower}"', fix)
