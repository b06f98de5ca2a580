"""CM078: what opens a block is not said again where it ends."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Severity
from scaffold.api.ament import Finding, lint_cmake

BLOCK_ENDS = {"else", "endforeach", "endfunction", "endif", "endmacro", "endwhile"}


class RepeatedCondition(Rule):
    """``else()``, ``endif()`` or alike repeats what opened the block.

    **Why.** ``ament_lint_cmake`` fails under ``colcon test``. CMake ignores the words there, so
    they go wrong unnoticed. The linter judges a line as a whole: a command with arguments behind
    ``endif()`` on the same line is reported as well.

    **Fix.** Leave the parentheses empty; put another command on a line of its own.

    **Source.** ament_lint_cmake, filter ``readability/logic``; ROS 2 code style, CMake.
    """

    code = "CM078"
    name = "repeated-condition"
    severity = Severity.WARNING
    examples = (
        Example("empty", {"CMakeLists.txt": "if(TALKER)\nelse()\nendif()\n"}),
        Example(
            "repeated",
            {"CMakeLists.txt": "if(TALKER)\nelse(TALKER)\nendif(TALKER)\n"},
            reports=(
                Report(
                    "CMakeLists.txt:2:1",
                    "else() repeats what opens its block; CMake ignores the words",
                    fix="leave the parentheses empty",
                ),
                Report(
                    "CMakeLists.txt:3:1",
                    "endif() repeats what opens its block; CMake ignores the words",
                    fix="leave the parentheses empty",
                ),
            ),
            fixed={"CMakeLists.txt": "if(TALKER)\nelse()\nendif()\n"},
        ),
        Example(
            "two commands on one line",
            {"CMakeLists.txt": "if(TALKER)\nendif() set(LISTENER 1)\n"},
            reports=(
                Report(
                    "CMakeLists.txt:2:1",
                    "endif() repeats what opens its block; CMake ignores the words",
                ),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for found in lint_cmake.findings(package, "readability/logic"):
            if found.said.lower() in BLOCK_ENDS:
                message = f"{found.said}() repeats what opens its block; CMake ignores the words"
            else:
                message = f"{found.said}() shares a line with the end of a block"
            yield self.report(found, message, _fix(found))


def _fix(found: Finding) -> Fix | None:
    text = found.source.text[found.start : found.end]
    name, _, arguments = text.partition("(")
    if found.said.lower() not in BLOCK_ENDS or any(c in arguments[:-1] for c in '()"['):
        return None
    start = found.start + len(name) + 1
    edit = Edit(found.source.path, start, found.end - 1, "")
    return Fix("leave the parentheses empty", (edit,))
