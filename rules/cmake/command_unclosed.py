"""CM083: every command has its closing parenthesis."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity, ViewError
from scaffold.api.ament import lint_cmake
from scaffold.api.files import CMAKE_LISTS


class CommandUnclosed(Rule):
    """No ``)`` follows a command up to the end of the file.

    **Why.** CMake stops there; ``ament_lint_cmake`` fails under ``colcon test``. To the linter
    a ``#`` begins a comment even inside of a string and hides the ``)`` behind it.

    **Fix.** Close the command; break the line behind a string with a ``#``.

    **Source.** ament_lint_cmake, filter ``syntax``.
    """

    code = "CM083"
    name = "command-unclosed"
    severity = Severity.WARNING
    examples = (
        Example("closed", {"cmake/talker.cmake": "set(TALKER\n  1\n)\n"}),
        Example(
            "open",
            {"cmake/talker.cmake": "set(TALKER\n  1\n"},
            reports=(Report("cmake/talker.cmake:1:1", 'no ")" follows the "(" of set'),),
        ),
        Example(
            "hidden from the linter",
            {"cmake/talker.cmake": 'set(COLOUR "#fff")\n'},
            reports=(Report("cmake/talker.cmake:1:1", 'no ")" follows the "(" of set'),),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for found in lint_cmake.findings(package, "syntax"):
            if found.location.path == CMAKE_LISTS and _is_unparsable(package):
                continue  # that it cannot be parsed is said already
            yield self.report(found, f'no ")" follows the "(" of {found.said}')


def _is_unparsable(package: Package) -> bool:
    try:
        return not package.cmake
    except ViewError:
        return True
