"""CM076: commands of a CMake file are all in lower case."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Severity, Source
from scaffold.api.ament import lint_cmake


class CommandCaseMixed(Rule):
    """Commands in upper case and in lower case are mixed in one file.

    **Why.** ``ament_lint_cmake`` fails under ``colcon test``. What the first command is, it
    demands of all others; the style guide wants lower case.

    **Fix.** Write the commands in lower case.

    **Source.** ament_lint_cmake, filter ``readability/mixedcase``; ROS 2 code style, CMake.
    """

    code = "CM076"
    name = "command-case-mixed"
    severity = Severity.WARNING
    examples = (
        Example("lower case", {"CMakeLists.txt": "project(talker)\nif(A)\nendif()\n"}),
        Example(
            "one in upper case",
            {"CMakeLists.txt": "project(talker)\nIF(A)\nendif()\n"},
            reports=(
                Report(
                    "CMakeLists.txt:2:1",
                    '"IF" stands in a file whose first command is in lower case',
                    fix="write the commands in lower case",
                ),
            ),
            fixed={"CMakeLists.txt": "project(talker)\nif(A)\nendif()\n"},
        ),
        Example(
            "the first in upper case: the others are reported",
            {"CMakeLists.txt": "PROJECT(talker)\nif(A)\n"},
            reports=(
                Report(
                    "CMakeLists.txt:2:1",
                    '"if" stands in a file whose first command is in upper case',
                    fix="write the commands in lower case",
                ),
            ),
            fixed={"CMakeLists.txt": "project(talker)\nif(A)\n"},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        fixes: dict[str, Fix | None] = {}
        for found in lint_cmake.findings(package, "readability/mixedcase"):
            path = found.source.path
            if path not in fixes:
                fixes[path] = _lower(package, found.source)
            other = "lower" if found.said == found.said.upper() else "upper"
            message = f'"{found.said}" stands in a file whose first command is in {other} case'
            yield self.report(found, message, fixes[path])


def _lower(package: Package, source: Source) -> Fix | None:
    """Return one fix for the whole file, unless a word in question may be no command."""
    edits: list[Edit] = []
    commands = lint_cmake.outline(package, source).commands
    for line in lint_cmake.lines(source):
        start, end = line.start + line.name_start, line.start + line.name_end
        if line.command and line.command == line.command.upper() != line.command.lower():
            if start not in commands:
                return None
            edits.append(Edit(source.path, start, end, line.command.lower()))
    return Fix("write the commands in lower case", tuple(edits)) if edits else None
