"""CM084: a pragma for ament_lint_cmake names filters that exist."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.ament import lint_cmake


class LintPragmaInvalid(Rule):
    """A ``# lint_cmake:`` comment has a word that is no filter with ``-`` or ``+``.

    **Why.** ``ament_lint_cmake`` ends in a traceback on it; no file of the package is checked,
    and ``colcon test`` reports an error.

    **Fix.** Write ``-`` or ``+`` and the name of a filter, separated by single commas.

    **Source.** ament_lint_cmake, ``SetFilters``.
    """

    code = "CM084"
    name = "lint-pragma-invalid"
    severity = Severity.ERROR
    examples = (
        Example("known", {"CMakeLists.txt": "# lint_cmake: -linelength, +whitespace/tabs\n"}),
        Example(
            "no sign",
            {"CMakeLists.txt": "# lint_cmake: linelength\n"},
            reports=(
                Report(
                    "CMakeLists.txt:1:1",
                    "'linelength' is no filter with - or +: ament_lint_cmake crashes on it",
                ),
            ),
        ),
        Example(
            "misspelt",
            {"CMakeLists.txt": "project(talker)\n# lint_cmake: -linelenght\n"},
            reports=(
                Report(
                    "CMakeLists.txt:2:1",
                    "'-linelenght' is no filter with - or +: ament_lint_cmake crashes on it",
                ),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for found in lint_cmake.findings(package, lint_cmake.PRAGMA_INVALID):
            message = f"{found.said!r} is no filter with - or +: ament_lint_cmake crashes on it"
            yield self.report(found, message)
