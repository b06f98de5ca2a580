"""CM071: no blank stands between a command and its parenthesis."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Severity
from scaffold.api.ament import lint_cmake


class SpaceBeforeParenthesis(Rule):
    """A blank stands between a command and its ``(``.

    **Why.** ``ament_lint_cmake`` fails under ``colcon test``.

    **Fix.** Remove the blank.

    **Source.** ament_lint_cmake, filter ``whitespace/extra``; ROS 2 code style, CMake.
    """

    code = "CM071"
    name = "space-before-parenthesis"
    severity = Severity.WARNING
    examples = (
        Example("none", {"CMakeLists.txt": "if(A AND (B OR C))\nendif()\n"}),
        Example(
            "after if",
            {"CMakeLists.txt": "if (A)\nendif()\n"},
            reports=(
                Report(
                    "CMakeLists.txt:1:3",
                    'a blank stands between "if" and its "("',
                    fix="remove the blank",
                ),
            ),
            fixed={"CMakeLists.txt": "if(A)\nendif()\n"},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for found in lint_cmake.findings(package, "whitespace/extra"):
            path, start, end = found.source.path, found.start, found.end
            fix = None
            if not lint_cmake.outline(package, found.source).touches_literal(start, end):
                fix = Fix("remove the blank", (Edit(path, start, end, ""),))
            message = f'a blank stands between "{found.said}" and its "("'
            yield self.report(found, message, fix)
