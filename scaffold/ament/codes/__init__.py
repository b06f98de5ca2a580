"""All codes for what ament's linters report on Jazzy: names, severities, fixes, documentation.

The codes of ament_flake8 and ament_pep257 are those of flake8 and pydocstyle, one line each in
``scaffold/data/style_codes.txt``; codes that ament's configuration disables are marked optional.
The other linters of ament have no codes: this project defines them, in one module per linter.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping

from scaffold.ament.codes import ament_copyright, ament_lint_cmake, ament_xmllint
from scaffold.ament.codes.code import (
    BOTH,
    COPYRIGHT,
    LINT_CMAKE,
    LINTERS,
    XMLLINT,
    AmentCode,
)
from scaffold.ament.finding import FLAKE8, PEP257
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.distributions import DATA
from scaffold.edits import Fix, Safety
from scaffold.source import Location

__all__ = [
    "CODES",
    "COPYRIGHT",
    "LINTERS",
    "LINT_CMAKE",
    "STYLE",
    "XMLLINT",
    "AmentCode",
    "diagnostic",
]

_STYLE_FILE = os.path.join(DATA, "style_codes.txt")
_STYLE_LINTERS = {"flake8": FLAKE8, "pep257": PEP257, "both": BOTH}


def _style_codes() -> Iterator[AmentCode]:
    with open(_STYLE_FILE, encoding="utf-8") as file:
        next(file)  # describes the columns
        for line in file:
            code, name, linters, severity, fix, summary = line.rstrip("\n").split(None, 5)
            safety = None if fix == "-" else Safety(fix)
            who = _STYLE_LINTERS[linters.rstrip("*")]
            row = AmentCode(code, name, summary, who, Severity(severity), safety)
            yield row._replace(is_optional=linters.endswith("*"))


STYLE: Mapping[str, AmentCode] = {row.code: row for row in _style_codes()}
"""The codes of Python style and docstrings, in alphabetical order."""
CODES: Mapping[str, AmentCode] = {
    row.code: row
    for row in sorted(
        [*STYLE.values(), *ament_lint_cmake.ROWS, *ament_copyright.ROWS, *ament_xmllint.ROWS]
    )
}
"""All codes in alphabetical order."""


def diagnostic(
    code: str,
    at: Location,
    message: str,
    fix: Fix | None = None,
    severity: Severity | None = None,
    cause: str = "",
) -> Diagnostic:
    """Return a diagnostic of a code, with the name and severity of the table."""
    row = CODES[code]
    return Diagnostic(code, row.name, severity or row.severity, at, message, fix, cause)
