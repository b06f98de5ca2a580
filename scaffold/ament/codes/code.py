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
"""Who reports a code; the values of several are added up."""


class AmentCode(NamedTuple):
    """The metadata of one code."""

    code: str
    name: str
    summary: str
    """One line, what is wrong; the message of a style finding that has none of its own."""
    linters: int = FLAKE8
    """Who reports it; see `LINTERS`."""
    severity: Severity = Severity.WARNING
    """ERROR where the code fails when it is imported or run, or the package cannot be built."""
    fix: Safety | None = None
    """How the fix is applied, where the place is plain enough for one."""
    message: str = ""
    """What users read, for example; a test has the case that it belongs to."""
    documentation: str = ""
    """**Why.**, **Fix.** and **Source.**, where there is more to say than the summary."""
    other_severities: Mapping[Severity, str] | None = None
    """Severities that a diagnostic may have instead, each with the condition for it."""
    is_optional: bool = False
    """Whether only a configuration of a package's own asks for it."""
    release_refused: str = ""
    """Why no release is made of what has this flaw: then it is an error with `check --release`."""
