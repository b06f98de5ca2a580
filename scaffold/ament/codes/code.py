"""The metadata of a code that a linter of ament reports."""

from __future__ import annotations

from collections.abc import Mapping

from scaffold.ament.finding import FLAKE8, PEP257
from scaffold.diagnostic import Severity
from scaffold.edits import Safety
from scaffold.record import NamedTuple

BOTH = FLAKE8 | PEP257
LINT_CMAKE, XMLLINT, COPYRIGHT = 4, 8, 16
LINTERS: Mapping[int, str] = {
    FLAKE8: "ament_flake8",
    PEP257: "ament_pep257",
    LINT_CMAKE: "ament_lint_cmake",
    XMLLINT: "ament_xmllint",
    COPYRIGHT: "ament_copyright",
}
"""Flags of the linters that report a code."""


class AmentCode(NamedTuple):
    """The metadata of one code."""

    code: str
    name: str
    summary: str
    """One line about the problem; the default message of style findings."""
    linters: int = FLAKE8
    """The linters that report it; see `LINTERS`."""
    severity: Severity = Severity.WARNING
    """ERROR if the code fails when imported or run, or the package cannot be built."""
    fix: Safety | None = None
    """The safety of the fix, if there is one."""
    message: str = ""
    """An example of the message, from a test case."""
    documentation: str = ""
    """**Why.**, **Fix.** and **Source.**, if there is more to say than the summary."""
    other_severities: Mapping[Severity, str] | None = None
    """Severities that a diagnostic may have instead, each with the condition for it."""
    is_optional: bool = False
    """Whether it is only enabled by a package's own configuration."""
    release_refused: str = ""
    """Why it blocks a release, so that it is an error with `check --release`."""
